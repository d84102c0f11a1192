"""The inside of a surface: voxels, and the distance of points from the wall."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array, FileFaultError, Indices

VOXELS = 3_000_000  # of the box around the surface, at most
CROSSINGS = 20_000_000  # columns that are tried for all triangles, at most
SAMPLES = 200_000  # of the wall, at most


class Interior(NamedTuple):
    """Voxels inside a surface.

    Attributes
    ----------
    centres
        Shape (n, 3).
    number
        Index of each voxel of the box in ``centres``, -1 outside.
    cell
        Edge length of a voxel.
    """

    centres: Array
    number: NDArray[np.int32]
    cell: float

    def graph(self, cost: Array) -> csr_array:
        """Links of neighbouring voxels, as long as they are far apart times their mean cost."""
        rows, columns, lengths = [], [], []
        for shift in _SHIFTS:
            here = tuple(
                slice(max(0, -d), n - max(0, d))
                for d, n in zip(shift, self.number.shape, strict=True)
            )
            there = tuple(
                slice(max(0, d), n - max(0, -d))
                for d, n in zip(shift, self.number.shape, strict=True)
            )
            a, b = self.number[here].ravel(), self.number[there].ravel()
            both = (a >= 0) & (b >= 0)
            a, b = a[both], b[both]
            rows.append(a)
            columns.append(b)
            lengths.append(self.cell * float(np.linalg.norm(shift)) * 0.5 * (cost[a] + cost[b]))
        n = len(self.centres)
        links = (np.concatenate(rows), np.concatenate(columns))
        return csr_array((np.concatenate(lengths), links), shape=(n, n))


_SHIFTS = [
    (i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if (i, j, k) > (0, 0, 0)
]


def fill(points: Array, triangles: Indices, cell: float) -> Interior:
    """Voxels whose centres are inside a closed surface.

    A centre is inside if a line from it along z meets the surface an odd number of times.

    Parameters
    ----------
    points, triangles
        The surface, shapes (n, 3) and (m, 3).
    cell
        Edge length of a voxel; larger if the box would hold more than ``VOXELS``.
    """
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    cell = max(cell, float(np.prod(np.maximum(extent, cell)) / VOXELS) ** (1.0 / 3.0))
    shape = np.ceil(extent / cell).astype(np.int64) + 3
    corner = low - 1.017 * cell  # off the corners of the surface, which often are round numbers
    column, height = _crossings((points - corner) / cell, triangles, int(shape[1]))
    # A crossing turns everything above it inside out.
    turns = np.zeros((int(shape[0] * shape[1]), int(shape[2])), dtype=np.uint8)
    above = np.clip(np.ceil(height - 0.5), 0, shape[2] - 1).astype(np.int64)
    np.add.at(turns, (column, above), 1)
    inside = (np.cumsum(turns, axis=1, dtype=np.uint8) % 2).astype(bool)
    inside[turns.sum(axis=1) % 2 == 1] = False  # such a column has met a hole
    inside = inside.reshape(tuple(shape))
    number = np.full(inside.shape, -1, dtype=np.int32)
    number[inside] = np.arange(int(inside.sum()), dtype=np.int32)
    centres = corner + (np.argwhere(inside) + 0.5) * cell
    return Interior(centres, number, cell)


def _crossings(places: Array, triangles: Indices, columns: int) -> tuple[Indices, Array]:
    """Where lines along z through the middles of the columns meet the triangles, in voxels."""
    corners = places[triangles]
    low = np.ceil(corners[:, :, :2].min(axis=1) - 0.5).astype(np.int64)
    count = np.floor(corners[:, :, :2].max(axis=1) - 0.5).astype(np.int64) - low + 1
    count = np.maximum(count, 0)
    tries = count.prod(axis=1)
    if tries.sum() > CROSSINGS:
        raise FileFaultError("has a surface too large for the voxels that its narrowest end needs")
    owner = np.repeat(np.arange(len(triangles)), tries)
    local = np.arange(len(owner)) - np.repeat(np.cumsum(tries) - tries, tries)
    i = low[owner, 0] + local // np.maximum(count[owner, 1], 1)
    j = low[owner, 1] + local % np.maximum(count[owner, 1], 1)
    a, b, c = (corners[owner, k] for k in range(3))
    x, y = i + 0.5, j + 0.5
    u = (b[:, 0] - x) * (c[:, 1] - y) - (c[:, 0] - x) * (b[:, 1] - y)
    v = (c[:, 0] - x) * (a[:, 1] - y) - (a[:, 0] - x) * (c[:, 1] - y)
    w = (a[:, 0] - x) * (b[:, 1] - y) - (b[:, 0] - x) * (a[:, 1] - y)
    hit = ((u >= 0) & (v >= 0) & (w >= 0)) | ((u < 0) & (v < 0) & (w < 0))
    total = np.where(u + v + w == 0.0, 1.0, u + v + w)
    hit &= u + v + w != 0.0
    height = (u * a[:, 2] + v * b[:, 2] + w * c[:, 2]) / total
    return (i * columns + j)[hit], height[hit]


def wall_samples(points: Array, triangles: Indices, spacing: float) -> tuple[Array, float]:
    """Points spread over the wall, shape (n, 3), and how far apart they are."""
    corners = points[triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    while True:
        parts = np.maximum(np.ceil(longest / spacing).astype(np.int64), 1)
        if ((parts + 1) * (parts + 2) // 2).sum() <= max(SAMPLES, 3 * len(parts)):  # all corners
            break
        spacing *= 1.3
    found = []
    for part in np.unique(parts):
        i, j = np.meshgrid(np.arange(part + 1), np.arange(part + 1), indexing="ij")
        keep = i + j <= part
        shares = np.column_stack([i[keep], j[keep], part - i[keep] - j[keep]]) / part
        found.append(np.einsum("sk,tkx->tsx", shares, corners[parts == part]).reshape(-1, 3))
    return np.unique(np.concatenate(found), axis=0), spacing


def to_wall(samples: KDTree, points: Array, within: float = 0.0) -> tuple[Array, Array]:
    """Distance of points from the wall, shape (n,), and unit vectors away from it, (n, 3).

    Parameters
    ----------
    samples
        Samples of the wall.
    points
        Shape (n, 3).
    within
        Part by which the distance may be too large; the larger, the faster.
    """
    distance, nearest = samples.query(points, eps=within)
    away = points - samples.data[nearest]
    return distance, away / np.maximum(distance, 1e-300)[:, None]
