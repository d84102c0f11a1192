"""A wall of triangles: checked, turned the same way round, and ready to be searched."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array
from magwire.kernels.wall.closest import DEEPEST, LEAF, Triangles, depths

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

MORTON = 10  # bits of each coordinate by which triangles are put in order
LARGEST = 2_000_000  # triangles, at most


class Nearest(NamedTuple):
    """What of a wall is nearest to points.

    Attributes
    ----------
    depth
        How deep each is inside, negative outside, shape (n,) [m].
    points
        The wall's nearest points, shape (n, 3) [m].
    beyond
        Whether these are far past an end, shape (n,).
    """

    depth: Array
    points: Array
    beyond: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Sheet:
    """A wall of triangles, open at the ends of the lumen and nowhere else.

    Parameters
    ----------
    points
        Corners of the triangles, shape (n, 3) [m].
    triangles
        Their indices, shape (m, 3).

    Raises
    ------
    InputError
        If there are no triangles, indices of points that there are not, points that are not finite,
        or triangles that cannot be turned so that neighbours agree on the sides of the wall.
    """

    points: Array
    triangles: Indices

    def __post_init__(self) -> None:
        points = array("Lumen.with_surface", "points", self.points, (None, 3), "m")
        triangles = _indices(self.triangles, len(points))
        corners = points[triangles]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.linalg.norm(across, axis=1)
        triangles = triangles[size > 1e-12 * size.max(initial=0.0)]
        triangles = _turned(triangles)
        object.__setattr__(self, "points", _fixed(points))
        object.__setattr__(self, "triangles", _fixed(triangles))

    def turned(self) -> Sheet:
        """The same wall with its inside outside."""
        return Sheet(self.points, self.triangles[:, ::-1])

    @property
    def volume(self) -> float:
        """What is inside, its rims closed by fans [m^3]; negative if normals point inward."""
        middle = self.points.mean(axis=0)
        corners = [self.points[self.triangles] - middle]
        for rim in self.rims:
            here = self.points[rim] - middle
            centre = np.broadcast_to(here.mean(axis=0), here.shape)
            corners.append(np.stack([np.roll(here, -1, axis=0), here, centre], axis=1))
        a, b, c = np.concatenate(corners).transpose(1, 0, 2)
        return float(np.sum(a * np.cross(b, c))) / 6.0

    @cached_property
    def rims(self) -> list[Indices]:
        """Points of each open rim in their order, the first one not repeated."""
        sides = self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        _, where, count = np.unique(
            np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True
        )
        onward = dict(sides[count[where.reshape(-1)] == 1].tolist())
        rims = []
        while onward:
            start, at = onward.popitem()
            run = [start]
            while at != start and at in onward:
                run.append(at)
                at = onward.pop(at)
            if at != start or len(run) < 3:
                x, y, z = self.points[start]
                raise InputError(
                    "Input triangles of Lumen.with_surface must have rims that are closed; "
                    f"received one that is not, near ({x:.6g}, {y:.6g}, {z:.6g}) m."
                )
            rims.append(np.array(run, dtype=np.int64))
        return rims


def search_tree(points: Array, triangles: Indices, beyond: NDArray[np.bool_]) -> Triangles:
    """Triangles for the kernels that look for the nearest one; ``beyond`` as they have it."""
    corners = points[triangles]
    order = _in_order(corners.mean(axis=1))
    corners = corners[order]
    leaves = 1
    while LEAF * leaves < len(corners):
        leaves *= 2
    boxes = np.empty((2 * leaves - 1, 6))
    boxes[:, :3], boxes[:, 3:] = np.inf, -np.inf
    starts = np.arange(0, len(corners), LEAF)
    here = boxes[leaves - 1 : leaves - 1 + len(starts)]
    here[:, :3] = np.minimum.reduceat(corners.min(axis=1), starts)
    here[:, 3:] = np.maximum.reduceat(corners.max(axis=1), starts)
    first = leaves - 1
    while first > 0:
        below, above = boxes[first : 2 * first + 1], boxes[(first - 1) // 2 : first]
        above[:, :3] = np.minimum(below[::2, :3], below[1::2, :3])
        above[:, 3:] = np.maximum(below[::2, 3:], below[1::2, 3:])
        first = (first - 1) // 2
    return Triangles(
        np.ascontiguousarray(corners.reshape(-1, 9)),
        boxes,
        leaves,
        beyond[order],
        _normals(points, triangles)[order],
    )


def nearest(tree: Triangles, points: Array) -> Nearest:
    """What of a wall is nearest to points, shape (n, 3) [m]."""
    depth, triangle = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
    foot = np.empty((len(points), 3))
    waiting = np.empty(DEEPEST, dtype=np.int64)
    depths(tree, np.ascontiguousarray(points), waiting, depth, triangle, foot)
    return Nearest(depth, foot, tree.beyond[triangle])


def _indices(value: ArrayLike, count: int) -> Indices:
    """Triangles, checked."""
    given = np.asarray(value)
    if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu" or len(given) < 4:
        raise InputError(
            "Input triangles of Lumen.with_surface must be whole numbers, three for each of four "
            f"triangles at least; received shape {given.shape} of {given.dtype}."
        )
    if len(given) > LARGEST:
        raise InputError(
            f"Input triangles of Lumen.with_surface must be at most {LARGEST}; "
            f"received {len(given)}."
        )
    if given.min() < 0 or given.max() >= count:
        raise InputError(
            f"Input triangles of Lumen.with_surface must be indices from 0 to {count - 1}; "
            f"received {given.min()} to {given.max()}."
        )
    return given.astype(np.int64)


def _fixed(value: NDArray[Any]) -> NDArray[Any]:
    value = value.copy()
    value.flags.writeable = False
    return value


def _turned(triangles: Indices) -> Indices:
    """The triangles, turned so that neighbours run through their common edge in opposite ways."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, connected_components

    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, where, count = np.unique(
        np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    where = where.reshape(-1)
    if count.max() > 2:
        raise InputError(
            "Input triangles of Lumen.with_surface must meet by two at an edge, at most; received "
            f"{int(np.sum(count > 2))} edges with more."
        )
    order = np.argsort(where, kind="stable")
    pairs = np.flatnonzero(np.diff(where[order]) == 0)
    one, other = order[pairs], order[pairs + 1]
    same = sides[one, 0] == sides[other, 0]  # both run the same way: one of them is to be turned
    a, b = one // 3, other // 3
    if not same.any():
        return triangles
    links = coo_array((np.ones(len(a)), (a, b)), shape=(len(triangles),) * 2).tocsr()
    links = links + links.T
    apart = {(int(i), int(j)): bool(s) for i, j, s in zip(a, b, same, strict=True)}
    turn = np.zeros(len(triangles), dtype=bool)
    pieces, label = connected_components(links, directed=False)
    for piece in range(pieces):
        start = int(np.argmax(label == piece))
        reached, before = breadth_first_order(links, start, directed=False)
        for i in reached[1:].tolist():
            j = int(before[i])
            turn[i] = turn[j] ^ apart[(i, j) if (i, j) in apart else (j, i)]
    if np.any(turn[a] ^ turn[b] ^ same):
        raise InputError(
            "Input triangles of Lumen.with_surface must have an inside and an outside; received a "
            "surface that cannot be turned the same way round all over."
        )
    if 2 * turn.sum() > len(turn):
        turn = ~turn
    return np.where(turn[:, None], triangles[:, ::-1], triangles)


def _in_order(points: Array) -> Indices:
    """An order in which neighbours in space are neighbours: that of interleaved bits (Morton)."""
    low, size = points.min(axis=0), max(float(np.ptp(points, axis=0).max()), 1e-300)
    steps = ((points - low) / size * (2**MORTON - 1)).astype(np.int64)
    code = np.zeros(len(points), dtype=np.int64)
    for bit in range(MORTON):
        for axis in range(3):
            code |= ((steps[:, axis] >> bit) & 1) << (3 * bit + axis)
    return np.argsort(code, kind="stable")


def _normals(points: Array, triangles: Indices) -> Array:
    """Normals of triangles, and sums of them at their edges and corners, shape (m, 7, 3)."""
    corners = points[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face /= np.maximum(np.linalg.norm(face, axis=1), 1e-300)[:, None]
    at_points = np.zeros_like(points)
    for k in range(3):
        one = corners[:, (k + 1) % 3] - corners[:, k]
        two = corners[:, (k + 2) % 3] - corners[:, k]
        sine = np.linalg.norm(np.cross(one, two), axis=1)
        angle = np.arctan2(sine, np.sum(one * two, axis=1))
        np.add.at(at_points, triangles[:, k], angle[:, None] * face)
    sides = np.sort(triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2), axis=1)
    edges, where = np.unique(sides, axis=0, return_inverse=True)
    at_edges = np.zeros((len(edges), 3))
    np.add.at(at_edges, where.reshape(-1), np.repeat(face, 3, axis=0))
    found = np.empty((len(triangles), 7, 3))
    found[:, 0] = face
    found[:, 1:4] = at_edges[where.reshape(-1)].reshape(-1, 3, 3)
    found[:, 4:7] = at_points[triangles]
    return found
