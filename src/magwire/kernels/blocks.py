"""Small matrices as tuples: symmetric 3x3 as 6 numbers, general 3x3 as 9, by rows."""

from __future__ import annotations

from magwire.kernels._jit import kernel


@kernel
def sym_outer(factor, a):
    """Symmetric factor * a a^T."""
    x, y, z = factor * a[0], factor * a[1], factor * a[2]
    return (x * a[0], x * a[1], x * a[2], y * a[1], y * a[2], z * a[2])


@kernel
def sym_pair(factor, a, b):
    """Symmetric factor * (a b^T + b a^T)."""
    return (
        2.0 * factor * a[0] * b[0],
        factor * (a[0] * b[1] + a[1] * b[0]),
        factor * (a[0] * b[2] + a[2] * b[0]),
        2.0 * factor * a[1] * b[1],
        factor * (a[1] * b[2] + a[2] * b[1]),
        2.0 * factor * a[2] * b[2],
    )


@kernel
def sym_identity(factor):
    """Symmetric factor * I."""
    return (factor, 0.0, 0.0, factor, 0.0, factor)


@kernel
def sym_add(a, b):
    """Sum of two symmetric matrices."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5])


@kernel
def sym_scale(factor, a):
    """Product factor * a of a symmetric matrix."""
    return (
        factor * a[0],
        factor * a[1],
        factor * a[2],
        factor * a[3],
        factor * a[4],
        factor * a[5],
    )


@kernel
def outer(factor, a, b):
    """General factor * a b^T."""
    x, y, z = factor * a[0], factor * a[1], factor * a[2]
    return (
        x * b[0],
        x * b[1],
        x * b[2],
        y * b[0],
        y * b[1],
        y * b[2],
        z * b[0],
        z * b[1],
        z * b[2],
    )


@kernel
def skew(factor, a):
    """General factor * [a]x, the matrix of the vector product with a."""
    x, y, z = factor * a[0], factor * a[1], factor * a[2]
    return (0.0, -z, y, z, 0.0, -x, -y, x, 0.0)


@kernel
def full(a):
    """A symmetric matrix as a general one."""
    return (a[0], a[1], a[2], a[1], a[3], a[4], a[2], a[4], a[5])


@kernel
def mat_add(a, b):
    """Sum of two general matrices."""
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
    )


@kernel
def mat_scale(factor, a):
    """Product factor * a of a general matrix."""
    return (
        factor * a[0],
        factor * a[1],
        factor * a[2],
        factor * a[3],
        factor * a[4],
        factor * a[5],
        factor * a[6],
        factor * a[7],
        factor * a[8],
    )


@kernel
def transpose(a):
    """Transpose of a general matrix."""
    return (a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8])
