"""Complete elliptic integrals of all kinds in one (R. Bulirsch, Numer. Math. 13, 305, 1969).

cel(k, p, a, b) = integral over t from 0 to pi/2 of
(a cos^2 t + b sin^2 t) / ((cos^2 t + p sin^2 t) sqrt(cos^2 t + k^2 sin^2 t)), k the complementary
modulus. K = cel(k, 1, 1, 1) and E = cel(k, 1, 1, k^2).
"""

from __future__ import annotations

from math import pi, sqrt

from magwire.kernels._jit import kernel

MEANS_AGREE = 1e-8
"""Arithmetic and geometric mean may differ by this much: their next difference is its square."""


@kernel
def cel(k, p, a, b):
    """General complete elliptic integral, for k > 0 and p > 0.

    Each turn replaces modulus and characteristic by their arithmetic and geometric means (Landen).
    """
    mean, product, root = 1.0, k, sqrt(p)
    b = b / root
    while True:
        a, b = a + b / root, 2.0 * (b + a * product / root)
        root = root + product / root
        before, mean = mean, mean + k
        if abs(before - k) <= MEANS_AGREE * before:
            return 0.5 * pi * (b + a * mean) / (mean * (mean + root))
        k = 2.0 * sqrt(product)
        product = k * mean
