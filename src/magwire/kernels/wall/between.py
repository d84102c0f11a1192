"""Contact between the nodes: no point of an edge leaves the lumen (P-11).

An edge is a chord. Where the wall bulges towards it, as on the inside of a bend, its middle comes
nearer to the wall than its nodes do. Points that divide it into equal parts have a barrier of their
own, much thinner than that of the nodes: it acts only where the nodes' barrier leaves an edge
uncovered, and is zero elsewhere. The points keep a margin from the wall that the chords between
them cannot use up.
"""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel, part
from magwire.kernels.blocks import full, sym_scale
from magwire.kernels.scatter import add_block, add_diagonal, add_vector
from magwire.kernels.vectors import combine, dot, norm, row, sub
from magwire.kernels.wall.foundation import at_edge
from magwire.kernels.wall.gap import fall
from magwire.kernels.wall.push import asked_at, push, query

CAREFUL = 2.0  # bulges are sampled: what a chord may lose is taken this many times as much


@kernel
def thick_at(rod, j, s):
    """What the wall keeps from the axis at a part s of edge j: linear between its nodes."""
    return rod.offset[j] + s * (rod.offset[j + 1] - rod.offset[j])


@kernel
def keep_off(rod, between, j, s):
    """The same at the points of the edge, with their margin."""
    return thick_at(rod, j, s) + between.margin


@kernel
def clear_edge(between, q, j, reach):
    """Whether no point of edge j can feel the wall, also if its nodes move on by ``reach``."""
    known = between.clear[j]
    room = known[6] - reach
    x, y, z = q[j, 0] - known[0], q[j, 1] - known[1], q[j, 2] - known[2]
    u, v, w = q[j + 1, 0] - known[3], q[j + 1, 1] - known[4], q[j + 1, 2] - known[5]
    moved = max(x * x + y * y + z * z, u * u + v * v + w * w)
    return room >= 0.0 and moved <= room * room


@kernel
def slowed(fast, room, gap):
    """How far an edge's nodes may move before the gap at its points has fallen by ``room``.

    Also less the gap: see ``clear_edge``.
    """
    return room if fast == 1.0 else (room + gap) / fast - gap


@part
def remember(between, q, j, room):
    """Keep how far edge j may move from here on."""
    for c in range(3):
        between.clear[j, c] = q[j, c]
        between.clear[j, 3 + c] = q[j + 1, c]
    between.clear[j, 6] = room


@kernel
def bulge_at(bulges, jet):
    """How sharply the wall bulges near the ball that a remembered gap is from; -1 if not known.

    It is not known past the ends of the branches, where the wall flares out.
    """
    if jet[11] < 0.0 or bulges.value.shape[0] == 0:
        return -1.0
    branch = int(jet[11])
    first = bulges.first[branch]
    place = jet[10] * bulges.per_arc[branch]
    if not 0.0 <= place <= bulges.first[branch + 1] - first - 1:
        return -1.0
    return bulges.value[first + int(place + 0.5)]


@kernel
def bulge_in(grid, x):
    """How sharply a wall of triangles bulges around a point; -1 if not known."""
    if grid.value.shape[0] == 0:
        return -1.0
    i = (x[0] - grid.x0) * grid.per_cube
    j = (x[1] - grid.y0) * grid.per_cube
    k = (x[2] - grid.z0) * grid.per_cube
    nx, ny, nz = grid.value.shape
    if not (0.0 <= i < nx and 0.0 <= j < ny and 0.0 <= k < nz):
        return -1.0
    return grid.value[int(i), int(j), int(k)]


@kernel
def bulge_near(sheets, bulges, jet, x):
    """How sharply the wall bulges near a point whose gap is remembered; -1 if not known."""
    if len(sheets) == 0:
        return bulge_at(bulges, jet)
    else:
        return bulge_in(bulges, x)


@kernel
def dip(low, high, sagitta):
    """Least value between the ends of a chord of what falls below the straight line by a parabola.

    low, high: values at the ends; sagitta: by how much it falls in the middle.
    """
    rise = abs(high - low)
    least = min(low, high)
    if rise >= 4.0 * sagitta:
        return least
    return 0.5 * (low + high) - sagitta - rise * rise / (16.0 * sagitta)


@part
def sag(lumen, wall, q, j):
    """By how much the gap may fall below the straight line between the nodes of edge j, at most.

    -1 where that is not known, nor at a wall that moves. Asks for the gap at both nodes, so that it
    is known there.
    """
    if len(lumen.moving) > 0:
        return -1.0
    bulge = 0.0
    for i in range(j, j + 2):
        x, known = row(q, i), wall.known[i]
        if not asked_at(x, known):
            query(lumen, x, known, wall.jet[i])
        here = bulge_near(lumen.sheet, wall.between.bulges, wall.jet[i], x)
        if here < 0.0:
            return -1.0
        bulge = max(bulge, here)
    edge = sub(row(q, j + 1), row(q, j))
    return 0.125 * CAREFUL * bulge * dot(edge, edge)


@kernel
def left_at(rod, between, q, j, k, fast):
    """What is known to be left to the activation gap of point k of edge j.

    Also by how much less that is than when it was asked for, and where the point is.
    """
    s = k / between.parts
    x = combine(1.0 - s, row(q, j), s, row(q, j + 1))
    known = between.known[j, k]
    away = fast * norm(sub(x, (known[0], known[1], known[2])))
    return known[3] - keep_off(rod, between, j, s) - between.gap - away, away, x


@kernel
def left_at_ends(rod, wall, j, sagitta):
    """The same at the nodes of an edge whose ``sag`` is known, and was asked for last."""
    between = wall.between
    if sagitta < 0.0:
        return -inf, -inf
    low = wall.jet[j, 0] - keep_off(rod, between, j, 0.0) - between.gap
    return low, wall.jet[j + 1, 0] - keep_off(rod, between, j, 1.0) - between.gap


@kernel
def least_within(low, high, sagitta, part):
    """What is left at least in a part of an edge, from what is left at its ends; see ``sag``."""
    return -inf if sagitta < 0.0 else dip(low, high, sagitta * part * part)


@kernel
def press_edge(rod, lumen, wall, state, j, gradient, band, r):
    """Barrier of the points of edge j; r is the band's row of its first node.

    Returns the smallest clearance, +inf where no point feels the wall, and the energy.

    A part of the edge in which a point may feel the wall is halved, and the point in its middle
    asked for. Points come in their order: sums must not hang on what was known.
    """
    between = wall.between
    energy = 0.0
    nearest = inf
    stiffness = between.stiffness * rod.rest[j] / between.parts
    give, fast = at_edge(wall.bed, j), fall(lumen)
    sagitta = sag(lumen, wall, state.q, j)
    low, end = left_at_ends(rod, wall, j, sagitta)
    room = inf
    first, waiting = 0, 1  # points that wait to be the last of a part
    between.waiting[0] = between.parts
    while waiting > 0:
        last = between.waiting[waiting - 1]
        high = end
        if last < between.parts:
            high, away, x = left_at(rod, between, state.q, j, last, fast)
            if high < 0.0 and away > 0.0:
                query(lumen, x, between.known[j, last], between.jet[j, last])
                high, _, _ = left_at(rod, between, state.q, j, last, fast)
            room = min(room, high)
        if last - first > 1:
            least = least_within(low, high, sagitta, (last - first) / between.parts)
            if least < 0.0:
                between.waiting[waiting] = (first + last) // 2
                waiting += 1
                continue
            room = min(room, least)
        waiting -= 1
        first, low = last, high
        if last == between.parts or high >= 0.0:
            continue
        s = last / between.parts
        offset = keep_off(rod, between, j, s)
        x = combine(1.0 - s, row(state.q, j), s, row(state.q, j + 1))
        known, jet = between.known[j, last], between.jet[j, last]
        d, value, pushed, block = push(
            lumen, x, stiffness, between.gap, offset, known, jet, give, wall.easy
        )
        if d < inf:
            nearest = min(nearest, d)
            energy += value
            add_vector(gradient, j, 1.0 - s, pushed)
            add_vector(gradient, j + 1, s, pushed)
            if len(band) > 0:
                add_diagonal(band, r, sym_scale((1.0 - s) * (1.0 - s), block))
                add_diagonal(band, r + 4, sym_scale(s * s, block))
                add_block(band, r + 4, r, full(sym_scale(s * (1.0 - s), block)))
    remember(between, state.q, j, slowed(fast, room, between.gap))
    return nearest, energy


@part
def add_between(rod, lumen, wall, state, held, gradient, band):
    """Barrier energy of the edges past the last held node; see ``press_edge``."""
    energy = 0.0
    nearest = inf
    for j in range(held, state.length.shape[0]):
        if not clear_edge(wall.between, state.q, j, 0.0):
            r = 4 * (j - held + 1)
            d, value = press_edge(rod, lumen, wall, state, j, gradient, band, r)
            nearest = min(nearest, d)
            energy += value
    return nearest, energy
