"""Banded symmetric matrices: Cholesky factor and solve (P-1: half-bandwidth 10).

Column j of the lower triangle is stored in row j: band[j, k] = A[j + k, j], k = 0 ... 10.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel

HALF_BANDWIDTH = 10
WIDTH = HALF_BANDWIDTH + 1


@kernel
def factor(band, first, last):
    """Cholesky factor of rows first ... last - 1 in place; the row where it fails, or -1 (P-5)."""
    for j in range(first, last):
        pivot = band[j, 0]
        if not pivot > 0.0:
            return j
        root = sqrt(pivot)
        inverse = 1.0 / root
        band[j, 0] = root
        reach = min(WIDTH, last - j)
        for k in range(1, reach):
            band[j, k] *= inverse
        for k in range(1, reach):
            head = band[j, k]
            for m in range(k, reach):
                band[j + k, m - k] -= head * band[j, m]
    return -1


@kernel
def solve(band, x, first, last):
    """Solve in place with the factor of rows first ... last - 1; x is indexed as the band."""
    for j in range(first, last):
        value = x[j] / band[j, 0]
        x[j] = value
        for k in range(1, min(WIDTH, last - j)):
            x[j + k] -= value * band[j, k]
    for j in range(last - 1, first - 1, -1):
        value = x[j]
        for k in range(1, min(WIDTH, last - j)):
            value -= band[j, k] * x[j + k]
        x[j] = value / band[j, 0]
