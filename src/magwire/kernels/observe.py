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
from magwire.kernels.vectors import combine, dot, norm, row, scale, sub
from magwire.kernels.wall.between import thick_at
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.foundation import at_edge, at_node, pressed_in
from magwire.kernels.wall.gap import gap_jet, gap_value, slopes
from magwire.kernels.wall.motion import at_rest, pace
from magwire.kernels.wall.onward import hold_walls, positive

FINEST = 1.0 / 24.0  # part of an edge that the search for its nearest point passes over, at most


@part
def hop(lumen, x, t, offset, least):
    """Clearance of a point, and how far along t no other has less than ``least``.

    The point's ball is part of the lumen: g + rho - |x + s t - c| is what it leaves at s, with the
    distance rho of the point from the ball's centre, which is at least the smallest radius less g.
    Past an open end, and of a wall of triangles, there is no such ball: the gap changes by no more
    than the way times its slope.
    """
    steep = slopes(lumen.sheet)[1]
    if steep > 1.0:
        g, _, _, _ = gap_value(lumen, x[0], x[1], x[2])
        return (inf, 0.0) if g == inf else (g - offset, max(g - offset - least, 0.0) / steep)
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
def nearest_on_edge(rod, lumen, state, j, least):
    """Smallest clearance along edge j, or ``least`` if that is smaller."""
    x, y, length = row(state.q, j), row(state.q, j + 1), state.length[j]
    t = scale(1.0 / length, sub(y, x))
    widens = abs(rod.offset[j + 1] - rod.offset[j]) / length
    steep = pace(lumen.moving) * max(slopes(lumen.sheet)[1], 1.0) + widens
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
    between, fast = wall.between, pace(lumen.moving)
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
def nearest_along(beds, rod, lumen, wall, state, j, least):
    """Smallest clearance along edge j, or ``least`` if that is smaller."""
    if len(beds) == 0:
        return nearest_on_edge(rod, lumen, state, j, least)
    else:
        return nearest_in_bed(rod, lumen, wall, state, j, least)


@kernel
def read_frames(state, directors):
    """Fill ``directors`` [N+1, 3] with the material director m1 of the edge from each node.

    The tip has its edge's. Returns the twist of the tip: that of the guide, and what the wire
    between them is twisted by.
    """
    last = state.length.shape[0] - 1
    for j in range(last + 1):
        m1, _ = material_frame(row(state.director, j), row(state.tangent, j), state.q[j, 3])
        for c in range(3):
            directors[j, c] = m1[c]
    for c in range(3):
        directors[last + 1, c] = directors[last, c]
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


@kernel
def observe(model, state, mouth, work, forces, clearance, sunk):
    """Read off a state what a record holds (P-8, P-13, P-16).

    Fills the force of the wall on every node, ``forces`` [N+1, 3], the clearance of every free
    node from the wall as it is, ``clearance`` [N+1], and how far that is pressed in there, ``sunk``
    [N+1]. Leaves the gradient of the energy, without inertia, in
    ``work.gradient``: of what is held, too (P-38).

    Returns
    -------
    middle
        Smallest clearance midway between two nodes.
    between
        Smallest clearance of all points of the edges, looked for in steps of ``FINEST``.
    stable
        Whether the tangent stiffness, without inertia, is positive definite; with friction, see
        ``wall.onward.positive``.
    """
    rod, _, wall, lumen = model
    nodes = state.q.shape[0]
    held = mouth.held
    clear_rows(work.gradient, 0, nodes)
    add_walls(rod, lumen, wall, state, held, work.gradient, work.no_band)
    for i in range(nodes):
        for c in range(3):
            forces[i, c] = -work.gradient[i, c]
    middle = inf
    between = inf
    for i in range(nodes):
        sunk[i] = 0.0
    for i in range(held + 1, nodes):
        clearance[i] = clearance_at(lumen, row(state.q, i), rod.offset[i])
        sunk[i] = pressed_in(at_node(wall.bed, i), clearance[i], wall.gap)
        clearance[i] += sunk[i]
    for i in range(held, nodes):
        x = row(state.q, i)
        if i > held:
            between = min(between, clearance[i])
        if i < nodes - 1:
            y = row(state.q, i + 1)
            d = clearance_at(lumen, combine(0.5, x, 0.5, y), thick_at(rod, i, 0.5))
            middle = min(middle, d + pressed_in(at_edge(wall.bed, i), d, wall.gap))
    for j in range(held, nodes - 1):
        between = nearest_along(wall.bed, rod, lumen, wall, state, j, between)
    if held == nodes - 1:
        return middle, between, True
    last = 4 * (nodes - held + 1) - 1
    hold_walls(wall.friction, rod, lumen, wall, state, held, work)
    assemble(model, state, mouth, Motion(0.0, work.target), work.gradient, work.band)
    return middle, between, positive(wall.friction, state, held, work, FIRST, last)
