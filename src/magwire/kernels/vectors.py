"""3-vectors as tuples: they live in registers, arrays do not."""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel

Vector = tuple[float, float, float]


@kernel
def row(array, i):
    """Row i of an array of shape [n, 3]."""
    return (array[i, 0], array[i, 1], array[i, 2])


@kernel
def add(a, b):
    """Sum a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@kernel
def sub(a, b):
    """Difference a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@kernel
def scale(factor, a):
    """Product factor * a."""
    return (factor * a[0], factor * a[1], factor * a[2])


@kernel
def combine(alpha, a, beta, b):
    """Linear combination alpha * a + beta * b."""
    return (alpha * a[0] + beta * b[0], alpha * a[1] + beta * b[1], alpha * a[2] + beta * b[2])


@kernel
def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a, b):
    """Vector product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@kernel
def norm(a):
    """Length of a vector."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
