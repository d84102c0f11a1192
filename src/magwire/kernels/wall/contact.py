"""What the wall adds to energy, gradient and Hessian (P-11, P-13)."""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import short
from magwire.kernels.groups import group, numbers, places, rows
from magwire.kernels.scatter import add_diagonal, add_vector
from magwire.kernels.vectors import row
from magwire.kernels.wall.between import add_between
from magwire.kernels.wall.gap import fall
from magwire.kernels.wall.push import all_clear, press


@short
def add_walls(rod, lumen, wall, state, held, gradient, band):
    """Barrier energy of the wire past the last held node (P-11, P-13).

    Returns
    -------
    energy
        +inf if any point is in the wall.
    nearest
        Smallest clearance of the points that feel the wall; +inf if none does.
    """
    energy = 0.0
    nearest = inf
    tip, fast = state.q.shape[0] - 1, fall(lumen)
    for begin in range(held + 1, tip + 1, 4):
        g = group(begin, tip)
        reach = wall.gap + numbers(rod.offset, g)
        if all_clear(places(state.q, g), rows(wall.known, g), fast, reach):
            continue
        for i in range(begin, min(begin + 4, tip + 1)):
            d, value, pushed, block = press(rod, lumen, wall, row(state.q, i), i)
            if d < inf:
                nearest = min(nearest, d)
                energy += value
                add_vector(gradient, i, 1.0, pushed)
                if len(band) > 0:
                    add_diagonal(band, 4 * (i - held + 1), block)
    if wall.between.parts > 1 and held < tip:
        d, value = add_between(rod, lumen, wall, state, held, gradient, band)
        nearest = min(nearest, d)
        energy += value
    return energy, nearest
