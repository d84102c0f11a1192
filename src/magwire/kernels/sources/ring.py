"""Integrals over a ring, the building stones of loops and cylinders.

J(n, p) = integral over phi from 0 to pi of sin^(2p) phi D^(-n-1/2), with the squared distance
from a point of the ring D = rho^2 + a^2 + z^2 - 2 a rho cos phi. All are positive and regular
on the axis.
Two ways give them to rounding: away from the ring the midpoint rule, which converges geometrically
for a periodic integrand (error exp(-2 N eta), cosh eta = (rho^2 + a^2 + z^2)/(2 a rho); Trefethen
and Weideman, SIAM Review 56, 2014), and near the ring elliptic integrals with the recurrence in n.
The second way loses digits where the first one does not need many nodes: on the axis.

D (1/rho d/drho) of J(n, p) is (2n+1) (-J(n+1, p) + a^2 (2n+3)/(2p+1) J(n+2, p+1)); it follows from
integrating the cosine by parts.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np

from magwire.kernels._jit import kernel, summing
from magwire.kernels.sources.elliptic import cel


def _half_sines(nodes: int) -> np.ndarray:
    return np.sin((np.arange(nodes) + 0.5) * 0.5 * pi / nodes) ** 2


# sin^2(phi/2) at the midpoints of 12, 16, 24 and 32 intervals, one after the other
NODES = np.concatenate([_half_sines(n) for n in (12, 16, 24, 32)])
FAR, MIDDLE, NEAR, CLOSE = 4.2, 2.6, 1.6, 1.3
"""cosh eta from which so many nodes give all integrals to 2e-13 or better."""


@kernel
def nodes_for(d2, b2):
    """First node and number of nodes of the midpoint rule; none near the ring."""
    half = 0.5 * b2
    reach = d2 + half  # cosh eta = reach / half
    if reach >= MIDDLE * half:
        return (0, 12) if reach >= FAR * half else (12, 16)
    if reach >= CLOSE * half:
        return (28, 24) if reach >= NEAR * half else (52, 32)
    return (0, 0)


@summing
def loop_sums(d2, b2, start, n):
    """J10, J21, J31, J41, J42, J52, J63 by the midpoint rule; D = d2 + b2 sin^2(phi/2)."""
    s10 = s21 = s31 = s41 = s42 = s52 = s63 = 0.0
    nodes = NODES[start : start + n]
    for j in range(n):
        s = nodes[j]
        i = 1.0 / (d2 + b2 * s)
        w = 4.0 * s * (1.0 - s)
        t = i * sqrt(i)
        s10 += t
        t21 = w * i * t
        t31 = t21 * i
        t41 = t31 * i
        t42 = w * t41
        t52 = t42 * i
        s21 += t21
        s31 += t31
        s41 += t41
        s42 += t42
        s52 += t52
        s63 += w * i * t52
    h = pi / n
    return (h * s10, h * s21, h * s31, h * s41, h * s42, h * s52, h * s63)


@summing
def cylinder_sums(d2, b2, height, start, n):
    """J00, J11, J21, J31, J32, J42, J53 and the integral of 1/(D + |z| sqrt(D))."""
    s00 = s11 = s21 = s31 = s32 = s42 = s53 = st = 0.0
    nodes = NODES[start : start + n]
    for j in range(n):
        s = nodes[j]
        i = 1.0 / (d2 + b2 * s)
        w = 4.0 * s * (1.0 - s)
        u = sqrt(i)
        s00 += u
        st += i / (1.0 + height * u)
        wi = w * i
        t11 = wi * u
        t21 = t11 * i
        t31 = t21 * i
        t32 = t21 * wi
        t42 = t31 * wi
        s11 += t11
        s21 += t21
        s31 += t31
        s32 += t32
        s42 += t42
        s53 += t42 * wi
    h = pi / n
    return (h * s00, h * s11, h * s21, h * s31, h * s32, h * s42, h * s53, h * st)


@kernel
def ladder(d2, b2):
    """Integrals of D^(1/2), D^(-1/2), ..., D^(-13/2), from elliptic integrals."""
    far2 = d2 + b2
    far = sqrt(far2)
    k = sqrt(d2 / far2)
    middle = d2 + 0.5 * b2
    m0 = 2.0 * cel(k, 1.0, 1.0, 1.0) / far
    e = 2.0 * cel(k, 1.0, 1.0, k * k)
    m1 = e / (d2 * far)
    # m (A^2 - B^2) M_(m+1) = (2m - 1) A M_m - (m - 1) M_(m-1), m = 3/2, 5/2, ...
    c = 1.0 / (d2 * far2)
    m2 = c * (2.0 * middle * m1 - 0.5 * m0) / 1.5
    m3 = c * (4.0 * middle * m2 - 1.5 * m1) / 2.5
    m4 = c * (6.0 * middle * m3 - 2.5 * m2) / 3.5
    m5 = c * (8.0 * middle * m4 - 3.5 * m3) / 4.5
    m6 = c * (10.0 * middle * m5 - 4.5 * m4) / 5.5
    return (far * e, m0, m1, m2, m3, m4, m5, m6)


@kernel
def loop_elliptic(d2, b2):
    """The same seven as ``loop_sums``, near the ring."""
    m = ladder(d2, b2)
    return (
        m[2],
        _one(m, 2, d2, b2),
        _one(m, 3, d2, b2),
        _one(m, 4, d2, b2),
        _two(m, 4, d2, b2),
        _two(m, 5, d2, b2),
        _three(m, 6, d2, b2),
    )


@kernel
def cylinder_elliptic(d2, b2):
    """The first seven of ``cylinder_sums``, near the ring."""
    m = ladder(d2, b2)
    return (
        m[1],
        _one(m, 1, d2, b2),
        _one(m, 2, d2, b2),
        _one(m, 3, d2, b2),
        _two(m, 3, d2, b2),
        _two(m, 4, d2, b2),
        _three(m, 5, d2, b2),
    )


# sin^2 phi = (4/b2) y (1 - y/b2), y = D - d2: powers of y are differences of neighbours on
# the ladder.


@kernel
def _y1(m, n, d2):
    """Integral of y D^(-n-1/2)."""
    return m[n] - d2 * m[n + 1]


@kernel
def _y2(m, n, d2):
    return _y1(m, n - 1, d2) - d2 * _y1(m, n, d2)


@kernel
def _y3(m, n, d2):
    return _y2(m, n - 1, d2) - d2 * _y2(m, n, d2)


@kernel
def _y4(m, n, d2):
    return _y3(m, n - 1, d2) - d2 * _y3(m, n, d2)


@kernel
def _y5(m, n, d2):
    return _y4(m, n - 1, d2) - d2 * _y4(m, n, d2)


@kernel
def _y6(m, n, d2):
    return _y5(m, n - 1, d2) - d2 * _y5(m, n, d2)


@kernel
def _one(m, n, d2, b2):
    """J(n, 1)."""
    e = 1.0 / b2
    return 4.0 * e * (_y1(m, n, d2) - e * _y2(m, n, d2))


@kernel
def _two(m, n, d2, b2):
    """J(n, 2)."""
    e = 1.0 / b2
    return 16.0 * e * e * (_y2(m, n, d2) - e * (2.0 * _y3(m, n, d2) - e * _y4(m, n, d2)))


@kernel
def _three(m, n, d2, b2):
    """J(n, 3)."""
    e = 1.0 / b2
    inner = 3.0 * _y4(m, n, d2) - e * (3.0 * _y5(m, n, d2) - e * _y6(m, n, d2))
    return 64.0 * e * e * e * (_y3(m, n, d2) - e * inner)
