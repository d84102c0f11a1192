"""How far a step may go before a point could cross the wall (P-8).

The gap is 1-Lipschitz, so a point may move by less than its gap. Repeating that along the step
(conservative advancement) is an exact collision test that lets a point slide along the wall.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel, part, short
from magwire.kernels.groups import group, numbers, places, rows
from magwire.kernels.lanes import load, transposed
from magwire.kernels.vectors import combine, norm, row
from magwire.kernels.wall.between import (
    clear_edge,
    keep_off,
    least_within,
    left_at,
    left_at_ends,
    sag,
)
from magwire.kernels.wall.gap import fall, gap_value, slopes
from magwire.kernels.wall.push import all_clear, asked_at, clear_of_wall, query

CAUTION = 0.9  # part of the safe distance that one hop uses
CLOSEST = 0.1  # a step may shrink the clearance to this part of itself, not further
HOPS = 200


@kernel
def free_way(lumen, g, safe, offset):
    """By how much the gap may fall before what the wall keeps from a point, ``offset``, is used up.

    ``safe`` is for a point without one. Past an open end, where it is less than the gap, it may be
    less than the offset, too, of a point that is clear: there the slope of the gap says how far.
    """
    return max(safe - offset, min((g - offset) / slopes(lumen.sheet)[0], safe))


@kernel
def travel(lumen, x, dx, offset, known, jet, limit):
    """Largest part of the step dx, at most ``limit``, that a point x near the wall may take."""
    length = fall(lumen) * norm(dx)
    if not asked_at(x, known):
        query(lumen, x, known, jet)
    start = free_way(lumen, jet[0], known[3], offset)
    share = 0.0
    free = start
    for _ in range(HOPS):
        share += CAUTION * free / length
        if share >= limit:
            return limit
        here = combine(1.0, x, share, dx)
        g, _, _, safe = gap_value(lumen, here[0], here[1], here[2])
        free = free_way(lumen, g, safe, offset)
        if free < CLOSEST * start:
            return share
    return share


@part
def edge_part(rod, lumen, wall, q, step, j, r, limit):
    """Largest part of a step, at most ``limit``, that the points of edge j may take.

    r is the row of its first node.
    """
    between = wall.between
    dx, dy = (step[r], step[r + 1], step[r + 2]), (step[r + 4], step[r + 5], step[r + 6])
    fast = fall(lumen)
    if clear_edge(between, q, j, limit * max(norm(dx), norm(dy)) / CAUTION - between.gap):
        return limit
    leeway = wall.bed.deepest
    spare = between.gap + leeway  # what a point may use up besides what is left to its barrier
    sagitta = sag(lumen, wall, q, j)
    low, end = left_at_ends(rod, wall, j, sagitta)
    first, waiting = 0, 1  # as in ``press_edge``
    between.waiting[0] = between.parts
    while waiting > 0:
        last = between.waiting[waiting - 1]
        s = last / between.parts
        move = combine(1.0 - s, dx, s, dy)
        high, away, here = left_at(rod, between, q, j, last, fast)
        if last == between.parts:
            high = end
        elif high + spare < fast * limit * norm(move) / CAUTION and away > 0.0:
            query(lumen, here, between.known[j, last], between.jet[j, last])
            high, _, _ = left_at(rod, between, q, j, last, fast)
        if last - first > 1:
            least = least_within(low, high, sagitta, (last - first) / between.parts)
            if least + spare < fast * limit * max(norm(dx), norm(dy)) / CAUTION:
                between.waiting[waiting] = (first + last) // 2
                waiting += 1
                continue
        waiting -= 1
        first, low = last, high
        if last < between.parts and high + spare < fast * limit * norm(move) / CAUTION:
            offset = keep_off(rod, between, j, s) - leeway
            known, jet = between.known[j, last], between.jet[j, last]
            limit = travel(lumen, here, move, offset, known, jet, limit)
    return limit


@kernel
def allowed_between(rod, lumen, wall, q, step, held, limit):
    """Largest part of a step, at most ``limit``, that keeps the points between the nodes inside."""
    if wall.between.parts > 1:
        for j in range(held, q.shape[0] - 1):
            limit = edge_part(rod, lumen, wall, q, step, j, 4 * (j - held + 1), limit)
    return limit


@short
def allowed_part(rod, lumen, wall, q, step, held, leeway):
    """Largest part of a step (rows of the band's layout) that keeps the nodes inside.

    Where it takes points between the nodes into the wall, their energy is infinite, and
    ``allowed_between`` says how far they may go: it is asked only then. A chord between two nodes
    that stayed inside cannot have gone through the wall of a tree on the way.
    leeway: how far into the wall the way may lead, of a step that is known to end inside.
    """
    share, fast = 1.0, fall(lumen)
    nodes = q.shape[0]
    lead = 4 * (held - 1)
    leeway += wall.bed.deepest
    for begin in range(held + 1, nodes, 4):
        g = group(begin, nodes - 1)
        dx, dy, dz, _ = transposed(
            load(step, 4 * g[0] - lead, 0),
            load(step, 4 * g[1] - lead, 0),
            load(step, 4 * g[2] - lead, 0),
            load(step, 4 * g[3] - lead, 0),
        )
        far = fast * share / CAUTION
        reach = far * norm((dx, dy, dz)) + (numbers(rod.offset, g) - leeway)
        if all_clear(places(q, g), rows(wall.known, g), fast, reach):
            continue
        for i in range(begin, min(begin + 4, nodes)):
            r = 4 * i - lead
            x, move = row(q, i), (step[r], step[r + 1], step[r + 2])
            offset, far = rod.offset[i] - leeway, fast * share / CAUTION
            if not clear_of_wall(x, wall.known[i], fast, far * norm(move) + offset):
                share = travel(lumen, x, move, offset, wall.known[i], wall.jet[i], share)
    return share
