"""Signed distance from the triangles of a surface."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array, Indices

CANDIDATES = 12  # samples of the surface whose triangles are tried
MOST = 400_000  # samples
CHUNK = 100_000  # points at once


@dataclass(frozen=True, eq=False)
class Skin:
    """A surface of triangles, with its inside where its points' lines run.

    Parameters
    ----------
    points, triangles
        Shapes (n, 3) and (m, 3), all turned the same way round.
    inside
        Points that are inside for certain, shape (k, 3): they tell the sides apart.
    """

    points: Array
    triangles: Indices
    inside: Array

    def depth(self, points: Array) -> Array:
        """How deep points, shape (n, 3), are inside, shape (n,); negative outside."""
        return self._sign * self._signed(points)

    @cached_property
    def _sign(self) -> float:
        return float(np.sign(np.median(self._signed(self.inside)))) or 1.0

    @cached_property
    def _corners(self) -> Array:
        return self.points[self.triangles]

    @cached_property
    def _samples(self) -> tuple[KDTree, Indices]:
        """Points spread over the triangles, about as dense as their corners, and whose they are."""
        corners = self._corners
        sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        spacing = 0.5 * float(np.median(sides))
        while True:
            parts = np.maximum(np.ceil(sides / spacing).astype(np.int64), 1)
            if (parts * (parts + 1) // 2).sum() <= MOST:
                break
            spacing *= 1.3
        places, owners = [], []
        for part in np.unique(parts):
            i, j = np.meshgrid(np.arange(part), np.arange(part), indexing="ij")
            keep = i + j < part
            share = np.column_stack([i[keep] + 1 / 3, j[keep] + 1 / 3]) / part
            share = np.column_stack([share, 1.0 - share.sum(axis=1)])
            mine = np.flatnonzero(parts == part)
            places.append(np.einsum("sk,tkx->tsx", share, corners[mine]).reshape(-1, 3))
            owners.append(np.repeat(mine, len(share)))
        return KDTree(np.concatenate(places)), np.concatenate(owners)

    @cached_property
    def _normals(self) -> tuple[Array, Array, Array]:
        """Normals of triangles, and sums of them at their edges and corners (Baerentzen 2005).

        Shapes (m, 3), (m, 3, 3) for the edges opposite to each corner, and (n, 3).
        """
        a, b, c = (self._corners[:, k] for k in range(3))
        face = np.cross(b - a, c - a)
        face /= np.maximum(np.linalg.norm(face, axis=1), 1e-300)[:, None]
        at_points = np.zeros_like(self.points)
        for k in range(3):
            one = self._corners[:, (k + 1) % 3] - self._corners[:, k]
            two = self._corners[:, (k + 2) % 3] - self._corners[:, k]
            cosine = np.sum(one * two, axis=1) / np.maximum(
                np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1), 1e-300
            )
            angle = np.arccos(np.clip(cosine, -1.0, 1.0))
            np.add.at(at_points, self.triangles[:, k], angle[:, None] * face)
        sides = np.sort(self.triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2), axis=1)
        edges, where = np.unique(sides, axis=0, return_inverse=True)
        at_edges = np.zeros((len(edges), 3))
        np.add.at(at_edges, where.reshape(-1), np.repeat(face, 3, axis=0))
        return face, at_edges[where.reshape(-1)].reshape(-1, 3, 3), at_points

    def _signed(self, points: Array) -> Array:
        """Distance, negative on the side that normals point to, shape (n,)."""
        parts = [self._part(points[i : i + CHUNK]) for i in range(0, len(points), CHUNK)]
        return np.concatenate(parts) if parts else np.zeros(0)

    def _part(self, points: Array) -> Array:
        tree, owners = self._samples
        which = owners[tree.query(points, k=min(CANDIDATES, len(owners)))[1]]
        which = which.reshape(len(points), -1)
        best = np.full(len(points), np.inf)
        triangle = np.zeros(len(points), dtype=np.int64)
        share = np.zeros((len(points), 3))
        for column in which.T:
            weights = _foot(points, self._corners[column])
            foot = np.einsum("nk,nkx->nx", weights, self._corners[column])
            distance = np.sum((points - foot) ** 2, axis=1)
            closer = distance < best
            best[closer], triangle[closer] = distance[closer], column[closer]
            share[closer] = weights[closer]
        foot = np.einsum("nk,nkx->nx", share, self._corners[triangle])
        side = np.sum((points - foot) * self._outward(triangle, share), axis=1)
        return np.asarray(np.where(side > 0.0, -1.0, 1.0) * np.sqrt(best))

    def _outward(self, triangle: Indices, share: Array) -> Array:
        """The normal at a place in, on an edge or at a corner of a triangle."""
        face, edges, corners = self._normals
        normal = face[triangle].copy()
        zero = share <= 1e-9
        on_edge = zero.sum(axis=1) == 1
        normal[on_edge] = edges[triangle[on_edge], np.argmax(zero[on_edge], axis=1)]
        at_corner = zero.sum(axis=1) == 2
        corner = self.triangles[triangle[at_corner], np.argmin(zero[at_corner], axis=1)]
        normal[at_corner] = corners[corner]
        return normal


def _foot(points: Array, corners: Array) -> Array:
    """Shares of the corners in the point of each triangle nearest to a point, shape (n, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, points - a
    d00, d01, d11 = (np.sum(x * y, axis=1) for x, y in ((ab, ab), (ab, ac), (ac, ac)))
    d20, d21 = np.sum(ap * ab, axis=1), np.sum(ap * ac, axis=1)
    area = np.maximum(d00 * d11 - d01 * d01, 1e-300)
    v, w = (d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area
    inner = np.column_stack([1.0 - v - w, v, w])
    best, found = np.full(len(points), np.inf), inner.copy()
    outside = (inner < 0.0).any(axis=1)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        along = corners[:, other] - corners[:, one]
        t = np.sum((points - corners[:, one]) * along, axis=1)
        t = np.clip(t / np.maximum(np.sum(along * along, axis=1), 1e-300), 0.0, 1.0)
        off = np.sum((points - corners[:, one] - t[:, None] * along) ** 2, axis=1)
        closer = outside & (off < best)
        best[closer] = off[closer]
        found[closer] = 0.0
        found[closer, one], found[closer, other] = 1.0 - t[closer], t[closer]
    return found
