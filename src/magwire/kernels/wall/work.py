"""What a wall that moves does to the wire (P-40)."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import add, dot, row, scale, sub
from magwire.kernels.wall.motion import came_from
from magwire.kernels.wall.traction import held_by, read_loads


@kernel
def count_half(movings, model, state, there, work):
    """Add to the work of the wall that of its forces at one end of a step: half of it.

    Forces across the wall and along it, on the way that the wall has gone in the step.

    Parameters
    ----------
    movings
        The wall's motion; nothing is done without one.
    model, work
        Rod, field, wall and lumen; scratch arrays.
    state
        Whose contacts hold the friction at that end, and whose work it is.
    there
        Where the wire is: at the end, or at the beginning, carried along with the wall.
    """
    if len(movings) > 0:
        rod, wall, lumen = model.rod, model.wall, model.lumen
        held = state.held[0]
        read_loads(rod, lumen, wall, there, held, work.gradient, work.no_band)
        for i in range(held + 1, state.q.shape[0]):
            force = add(scale(-1.0, row(work.gradient, i)), held_by(wall.friction, rod, state, i))
            if force != (0.0, 0.0, 0.0):
                x = row(there.q, i)
                state.spent[1] += 0.5 * dot(force, sub(x, came_from(movings, x)))
