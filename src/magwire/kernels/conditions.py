"""Rows of the programme for the change of the field (P-22)."""

from __future__ import annotations

from math import inf, sqrt

from magwire.kernels._jit import kernel


@kernel
def fill_conditions(normals, fields, rooms, seen, limits, rows, upper):
    """Fill the linearised conditions, rows . (change, misses) <= upper, for some fields.

    Parameters
    ----------
    normals
        Of the polygon in which the tip may be, shape [n, 2].
    fields, rooms
        Fields over the weakest one, and the room for the tip in each, shapes [m].
    seen
        Weakest flux density [3], offset [2] and its derivative [2, 3], the eigenvalue's derivative
        [3], all without units.
    limits
        The eigenvalue, and what is asked for; the largest weakest field.
    rows, upper
        Shapes [m n + m + 1, 6] and [m n + m + 1]; of the rows the last three columns stay.

    Returns
    -------
    tuple
        The smallest upper bound of each kind: offset, eigenvalue, field.
    """
    b, offset, by_field, by_eigen = seen
    value, margin, largest = limits
    sides, cases = normals.shape[0], fields.shape[0]
    moved = (
        by_field[0, 0] * b[0] + by_field[0, 1] * b[1] + by_field[0, 2] * b[2],
        by_field[1, 0] * b[0] + by_field[1, 1] * b[1] + by_field[1, 2] * b[2],
    )
    stiffer = by_eigen[0] * b[0] + by_eigen[1] * b[1] + by_eigen[2] * b[2]
    tip, eigen = inf, inf
    for k in range(cases):
        f, more = fields[k], fields[k] - 1.0
        x, y = offset[0] + more * moved[0], offset[1] + more * moved[1]
        for i in range(sides):
            r = k * sides + i
            for c in range(3):
                slope = normals[i, 0] * by_field[0, c] + normals[i, 1] * by_field[1, c]
                rows[r, c] = f * slope
            upper[r] = rooms[k] - (x * normals[i, 0] + y * normals[i, 1])
            tip = min(tip, upper[r])
        r = cases * sides + k
        for c in range(3):
            rows[r, c] = -f * by_eigen[c]
        upper[r] = value + more * stiffer - margin
        eigen = min(eigen, upper[r])
    r = cases * (sides + 1)
    size = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2])
    for c in range(3):
        rows[r, c] = b[c] / max(size, 1e-9)
    upper[r] = largest - size
    return tip, eigen, upper[r]
