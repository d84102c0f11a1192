"""A measured map: a tricubic spline through values on a regular grid, twice differentiable.

Coefficients are those of cubic B-splines on the grid, one more than there are points at each end.
Nothing makes such a field free of curl and divergence: all 9 and 18 derivatives are its own.
"""

from __future__ import annotations

from math import nan

from magwire.kernels._jit import kernel

ROUNDING = 1e-9
"""Of a point on the edge, over the step of the grid; it is turned into the map's frame."""
NAN3, NAN9, NAN18 = (nan,) * 3, (nan,) * 9, (nan,) * 18


@kernel
def inside(grid, shape, r):
    """Whether ``r``, in the map's frame, is on the grid; ``shape`` is that of the coefficients."""
    for i in range(3):
        s = (r[i] - grid[i]) / grid[3 + i]
        if not -ROUNDING <= s <= shape[2 + i] - 3.0 + ROUNDING:
            return False
    return True


@kernel
def in_frame(grid, x):
    """A point in the frame of the map: transposed rotation times (x - translation)."""
    a, b, c = x[0] - grid[6], x[1] - grid[7], x[2] - grid[8]
    return (
        grid[9] * a + grid[12] * b + grid[15] * c,
        grid[10] * a + grid[13] * b + grid[16] * c,
        grid[11] * a + grid[14] * b + grid[17] * c,
    )


@kernel
def _weights(s, cell, step):
    """Four weights of value, slope and second derivative in a cell; ``s`` from the first point."""
    t = s - cell
    u = 1.0 - t
    d, d2 = 1.0 / step, 1.0 / (step * step)
    value = (
        u * u * u / 6.0,
        (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
        (4.0 + u * u * (3.0 * u - 6.0)) / 6.0,
        t * t * t / 6.0,
    )
    slope = (
        -0.5 * d * u * u,
        d * t * (1.5 * t - 2.0),
        -d * u * (1.5 * u - 2.0),
        0.5 * d * t * t,
    )
    bend = (d2 * u, d2 * (3.0 * t - 2.0), d2 * (3.0 * u - 2.0), d2 * t)
    return value, slope, bend


@kernel
def component(maps, grid, which, r):
    """One component of one map, ``which`` = (map, component): value, 3 slopes, 6 second ones."""
    m, c = which
    sx, sy, sz = (
        (r[0] - grid[0]) / grid[3],
        (r[1] - grid[1]) / grid[4],
        (r[2] - grid[2]) / grid[5],
    )
    i = min(int(sx), maps.shape[2] - 4)
    j = min(int(sy), maps.shape[3] - 4)
    k = min(int(sz), maps.shape[4] - 4)
    wx = _weights(sx, i, grid[3])
    wy = _weights(sy, j, grid[4])
    wz = _weights(sz, k, grid[5])
    f = fx = fy = fz = fxx = fxy = fxz = fyy = fyz = fzz = 0.0
    for p in range(4):
        for q in range(4):
            v = vz = vzz = 0.0
            for s in range(4):
                a = maps[m, c, i + p, j + q, k + s]
                v += wz[0][s] * a
                vz += wz[1][s] * a
                vzz += wz[2][s] * a
            x, dx, ddx = wx[0][p], wx[1][p], wx[2][p]
            y, dy, ddy = wy[0][q], wy[1][q], wy[2][q]
            f += x * y * v
            fx += dx * y * v
            fy += x * dy * v
            fz += x * y * vz
            fxx += ddx * y * v
            fxy += dx * dy * v
            fxz += dx * y * vz
            fyy += x * ddy * v
            fyz += x * dy * vz
            fzz += x * y * vzz
    return f, (fx, fy, fz), (fxx, fxy, fxz, fyy, fyz, fzz)


@kernel
def on_grid(maps, grid, m, x):
    """Field of map ``m`` at ``x``: (3), (9), (18), turned back; NaN outside the grid."""
    r = in_frame(grid, x)
    if not inside(grid, maps.shape, r):
        return NAN3, NAN9, NAN18
    bx, gx, hx = component(maps, grid, (m, 0), r)
    by, gy, hy = component(maps, grid, (m, 1), r)
    bz, gz, hz = component(maps, grid, (m, 2), r)
    q = (grid[9], grid[10], grid[11], grid[12], grid[13], grid[14], grid[15], grid[16], grid[17])
    gx, gy, gz = _turn_slopes(q, gx), _turn_slopes(q, gy), _turn_slopes(q, gz)
    hx, hy, hz = _turn_bends(q, hx), _turn_bends(q, hy), _turn_bends(q, hz)
    flux = (_mix(q, 0, bx, by, bz), _mix(q, 3, bx, by, bz), _mix(q, 6, bx, by, bz))
    gradient = _mix3(q, 0, gx, gy, gz) + _mix3(q, 3, gx, gy, gz) + _mix3(q, 6, gx, gy, gz)
    second = _mix6(q, 0, hx, hy, hz) + _mix6(q, 3, hx, hy, hz) + _mix6(q, 6, hx, hy, hz)
    return flux, gradient, second


@kernel
def _turn_slopes(q, g):
    """Rotation times a slope."""
    return (
        _mix(q, 0, g[0], g[1], g[2]),
        _mix(q, 3, g[0], g[1], g[2]),
        _mix(q, 6, g[0], g[1], g[2]),
    )


@kernel
def _turn_bends(q, h):
    """Rotation times second derivatives times its transpose."""
    x = _turn_slopes(q, (h[0], h[1], h[2]))
    y = _turn_slopes(q, (h[1], h[3], h[4]))
    z = _turn_slopes(q, (h[2], h[4], h[5]))
    xx, xy, xz = _turn_slopes(q, (x[0], y[0], z[0]))
    _, yy, yz = _turn_slopes(q, (x[1], y[1], z[1]))
    zz = _mix(q, 6, x[2], y[2], z[2])
    return (xx, xy, xz, yy, yz, zz)


@kernel
def _mix(q, i, x, y, z):
    return q[i] * x + q[i + 1] * y + q[i + 2] * z


@kernel
def _mix3(q, i, x, y, z):
    return (
        _mix(q, i, x[0], y[0], z[0]),
        _mix(q, i, x[1], y[1], z[1]),
        _mix(q, i, x[2], y[2], z[2]),
    )


@kernel
def _mix6(q, i, x, y, z):
    return _mix3(q, i, x, y, z) + _mix3(
        q, i, (x[3], x[4], x[5]), (y[3], y[4], y[5]), (z[3], z[4], z[5])
    )
