"""Banded symmetric matrices: root-free Cholesky factor and solve (P-1: half-bandwidth 10).

Column j of the lower triangle is stored in row j: band[j, k] = A[j + k, j], k = 0 ... 10, and
band[j, 11] = 0: so a row is three registers of four numbers. Rows of the matrix go in fours, of
which those of a wire are a node's three coordinates and the angle of the edge after it. What
follows each other twice, a node and the two after it, is coupled, but for the last one's angle:
A[i, j] = 0 for i > 4 (j // 4) + 10. Twelve rows more than the matrix has must be there.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.lanes import first as at0
from magwire.kernels.lanes import four, load, splat, store, transposed
from magwire.kernels.lanes import fourth as at3
from magwire.kernels.lanes import second as at1
from magwire.kernels.lanes import third as at2

HALF_BANDWIDTH = 10
WIDTH = HALF_BANDWIDTH + 2


@kernel
def column_of(band, j, c):
    """Column c of the four from row j on: three times four rows from j on, above it anything."""
    return load(band, j + c, -c), load(band, j + c, 4 - c), load(band, j + c, 8 - c)


@kernel
def less(a, factor, b):
    """Three times four numbers, less a factor times three times four."""
    return a[0] - factor * b[0], a[1] - factor * b[1], a[2] - factor * b[2]


@kernel
def factor(band, first, last):
    """Factor A = L D L^T of rows first ... last - 1 in place, with 1/D on the diagonal (P-5).

    Four columns at a time: c0 ... c3, twelve rows of each. What they leave of the next four columns
    is kept in t0 ... t3, eight rows of each; of the three after these in u0 ... u2, four rows.

    Returns -1, or the row where A is found not to be positive definite.
    """
    none = splat(0.0)
    t0, t1, t2, t3 = (none, none), (none, none), (none, none), (none, none)
    u0, u1, u2 = none, none, none
    for j in range(first - first % 4, last, 4):
        c0, c1 = plus(column_of(band, j, 0), t0), plus(column_of(band, j, 1), t1)
        c2, c3 = plus(column_of(band, j, 2), t2), plus(column_of(band, j, 3), t3)
        d0 = d1 = d2 = d3 = 0.0
        if first <= j:
            pivot = at0(c0[0])
            if not pivot > 0.0:
                return j
            d0 = 1.0 / pivot
            l0 = times(c0, d0)
            store(band, j, 0, four(d0, at1(l0[0]), at2(l0[0]), at3(l0[0])))
            store(band, j, 4, l0[1])
            store(band, j, 8, l0[2])
            c1 = less(c1, at1(l0[0]), c0)
            c2 = less(c2, at2(l0[0]), c0)
            c3 = less(c3, at3(l0[0]), c0)
        if first <= j + 1 < last:
            pivot = at1(c1[0])
            if not pivot > 0.0:
                return j + 1
            d1 = 1.0 / pivot
            l1 = times(c1, d1)
            store(band, j + 1, -1, four(0.0, d1, at2(l1[0]), at3(l1[0])))
            store(band, j + 1, 3, l1[1])
            store(band, j + 1, 7, l1[2])
            c2 = less(c2, at2(l1[0]), c1)
            c3 = less(c3, at3(l1[0]), c1)
        if first <= j + 2 < last:
            pivot = at2(c2[0])
            if not pivot > 0.0:
                return j + 2
            d2 = 1.0 / pivot
            l2 = times(c2, d2)
            store(band, j + 2, -2, four(0.0, 0.0, d2, at3(l2[0])))
            store(band, j + 2, 2, l2[1])
            store(band, j + 2, 6, l2[2])
            c3 = less(c3, at3(l2[0]), c2)
        if first <= j + 3 < last:
            pivot = at3(c3[0])
            if not pivot > 0.0:
                return j + 3
            d3 = 1.0 / pivot
            l3 = times(c3, d3)
            store(band, j + 3, -3, four(0.0, 0.0, 0.0, d3))
            store(band, j + 3, 1, l3[1])
            store(band, j + 3, 5, l3[2])
        near = d0 * c0[1], d1 * c1[1], d2 * c2[1], d3 * c3[1]
        far = d0 * c0[2], d1 * c1[2], d2 * c2[2], d3 * c3[2]
        whole = c0, c1, c2, c3
        t0 = left(u0, none, whole, (at0(near[0]), at0(near[1]), at0(near[2]), at0(near[3])))
        t1 = left(u1, none, whole, (at1(near[0]), at1(near[1]), at1(near[2]), at1(near[3])))
        t2 = left(u2, none, whole, (at2(near[0]), at2(near[1]), at2(near[2]), at2(near[3])))
        t3 = left(none, none, whole, (at3(near[0]), at3(near[1]), at3(near[2]), at3(near[3])))
        u0 = last_left(whole, (at0(far[0]), at0(far[1]), at0(far[2]), at0(far[3])))
        u1 = last_left(whole, (at1(far[0]), at1(far[1]), at1(far[2]), at1(far[3])))
        u2 = last_left(whole, (at2(far[0]), at2(far[1]), at2(far[2]), at2(far[3])))
    return -1


@kernel
def plus(c, t):
    """A column and what earlier ones left of its first eight rows."""
    return c[0] + t[0], c[1] + t[1], c[2]


@kernel
def times(c, factor):
    """A factor times a column."""
    return factor * c[0], factor * c[1], factor * c[2]


@kernel
def left(a, b, c, f):
    """Two times four rows of a later column, less parts f of four columns c."""
    for_a = (f[0] * c[0][1] + f[1] * c[1][1]) + (f[2] * c[2][1] + f[3] * c[3][1])
    for_b = (f[0] * c[0][2] + f[1] * c[1][2]) + (f[2] * c[2][2] + f[3] * c[3][2])
    return a - for_a, b - for_b


@kernel
def last_left(c, f):
    """Four rows of a column two further on, less parts f of four columns c."""
    return -((f[0] * c[0][2] + f[1] * c[1][2]) + (f[2] * c[2][2] + f[3] * c[3][2]))


@kernel
def solve(band, x, first, last):
    """Solve in place with the factor of rows first ... last - 1; x is indexed as the band."""
    begin = first - first % 4 + 4  # fours from here to ``end``, the rest one by one
    end = max(last - last % 4, begin)
    for j in range(first, min(begin, last)):
        eliminate(band, x, j)
    near, far = load(x, begin, 0), load(x, begin + 4, 0)
    for j in range(begin, end, 4):
        x0 = at0(near)
        x1 = at1(near) - x0 * band[j, 1]
        x2 = (at2(near) - x0 * band[j, 2]) - x1 * band[j + 1, 1]
        x3 = ((at3(near) - x0 * band[j, 3]) - x1 * band[j + 1, 2]) - x2 * band[j + 2, 1]
        store(x, j, 0, four(x0, x1, x2, x3))
        near = (far - x0 * load(band, j, 4)) - x1 * load(band, j + 1, 3)
        near = (near - x2 * load(band, j + 2, 2)) - x3 * load(band, j + 3, 1)
        far = (load(x, j + 8, 0) - x0 * load(band, j, 8)) - x1 * load(band, j + 1, 7)
        far = (far - x2 * load(band, j + 2, 6)) - x3 * load(band, j + 3, 5)
    store(x, end, 0, near)
    store(x, end + 4, 0, far)
    for j in range(end, last):
        eliminate(band, x, j)
    for j in range(last - 1, end - 1, -1):
        substitute(band, x, j)
    near, far = load(x, end, 0), load(x, end + 4, 0)
    for j in range(end - 4, begin - 1, -4):
        s0 = near * load(band, j, 4) + far * load(band, j, 8)
        s1 = near * load(band, j + 1, 3) + far * load(band, j + 1, 7)
        s2 = near * load(band, j + 2, 2) + far * load(band, j + 2, 6)
        s3 = near * load(band, j + 3, 1) + far * load(band, j + 3, 5)
        s0, s1, s2, s3 = transposed(s0, s1, s2, s3)
        inverse = four(band[j, 0], band[j + 1, 0], band[j + 2, 0], band[j + 3, 0])
        y = load(x, j, 0) * inverse - ((s0 + s1) + (s2 + s3))
        x3 = at3(y)
        x2 = at2(y) - x3 * band[j + 2, 1]
        x1 = (at1(y) - x3 * band[j + 1, 2]) - x2 * band[j + 1, 1]
        x0 = ((at0(y) - x3 * band[j, 3]) - x2 * band[j, 2]) - x1 * band[j, 1]
        far = near
        near = four(x0, x1, x2, x3)
        store(x, j, 0, near)
    for j in range(min(begin, last) - 1, first - 1, -1):
        substitute(band, x, j)


@kernel
def eliminate(band, x, j):
    """Take row j of a solution out of the rows after it."""
    for k in range(1, WIDTH - 1):
        x[j + k] -= x[j] * band[j, k]


@kernel
def substitute(band, x, j):
    """Row j of a solution from the rows after it."""
    value = x[j] * band[j, 0]
    for k in range(1, WIDTH - 1):
        value -= band[j, k] * x[j + k]
    x[j] = value
