"""What is read off a state: wall forces, clearances, stability."""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import FIRST, assemble, clear
from magwire.kernels.band import factor
from magwire.kernels.vectors import combine, row
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.gap import gap_value

FINEST = 1.0 / 24.0  # part of an edge that the search for its nearest point passes over, at most


@kernel
def nearest_on_edge(lumen, x, y, length, offset, least):
    """Smallest clearance along an edge from x to y, or ``least`` if that is smaller.

    The gap changes by no more than the way along the edge: a point whose clearance is larger than
    the least one so far tells that its neighbours are no nearer to the wall than that.
    """
    s = 0.0
    while s < 1.0:
        here = combine(1.0 - s, x, s, y)
        g, _, _, _ = gap_value(lumen, here[0], here[1], here[2])
        d = g - offset
        if d < inf:
            ahead = (d - least) / length
            least = min(least, d)
        else:
            ahead = 0.0
        s += max(FINEST, ahead)
    return least


@kernel
def observe(model, state, mouth, work, forces, clearance):
    """Read off a state what a record holds (P-8, P-13, P-16).

    Fills the force of the wall on every node, ``forces`` [N+1, 3], and the clearance of every
    free node, ``clearance`` [N+1]. Leaves the gradient of the energy, without inertia, in
    ``work.gradient``: of what is held, too (P-38).

    Returns
    -------
    middle
        Smallest clearance midway between two nodes.
    between
        Smallest clearance of all points of the edges, looked for in steps of ``FINEST``.
    stable
        Whether the tangent stiffness, without inertia, is positive definite.
    """
    rod, _, wall, lumen = model
    nodes = state.q.shape[0]
    held = mouth.held
    clear(work.gradient, 0, nodes)
    add_walls(rod, lumen, wall, state, held, work.gradient, work.no_band)
    for i in range(nodes):
        for c in range(3):
            forces[i, c] = -work.gradient[i, c]
    middle = inf
    between = inf
    for i in range(held, nodes):
        x = row(state.q, i)
        if i > held:
            g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
            clearance[i] = g - rod.offset[i]
            between = min(between, clearance[i])
        if i < nodes - 1:
            y = row(state.q, i + 1)
            offset = max(rod.offset[i], rod.offset[i + 1])
            x = combine(0.5, x, 0.5, y)
            g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
            middle = min(middle, g - offset)
    for j in range(held, nodes - 1):
        x, y = row(state.q, j), row(state.q, j + 1)
        offset = max(rod.offset[j], rod.offset[j + 1])
        between = nearest_on_edge(lumen, x, y, state.length[j], offset, between)
    if held == nodes - 1:
        return middle, between, True
    assemble(model, state, mouth, Motion(0.0, work.target), work.gradient, work.band)
    stable = factor(work.band, FIRST, 4 * (nodes - held + 1) - 1) < 0
    return middle, between, stable
