"""Gap of a point to the wall of a lumen, with its gradient and Hessian (P-8 to P-10).

The gap is g(x) = max over S of (R(S) - |x - c(S)|): how deep x lies in the union of balls of radius
R(S) along the centreline c(S). Inside the lumen g > 0, outside g < 0, and moving x by less than
g can never cross the wall.

A query looks up the voxel of x, climbs from each seed stored there to its local maximum by
Newton's method, and takes the largest. Kernels are free of units: points and lumen share one.

Past the plane of an open end there is a mouth: the tube goes on straight, its wall flares out by
R_end (z / R_end)^3 over one end radius, and farther out there is no wall, g = +inf. A point
farther out is free unless it lies within the smallest radius of the wall of another part of the
lumen. Points in no voxel of the grid are more than a radius outside of every wall, or past an end:
they count as free, too.
"""

from __future__ import annotations

from math import inf, nan, sqrt

from numpy import int32

from magwire.kernels._jit import kernel, part, short
from magwire.kernels.centreline import (
    BEGIN,
    BLEND,
    END,
    END_OPEN,
    END_RADIUS,
    SHORTEST,
    climb,
)
from magwire.kernels.vectors import combine, dot, norm, scale, sub
from magwire.kernels.wall.motion import at_rest, moved_jet, pace
from magwire.kernels.wall.rim import mouth, mouth_jet, safe_distance
from magwire.kernels.wall.sheet import STEEPEST, sheet_jet, sheet_value

BALLS_STEEPEST = 10.0  # largest slope past an open end, where the radius changes by 0.95
FLATTEST = 1e-4  # conditioning guard: smallest |F'|, reached at a centre of curvature


@kernel
def gap_from(lumen, branch, seed, x, y, z):
    """Gap that one seed leads to.

    Returns
    -------
    g, S, side, safe
        As ``climb`` and ``gap_value`` say; g = +inf past the flare of an open end; side is -2 or 2
        at a closed end.
    frame
        x - c and the derivatives of (c, R) as of ``climb``.
    """
    g, s, side, _, p, c1, c2 = climb(lumen.coefficients, lumen.branches, branch, seed, x, y, z)
    at = BEGIN if side < 0 else END
    if side == 0 or lumen.branches[branch, at + END_OPEN] == 0.0:
        return g, s, 0 if side == 0 else 2 * side, g, (p, c1, c2)
    past, g, lateral, _ = mouth(lumen.branches, branch, side, x, y, z)
    radius = lumen.branches[branch, at + END_RADIUS]
    safe = safe_distance(lumen.branches, branch, side, past, g, lateral)
    s += side * past * radius
    if past > 1.0:
        return inf, s, side, safe, (p, c1, c2)
    return g, s, side, safe, (p, c1, c2)


@kernel
def blend(a, b, width):
    """Smooth maximum of two gaps: C2, 1-Lipschitz, and equal to the larger if they are far apart.

    Returns
    -------
    value, weight, curvature
        Its derivatives by a and b are ``weight`` and 1 - ``weight``; its second derivative along
        a - b is ``curvature``.
    """
    apart = abs(a - b)
    if not apart < width:
        return max(a, b), 1.0 if a >= b else 0.0, 0.0
    h = (width - apart) / width
    share = 0.5 * h * h
    return max(a, b) + width * h * h * h / 6.0, 1.0 - share if a >= b else share, h / width


@kernel
def first_seed(lumen, x, y, z):
    """Index of the first seed of a point's voxel, and the point's place in that voxel.

    Returns
    -------
    index
        -1 if there is none.
    offset
        Vector from the voxel's centre to the point.
    safe
        If there is none: distance to the nearest wall (a lower bound).
    """
    none = (0.0, 0.0, 0.0)
    if lumen.nx == 0:
        return -1, none, inf
    per_cell = 1.0 / lumen.cell
    u, v, w = (x - lumen.x0) * per_cell, (y - lumen.y0) * per_cell, (z - lumen.z0) * per_cell
    if not (0.0 <= u < lumen.nx and 0.0 <= v < lumen.ny and 0.0 <= w < lumen.nz):
        du, dv = max(-u, u - lumen.nx, 0.0), max(-v, v - lumen.ny, 0.0)
        dw = max(-w, w - lumen.nz, 0.0)
        return -1, none, lumen.cell * sqrt(du * du + dv * dv + dw * dw) + lumen.margin
    i, j, k = int(u), int(v), int(w)
    index = lumen.cells[(i * lumen.ny + j) * lumen.nz + k]
    if index < 0:
        return -1, none, lumen.cell * (-1 - index) + lumen.margin
    offset = (
        (u - i - 0.5) * lumen.cell,
        (v - j - 0.5) * lumen.cell,
        (w - k - 0.5) * lumen.cell,
    )
    return index, offset, 0.0


@kernel
def seed_at(lumen, index, offset):
    """Arc parameter to start from, its branch, and whether it is the voxel's last."""
    marked = lumen.seed_branch[index]
    s = lumen.seeds[index, 0] + (
        lumen.seeds[index, 1] * offset[0]
        + lumen.seeds[index, 2] * offset[1]
        + lumen.seeds[index, 3] * offset[2]
    )
    if marked < 0:
        return s, -1 - marked, True
    return s, marked, False


@kernel
def balls_value(lumen, x, y, z):
    """Gap of a point to a wall of balls.

    Returns
    -------
    g
        Gap; +inf where there is no wall.
    S, branch
        Arc parameter and branch of the ball it belongs to, S below 0 or above the branch's length
        past an end; nan and -1 in no voxel of the grid.
    safe
        By how much the gap may fall before the point could cross the wall; it falls by ``fall`` at
        most for each length that the point moves. At balls, where it falls by one, it is the
        distance by which the point may move without crossing the wall: g inside the lumen, also
        where branches blend; less past an open end, where the flared wall is steeper. From
        free space outside it the point may come to lie in the solid, but not through it. In a lumen
        that moves it is the way of the tissue that is at the point; see ``wall.motion.pace``.
    """
    index, offset, safe = first_seed(lumen, x, y, z)
    if index < 0:
        return inf, nan, -1, safe
    g, s, branch, safe = -inf, nan, -1, -inf  # of the branches before
    new_g, new_s, new_safe = -inf, nan, -inf  # of the branch whose seeds are being read
    free_s, free_safe, free_branch = nan, inf, -1
    last = False
    while not last:
        seed, here, last = seed_at(lumen, index, offset)
        one_g, one_s, _, one_safe, _ = gap_from(lumen, here, seed, x, y, z)
        if one_g == inf:
            free_s, free_safe, free_branch = one_s, one_safe, here
        elif one_g > new_g:
            new_g, new_s, new_safe = one_g, one_s, one_safe
        index += 1
        if last or seed_at(lumen, index, offset)[1] != here:
            tubes = new_safe == new_g and safe == g
            g, weight, _ = blend(new_g, g, lumen.branches[here, BLEND])
            if weight >= 0.5:
                s, branch = new_s, here
            safe = g if tubes else max(safe, new_safe)
            new_g, new_s, new_safe = -inf, nan, -inf
    if free_branch >= 0 and g <= -lumen.margin:
        return inf, free_s, free_branch, min(free_safe, lumen.margin)
    return g, s, branch, safe


@kernel
def ball_jet(g, side, frame):
    """Gradient and Hessian of the gap between the ends, or at a closed end.

    With n = (x - c)/d, u = c' + R' n and F as in ``climb``: grad g = -n and
    Hess g = -(I - n n^T)/d - u u^T/(d F'); at a closed end S stays, and u u^T drops out.
    """
    p, c1, c2 = frame
    exact = norm(p)
    distance = max(exact, SHORTEST * (g + exact))
    across = 1.0 / distance
    n = scale(across, p)
    u = combine(1.0, c1, c1[3], n)
    slope = dot(p, c2) - dot(c1, c1) + c2[3] * distance - c1[3] * dot(n, c1)
    along = 0.0 if side != 0 else across / max(-slope, FLATTEST)
    h = (
        across * (n[0] * n[0] - 1.0) + along * u[0] * u[0],
        across * n[0] * n[1] + along * u[0] * u[1],
        across * n[0] * n[2] + along * u[0] * u[2],
        across * (n[1] * n[1] - 1.0) + along * u[1] * u[1],
        across * n[1] * n[2] + along * u[1] * u[2],
        across * (n[2] * n[2] - 1.0) + along * u[2] * u[2],
    )
    return scale(-1.0, n), h


@kernel
def wall_jet(lumen, branch, g, side, frame, x, y, z):
    """Gradient and Hessian (xx xy xz yy yz zz) of the gap that belongs to a branch's S."""
    if side == 1 or side == -1:
        return mouth_jet(lumen, branch, side, x, y, z)
    return ball_jet(g, side, frame)


@kernel
def blend_jets(weight, curvature, n, h, n2, h2):
    """Gradient and Hessian of a blended gap from those of its two parts."""
    d = sub(n, n2)
    rest = 1.0 - weight
    mixed = (
        weight * h[0] + rest * h2[0] + curvature * d[0] * d[0],
        weight * h[1] + rest * h2[1] + curvature * d[0] * d[1],
        weight * h[2] + rest * h2[2] + curvature * d[0] * d[2],
        weight * h[3] + rest * h2[3] + curvature * d[1] * d[1],
        weight * h[4] + rest * h2[4] + curvature * d[1] * d[2],
        weight * h[5] + rest * h2[5] + curvature * d[2] * d[2],
    )
    return combine(weight, n, rest, n2), mixed


@kernel
def balls_jet(lumen, x, y, z):
    """Gap of a point to a wall of balls with its gradient and Hessian.

    Returns
    -------
    g, S, branch, safe
        As of ``balls_value``.
    n
        Gradient, 3 numbers; zero where g = +inf.
    h
        Hessian, 6 numbers xx xy xz yy yz zz; zero where g = +inf.
    """
    none = (0.0, 0.0, 0.0)
    flat = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    index, offset, safe = first_seed(lumen, x, y, z)
    if index < 0:
        return inf, nan, -1, safe, none, flat
    g, s, branch, safe, n, h = -inf, nan, -1, -inf, none, flat  # of the branches before
    new_g, new_s, new_side, new_safe = -inf, nan, 0, -inf  # of the branch being read
    new_frame = (none, (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
    free_s, free_safe, free_branch = nan, inf, -1
    last = False
    while not last:
        seed, here, last = seed_at(lumen, index, offset)
        one_g, one_s, side, one_safe, frame = gap_from(lumen, here, seed, x, y, z)
        if one_g == inf:
            free_s, free_safe, free_branch = one_s, one_safe, here
        elif one_g > new_g:
            new_g, new_s, new_side, new_safe, new_frame = one_g, one_s, side, one_safe, frame
        index += 1
        if last or seed_at(lumen, index, offset)[1] != here:
            tubes = new_safe == new_g and safe == g
            g, weight, curvature = blend(new_g, g, lumen.branches[here, BLEND])
            if weight > 0.0 and new_g > -inf:
                new_n, new_h = wall_jet(lumen, here, new_g, new_side, new_frame, x, y, z)
                n, h = blend_jets(weight, curvature, new_n, new_h, n, h)
            if weight >= 0.5:
                s, branch = new_s, here
            safe = g if tubes else max(safe, new_safe)
            new_g, new_s, new_side, new_safe = -inf, nan, 0, -inf
    if free_branch >= 0 and g <= -lumen.margin:
        return inf, free_s, free_branch, min(free_safe, lumen.margin), none, flat
    return g, s, branch, safe, n, h


# A lumen whose wall is of triangles holds it in a tuple, which is empty where there is none. The
# length of a tuple is part of its type: kernels for walls of balls are compiled without triangles.


@kernel
def wall_value(sheets, lumen, x, y, z):
    """See ``gap_value``; ``sheets`` as of ``LumenArrays``."""
    if len(sheets) == 0:
        return balls_value(lumen, x, y, z)
    else:
        g, safe = sheet_value(sheets[0], x, y, z)
        return g, nan, -1, safe


@kernel
def wall_jets(sheets, lumen, x, y, z):
    """See ``gap_jet``; ``sheets`` as of ``LumenArrays``."""
    if len(sheets) == 0:
        return balls_jet(lumen, x, y, z)
    else:
        g, safe, n, h = sheet_jet(sheets[0], x, y, z)
        return g, nan, -1, safe, n, h


@kernel
def gap_value(lumen, x, y, z):
    """Gap of a point; as of ``balls_value``. At a wall of triangles S is nan and branch -1.

    Of a wall that moves it is that of where the tissue at the point is at rest.
    """
    x, y, z = at_rest(lumen.moving, x, y, z)
    return wall_value(lumen.sheet, lumen, x, y, z)


@part
def gap_jet(lumen, x, y, z):
    """Gap of a point with its gradient and Hessian; as of ``balls_jet`` and ``gap_value``."""
    u, v, w = at_rest(lumen.moving, x, y, z)
    g, s, branch, safe, n, h = wall_jets(lumen.sheet, lumen, u, v, w)
    n, h = moved_jet(lumen.moving, x, y, z, n, h)
    return g, s, branch, safe, n, h


@short
def slopes(sheets):
    """Largest slope of the gap past an open end, over that elsewhere, and that."""
    if len(sheets) == 0:
        return BALLS_STEEPEST, 1.0
    else:
        return STEEPEST, sheets[0].steep


@short
def fall(lumen):
    """By how much the gap falls at most for each length that a point moves; see ``gap_value``."""
    return pace(lumen.moving) * slopes(lumen.sheet)[1]


@kernel
def gap_many(lumen, points, out_g, out_s, out_branch):
    """Gap, arc parameter and branch of each point, shapes [n, 3] and three times [n]."""
    for i in range(len(points)):
        g, s, branch, _ = gap_value(lumen, points[i, 0], points[i, 1], points[i, 2])
        out_g[i] = g
        out_s[i] = s
        out_branch[i] = int32(branch)


@kernel
def hessian_many(lumen, points, out_g, out_branch, out_h):
    """Gap, branch and Hessian of points [n, 3], into [n], [n] and [n, 6]; see ``gap_jet``."""
    for i in range(len(points)):
        g, _, branch, _, _, h = gap_jet(lumen, points[i, 0], points[i, 1], points[i, 2])
        out_g[i] = g
        out_branch[i] = int32(branch)
        for c in range(6):
            out_h[i, c] = h[c]


@kernel
def jets_many(lumen, points, out_g, out_n, out_h):
    """The same with its gradient, shape [n, 3]."""
    for i in range(len(points)):
        g, _, _, _, n, h = gap_jet(lumen, points[i, 0], points[i, 1], points[i, 2])
        out_g[i] = g
        for c in range(3):
            out_n[i, c] = n[c]
        for c in range(6):
            out_h[i, c] = h[c]


@kernel
def work_many(lumen, points, out_seeds, out_iterations):
    """Number of seeds and of iterations that each point's query takes, shapes [n]."""
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        index, offset, _ = first_seed(lumen, x, y, z)
        seeds, iterations, last = 0, 0, index < 0
        while not last:
            seed, branch, last = seed_at(lumen, index, offset)
            count = climb(lumen.coefficients, lumen.branches, branch, seed, x, y, z)[3]
            seeds += 1
            iterations += count
            index += 1
        out_seeds[i] = seeds
        out_iterations[i] = iterations
