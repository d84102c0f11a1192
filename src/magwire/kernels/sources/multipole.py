"""Sources of MPEM files of any order (Petruska and others, IEEE Trans. Magnetics 53, 2017).

psi = sum b_n r^(-n-1) P_n(c) + sum a_n r^n P_n(c), c the cosine of the angle to the direction, and
B = -grad psi.
All derivatives stay solid harmonics: with I_n = r^(-n-1) P_n and R_n = r^n P_n,
dI_n/dz = -(n+1) I_(n+1), D^k I_n = (-1)^k r^(-n-1-2k) P_(n+k)^(k), dR_n/dz = n R_(n-1),
D^k R_n = (-1)^k r^(n-2k) P_(n-k)^(k); D = (1/rho) d/drho.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.sources.harmonic import axial
from magwire.kernels.vectors import combine, dot


@kernel
def legendre(n, k, c):
    """The k-th derivative of the Legendre polynomial P_n at ``c``, k up to 3; 0 for n < k."""
    if n < k:
        return 0.0
    # P_k^(k) = (2k - 1)!!, then (m - k + 1) P_(m+1) = (2m + 1) c P_m - (m + k) P_(m-1)
    before, now = 0.0, 1.0
    for i in range(1, k + 1):
        now *= 2.0 * i - 1.0
    for m in range(k, n):
        before, now = now, ((2 * m + 1) * c * now - (m + k) * before) / (m - k + 1)
    return now


@kernel
def multipole(r, t, strength, outward, inward, j):
    """Field of source ``j``, ``r`` from it; rows of ``outward`` are b_n and of ``inward`` a_n."""
    z = dot(r, t)
    q = combine(1.0, r, -z, t)
    size = sqrt(dot(r, r))
    c = z / size
    b_z = p = p_z = dp = dp_z = ddp = 0.0
    for i in range(outward.shape[1]):
        n = i + 1
        b = -strength * outward[j, i] / size ** (n + 2)
        w = (n + 1.0) * b
        s2 = size * size
        b_z -= w * legendre(n + 1, 0, c)
        p -= b * legendre(n + 1, 1, c) / size
        p_z += w * legendre(n + 2, 1, c) / s2
        dp += b * legendre(n + 2, 2, c) / (s2 * size)
        dp_z -= w * legendre(n + 3, 2, c) / (s2 * s2)
        ddp -= b * legendre(n + 3, 3, c) / (s2 * s2 * size)
    for i in range(inward.shape[1]):
        n = i + 1
        a = -strength * inward[j, i]
        w = n * a
        b_z += w * size ** (n - 1) * legendre(n - 1, 0, c)
        if n >= 2:
            p -= a * size ** (n - 2) * legendre(n - 1, 1, c)
        if n >= 3:
            p_z -= w * size ** (n - 3) * legendre(n - 2, 1, c)
        if n >= 4:
            dp += a * size ** (n - 4) * legendre(n - 2, 2, c)
        if n >= 5:
            dp_z += w * size ** (n - 5) * legendre(n - 3, 2, c)
        if n >= 6:
            ddp -= a * size ** (n - 6) * legendre(n - 3, 3, c)
    return axial(t, z, q, (b_z, p_z, dp_z), (p, dp, ddp))
