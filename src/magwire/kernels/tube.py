"""The virtual tube around the centreline: what a navigator adds, and only the tip feels (P-19)."""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel, short
from magwire.kernels.scatter import add_diagonal, add_vector
from magwire.kernels.vectors import norm, row
from magwire.kernels.wall.collision import CAUTION, travel
from magwire.kernels.wall.foundation import RIGID
from magwire.kernels.wall.gap import fall
from magwire.kernels.wall.push import clear_of_wall, push


@kernel
def press(rod, tube, x):
    """Barrier of the tube on the tip at x; see ``wall.push``."""
    if clear_of_wall(x, tube.known[0], fall(tube.path), tube.gap + tube.offset):
        return inf, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    stiffness = tube.stiffness * rod.cell[rod.cell.shape[0] - 1]
    known, jet = tube.known[0], tube.jet[0]
    return push(tube.path, x, stiffness, tube.gap, tube.offset, known, jet, RIGID, known)


@short
def add_tube(rod, tube, state, held, gradient, band):
    """Barrier energy of the tip, if it is free: +inf outside of the tube; and its clearance."""
    tip = state.q.shape[0] - 1
    if not (tube.stiffness > 0.0 and held < tip):
        return 0.0, inf
    d, energy, pushed, block = press(rod, tube, row(state.q, tip))
    if d < inf:
        add_vector(gradient, tip, 1.0, pushed)
        if len(band) > 0:
            add_diagonal(band, 4 * (tip - held + 1), block)
    return energy, d


@short
def within_tube(tube, q, step, held, share):
    """The part of a share of a step that keeps the tip in the tube; see ``wall.allowed_part``."""
    tip = q.shape[0] - 1
    if tube.stiffness > 0.0 and held < tip:
        r = 4 * (tip - held + 1)
        x, dx = row(q, tip), (step[r], step[r + 1], step[r + 2])
        fast = fall(tube.path)
        reach = fast * share * norm(dx) / CAUTION + tube.offset
        if not clear_of_wall(x, tube.known[0], fast, reach):
            share = travel(tube.path, x, dx, tube.offset, tube.known[0], tube.jet[0], share)
    return share


@kernel
def tube_force(rod, tube, state, force, slope):
    """Force of the tube on the tip.

    Fills ``force`` [3] and its derivative by the tip's position, ``slope`` [3, 3].
    """
    _, _, pushed, h = press(rod, tube, row(state.q, state.q.shape[0] - 1))
    rows = (h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5])
    for i in range(3):
        force[i] = -pushed[i]
        for j in range(3):
            slope[i, j] = -rows[3 * i + j]
