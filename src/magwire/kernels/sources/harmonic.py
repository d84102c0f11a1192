"""Fields of empty space: 15 numbers hold flux density, first and second derivatives.

Divergence and curl are zero, so dB_i/dx_j is symmetric without trace (5 numbers), and
d2B_i/dx_j dx_k is symmetric in all three indices without any trace (7 numbers). In order:
x y z; xx xy xz yy yz; xxx xxy xxz xyy xyz yyy yyz.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import dot

NOTHING = (0.0,) * 15


@kernel
def plus(a, b):
    """Sum of two fields."""
    return (
        a[0] + b[0],
        a[1] + b[1],
        a[2] + b[2],
        a[3] + b[3],
        a[4] + b[4],
        a[5] + b[5],
        a[6] + b[6],
        a[7] + b[7],
        a[8] + b[8],
        a[9] + b[9],
        a[10] + b[10],
        a[11] + b[11],
        a[12] + b[12],
        a[13] + b[13],
        a[14] + b[14],
    )


@kernel
def first(h):
    """dB_i/dx_j, 9 numbers by rows."""
    return (h[3], h[4], h[5], h[4], h[6], h[7], h[5], h[7], -h[3] - h[6])


@kernel
def second(h):
    """d2B_i/dx_j dx_k, 18 numbers: for each i the pairs xx, xy, xz, yy, yz, zz."""
    xzz, yzz, zzz = -h[8] - h[11], -h[9] - h[13], -h[10] - h[14]
    return (
        (h[8], h[9], h[10], h[11], h[12], xzz)
        + (h[9], h[11], h[12], h[13], h[14], yzz)
        + (h[10], h[12], xzz, h[14], yzz, zzz)
    )


@kernel
def axial(t, z, q, along, radial):
    """Field of a source that is symmetric about the axis ``t``, from six numbers on the meridian.

    The potential is a function of z, the position along the axis, and rho^2 = q.q, q the position
    across it. With D = (1/rho) d/drho, B_z t + P q is the flux density, P = D(potential).

    along
        (B_z, dP/dz, D dP/dz).
    radial
        (P, D P, D D P).

    Laplace's equation gives dB_z/dz = -2 P - rho^2 D P, d2P/dz2 = -4 D P - rho^2 D D P and
    d2B_z/dz2 = -2 dP/dz - rho^2 D dP/dz.
    """
    b_z, p_z, dp_z = along
    p, dp, ddp = radial
    rho2 = dot(q, q)
    # dB_i/dx_j = P delta_ij + D P q_i q_j + P_z (q_i t_j + t_i q_j) + (B_zz - P) t_i t_j
    g = -3.0 * p - rho2 * dp
    # d2B: v_i delta_jk (3 places) + cubic form of q and t
    v = (dp * q[0] + p_z * t[0], dp * q[1] + p_z * t[1], dp * q[2] + p_z * t[2])
    a = -5.0 * dp - rho2 * ddp
    e = -5.0 * p_z - rho2 * dp_z
    # the cubic form as w_jk q_i + u_jk t_i, in rows i
    xx, xy, xz = _pair(q, t, 0, 0, ddp, dp_z, a), _pair(q, t, 0, 1, ddp, dp_z, a), 0.0
    xz = _pair(q, t, 0, 2, ddp, dp_z, a)
    yy, yz = _pair(q, t, 1, 1, ddp, dp_z, a), _pair(q, t, 1, 2, ddp, dp_z, a)
    u_xx, u_xy, u_xz = _pair(q, t, 0, 0, dp_z, a, e), _pair(q, t, 0, 1, dp_z, a, e), 0.0
    u_xz = _pair(q, t, 0, 2, dp_z, a, e)
    u_yy, u_yz = _pair(q, t, 1, 1, dp_z, a, e), _pair(q, t, 1, 2, dp_z, a, e)
    return (
        p * q[0] + b_z * t[0],
        p * q[1] + b_z * t[1],
        p * q[2] + b_z * t[2],
        p + _pair(q, t, 0, 0, dp, p_z, g),
        _pair(q, t, 0, 1, dp, p_z, g),
        _pair(q, t, 0, 2, dp, p_z, g),
        p + _pair(q, t, 1, 1, dp, p_z, g),
        _pair(q, t, 1, 2, dp, p_z, g),
        3.0 * v[0] + q[0] * xx + t[0] * u_xx,
        v[1] + q[0] * xy + t[0] * u_xy,
        v[2] + q[0] * xz + t[0] * u_xz,
        v[0] + q[0] * yy + t[0] * u_yy,
        q[0] * yz + t[0] * u_yz,
        3.0 * v[1] + q[1] * yy + t[1] * u_yy,
        v[2] + q[1] * yz + t[1] * u_yz,
    )


@kernel
def _pair(q, t, i, j, qq, qt, tt):
    """Entry i, j of qq q q + qt (q t + t q) + tt t t."""
    return qq * q[i] * q[j] + qt * (q[i] * t[j] + t[i] * q[j]) + tt * t[i] * t[j]
