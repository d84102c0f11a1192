"""The centrelines of a lumen, and the climb along them to the deepest ball (P-8, P-9)."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from numpy.typing import NDArray

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import combine, dot, norm, scale
from magwire.kernels.wall.sheet import Sheet

# Columns of LumenArrays.branches.
SPACING, FIRST, PIECES, BEGIN, END, BLEND = 0, 1, 2, 3, 13, 23
# Columns of an end, counted from BEGIN or END: its point, outward tangent, radius, outward slope
# of the radius, sqrt(1 - slope^2), and whether it is open. BLEND is the width over which the branch
# is blended with those before it.
END_POINT, END_TANGENT, END_RADIUS, END_SLOPE, END_COSINE, END_OPEN = 0, 3, 6, 7, 8, 9
COLUMNS = 24

ITERATIONS = 60  # Newton steps at most: a safeguard, three to five are taken
TOLERANCE = 1e-5  # last step over the radius: the one after it would be below round-off
FALL = 1e-9  # round-off of the gap, over the radius
SHORTEST = 1e-9  # conditioning guard: smallest distance to the centreline, over the radius
LOOKS = 4  # at the way of a seed to its maximum
FLAT = 0.1  # smallest |F'| in its voxel at which a seed is settled at the voxel's centre


class Moving(NamedTuple):
    """Displacements of the tissue around a lumen; see ``wall.motion``.

    Attributes
    ----------
    origin
        Where there is none, the entrance, shape [1, 3].
    amplitude, ramp, rate
        Of each: largest displacement, shape [m, 3]; distance over which it rises, and one over its
        period, shape [m].
    now, before
        Part of each that there is now, and that there was before the step, shape [m].
    pace
        How much farther than a point of space the tissue may move that is there, at most.
    """

    origin: NDArray
    amplitude: NDArray
    ramp: NDArray
    rate: NDArray
    now: NDArray
    before: NDArray
    pace: float


class LumenArrays(NamedTuple):
    """A lumen as the kernels take it.

    Attributes
    ----------
    coefficients
        Of the cubic pieces of all branches, shape [pieces, 4 powers of the distance from the
        piece's start, 4 components x y z R].
    branches
        One row per branch, shape [branches, 24]; columns as named at the top of this module.
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
    moving
        How it moves, if it does.
    sheet
        The wall of triangles, if that is the wall: then balls only say where points are.
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
    moving: tuple[()] | tuple[Moving] = ()
    sheet: tuple[()] | tuple[Sheet] = ()


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
    the signs seen so far. A step that leads down has leapt over a valley, and is halved.

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
    g, highest, there = -inf, -inf, s
    p, c1, c2 = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    for count in range(1, ITERATIONS + 1):
        piece = min(int(s * per_spacing), pieces - 1)
        c, c1, c2, c3 = spline(coefficients, first + piece, s - piece * spacing)
        p = (x - c[0], y - c[1], z - c[2])
        radius, radius1, radius2, radius3 = c[3], c1[3], c2[3], c3[3]
        exact = norm(p)
        g = radius - exact
        if g < highest - FALL * radius:
            if s < there:
                low = s
            else:
                high = s
            s = 0.5 * (s + there)
            continue
        highest, there = g, s
        distance = max(exact, SHORTEST * radius)
        along, speed2, bend = dot(p, c1), dot(c1, c1), dot(p, c2)
        ascent = along + radius1 * distance
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
def flattest(coefficients, branches, branch, begin, end, x, y, z, slack):
    """Largest F' (see ``climb``) from one arc parameter to another, anywhere around a point.

    Looked at in a few places, for the point and all that are at most ``slack`` away.
    """
    spacing = branches[branch, SPACING]
    first, pieces = int(branches[branch, FIRST]), int(branches[branch, PIECES])
    largest = -inf
    for k in range(LOOKS + 1):
        s = begin + (end - begin) * k / LOOKS
        piece = min(max(int(s / spacing), 0), pieces - 1)
        c, c1, c2, _ = spline(coefficients, first + piece, s - piece * spacing)
        p = (x - c[0], y - c[1], z - c[2])
        distance = max(norm(p), SHORTEST * c[3])
        slope = dot(p, c2) - dot(c1, c1) + c2[3] * distance - c1[3] * dot(p, c1) / distance
        largest = max(largest, slope + slack * (norm(c2) + abs(c2[3])))
    return largest


@kernel
def settle(coefficients, branches, seed_branch, points, slack, seeds):
    """Move each seed to its maximum at the voxel's centre and find how that moves around it.

    dS/dx = -(c' + R' n)/F'. Seeds that run into an end, and those on a ridge so flat that the
    maximum at the centre says little about its surroundings, stay where they are.

    Parameters
    ----------
    seed_branch, points
        Branch and voxel's centre of each seed, shapes [n] and [n, 3].
    slack
        Half the diagonal of a voxel.
    seeds
        Changed in place, shape [n, 4].
    """
    for i in range(len(seeds)):
        branch, seed = seed_branch[i], seeds[i, 0]
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        g, s, side, _, p, c1, c2 = climb(coefficients, branches, branch, seed, x, y, z)
        exact = norm(p)
        radius = g + exact
        if side != 0 or abs(s - seed) >= radius:
            continue
        if flattest(coefficients, branches, branch, seed, s, x, y, z, slack) < -FLAT:
            distance = max(exact, SHORTEST * radius)
            n = scale(1.0 / distance, p)
            slope = dot(p, c2) - dot(c1, c1) + c2[3] * distance - c1[3] * dot(n, c1)
            u = combine(1.0, c1, c1[3], n)
            seeds[i, 0] = s
            seeds[i, 1] = -u[0] / slope
            seeds[i, 2] = -u[1] / slope
            seeds[i, 3] = -u[2] / slope
