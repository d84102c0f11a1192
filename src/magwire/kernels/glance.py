"""What an observer sees of a moving wire at once, without a record of all its nodes."""

from __future__ import annotations

from math import cos, inf, sin, sqrt

from magwire.kernels._jit import kernel, part, short
from magwire.kernels.hinge import material_frame
from magwire.kernels.lanes import clear_rows
from magwire.kernels.vectors import combine, dot, norm, row, scale, sub
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.foundation import at_node, pressed_in
from magwire.kernels.wall.gap import fall
from magwire.kernels.wall.push import asked_at, query

GLANCE = 10
"""Numbers of a glance: tip (3), its direction (3), force on the tip, forces of the wall summed over
the wire, the largest of them over a patch, smallest clearance of the nodes."""


@kernel
def tip_direction(state, turn):
    """Unit tangent at the very tip, half an edge past where the last edge is seen.

    turn: rest curvature of the half cell before the tip, integrated; a free end bends no other way.
    """
    last = state.length.shape[0] - 1
    edge = sub(row(state.q, last + 1), row(state.q, last))
    t = scale(1.0 / norm(edge), edge)
    angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1])
    if state.held[0] == last + 1 or angle == 0.0:
        return t
    m1, m2 = material_frame(row(state.director, last), t, state.q[last, 3])
    aside = combine(turn[0], m1, turn[1], m2)
    return combine(cos(angle), t, sin(angle) / angle, aside)


@part
def force_up_to(rod, sums, place, i):
    """Sum of the wall's forces behind a place, and the node whose cell holds it, i or a later one.

    sums: as in ``largest_over``; a node's force is spread over its cell evenly.
    """
    while rod.cell_end[i] < place and i < rod.cell_end.shape[0] - 1:
        i += 1
    begin = rod.cell_end[i - 1] if i > 1 else 0.0
    share = (place - begin) / (rod.cell_end[i] - begin)
    return sums[i - 1] + min(max(share, 0.0), 1.0) * (sums[i] - sums[i - 1]), i


@part
def largest_over(rod, sums, held, patch):
    """Largest sum of the wall's forces over a stretch of wire: one of its ends is a cell's.

    sums: of the forces up to each node, from held - 1 on.
    """
    length = rod.station[rod.station.shape[0] - 1]
    best, a, b, c, d = 0.0, held, held, held, held
    for i in range(held, rod.station.shape[0]):
        if sums[i] == sums[i - 1]:
            continue
        begin = min(rod.cell_end[i - 1] if i > 1 else 0.0, length - patch)
        before, a = force_up_to(rod, sums, begin, a)
        behind, b = force_up_to(rod, sums, begin + patch, b)
        best = max(best, behind - before)
        begin = min(max(rod.cell_end[i] - patch, 0.0), length - patch)
        before, c = force_up_to(rod, sums, begin, c)
        behind, d = force_up_to(rod, sums, begin + patch, d)
        best = max(best, behind - before)
    return best


@part
def least_clearance(rod, lumen, wall, state, held):
    """Smallest clearance of the free nodes; what is known to be farther is not asked for."""
    least, fast = inf, fall(lumen)
    for i in range(state.q.shape[0] - 1, held, -1):
        x = row(state.q, i)
        known = wall.known[i]
        away = sub(x, (known[0], known[1], known[2]))
        if known[3] - fast * norm(away) - rod.offset[i] < least:
            if not asked_at(x, known):
                query(lumen, x, known, wall.jet[i])
            d = wall.jet[i, 0] - rod.offset[i]
            least = min(least, d + pressed_in(at_node(wall.bed, i), d, wall.gap))
    return least


@short
def glance(model, state, work, patch, turn, seen):
    """Fill ``seen`` [GLANCE], scaled; patch: length over which the largest force is looked for."""
    rod, wall, lumen = model.rod, model.wall, model.lumen
    held = state.held[0]
    last = state.q.shape[0] - 1
    tip, along = row(state.q, last), tip_direction(state, turn)
    for c in range(3):
        seen[c] = tip[c]
        seen[3 + c] = along[c]
    clear_rows(work.gradient, 0, last + 1)
    _, nearest = add_walls(rod, lumen, wall, state, held, work.gradient, work.no_band)
    total, sums = 0.0, work.step
    sums[held - 1] = 0.0
    for i in range(held, last + 1):
        g = row(work.gradient, i)
        total += sqrt(dot(g, g))
        sums[i] = total
    g = row(work.gradient, last)
    seen[6] = sqrt(dot(g, g))
    seen[7] = total
    seen[8] = largest_over(rod, sums, held, patch) if total > 0.0 else 0.0
    seen[9] = least_clearance(rod, lumen, wall, state, held)
