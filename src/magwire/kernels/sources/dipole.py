"""Point dipoles, among them the sources of order one of MPEM files and spheres seen from outside.

B = (3 (m.r) r/r^2 - m)/r^3 with m in units of 4 pi/mu0 (Jackson, Classical Electrodynamics, 5.64).
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import part, summing


@part
def dipole(r, m):
    """Field of one dipole, ``r`` from it, as in harmonic.py; taken in, so that sums are SIMD."""
    x, y, z = r
    i = 1.0 / (x * x + y * y + z * z)
    i3 = i * sqrt(i)
    a = 3.0 * i3 * i
    f = m[0] * x + m[1] * y + m[2] * z
    c = 5.0 * a * i
    d = 7.0 * c * i * f
    af, cf = a * f, c * f
    # m_i r_j + m_j r_i, and what multiplies the triple product of r
    xx, xy, xz = 2.0 * m[0] * x, m[0] * y + m[1] * x, m[0] * z + m[2] * x
    yy, yz = 2.0 * m[1] * y, m[1] * z + m[2] * y
    ux, uy, uz = a * m[0] - cf * x, a * m[1] - cf * y, a * m[2] - cf * z
    return (
        af * x - i3 * m[0],
        af * y - i3 * m[1],
        af * z - i3 * m[2],
        a * xx + af - cf * x * x,
        a * xy - cf * x * y,
        a * xz - cf * x * z,
        a * yy + af - cf * y * y,
        a * yz - cf * y * z,
        3.0 * ux - c * (1.5 * xx * x) + d * x * x * x,
        uy - c * (x * xy + m[0] * x * y) + d * x * x * y,
        uz - c * (x * xz + m[0] * x * z) + d * x * x * z,
        ux - c * (y * xy + m[1] * x * y) + d * x * y * y,
        d * x * y * z - c * (m[0] * y * z + m[1] * x * z + m[2] * x * y),
        3.0 * uy - c * (1.5 * yy * y) + d * y * y * y,
        uz - c * (y * yz + m[1] * y * z) + d * y * y * z,
    )


@summing
def dipoles(state, at, n, px, py, pz):
    """Sum of ``n`` dipoles whose state begins at ``at``, seen from a point."""
    s0 = s1 = s2 = s3 = s4 = s5 = s6 = s7 = s8 = s9 = s10 = s11 = s12 = s13 = s14 = 0.0
    # a slice each: an index that begins at zero needs no check for counting from the end
    x, y, z = state[at : at + n], state[at + n : at + 2 * n], state[at + 2 * n : at + 3 * n]
    at += 3 * n
    mx, my, mz = state[at : at + n], state[at + n : at + 2 * n], state[at + 2 * n : at + 3 * n]
    for j in range(n):
        h = dipole((px - x[j], py - y[j], pz - z[j]), (mx[j], my[j], mz[j]))
        s0 += h[0]
        s1 += h[1]
        s2 += h[2]
        s3 += h[3]
        s4 += h[4]
        s5 += h[5]
        s6 += h[6]
        s7 += h[7]
        s8 += h[8]
        s9 += h[9]
        s10 += h[10]
        s11 += h[11]
        s12 += h[12]
        s13 += h[13]
        s14 += h[14]
    return (s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11, s12, s13, s14)
