"""The slowest mode by inverse iteration of four vectors at a time (P-22).

One vector converges as the ratio of the two smallest eigenvalues, which a wire that may swing in
any direction has nearly equal; of four the first one does as that of the first and the fifth. Four
numbers are a register: a sweep with four costs hardly more than with one.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel, part
from magwire.kernels.assembly import FIRST
from magwire.kernels.band import WIDTH
from magwire.kernels.lanes import LANES, first, four, fourth, load, second, splat, store, third

SWEEPS = 30  # at most
SHARE = 0.03  # of every direction in the first guess of a mode
SETTLED = 1e-9  # relative change of the eigenvalue at which sweeps end
ROTATIONS = 12  # times that every pair of four vectors is turned, at most
ROUND_OFF = 1e-13  # what may be left of a product of two of them


@kernel
def lumped(rod, held, r):
    """Lumped mass of a row of the band."""
    i = held - 1 + r // 4
    return rod.inertia[i] if r % 4 == 3 else rod.mass[i]


@kernel
def solve_four(band, x, begin, last):
    """Solve in place, with the factor of rows begin ... last - 1, for the four columns of x."""
    for r in range(begin):
        store(x, r, 0, splat(0.0))
    for r in range(last, last + WIDTH):
        store(x, r, 0, splat(0.0))
    start = max(begin, WIDTH - 2)
    for j in range(begin, min(start, last)):
        value = load(x, j, 0)
        for k in range(1, j - begin + 1):
            value = value - band[j - k, k] * load(x, j - k, 0)
        store(x, j, 0, value)
    for j in range(start, last):
        far = band[j - 10, 10] * load(x, j - 10, 0) + band[j - 9, 9] * load(x, j - 9, 0)
        far = far + band[j - 8, 8] * load(x, j - 8, 0) + band[j - 7, 7] * load(x, j - 7, 0)
        mid = band[j - 6, 6] * load(x, j - 6, 0) + band[j - 5, 5] * load(x, j - 5, 0)
        mid = mid + band[j - 4, 4] * load(x, j - 4, 0) + band[j - 3, 3] * load(x, j - 3, 0)
        value = (load(x, j, 0) - far) - mid
        value = (value - band[j - 2, 2] * load(x, j - 2, 0)) - band[j - 1, 1] * load(x, j - 1, 0)
        store(x, j, 0, value)
    for j in range(last - 1, begin - 1, -1):
        far = band[j, 10] * load(x, j + 10, 0) + band[j, 9] * load(x, j + 9, 0)
        far = far + band[j, 8] * load(x, j + 8, 0) + band[j, 7] * load(x, j + 7, 0)
        mid = band[j, 6] * load(x, j + 6, 0) + band[j, 5] * load(x, j + 5, 0)
        mid = mid + band[j, 4] * load(x, j + 4, 0) + band[j, 3] * load(x, j + 3, 0)
        value = (band[j, 0] * load(x, j, 0) - far) - mid
        value = (value - band[j, 2] * load(x, j + 2, 0)) - band[j, 1] * load(x, j + 1, 0)
        store(x, j, 0, value)


@part
def mix(modes, last):
    """Give every direction a share in the guess of the slowest modes.

    A guess that lies in a plane, as the modes before may, would never find a mode across it.
    """
    size = 0.0
    for r in range(FIRST, last):
        size = max(size, abs(modes[r, 0]))
    share = SHARE * size if size > 0.0 else 1.0
    for r in range(FIRST, last):
        c, along = r % LANES, 1.0 - 2.0 * r / last
        ahead, aside = 1.0 if c == 0 else 0.0, 1.0 if c == 2 else 0.0
        store(modes, r, 0, load(modes, r, 0) + share * four(1.0, ahead, aside, along))


@part
def products(rod, held, modes, image, last, stiff, mass):
    """Products of the four columns with their images under stiffness, and under the masses."""
    s0 = s1 = s2 = s3 = splat(0.0)
    m0 = m1 = m2 = m3 = splat(0.0)
    for r in range(FIRST, last):
        y, b = load(modes, r, 0), load(image, r, 0)
        weighed = lumped(rod, held, r) * y
        s0, m0 = s0 + first(y) * b, m0 + first(y) * weighed
        s1, m1 = s1 + second(y) * b, m1 + second(y) * weighed
        s2, m2 = s2 + third(y) * b, m2 + third(y) * weighed
        s3, m3 = s3 + fourth(y) * b, m3 + fourth(y) * weighed
    store(stiff, 0, 0, s0)
    store(stiff, 1, 0, s1)
    store(stiff, 2, 0, s2)
    store(stiff, 3, 0, s3)
    store(mass, 0, 0, m0)
    store(mass, 1, 0, m1)
    store(mass, 2, 0, m2)
    store(mass, 3, 0, m3)


@part
def turn_pair(a, b, x, i, j):
    """Make columns i and j of x free of each other in both matrices, a and b, in place.

    Returns how far they were from that.
    """
    aii, ajj, aij = a[i, i], a[j, j], a[i, j]
    bii, bjj, bij = b[i, i], b[j, j], b[i, j]
    off = max(abs(aij) / sqrt(aii * ajj), abs(bij) / sqrt(bii * bjj))
    if not off > ROUND_OFF:
        return 0.0
    ci, cj = aii * bij - bii * aij, ajj * bij - bjj * aij
    c = aii * bjj - ajj * bii
    root = sqrt(max(0.25 * c * c + ci * cj, 0.0))
    x_ = 0.5 * c + (root if c >= 0.0 else -root)
    if x_ == 0.0:
        p, q = 0.0, (-aij / ajj if ajj != 0.0 else 0.0)
    else:
        p, q = cj / x_, -ci / x_
    for matrix in (a, b):
        for k in range(LANES):
            u, v = matrix[k, i], matrix[k, j]
            matrix[k, i], matrix[k, j] = u + q * v, v + p * u
        for k in range(LANES):
            u, v = matrix[i, k], matrix[j, k]
            matrix[i, k], matrix[j, k] = u + q * v, v + p * u
    for k in range(LANES):
        u, v = x[k, i], x[k, j]
        x[k, i], x[k, j] = u + q * v, v + p * u
    return off


@part
def ritz(stiff, mass, mixed):
    """The combinations of four vectors that are free of each other, in ``mixed`` by column.

    Jacobi's method for two matrices at once; ends with both diagonal. The slowest comes first, with
    unit mass. Returns its eigenvalue.
    """
    for i in range(LANES):
        for j in range(LANES):
            mixed[i, j] = 1.0 if i == j else 0.0
    for _ in range(ROTATIONS):
        worst = 0.0
        for i in range(LANES - 1):
            for j in range(i + 1, LANES):
                worst = max(worst, turn_pair(stiff, mass, mixed, i, j))
        if worst == 0.0:
            break
    best = 0
    for i in range(1, LANES):
        if stiff[i, i] * mass[best, best] < stiff[best, best] * mass[i, i]:
            best = i
    value = stiff[best, best] / mass[best, best]
    for i in range(LANES):
        for k in range(LANES):
            mixed[k, i] /= sqrt(mass[i, i])
    for k in range(LANES):
        mixed[k, 0], mixed[k, best] = mixed[k, best], mixed[k, 0]
    return value


@part
def slowest_modes(band, rod, held, block, last):
    """Smallest eigenvalue of stiffness against lumped mass, by the factor in the band.

    ``block.modes`` starts as a guess; its first column ends as the eigenvector, of unit mass.
    """
    modes, image = block.modes, block.image
    value = 0.0
    for _ in range(SWEEPS):
        for r in range(FIRST, last):
            b = lumped(rod, held, r) * load(modes, r, 0)
            store(image, r, 0, b)
            store(modes, r, 0, b)
        solve_four(band, modes, FIRST, last)
        products(rod, held, modes, image, last, block.stiff, block.mass)
        new = ritz(block.stiff, block.mass, block.mixed)
        m0, m1 = load(block.mixed, 0, 0), load(block.mixed, 1, 0)
        m2, m3 = load(block.mixed, 2, 0), load(block.mixed, 3, 0)
        for r in range(FIRST, last):
            y = load(modes, r, 0)
            mixed = first(y) * m0 + second(y) * m1 + third(y) * m2 + fourth(y) * m3
            store(modes, r, 0, mixed)
        others = 0.0
        for i in range(LANES):
            others = max(others, block.stiff[i, i] / block.mass[i, i])
        if abs(new - value) * (new / others) ** 2 <= SETTLED * new:
            return new
        value = new
    return value
