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
from typing import NamedTuple

from numpy import int32
from numpy.typing import NDArray

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import combine, dot, norm, scale, sub

# Columns of LumenArrays.branches.
SPACING, FIRST, PIECES, BEGIN, END = 0, 1, 2, 3, 13
# Columns of an end, counted from BEGIN or END: its point, outward tangent, radius, outward slope
# of the radius, sqrt(1 - slope^2), and whether it is open.
END_POINT, END_TANGENT, END_RADIUS, END_SLOPE, END_COSINE, END_OPEN = 0, 3, 6, 7, 8, 9
COLUMNS = 23

ITERATIONS = 60  # Newton steps at most: a safeguard, three to five are taken
TOLERANCE = 1e-5  # last step over the radius: the one after it would be below round-off
SHORTEST = 1e-9  # conditioning guard: smallest distance to the centreline, over the radius
FLAT = 0.3  # smallest |F'| at which a seed is settled at the centre of its voxel
FLATTEST = 1e-4  # conditioning guard: smallest |F'|, reached at a centre of curvature


class LumenArrays(NamedTuple):
    """A lumen as the kernels take it.

    Attributes
    ----------
    coefficients
        Of the cubic pieces of all branches, shape [pieces, 4 powers of the distance from the
        piece's start, 4 components x y z R].
    branches
        One row per branch, shape [branches, 23]; columns as named at the top of this module.
    cells
        One number per voxel, shape [nx * ny * nz]: the index of its first seed, or -k for a voxel
        without seeds whose nearest voxel with seeds is k voxels away.
    seeds
        Arc parameter at the voxel's centre and its gradient for points around it, shape [seeds, 4].
    seed_branch
        Branch of each seed, shape [seeds]. The seeds of a voxel follow each other in the order of
        their branches, and the last one has ``-1 - branch`` in place of ``branch``.
    x0, y0, z0, cell
        Lower corner and edge length of the grid of voxels.
    nx, ny, nz
        Number of voxels; zero in open space.
    margin
        Smallest radius; no voxel that is nearer to a wall from outside is without seeds.
    blend
        Width over which the gaps of two branches are blended into each other.
    """

    coefficients: NDArray
    branches: NDArray
    cells: NDArray
    seeds: NDArray
    seed_branch: NDArray
    x0: float
    y0: float
    z0: float
    cell: float
    nx: int
    ny: int
    nz: int
    margin: float
    blend: float


@kernel
def spline(a, i, t):
    """Point, radius and their derivatives up to the third, ``t`` past the start of piece ``i``."""
    t3, t6 = 3.0 * t, 6.0 * t
    c = (
        ((a[i, 3, 0] * t + a[i, 2, 0]) * t + a[i, 1, 0]) * t + a[i, 0, 0],
        ((a[i, 3, 1] * t + a[i, 2, 1]) * t + a[i, 1, 1]) * t + a[i, 0, 1],
        ((a[i, 3, 2] * t + a[i, 2, 2]) * t + a[i, 1, 2]) * t + a[i, 0, 2],
        ((a[i, 3, 3] * t + a[i, 2, 3]) * t + a[i, 1, 3]) * t + a[i, 0, 3],
    )
    c1 = (
        (a[i, 3, 0] * t3 + 2.0 * a[i, 2, 0]) * t + a[i, 1, 0],
        (a[i, 3, 1] * t3 + 2.0 * a[i, 2, 1]) * t + a[i, 1, 1],
        (a[i, 3, 2] * t3 + 2.0 * a[i, 2, 2]) * t + a[i, 1, 2],
        (a[i, 3, 3] * t3 + 2.0 * a[i, 2, 3]) * t + a[i, 1, 3],
    )
    c2 = (
        a[i, 3, 0] * t6 + 2.0 * a[i, 2, 0],
        a[i, 3, 1] * t6 + 2.0 * a[i, 2, 1],
        a[i, 3, 2] * t6 + 2.0 * a[i, 2, 2],
        a[i, 3, 3] * t6 + 2.0 * a[i, 2, 3],
    )
    c3 = (6.0 * a[i, 3, 0], 6.0 * a[i, 3, 1], 6.0 * a[i, 3, 2], 6.0 * a[i, 3, 3])
    return c, c1, c2, c3


@kernel
def shift(step, p, c1, c2, c3):
    """Vector x - c and the derivatives of (c, R) a small ``step`` farther along the same cubic."""
    half, third = 0.5 * step, step / 3.0
    p = (
        p[0] - step * (c1[0] + half * (c2[0] + third * c3[0])),
        p[1] - step * (c1[1] + half * (c2[1] + third * c3[1])),
        p[2] - step * (c1[2] + half * (c2[2] + third * c3[2])),
    )
    c1 = (
        c1[0] + step * (c2[0] + half * c3[0]),
        c1[1] + step * (c2[1] + half * c3[1]),
        c1[2] + step * (c2[2] + half * c3[2]),
        c1[3] + step * (c2[3] + half * c3[3]),
    )
    c2 = (
        c2[0] + step * c3[0],
        c2[1] + step * c3[1],
        c2[2] + step * c3[2],
        c2[3] + step * c3[3],
    )
    return p, c1, c2


@kernel
def climb(coefficients, branches, branch, seed, x, y, z):
    """Local maximum over S of R(S) - |x - c(S)| next to ``seed``.

    Chebyshev's method (Newton's with the second derivative, of third order) on
    F(S) = (x - c).c' + R' |x - c|, which has the sign of the ascent, kept inside the bracket of
    the signs seen so far.

    Returns
    -------
    g, S
        Value and arc parameter.
    side
        0 between the ends; -1 or 1 if the ascent runs out of the branch at its begin or end.
    count
        Iterations.
    p, c1, c2
        There: x - c, 3 numbers, and first and second derivatives of (c, R), 4 numbers each.
    """
    spacing = branches[branch, SPACING]
    first = int(branches[branch, FIRST])
    pieces = int(branches[branch, PIECES])
    length = spacing * pieces
    per_spacing = 1.0 / spacing
    s = min(max(seed, 0.0), length)
    low, high = -inf, inf
    g = -inf
    p, c1, c2 = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    for count in range(1, ITERATIONS + 1):
        piece = min(int(s * per_spacing), pieces - 1)
        c, c1, c2, c3 = spline(coefficients, first + piece, s - piece * spacing)
        p = (x - c[0], y - c[1], z - c[2])
        radius, radius1, radius2, radius3 = c[3], c1[3], c2[3], c3[3]
        exact = norm(p)
        distance = max(exact, SHORTEST * radius)
        along, speed2, bend = dot(p, c1), dot(c1, c1), dot(p, c2)
        ascent = along + radius1 * distance
        g = radius - exact
        if ascent <= 0.0 and s <= 0.0:
            return g, 0.0, -1, count, p, c1, c2
        if ascent >= 0.0 and s >= length:
            return g, length, 1, count, p, c1, c2
        per_distance = 1.0 / distance
        distance1 = -along * per_distance
        slope = bend - speed2 + radius2 * distance + radius1 * distance1
        reach = 0.5 * (distance + radius)
        if slope < 0.0 and abs(ascent) < -slope * reach:
            per_slope = 1.0 / slope
            step = -ascent * per_slope
            distance2 = (speed2 - bend - distance1 * distance1) * per_distance
            curve = dot(p, c3) - 3.0 * dot(c1, c2) + radius3 * distance
            curve += 2.0 * radius2 * distance1 + radius1 * distance2
            correction = 0.5 * step * curve * per_slope
            if abs(correction) < 0.5:
                step -= step * correction
            if abs(step) <= TOLERANCE * radius:
                p, c1, c2 = shift(step, p, c1, c2, c3)
                return g + 0.5 * ascent * step * per_distance, s + step, 0, count, p, c1, c2
        elif ascent > 0.0:
            step = reach
        else:
            step = -reach
        if ascent > 0.0:
            low = s
            s = s + step if s + step < high else 0.5 * (s + high)
        else:
            high = s
            s = s + step if s + step > low else 0.5 * (s + low)
        s = min(max(s, 0.0), length)
    return g, s, 0, ITERATIONS, p, c1, c2


@kernel
def mouth(branches, branch, side, x, y, z):
    """Where a point past an end is: see the module's text.

    Returns
    -------
    past
        Arc length past the end's plane, over the end's radius.
    g
        Gap to the flared wall; goes on linearly where the flare ends at past = 1.
    lateral, m
        Distance from the end's axis and its direction.
    """
    at = BEGIN if side < 0 else END
    row = branches[branch]
    t = (row[at + END_TANGENT], row[at + END_TANGENT + 1], row[at + END_TANGENT + 2])
    radius, slope, cosine = row[at + END_RADIUS], row[at + END_SLOPE], row[at + END_COSINE]
    p = (x - row[at + END_POINT], y - row[at + END_POINT + 1], z - row[at + END_POINT + 2])
    axial = dot(p, t)
    p = sub(p, scale(axial, t))
    exact = norm(p)
    lateral = max(exact, SHORTEST * radius)
    past = (axial + slope * lateral / cosine) / radius
    flare = past * past * past if past < 1.0 else 3.0 * past - 2.0
    g = radius + slope * axial - cosine * exact + radius * flare
    return past, g, lateral, scale(1.0 / lateral, p)


@kernel
def safe_distance(branches, branch, side, past, g, lateral):
    """How far a point past an end may move without crossing the wall (a lower bound)."""
    at = BEGIN if side < 0 else END
    radius, slope = branches[branch, at + END_RADIUS], branches[branch, at + END_SLOPE]
    cosine = branches[branch, at + END_COSINE]
    narrowest = radius * min(1.0, 1.0 + slope)
    steepest = sqrt(1.0 + 9.0 / (cosine * cosine))  # Lipschitz constant of the flared gap
    return max(narrowest - lateral, g / steepest, (past - 1.0) * radius * cosine)


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
def gap_value(lumen, x, y, z):
    """Gap of a point.

    Returns
    -------
    g
        Gap; +inf where there is no wall.
    S, branch
        Arc parameter and branch of the ball it belongs to, S below 0 or above the branch's length
        past an end; nan and -1 in no voxel of the grid.
    safe
        Distance by which the point may move without crossing the wall: g inside the lumen, also
        where branches blend; less past an open end, where the flared wall is steeper. From
        free space outside it the point may come to lie in the solid, but not through it.
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
            g, weight, _ = blend(new_g, g, lumen.blend)
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
def mouth_jet(lumen, branch, side, x, y, z):
    """Gradient and Hessian of the gap to the flared wall past an open end."""
    past, _, lateral, m = mouth(lumen.branches, branch, side, x, y, z)
    at = BEGIN if side < 0 else END
    row = lumen.branches[branch]
    t = (row[at + END_TANGENT], row[at + END_TANGENT + 1], row[at + END_TANGENT + 2])
    radius, slope, cosine = row[at + END_RADIUS], row[at + END_SLOPE], row[at + END_COSINE]
    w = combine(1.0, t, slope / cosine, m)
    steep = 3.0 * past * past
    n = combine(slope + steep, t, steep * slope / cosine - cosine, m)
    around = (steep * slope / cosine - cosine) / lateral
    bend = 6.0 * past / radius
    h = (
        around * (1.0 - t[0] * t[0] - m[0] * m[0]) + bend * w[0] * w[0],
        around * (-t[0] * t[1] - m[0] * m[1]) + bend * w[0] * w[1],
        around * (-t[0] * t[2] - m[0] * m[2]) + bend * w[0] * w[2],
        around * (1.0 - t[1] * t[1] - m[1] * m[1]) + bend * w[1] * w[1],
        around * (-t[1] * t[2] - m[1] * m[2]) + bend * w[1] * w[2],
        around * (1.0 - t[2] * t[2] - m[2] * m[2]) + bend * w[2] * w[2],
    )
    return n, h


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
def gap_jet(lumen, x, y, z):
    """Gap of a point with its gradient and Hessian.

    Returns
    -------
    g, S, branch, safe
        As of ``gap_value``.
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
            g, weight, curvature = blend(new_g, g, lumen.blend)
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


@kernel
def gap_many(lumen, points, out_g, out_s, out_branch):
    """Gap, arc parameter and branch of each point, shapes [n, 3] and three times [n]."""
    for i in range(len(points)):
        g, s, branch, _ = gap_value(lumen, points[i, 0], points[i, 1], points[i, 2])
        out_g[i] = g
        out_s[i] = s
        out_branch[i] = int32(branch)


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


@kernel
def settle(coefficients, branches, seed_branch, points, seeds):
    """Move each seed to its maximum at the voxel's centre and find how that moves around it.

    dS/dx = -(c' + R' n)/F'. Seeds that run into an end, and those on a ridge so flat that the
    maximum at the centre says little about its surroundings, stay where they are.

    Parameters
    ----------
    seed_branch, points
        Branch and voxel's centre of each seed, shapes [n] and [n, 3].
    seeds
        Changed in place, shape [n, 4].
    """
    for i in range(len(seeds)):
        branch = seed_branch[i]
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        g, s, side, _, p, c1, c2 = climb(coefficients, branches, branch, seeds[i, 0], x, y, z)
        exact = norm(p)
        radius = g + exact
        distance = max(exact, SHORTEST * radius)
        n = scale(1.0 / distance, p)
        slope = dot(p, c2) - dot(c1, c1) + c2[3] * distance - c1[3] * dot(n, c1)
        if side == 0 and slope < -FLAT and abs(s - seeds[i, 0]) < radius:
            u = combine(1.0, c1, c1[3], n)
            seeds[i, 0] = s
            seeds[i, 1] = -u[0] / slope
            seeds[i, 2] = -u[1] / slope
            seeds[i, 3] = -u[2] / slope
