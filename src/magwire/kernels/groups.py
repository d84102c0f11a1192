"""Nodes, edges and hinges four at a time: reading them from arrays, and adding to arrays.

A group starts at one of them and ends with the last one at most; where fewer than four are left,
the last one is read more than once, and only the first ``count`` are written.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.lanes import (
    first,
    four,
    fourth,
    load,
    second,
    store,
    third,
    transposed,
    where,
)


@kernel
def group(start, last):
    """Numbers of four elements from ``start`` on, none above ``last``."""
    return start, min(start + 1, last), min(start + 2, last), min(start + 3, last)


@kernel
def rows(array, g):
    """Columns of the rows g of an array of shape [n, 4]."""
    return transposed(
        load(array, g[0], 0), load(array, g[1], 0), load(array, g[2], 0), load(array, g[3], 0)
    )


@kernel
def places(q, g):
    """Positions of the nodes g of a configuration, by component."""
    x, y, z, _ = rows(q, g)
    return x, y, z


@kernel
def numbers(array, g):
    """Entries g of a vector."""
    return four(array[g[0]], array[g[1]], array[g[2]], array[g[3]])


@kernel
def column(array, g, c):
    """Column c of the rows g of an array."""
    return four(array[g[0], c], array[g[1], c], array[g[2], c], array[g[3], c])


@kernel
def vectors(array, g):
    """3-vectors from the rows g of an array of shape [n, 3]."""
    return column(array, g, 0), column(array, g, 1), column(array, g, 2)


@kernel
def put_numbers(array, start, count, v):
    """Write the first ``count`` of four numbers to a vector."""
    array[start] = first(v)
    if count > 1:
        array[start + 1] = second(v)
    if count > 2:
        array[start + 2] = third(v)
    if count > 3:
        array[start + 3] = fourth(v)


@kernel
def put_vectors(array, start, count, v):
    """Write the first ``count`` of four 3-vectors to rows of an array of shape [n, 3]."""
    for c in range(3):
        array[start, c] = first(v[c])
        if count > 1:
            array[start + 1, c] = second(v[c])
        if count > 2:
            array[start + 2, c] = third(v[c])
        if count > 3:
            array[start + 3, c] = fourth(v[c])


@kernel
def add_rows(array, start, count, step, k, columns):
    """Add the first ``count`` of four rows, by columns, to an array.

    They go to the rows start, start + step and so on, from column k on, which may be negative, as
    of ``lanes.load``.
    """
    a, b, c, d = transposed(columns[0], columns[1], columns[2], columns[3])
    store(array, start, k, load(array, start, k) + a)
    if count > 1:
        store(array, start + step, k, load(array, start + step, k) + b)
    if count > 2:
        store(array, start + 2 * step, k, load(array, start + 2 * step, k) + c)
    if count > 3:
        store(array, start + 3 * step, k, load(array, start + 3 * step, k) + d)


@kernel
def total(v):
    """Sum of four numbers."""
    return (first(v) + second(v)) + (third(v) + fourth(v))


@kernel
def largest_of(v):
    """Largest of four numbers."""
    return max(max(first(v), second(v)), max(third(v), fourth(v)))


@kernel
def any_of(v):
    """Whether a component of four vectors is not zero."""
    return largest_of(abs(v[0]) + abs(v[1]) + abs(v[2])) > 0.0


@kernel
def smallest_of(v):
    """Smallest of four numbers."""
    return min(min(first(v), second(v)), min(third(v), fourth(v)))


@kernel
def larger(a, b):
    """Of each lane, the larger of two numbers."""
    return where(a - b, a, b)
