"""Steps that follow a curved wall instead of ending where they meet it (P-8).

A straight step along a wall of radius R comes to it after sqrt(2 R d), if the clearance is d. Where
a large force holds a point close to the wall, that is far less than the point has to slide.
"""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import combine, norm, row
from magwire.kernels.wall.between import clear_edge, keep_off
from magwire.kernels.wall.foundation import at_edge, at_node, pressed_in
from magwire.kernels.wall.gap import fall, gap_jet
from magwire.kernels.wall.push import asked_at, clear_of_wall, query

KEPT = 0.5  # part of its clearance that a point keeps
PASSES = 3  # of pushing a point back: the gap falls by one for each length along its gradient


@kernel
def push_back(lumen, x, dx, offset, known, jet, yielding):
    """A step dx of a point near the wall, changed so that it ends inside the wall as it is.

    yielding: how the wall gives way at the point, and the barrier's activation gap there.
    """
    if not asked_at(x, known):
        query(lumen, x, known, jet)
    give, gap = yielding
    offset -= pressed_in(give, jet[0] - offset, gap)
    least = offset + KEPT * min(jet[0] - offset, norm(dx))
    for _ in range(PASSES):
        there = combine(1.0, x, 1.0, dx)
        g, _, _, _, n, _ = gap_jet(lumen, there[0], there[1], there[2])
        if g >= least or g == -inf:
            break
        dx = combine(1.0, dx, least - g, n)
    return dx


@kernel
def add_move(way, r, factor, dx):
    """Add factor * dx to the step at a row."""
    for c in range(3):
        way[r + c] += factor * dx[c]


@kernel
def slide(rod, lumen, wall, q, step, held, part, way):
    """Fill ``way`` with part * step (rows of the band's layout), bent along the wall."""
    nodes = q.shape[0]
    lead = 4 * (held - 1)
    for r in range(4 * (nodes - held + 1)):
        way[r] = part * step[r]
    fast = fall(lumen)
    for i in range(held + 1, nodes):
        r = 4 * i - lead
        x, dx = row(q, i), (way[r], way[r + 1], way[r + 2])
        if not clear_of_wall(x, wall.known[i], fast, fast * norm(dx) + rod.offset[i]):
            give = at_node(wall.bed, i), wall.gap
            bent = push_back(lumen, x, dx, rod.offset[i], wall.known[i], wall.jet[i], give)
            add_move(way, r, 1.0, combine(1.0, bent, -1.0, dx))
    between = wall.between
    if between.parts < 2:
        return
    for j in range(held, nodes - 1):
        r = 4 * j - lead
        dx, dy = (way[r], way[r + 1], way[r + 2]), (way[r + 4], way[r + 5], way[r + 6])
        x, y = row(q, j), row(q, j + 1)
        if clear_edge(between, q, j, max(norm(dx), norm(dy)) - between.gap):
            continue
        for k in range(1, between.parts):
            s = k / between.parts
            offset = keep_off(rod, between, j, s)
            here = combine(1.0 - s, x, s, y)
            move = combine(
                1.0 - s, (way[r], way[r + 1], way[r + 2]), s, (way[r + 4], way[r + 5], way[r + 6])
            )
            known = between.known[j, k]
            if not clear_of_wall(here, known, fast, fast * norm(move) + offset):
                give = at_edge(wall.bed, j), between.gap
                bent = push_back(lumen, here, move, offset, known, between.jet[j, k], give)
                change = combine(1.0, bent, -1.0, move)
                if j > held:
                    add_move(way, r, 1.0, change)
                add_move(way, r + 4, 1.0 if j > held else 1.0 / s, change)
