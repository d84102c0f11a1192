"""Bricks of the lattice on which the distance from a wall is a spline, and bricks half as large."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.wall.closest import DEEPEST, Triangles, agree, fill, surround
from magwire.kernels.wall.sheet import BRICK, WIDE, splines

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

HALO = 3  # points around a brick that its coefficients depend on
WHOLE = 1.5  # cells around a point on which finer coefficients there hang
SIDES = np.array(list(product((-1, 0, 1), repeat=3)))
OCTANTS = np.array(list(product((0, 1), repeat=3)))


@dataclass(eq=False)
class Level:
    """Bricks of one size.

    Attributes
    ----------
    corner, cell
        Lower corner of the box, and edge length of a cell [m].
    shape
        How many bricks of this size the box would have.
    places
        Where in the box each brick is, in the order of its number there, shape (bricks, 3).
    coefficients
        Coefficients of its spline, in cells, shape (bricks, 343).
    finer
        Which bricks are divided into smaller ones, shape (bricks,).
    """

    corner: Array
    cell: float
    shape: Indices
    places: Indices
    coefficients: Array = field(default_factory=lambda: np.zeros((0, WIDE**3)))
    finer: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))

    @property
    def edge(self) -> float:
        """Edge length of a brick [m]."""
        return BRICK * self.cell

    @property
    def slack(self) -> float:
        """Half the diagonal of a brick [m]."""
        return 0.5 * float(np.sqrt(3.0)) * self.edge

    @property
    def middles(self) -> Array:
        """Centres of the bricks, shape (bricks, 3) [m]."""
        return self.corner + (self.places + 0.5) * self.edge

    @cached_property
    def keys(self) -> Indices:
        """Number of each brick in the box; they increase."""
        return numbers(self.places, self.shape)

    def at(self, places: Indices) -> Indices:
        """Which brick is at each place of the box, -1 for none, shape (...)."""
        inside = ((places >= 0) & (places < self.shape)).all(axis=-1)
        keys = np.where(inside, numbers(places, self.shape), -1)
        found = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
        return np.where(inside & (self.keys[found] == keys), found, -1)

    @cached_property
    def beside(self) -> Indices:
        """The 27 bricks around each one, shape (bricks, 27)."""
        return np.ascontiguousarray(self.at(self.places[:, None, :] + SIDES))

    def samples(self, tree: Triangles, alone: bool) -> Array:
        """Coefficients of a spline close to the signed distance, shape (bricks, 7, 7, 7).

        They are the distance less a sixth of its second differences, so that what is cubic comes
        out as it is but for its fourth differences. alone: as of ``surround``.
        """
        count, padded = len(self.places), BRICK + 2 * HALO
        values = np.empty((count, padded**3))
        far = np.empty((count, BRICK**3), dtype=bool)
        waiting = np.empty(DEEPEST, dtype=np.int64)
        place = (tree, self.corner, self.cell, self.places)
        fill(*place, BRICK, HALO, waiting, values, far)
        scratch = np.empty((2, count * BRICK**3), dtype=np.int64)
        agree(self.beside, BRICK, HALO, values, far, *scratch)
        surround(*place, self.beside, alone, BRICK, HALO, waiting, values)
        cubes = values.reshape(count, padded, padded, padded)
        first, last = HALO - 1, HALO + BRICK + 2
        inner = slice(first, last)
        laplacian = -6.0 * cubes[:, inner, inner, inner]
        for step in (-1, 1):
            moved = slice(first + step, last + step)
            laplacian += cubes[:, moved, inner, inner]
            laplacian += cubes[:, inner, moved, inner]
            laplacian += cubes[:, inner, inner, moved]
        return np.asarray(cubes[:, inner, inner, inner] - laplacian / 6.0)

    def finished(self) -> Array:
        """Which coefficients have all their cells in bricks that are there, (bricks, 7, 7, 7)."""
        there = (self.beside >= 0).reshape(-1, 3, 3, 3)
        found = np.ones((len(self.places), WIDE, WIDE, WIDE), dtype=bool)
        parts = ((0, slice(0, 3)), (1, slice(3, 4)), (2, slice(4, 7)))
        for (a, x), (b, y), (c, z) in product(parts, repeat=3):
            needed = product({1, a}, {1, b}, {1, c})
            found[:, x, y, z] = np.all([there[:, i, j, k] for i, j, k in needed], axis=0)[
                :, None, None, None
            ]
        return found

    def off(self, spots: Array) -> tuple[Indices, Array]:
        """Which points are in bricks, and the spline there [m]."""
        inside = (spots - self.corner) / self.edge
        places = inside.astype(np.int64)
        bricks = self.at(places)
        there = np.flatnonzero(bricks >= 0)
        value = np.empty(len(there))
        splines(self.coefficients, bricks[there], BRICK * (inside[there] - places[there]), value)
        return there, self.cell * value

    def around(self, spots: Array) -> NDArray[np.bool_]:
        """Which bricks have to be finer for all that the finer spline hangs on at some points."""
        places = (spots - self.corner) / self.edge
        found = np.zeros(len(self.places), dtype=bool)
        for side in product((-WHOLE, WHOLE), repeat=3):
            bricks = self.at(np.floor(places + np.array(side) / BRICK).astype(np.int64))
            found[bricks[bricks >= 0]] = True
        return found

    def halved(self, tree: Triangles) -> Level:
        """Eight bricks for each that is to be finer, with corrections to the coarse spline."""
        parents = np.flatnonzero(self.finer)
        places = (2 * self.places[parents][:, None, :] + OCTANTS).reshape(-1, 3)
        made = _inserted(self.coefficients[parents]).reshape(-1, WIDE, WIDE, WIDE)
        order = np.argsort(numbers(places, 2 * self.shape))
        finer = Level(self.corner, 0.5 * self.cell, 2 * self.shape, places[order])
        wanted = finer.samples(tree, False)
        finer.coefficients = np.where(finer.finished(), wanted, made[order]).reshape(-1, WIDE**3)
        return finer


def numbers(places: Indices, shape: Indices) -> Indices:
    """Number of each place in a box of bricks, shape (...)."""
    found: Indices = (places[..., 0] * shape[1] + places[..., 1]) * shape[2] + places[..., 2]
    return found


def _inserted(coefficients: Array) -> Array:
    """The same splines by cells of half the size, in eight parts, in units of these.

    Shape (bricks, 2, 2, 2, 7, 7, 7). Knots are inserted in the middle of each cell: a coefficient
    is the mean of two, or (1, 6, 1)/8 of three.
    """
    half = np.zeros((2, WIDE, WIDE))
    for part in range(2):
        for i in range(WIDE):  # coefficient i - 1 of the part, i - 1 + BRICK * part of the whole
            fine = i - 1 + BRICK * part
            if fine % 2 == 0:
                half[part, i, fine // 2 : fine // 2 + 3] = 0.125, 0.75, 0.125
            else:
                half[part, i, (fine - 1) // 2 + 1 : (fine - 1) // 2 + 3] = 0.5
    cubes = coefficients.reshape(-1, WIDE, WIDE, WIDE)
    made = np.einsum("axi,byj,czk,nijk->nabcxyz", half, half, half, cubes, optimize=True)
    found: Array = 2.0 * made
    return found
