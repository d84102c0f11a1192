"""A surface made ready for extraction: welded, in one piece, its ends found and capped."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from magwire.vessel.files.drawing import Array, FileFaultError, Indices, Surface, chains

WELD = 1e-6  # distance at which corners are one, over the size of the surface
DEBRIS = 0.05  # area of a piece that is left out without asking, over the area of all
FLAT = np.cos(np.radians(3.0))  # between normals of neighbouring triangles of a flat cap
EDGE = np.cos(np.radians(40.0))  # between the normals of a cap and of the wall around it
ROUND = 0.7  # area of a cap over that of the circle around it
SMOOTHER = 0.6  # part of a cap's rim that is a sharp edge, at least


class End(NamedTuple):
    """An end of the vessel.

    Attributes
    ----------
    centre, outward
        Its middle, and the direction out of the vessel, shape (3,).
    radius
        Radius of a circle of the same area.
    across
        Mean of the cosine between its axis and the normals of the wall around it: near 0 at the end
        of a tube, near 1 at a hole in a wall.
    """

    centre: Array
    outward: Array
    radius: float
    across: float = 0.0


class Shell(NamedTuple):
    """A surface whose ends are known.

    Attributes
    ----------
    points
        Shape (n, 3).
    wall, caps
        Triangles of the vessel's wall and of what closes its ends, shapes (m, 3).
    ends
        One for each open rim and each flat cap.
    notes
        What was done to the surface, a sentence each.
    cap_of
        The end that each triangle of the caps closes, shape (m,).
    """

    points: Array
    wall: Indices
    caps: Indices
    ends: list[End]
    notes: tuple[str, ...]
    cap_of: Indices


def shell(surface: Surface) -> Shell:
    """The surface in one piece, with its ends.

    Raises
    ------
    FileFaultError
        If it has no triangles of any area, or is in several pieces.
    """
    points, triangles = _welded(surface)
    triangles, notes = _one_piece(points, triangles)
    used, triangles = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], triangles.reshape(-1, 3).astype(np.int64)
    rims = _rims(triangles)
    if rims:
        return _capped(points, triangles, rims, notes)
    flat = _flat_caps(points, triangles)
    ends = [_end(points, triangles[cap], points.mean(axis=0)) for cap in flat]
    caps = np.concatenate(flat) if flat else np.zeros(0, dtype=np.int64)
    wall = np.setdiff1d(np.arange(len(triangles)), caps)
    return Shell(points, triangles[wall], triangles[caps], ends, notes, _owners(flat))


def _owners(caps: Sequence[Indices]) -> Indices:
    """Which of some caps each triangle of all of them belongs to."""
    return np.repeat(np.arange(len(caps)), [len(cap) for cap in caps]).astype(np.int64)


def areas(points: Array, triangles: Indices) -> tuple[Array, Array]:
    """Areas, shape (m,), and unit normals, shape (m, 3)."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    size = np.linalg.norm(across, axis=1)
    return 0.5 * size, across / np.maximum(size, 1e-300)[:, None]


def _welded(surface: Surface) -> tuple[Array, Indices]:
    points = surface.points
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    if size <= 0.0:
        raise FileFaultError("has a surface without any extent")
    keys = np.round((points - points.min(axis=0)) / (WELD * size)).astype(np.int64)
    _, first, where = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    triangles = where.reshape(-1)[surface.triangles]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    kept = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)[1]
    triangles = triangles[np.sort(kept)]
    if len(triangles) < 4:
        raise FileFaultError(
            f"has a surface of {len(triangles)} triangles; expected a vessel's wall"
        )
    return points[first], triangles.astype(np.int64)


def _one_piece(points: Array, triangles: Indices) -> tuple[Indices, tuple[str, ...]]:
    """The largest piece, if all others are small."""
    ones = np.ones(2 * len(triangles))
    a, b = triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel()
    graph = coo_array((ones, (a, b)), shape=(len(points),) * 2)
    label = connected_components(graph, directed=False)[1][triangles[:, 0]]
    pieces, where = np.unique(label, return_inverse=True)
    sizes = np.bincount(where, weights=areas(points, triangles)[0])
    large = int(np.sum(sizes > DEBRIS * sizes.sum()))
    if large > 1:
        raise FileFaultError(f"has a surface in {large} disconnected pieces; expected one")
    notes = (
        (f"{len(pieces) - 1} small pieces of the surface are left out.",) if len(pieces) > 1 else ()
    )
    return triangles[where == int(np.argmax(sizes))], notes


def _edges(triangles: Indices) -> tuple[Indices, Indices, Indices]:
    """Edges, shape (k, 2); the edge of each side of each triangle, (3 m,); triangles per edge."""
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, where, count = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    return edges, where.reshape(-1), count


def _rims(triangles: Indices) -> list[Indices]:
    """Closed rims of the surface: indices of the points, the first one not repeated."""
    edges, _, count = _edges(triangles)
    runs = chains(edges[count == 1], int(triangles.max()) + 1)
    return [run[:-1] for run in runs if len(run) > 3 and run[0] == run[-1]]


def _capped(
    points: Array, triangles: Indices, rims: list[Indices], notes: tuple[str, ...]
) -> Shell:
    """The surface with a fan of triangles over each rim."""
    ends, caps, centres = [], [], []
    for k, rim in enumerate(rims):
        centres.append(points[rim].mean(axis=0))
        middle = np.full(len(rim), len(points) + k)
        caps.append(np.column_stack([rim, np.roll(rim, -1), middle]))
    every = np.concatenate([points, centres])
    inside = points[np.unique(triangles)]
    for cap, centre in zip(caps, centres, strict=True):
        reach = 3.0 * np.linalg.norm(every[cap[:, 0]] - centre, axis=1).max()
        near = inside[np.linalg.norm(inside - centre, axis=1) < reach]
        end = _end(every, cap, near.mean(axis=0))
        around = np.isin(triangles, cap[:, 0]).any(axis=1)
        size, normals = areas(every, triangles[around])
        across = np.average(np.abs(normals @ end.outward), weights=np.maximum(size, 1e-300))
        ends.append(end._replace(across=float(across)))
    return Shell(every, triangles, np.concatenate(caps), ends, notes, _owners(caps))


def _end(points: Array, cap: Indices, inside: Array) -> End:
    """Centre, direction and radius of a cap."""
    size, normals = areas(points, cap)
    centre = np.average(points[cap].mean(axis=1), axis=0, weights=np.maximum(size, 1e-300))
    # Normals of a fan may point either way: their common axis is the strongest of their sum.
    axis = np.linalg.eigh(np.einsum("n,ni,nj->ij", size, normals, normals))[1][:, -1]
    outward = axis if axis @ (centre - inside) > 0.0 else -axis
    return End(centre, outward, float(np.sqrt(size.sum() / np.pi)))


def _flat_caps(points: Array, triangles: Indices) -> list[NDArray[np.int64]]:
    """Triangles of each flat, round patch with a sharp rim."""
    _, where, _ = _edges(triangles)
    order = np.argsort(where, kind="stable")
    same = np.flatnonzero(np.diff(where[order]) == 0)
    one, other = order[same] // 3, order[same + 1] // 3
    size, normals = areas(points, triangles)
    cosine = np.sum(normals[one] * normals[other], axis=1)
    flat = cosine > FLAT
    graph = coo_array((np.ones(flat.sum()), (one[flat], other[flat])), shape=(len(triangles),) * 2)
    label = connected_components(graph, directed=False)[1]
    found = []
    for patch in np.flatnonzero(np.bincount(label) >= 3):
        members = np.flatnonzero(label == patch)
        corners = points[np.unique(triangles[members])]
        centre = corners.mean(axis=0)
        reach = float(np.linalg.norm(corners - centre, axis=1).max())
        rim = (label[one] == patch) != (label[other] == patch)
        sharp = np.mean(cosine[rim] < EDGE) if rim.any() else 0.0
        if size[members].sum() > ROUND * np.pi * reach**2 and sharp > SMOOTHER:
            found.append(members)
    return found
