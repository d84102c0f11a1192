"""What is read off a state: wall forces, clearances, stability."""

from __future__ import annotations

from math import inf, nan, sqrt

from magwire.kernels._jit import kernel, part
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.centreline import FIRST as FIRST_PIECE
from magwire.kernels.centreline import PIECES, SPACING, spline
from magwire.kernels.hinge import material_frame
from magwire.kernels.lanes import clear_rows
from magwire.kernels.sheet import (
    CLEARANCE_ALONG,
    CLEARANCE_MIDPOINT,
    FACTORISATIONS,
    FEED,
    FIRST_CONTACT_FEED,
    FRICTION_WORK,
    GUIDE_TORQUE,
    GUIDE_TWIST,
    INSERTION_FORCE,
    MAX_TIP_FORCE,
    MEAN_TIP_FORCE,
    NEWTON_ITERATIONS_TOTAL,
    PUSH_FORCE,
    RETRIES,
    STABLE,
    STEPS,
    TIP_FORCE,
    TIP_OFFSET,
    TIP_TWIST,
    WALL_WORK,
)
from magwire.kernels.sources.steer import field_of
from magwire.kernels.vectors import add, combine, cross, dot, norm, row, scale, sub
from magwire.kernels.wall.between import thick_at
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.foundation import at_edge, at_node, pressed_in
from magwire.kernels.wall.gap import fall, gap_jet, gap_value, slopes
from magwire.kernels.wall.motion import at_rest, displacement_at, pace
from magwire.kernels.wall.onward import hold_walls, positive
from magwire.kernels.wall.traction import SLID

GUARD = 1e-9  # for rounding, in wire lengths
FINEST = 1.0 / 24.0  # part of an edge that the search for its nearest point passes over, at most


@part
def hop(lumen, x, t, offset, least):
    """Clearance of a point, and how far along t no other has less than ``least``.

    The point's ball is part of the lumen: g + rho - |x + s t - c| is what it leaves at s, with the
    distance rho of the point from the ball's centre, which is at least the smallest radius less g.
    Past an open end, and of a wall of triangles, there is no such ball: the gap changes by no more
    than the way times its slope.
    """
    if slopes(lumen.sheet)[1] > 1.0:
        g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
        return (inf, 0.0) if g == inf else (g - offset, max(g - offset - least, 0.0) / fall(lumen))
    g, _, _, safe, n, _ = gap_jet(lumen, x[0], x[1], x[2])
    if g == inf:
        return inf, 0.0
    d = g - offset
    above = d - least
    fast = pace(lumen.moving)
    if above <= 0.0 or safe != g or fast > 1.0:
        return d, max(above, 0.0) / fast
    rho = max(lumen.margin - g, 0.0)
    slope = rho * dot(n, t)
    return d, slope + sqrt(slope * slope + above * (above + 2.0 * rho))


@kernel
def slope_along(rod, lumen, state, j):
    """Largest change of the clearance along edge j, per length of it."""
    widens = abs(rod.offset[j + 1] - rod.offset[j]) / state.length[j]
    return fall(lumen) + widens, widens


@part
def far_along(rod, lumen, state, j, known, least):
    """Whether no point of edge j has less than ``least``.

    known: clearances of its ends and its middle from a wall at rest; one that gives way is farther.
    """
    before, middle, after = known
    drop = 0.5 * slope_along(rod, lumen, state, j)[0] * state.length[j]
    lowest = 0.5 * (middle + min(before, after) - drop)
    return max(before, middle, after) < inf and lowest > least + GUARD


@kernel
def nearest_on_edge(rod, lumen, state, j, least):
    """Smallest clearance along edge j, or ``least`` if that is smaller."""
    x, y, length = row(state.q, j), row(state.q, j + 1), state.length[j]
    t = scale(1.0 / length, sub(y, x))
    steep, widens = slope_along(rod, lumen, state, j)
    s = 0.0
    while s < 1.0:
        d, ahead = hop(lumen, combine(1.0 - s, x, s, y), t, thick_at(rod, j, s), least)
        if widens > 0.0:
            ahead = max(d - least, 0.0) / steep
        least = min(least, d)
        s += max(FINEST, ahead / length)
    return least


@kernel
def clearance_at(lumen, x, offset):
    """Distance of a point of the wire from the wall where that is at rest."""
    g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
    return g - offset


@part
def nearest_in_bed(rod, lumen, wall, state, j, least):
    """Smallest clearance along edge j from a wall that gives way, or ``least`` if that is smaller.

    Between the points at which it is pressed the wall's indentation is linear along the edge.
    """
    between, fast = wall.between, fall(lumen)
    x, y = row(state.q, j), row(state.q, j + 1)
    widens = abs(rod.offset[j + 1] - rod.offset[j]) / state.length[j]
    part = state.length[j] / between.parts
    sunk = 0.0
    for k in range(between.parts + 1):
        s = k / between.parts
        d = clearance_at(lumen, combine(1.0 - s, x, s, y), thick_at(rod, j, s))
        give = at_edge(wall.bed, j)
        if k == 0:
            give = at_node(wall.bed, j)
        elif k == between.parts:
            give = at_node(wall.bed, j + 1)
        after = pressed_in(give, d, wall.gap)
        if k > 0:
            steep = fast + widens + abs(after - sunk) / part
            here = 0.0
            while here < 1.0:
                share = (k - 1 + here) / between.parts
                point = combine(1.0 - share, x, share, y)
                bed = (1.0 - here) * sunk + here * after
                d = clearance_at(lumen, point, thick_at(rod, j, share)) + bed
                ahead = (d - least) / steep
                least = min(least, d)
                here += max(FINEST * between.parts, ahead / part)
        sunk = after
    return least


@kernel
def nearest_along(rod, lumen, wall, state, j, least):
    """Smallest clearance along edge j, or ``least`` if that is smaller."""
    if wall.bed.deepest > 0.0:
        return nearest_in_bed(rod, lumen, wall, state, j, least)
    return nearest_on_edge(rod, lumen, state, j, least)


@part
def read_frames(state, directors):
    """Fill ``directors`` [N, 3] with the material director m1 of the edge from each node.

    The tip has its edge's. Returns the twist of the tip: that of the guide, and what the wire
    between them is twisted by.
    """
    last = state.length.shape[0] - 1
    for j in range(1, last + 1):
        m1, _ = material_frame(row(state.director, j), row(state.tangent, j), state.q[j, 3])
        for c in range(3):
            directors[j - 1, c] = m1[c]
    for c in range(3):
        directors[last, c] = directors[last - 1, c]
    twist = state.q[last, 3]
    for i in range(state.held[0], last + 1):
        twist += state.twist[i]
    return twist


@kernel
def off_centreline(path, x):
    """Distance of a point from the centreline of a single tube; nan where no voxel holds it."""
    _, s, branch, _ = gap_value(path, x[0], x[1], x[2])
    if branch < 0:
        return nan
    x = at_rest(path.moving, x[0], x[1], x[2])
    only = path.branches[0]
    inside = min(max(s, 0.0), only[SPACING] * only[PIECES])
    piece = min(int(inside / only[SPACING]), int(only[PIECES]) - 1)
    t = inside - piece * only[SPACING]
    c, c1, _, _ = spline(path.coefficients, int(only[FIRST_PIECE]) + piece, t)
    centre = combine(1.0, (c[0], c[1], c[2]), s - inside, (c1[0], c1[1], c1[2]))
    return norm(sub(x, centre))


@part
def read_contact(model, state, held, work, sheet, scales):
    """Forces of the wall and clearances, in SI (P-8, P-13); the smallest ones, scaled.

    Returns
    -------
    middle
        Smallest clearance midway between two nodes.
    between
        Smallest clearance of all points of the edges, looked for in steps of ``FINEST``.
    """
    rod, wall, lumen = model.rod, model.wall, model.lumen
    nodes = state.q.shape[0]
    length, force = scales
    clear_rows(work.gradient, 0, nodes)
    add_walls(rod, lumen, wall, state, held, work.gradient, work.no_band)
    middle = inf
    between = inf
    for i in range(1, nodes):
        clearance, sunk = nan, 0.0
        if i > held:
            clearance = clearance_at(lumen, row(state.q, i), rod.offset[i])
            sunk = pressed_in(at_node(wall.bed, i), clearance, wall.gap)
            clearance += sunk
            between = min(between, clearance)
        sheet.clearance[i - 1] = clearance * length
        sheet.wall_indentation[i - 1] = sunk * length
        for c in range(3):
            sheet.contact_force[i - 1, c] = -work.gradient[i, c] * force
    before = clearance_at(lumen, row(state.q, held), rod.offset[held])
    for j in range(held, nodes - 1):
        x, y = row(state.q, j), row(state.q, j + 1)
        d = clearance_at(lumen, combine(0.5, x, 0.5, y), thick_at(rod, j, 0.5))
        middle = min(middle, d + pressed_in(at_edge(wall.bed, j), d, wall.gap))
        after = sheet.clearance[j] / length - sheet.wall_indentation[j] / length
        if not far_along(rod, lumen, state, j, (before, d, after), between):
            between = nearest_along(rod, lumen, wall, state, j, between)
        before = after
    return middle, between


@part
def squeeze(rod, guide, state, mouth):
    """Force with which the bend at the guide's mouth squeezes the wire out of the guide (P-38).

    It is minus the derivative of the energy by the part of the mouth's hinge that is past the
    entrance, per length of it; none where the wire is released node by node (P-15).
    """
    held, share = mouth.held, mouth.fraction
    if held >= state.tangent.shape[0] or not guide.sliding:
        return 0.0
    te, tf = row(state.tangent, held - 1), row(state.tangent, held)
    binormal = scale(2.0 / (1.0 + dot(te, tf)), cross(te, tf))
    e1, e2 = material_frame(row(state.director, held - 1), te, state.q[held - 1, 3])
    f1, f2 = material_frame(row(state.director, held), tf, state.q[held, 3])
    kappa1 = dot(combine(0.5, e2, 0.5, f2), binormal) / share
    kappa2 = -dot(combine(0.5, e1, 0.5, f1), binormal) / share
    twist = (state.q[held, 3] - state.q[held - 1, 3] + state.twist[held]) / share
    r1, r2 = rod.rest_curvature[held, 0], rod.rest_curvature[held, 1]
    bent = kappa1 * kappa1 + kappa2 * kappa2 - (r1 * r1 + r2 * r2)
    density = 0.5 * rod.bend[held] * bent + 0.5 * rod.twist[held] * twist * twist
    return density / rod.cell[held]


@part
def read_guide(rod, guide, state, mouth, gradient, sheet, scales):
    """Push along the guide and torque about it, of the guide on the wire in front (P-38), in SI.

    What the guide holds of the wire in front is an edge: two nodes, one angle. ``gradient`` is that
    of the energy without inertia.
    """
    length, force = scales
    j = mouth.held - 1
    edge = add(row(gradient, j), row(gradient, j + 1))
    push = dot(edge, (guide.direction[0], guide.direction[1], guide.direction[2])) * force
    sheet.numbers[PUSH_FORCE] = push
    sheet.numbers[INSERTION_FORCE] = push - squeeze(rod, guide, state, mouth) * force
    sheet.numbers[GUIDE_TORQUE] = gradient[j, 3] * force * length


@kernel
def read_tally(tally, sheet, scales):
    """What the steps so far add up to."""
    length, force = scales
    steps, taken, factored, retried = 0, 1, 2, 3
    largest, total, first = tally.forces[0], tally.forces[1], tally.forces[2]
    numbers, counts = sheet.numbers, tally.counts
    numbers[MAX_TIP_FORCE] = largest * force
    numbers[MEAN_TIP_FORCE] = total / max(counts[steps], 1.0) * force
    numbers[FIRST_CONTACT_FEED] = first * length if first >= 0.0 else nan
    numbers[STEPS] = counts[steps]
    numbers[NEWTON_ITERATIONS_TOTAL] = counts[taken]
    numbers[FACTORISATIONS] = counts[factored]
    numbers[RETRIES] = counts[retried]


@part
def stiff(model, state, mouth, work):
    """Whether the tangent stiffness, without inertia, is positive definite (P-16).

    Leaves the gradient of the energy, of what is held, too, in ``work.gradient``.
    """
    nodes, held = state.q.shape[0], mouth.held
    if held == nodes - 1:
        return True
    rod, wall, lumen = model.rod, model.wall, model.lumen
    hold_walls(wall.friction, rod, lumen, wall, state, held, work)
    assemble(model, state, mouth, Motion(0.0, work.target), work.gradient, work.band)
    last = 4 * (nodes - held + 1) - 1
    return positive(wall.friction, state, held, work, FIRST, last)


@kernel
def observe(model, path, guide, state, mouth, work, sheet, scales):
    """Fill a record's sheet with what a state says, in SI (P-8, P-13, P-16).

    Parameters
    ----------
    path
        The way to the target, as a single tube.
    sheet
        What is there of the outside field is left as it is; so are the numbers that Python counts.
    scales
        Of length and force.
    """
    rod, field, lumen = model.rod, model.field, model.lumen
    length, force = scales
    numbers, nodes, held = sheet.numbers, state.q.shape[0], mouth.held
    middle, between = read_contact(model, state, held, work, sheet, scales)
    numbers[CLEARANCE_MIDPOINT] = middle * length if middle < inf else nan
    numbers[CLEARANCE_ALONG] = between * length if between < inf else nan
    numbers[TIP_FORCE] = norm(row(sheet.contact_force, nodes - 2))
    numbers[STABLE] = 1.0 if stiff(model, state, mouth, work) else 0.0
    read_guide(rod, guide, state, mouth, work.gradient, sheet, scales)
    numbers[TIP_TWIST] = read_frames(state, sheet.material_director)
    for i in range(1, nodes):
        u = displacement_at(lumen.moving, row(state.q, i)) if i > held else (0.0, 0.0, 0.0)
        sheet.slip[i - 1] = state.contact[i, SLID] * length
        for c in range(3):
            sheet.position[i - 1, c] = state.q[i, c] * length
            sheet.wall_displacement[i - 1, c] = u[c] * length
    tip = row(state.q, nodes - 1)
    numbers[TIP_OFFSET] = off_centreline(path, tip) * length
    made = field_of(field.sources, field.strength, tip, False)[0]
    for c in range(3):
        sheet.flux_density[c] = made[c]
    for c in range(state.inputs.shape[0]):
        sheet.inputs[c] = state.inputs[c]
    numbers[FEED] = state.guide[0] * length
    numbers[GUIDE_TWIST] = state.guide[1]
    numbers[FRICTION_WORK] = state.spent[0] * force * length
    numbers[WALL_WORK] = state.spent[1] * force * length
