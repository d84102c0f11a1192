"""What is read off a state: wall forces, clearances, stability."""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import FIRST, add_walls, assemble, clear
from magwire.kernels.band import factor
from magwire.kernels.gap import gap_value
from magwire.kernels.vectors import combine, row


@kernel
def observe(model, state, mouth, work, forces, clearance):
    """Read off a state what a record holds (P-8, P-13, P-16).

    Fills the force of the wall on every node, ``forces`` [N+1, 3], and the clearance of every
    free node, ``clearance`` [N+1]; returns the smallest clearance midway between two nodes, and
    whether the tangent stiffness, without inertia, is positive definite. Leaves the gradient of
    the energy, without inertia, in ``work.gradient``: of what is held, too (P-38).
    """
    rod, _, wall, lumen = model
    nodes = state.q.shape[0]
    held = mouth.held
    clear(work.gradient, 0, nodes)
    add_walls(rod, lumen, wall, state, mouth, work.gradient, work.no_band)
    for i in range(nodes):
        for c in range(3):
            forces[i, c] = -work.gradient[i, c]
    between = inf
    for i in range(held, nodes):
        x = row(state.q, i)
        if i > held:
            g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
            clearance[i] = g - rod.offset[i]
        if i < nodes - 1:
            x = combine(0.5, x, 0.5, row(state.q, i + 1))
            g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
            between = min(between, g - max(rod.offset[i], rod.offset[i + 1]))
    if held == nodes - 1:
        return between, True
    assemble(model, state, mouth, Motion(0.0, work.target), work.gradient, work.band)
    return between, factor(work.band, FIRST, 4 * (nodes - held + 1) - 1) < 0
