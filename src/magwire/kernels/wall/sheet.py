"""Gap of a point to a wall of triangles, as a spline that is twice continuously differentiable.

Space around the wall is divided into bricks; where it has to be fine, a brick into eight smaller
ones, and so on. The smallest ones have 4 by 4 by 4 cells and hold the coefficients of a cubic
B-spline for the signed distance: 7 by 7 by 7 of them, so that no cell needs those of another brick.
From coarse to fine bricks the spline is the same one, see ``lumen.distance``. It lies so that it is
nowhere positive on the triangles.

Past the plane of an open end there is a mouth, as of a tube of balls: the wall goes on straight, it
opens by R_end (z / R_end)^3 over one end radius, and farther out there is no wall, g = +inf. Which
mouth a cell belongs to is known for each cell. Points in no brick are farther than ``margin`` from
every wall, and count as free.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import NamedTuple

from numpy.typing import NDArray

from magwire.kernels._jit import kernel, part
from magwire.kernels.lanes import first, fourth, load, second, third
from magwire.kernels.vectors import combine, dot

BRICK = 4
"""Cells along the edge of a brick."""
WIDE = BRICK + 3
"""Coefficients along the edge of a brick."""
# Columns of Sheet.ends: a point of the end's plane, its outward normal and the end's radius.
MOUTH_POINT, MOUTH_NORMAL, MOUTH_RADIUS = 0, 3, 6
MOUTH_COLUMNS = 7
STEEPEST = 4.0
"""Largest slope of the gap where a mouth opens, over that elsewhere: one, and three more."""


class Sheet(NamedTuple):
    """The wall of a surface as the kernels take it.

    Attributes
    ----------
    bricks
        One number per brick of the box, shape [nx * ny * nz]: its place in ``tree``, or -k if it
        has none and the nearest one that has is k bricks away.
    tree
        Of each brick, its row in ``values``, or -1 - k if its eight parts are the entries from k
        on.
    values
        Coefficients in units of a cell of the box's bricks, shape [smallest bricks, 7 * 7 * 7].
    mouth
        Of each row of ``values``: its row in ``mouths``, -1 if it is in no mouth.
    mouths
        The end whose mouth each cell is in, -1 for none, shape [bricks in mouths, 4 * 4 * 4].
    ends
        Open ends, shape [ends, 7]; columns as named at the top of this module.
    x0, y0, z0, cell
        Lower corner of the box, and edge length of a cell of its bricks.
    nx, ny, nz
        Number of bricks of the box.
    margin
        No wall is nearer than this to a point in no brick.
    steep
        Largest slope of the spline: about one.
    """

    bricks: NDArray
    tree: NDArray
    values: NDArray
    mouth: NDArray
    mouths: NDArray
    ends: NDArray
    x0: float
    y0: float
    z0: float
    cell: float
    nx: int
    ny: int
    nz: int
    margin: float
    steep: float


@part
def find(sheet, x, y, z):
    """Where a point is.

    Returns
    -------
    row
        Of the coefficients; -1 if there are none.
    base, t, finer
        Its cell's first coefficient, its place in the cell, 3 numbers from 0 to 1, and how many
        times smaller the cell is than those of the box's bricks.
    end
        The end whose mouth it may be in; -1 if none.
    away
        If it is in no brick: distance to the nearest wall (a lower bound).
    """
    none = (0.0, 0.0, 0.0)
    per_brick = 1.0 / (BRICK * sheet.cell)
    u, v, w = (x - sheet.x0) * per_brick, (y - sheet.y0) * per_brick, (z - sheet.z0) * per_brick
    if not (0.0 <= u < sheet.nx and 0.0 <= v < sheet.ny and 0.0 <= w < sheet.nz):
        du, dv, dw = (
            max(-u, u - sheet.nx, 0.0),
            max(-v, v - sheet.ny, 0.0),
            max(-w, w - sheet.nz, 0.0),
        )
        away = BRICK * sheet.cell * sqrt(du * du + dv * dv + dw * dw) + sheet.margin
        return -1, 0, none, 1.0, -1, away
    i, j, k = int(u), int(v), int(w)
    at = sheet.bricks[(i * sheet.ny + j) * sheet.nz + k]
    if at < 0:
        return -1, 0, none, 1.0, -1, sheet.cell * BRICK * (-1 - at) + sheet.margin
    u, v, w = u - i, v - j, w - k
    finer = 1.0
    row = sheet.tree[at]
    while row < 0:
        u, v, w = 2.0 * u, 2.0 * v, 2.0 * w
        i, j, k = int(u), int(v), int(w)
        u, v, w = u - i, v - j, w - k
        finer *= 2.0
        row = sheet.tree[-1 - row + 4 * i + 2 * j + k]
    u, v, w = BRICK * u, BRICK * v, BRICK * w
    i, j, k = int(u), int(v), int(w)
    mouth = sheet.mouth[row]
    end = -1 if mouth < 0 else sheet.mouths[mouth, (i * BRICK + j) * BRICK + k]
    return row, (i * WIDE + j) * WIDE + k, (u - i, v - j, w - k), finer, end, 0.0


@part
def weights(t):
    """The four cubic B-splines at t from 0 to 1, their first and their second derivatives."""
    r = 1.0 - t
    value = (
        r * r * r / 6.0,
        t * t * (0.5 * t - 1.0) + 2.0 / 3.0,
        r * r * (0.5 * r - 1.0) + 2.0 / 3.0,
        t * t * t / 6.0,
    )
    rise = (-0.5 * r * r, t * (1.5 * t - 2.0), r * (2.0 - 1.5 * r), 0.5 * t * t)
    return value, rise, (r, 3.0 * t - 2.0, 3.0 * r - 2.0, t)


@part
def mix(w, a, b, c, d):
    """Sum of four numbers by their weights."""
    return w[0] * a + w[1] * b + w[2] * c + w[3] * d


@part
def along_z(w, v):
    """Sum of the four numbers of a register by the weights along z."""
    return (w[0] * first(v) + w[1] * second(v)) + (w[2] * third(v) + w[3] * fourth(v))


@part
def lines(c, at):
    """The four by four coefficients in a plane of y and z, those along z in a register."""
    return (
        load(c, at, 0),
        load(c, at + WIDE, 0),
        load(c, at + 2 * WIDE, 0),
        load(c, at + 3 * WIDE, 0),
    )


@part
def plane(c, at, v):
    """Sums along y in a plane."""
    a, b, p, q = lines(c, at)
    return mix(v, a, b, p, q)


@kernel
def spline_value(c, at, t):
    """Value of the spline."""
    u, v, w = weights(t[0])[0], weights(t[1])[0], weights(t[2])[0]
    next_plane = WIDE * WIDE
    a, b = plane(c, at, v), plane(c, at + next_plane, v)
    p, q = plane(c, at + 2 * next_plane, v), plane(c, at + 3 * next_plane, v)
    return along_z(w, mix(u, a, b, p, q))


@part
def plane_jet(c, at, y):
    """Sums along y in a plane, with two derivatives."""
    a, b, p, q = lines(c, at)
    return mix(y[0], a, b, p, q), mix(y[1], a, b, p, q), mix(y[2], a, b, p, q)


@kernel
def spline_jet(c, at, t):
    """Value of the spline, its gradient and its Hessian xx xy xz yy yz zz, by the cell's edge."""
    x, y, z = weights(t[0]), weights(t[1]), weights(t[2])
    next_plane = WIDE * WIDE
    a, b = plane_jet(c, at, y), plane_jet(c, at + next_plane, y)
    p, q = plane_jet(c, at + 2 * next_plane, y), plane_jet(c, at + 3 * next_plane, y)
    # Left to be summed along z: the value and its derivatives by x and y.
    value, by_y = mix(x[0], a[0], b[0], p[0], q[0]), mix(x[0], a[1], b[1], p[1], q[1])
    by_x = mix(x[1], a[0], b[0], p[0], q[0])
    n = (along_z(z[0], by_x), along_z(z[0], by_y), along_z(z[1], value))
    h = (
        along_z(z[0], mix(x[2], a[0], b[0], p[0], q[0])),
        along_z(z[0], mix(x[1], a[1], b[1], p[1], q[1])),
        along_z(z[1], by_x),
        along_z(z[0], mix(x[0], a[2], b[2], p[2], q[2])),
        along_z(z[1], by_y),
        along_z(z[2], value),
    )
    return along_z(z[0], value), n, h


@part
def past_end(ends, end, x, y, z):
    """How far a point is past the plane of an end, that plane's normal and the end's radius."""
    t = (ends[end, 3], ends[end, 4], ends[end, 5])
    axial = t[0] * (x - ends[end, 0]) + t[1] * (y - ends[end, 1]) + t[2] * (z - ends[end, 2])
    return axial, t, ends[end, MOUTH_RADIUS]


@part
def opened(sheet, g, axial, radius):
    """The gap in a mouth past its plane, and what is left of it at least, from the wall's g."""
    past = axial / radius
    if past <= 1.0:
        wider = g + radius * past * past * past
        return wider, max(g, wider / STEEPEST)
    onward = (g + radius * (3.0 * past - 2.0)) / STEEPEST
    return inf, max(g, min(max(axial - radius, onward), sheet.margin))


@part
def sheet_value(sheet, x, y, z):
    """Gap of a point, and what ``gap_value`` calls safe."""
    row, base, t, _, end, away = find(sheet, x, y, z)
    if row < 0:
        return inf, away
    g = sheet.cell * spline_value(sheet.values[row], base, t)
    if end < 0:
        return g, g
    axial, _, radius = past_end(sheet.ends, end, x, y, z)
    return (g, g) if axial <= 0.0 else opened(sheet, g, axial, radius)


@part
def sheet_jet(sheet, x, y, z):
    """The same with gradient and Hessian, which are zero where g = +inf; as of ``gap_jet``."""
    none = (0.0, 0.0, 0.0)
    flat = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    row, base, t, finer, end, away = find(sheet, x, y, z)
    if row < 0:
        return inf, away, none, flat
    value, n, h = spline_jet(sheet.values[row], base, t)
    g, curved = sheet.cell * value, finer * finer / sheet.cell
    n = (finer * n[0], finer * n[1], finer * n[2])
    h = (curved * h[0], curved * h[1], curved * h[2], curved * h[3], curved * h[4], curved * h[5])
    if end < 0:
        return g, g, n, h
    axial, m, radius = past_end(sheet.ends, end, x, y, z)
    if axial <= 0.0:
        return g, g, n, h
    g, safe = opened(sheet, g, axial, radius)
    if g == inf:
        return inf, safe, none, flat
    past = axial / radius
    bend = 6.0 * past / radius
    h = (
        h[0] + bend * m[0] * m[0],
        h[1] + bend * m[0] * m[1],
        h[2] + bend * m[0] * m[2],
        h[3] + bend * m[1] * m[1],
        h[4] + bend * m[1] * m[2],
        h[5] + bend * m[2] * m[2],
    )
    return g, safe, combine(1.0, n, 3.0 * past * past, m), h


@kernel
def splines(values, rows, places, out):
    """Value of the splines of some bricks at points of them.

    Parameters
    ----------
    values
        Coefficients, shape [bricks, 7 * 7 * 7].
    rows, places
        Brick of each point, and where in it it is, in cells, shapes [n] and [n, 3].
    out
        Shape [n].
    """
    for m in range(rows.shape[0]):
        i, j, k = (
            min(int(places[m, 0]), BRICK - 1),
            min(int(places[m, 1]), BRICK - 1),
            min(int(places[m, 2]), BRICK - 1),
        )
        t = (places[m, 0] - i, places[m, 1] - j, places[m, 2] - k)
        out[m] = spline_value(values[rows[m]], (i * WIDE + j) * WIDE + k, t)


@kernel
def steepest(values, finer, mouth, mouths, least):
    """Largest slope of the splines, looked for at the corners and in the middle of each cell.

    Parameters
    ----------
    values, mouth, mouths
        As of ``Sheet``; cells in mouths are passed over.
    finer
        How many times smaller the cells of each row are than ``Sheet.cell``.
    least
        Places that are this far outside, in ``Sheet.cell``, do not count.
    """
    largest = 0.0
    for m in range(values.shape[0]):
        for i in range(BRICK):
            for j in range(BRICK):
                for k in range(BRICK):
                    cell = (i * BRICK + j) * BRICK + k
                    if mouth[m] >= 0 and mouths[mouth[m], cell] >= 0:
                        continue
                    for half in range(2):
                        t = (0.5 * half, 0.5 * half, 0.5 * half)
                        value, n, _ = spline_jet(values[m], (i * WIDE + j) * WIDE + k, t)
                        if value > least:
                            largest = max(largest, finer[m] * sqrt(dot(n, n)))
    return largest
