"""Adding element blocks into the gradient and the band (lower triangle by columns)."""

from __future__ import annotations

from magwire.kernels._jit import kernel


@kernel
def add_vector(gradient, node, factor, v):
    """Add factor * v to the gradient of a node's position."""
    gradient[node, 0] += factor * v[0]
    gradient[node, 1] += factor * v[1]
    gradient[node, 2] += factor * v[2]


@kernel
def add_diagonal(band, r, a):
    """Add a symmetric block whose first row and column are r."""
    band[r, 0] += a[0]
    band[r, 1] += a[1]
    band[r, 2] += a[2]
    band[r + 1, 0] += a[3]
    band[r + 1, 1] += a[4]
    band[r + 2, 0] += a[5]


@kernel
def add_block(band, r, c, a):
    """Add a general block at rows r ..., columns c ..., with r >= c + 3."""
    d = r - c
    band[c, d] += a[0]
    band[c, d + 1] += a[3]
    band[c, d + 2] += a[6]
    band[c + 1, d - 1] += a[1]
    band[c + 1, d] += a[4]
    band[c + 1, d + 1] += a[7]
    band[c + 2, d - 2] += a[2]
    band[c + 2, d - 1] += a[5]
    band[c + 2, d] += a[8]


@kernel
def add_column(band, r, c, v):
    """Add a column vector at rows r ..., column c, with r > c."""
    d = r - c
    band[c, d] += v[0]
    band[c, d + 1] += v[1]
    band[c, d + 2] += v[2]


@kernel
def add_row(band, r, c, v):
    """Add a row vector at row r, columns c ..., with r > c + 2."""
    d = r - c
    band[c, d] += v[0]
    band[c + 1, d - 1] += v[1]
    band[c + 2, d - 2] += v[2]
