"""Banded symmetric matrices: root-free Cholesky factor and solve (P-1: half-bandwidth 10).

Column j of the lower triangle is stored in row j: band[j, k] = A[j + k, j], k = 0 ... 10. Ten rows
more than the matrix has must be there, and its columns must end in zeros: so every loop has a fixed
length, which the compiler unrolls.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel

HALF_BANDWIDTH = 10
WIDTH = HALF_BANDWIDTH + 1


@kernel
def subtract(row, factor, values):
    """Subtract factor * values from the head of a row."""
    for m in range(len(values)):
        row[m] -= factor * values[m]


@kernel
def factor(band, first, last):
    """Factor A = L D L^T of rows first ... last - 1 in place, with 1/D on the diagonal (P-5).

    Returns -1, or the row where A is found not to be positive definite.
    """
    for j in range(first, last):
        c = band[j]
        if not c[0] > 0.0:
            return j
        inverse = 1.0 / c[0]
        a = (c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10])
        subtract(band[j + 1], inverse * a[0], a)
        subtract(band[j + 2], inverse * a[1], a[1:])
        subtract(band[j + 3], inverse * a[2], a[2:])
        subtract(band[j + 4], inverse * a[3], a[3:])
        subtract(band[j + 5], inverse * a[4], a[4:])
        subtract(band[j + 6], inverse * a[5], a[5:])
        subtract(band[j + 7], inverse * a[6], a[6:])
        subtract(band[j + 8], inverse * a[7], a[7:])
        subtract(band[j + 9], inverse * a[8], a[8:])
        subtract(band[j + 10], inverse * a[9], a[9:])
        c[0] = inverse
        for k in range(1, WIDTH):
            c[k] *= inverse
    return -1


@kernel
def solve(band, x, first, last):
    """Solve in place with the factor of rows first ... last - 1; x is indexed as the band."""
    for j in range(first, last):
        for k in range(1, WIDTH):
            x[j + k] -= x[j] * band[j, k]
    for j in range(last - 1, first - 1, -1):
        value = x[j] * band[j, 0]
        for k in range(1, WIDTH):
            value -= band[j, k] * x[j + k]
        x[j] = value
