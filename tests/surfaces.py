"""Triangulations of tubes, and an independent test of whether anything is inside of triangles."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import magwire as mw

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def tube(centres: Array, radius: Callable[[Array, Array], Array], around: int):
    """Triangles around a planar centreline in the xy plane, open at both ends.

    Parameters
    ----------
    centres
        Points of the centreline, shape (n, 3); sections are across it.
    radius
        Distance of the wall from the centreline by the index of the point and the angle from the
        plane's normal z, both of shape (n, around).
    around
        Corners of a section.
    """
    along = np.gradient(centres, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    up = np.array([0.0, 0.0, 1.0])
    beside = np.cross(along, up)
    rows = np.arange(len(centres))[:, None]
    # Every other ring is turned by half a corner: the triangles are close to regular ones.
    angle = 2.0 * np.pi * (np.arange(around)[None, :] + 0.5 * (rows % 2)) / around
    distance = radius(np.broadcast_to(rows, angle.shape), angle)
    points = centres[:, None, :] + distance[..., None] * (
        np.cos(angle)[..., None] * up + np.sin(angle)[..., None] * beside[:, None, :]
    )
    triangles = []
    for ring in range(len(centres) - 1):
        first = ring * around + np.arange(around)
        beside_first = ring * around + (np.arange(around) + 1) % around
        above, beside_above = first + around, beside_first + around
        if ring % 2 == 0:
            triangles += [np.column_stack([first, beside_first, above])]
            triangles += [np.column_stack([beside_first, beside_above, above])]
        else:
            triangles += [np.column_stack([first, beside_above, above])]
            triangles += [np.column_stack([first, beside_first, beside_above])]
    return points.reshape(-1, 3), np.concatenate(triangles)


def of_lumen(lumen: mw.Lumen, cell: float) -> tuple[Array, Indices]:
    """Triangles of the wall of a lumen of balls, open at its ends, by surface nets.

    Parameters
    ----------
    lumen
        The lumen.
    cell
        Edge length of the cells [m]; each that the wall runs through has a corner of triangles,
        which is then brought to where the gap is zero.
    """
    points = np.concatenate([branch.points for branch in lumen.branches])
    room = 1.5 * lumen.radius_range[1]
    low = points.min(axis=0) - room
    count = np.ceil((points.max(axis=0) + room - low) / cell).astype(int)
    axes = [low[k] + cell * np.arange(count[k]) for k in range(3)]
    lattice = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    gap = lumen.gap(lattice)
    inside = (np.isfinite(gap) & (gap > 0.0)).reshape(count)
    corners = [inside[tuple(slice(k, n - 1 + k) for k, n in zip(c, count, strict=True))]
               for c in np.ndindex(2, 2, 2)]  # fmt: skip
    mixed = np.any(corners, axis=0) & ~np.all(corners, axis=0)
    number = np.full(mixed.shape, -1)
    number[mixed] = np.arange(int(mixed.sum()))
    spots = low + cell * (np.argwhere(mixed) + 0.5)
    quads = []
    for k in range(3):  # four cells around each edge along axis k that crosses the wall
        a, b = (axis for axis in range(3) if axis != k)
        first = np.moveaxis(inside, (k, a, b), (0, 1, 2))
        cells = np.moveaxis(number, (k, a, b), (0, 1, 2))
        crossing = first[:-1, 1:-1, 1:-1] != first[1:, 1:-1, 1:-1]
        around = [cells[:, i : i + crossing.shape[1], j : j + crossing.shape[2]][crossing]
                  for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]  # fmt: skip
        turned = np.stack(around, axis=1)
        outward = first[:-1, 1:-1, 1:-1][crossing] == (k != 1)
        quads.append(np.where(outward[:, None], turned, turned[:, ::-1]))
    four = np.concatenate(quads)
    triangles = np.concatenate([four[:, [0, 1, 2]], four[:, [0, 2, 3]]])
    for _ in range(4):  # to the wall, along the gap's gradient
        step = 1e-2 * cell * np.eye(3)
        gaps = [[lumen.gap(spots + side * e) for side in (1.0, -1.0)] for e in step]
        gaps = np.array(gaps)
        gaps[~np.isfinite(gaps).all(axis=1, keepdims=True).repeat(2, axis=1)] = 0.0
        normal = (gaps[:, 0] - gaps[:, 1]).T
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        moved = np.clip(lumen.gap(spots), -cell, cell)[:, None] * normal
        spots = spots - np.where(np.isfinite(moved), moved, 0.0)
    gone = np.zeros(len(spots), dtype=bool)
    for branch in lumen.branches:
        for arc, side, is_open in (
            (0.0, -1.0, branch.open_begin),
            (branch.length, 1.0, branch.open_end),
        ):
            end, ahead = branch.curve.at(np.array([arc]))[0], branch.curve.at(np.array([arc]), 1)[0]
            axis = side * ahead[:3] / np.linalg.norm(ahead[:3])
            along = (spots - end[:3]) @ axis
            off = np.linalg.norm(spots - end[:3] - along[:, None] * axis, axis=1)
            gone |= is_open & (along > -0.2 * cell) & (along < 3.0 * end[3]) & (off < 2.2 * end[3])
    triangles = triangles[~gone[triangles].any(axis=1)]
    while True:  # rims without corners where they touch themselves
        edges = np.sort(
            np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        )
        unique, which, uses = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        rim = np.bincount(unique[uses == 1].ravel(), minlength=len(spots))
        loose = (uses[which] == 1).reshape(3, -1).sum(axis=0) > 1
        bad = (rim > 2)[triangles].any(axis=1) | loose
        if not bad.any():
            break
        triangles = triangles[~bad]
    pairs = np.concatenate([triangles[:, :2], triangles[:, 1:]])
    graph = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(len(spots),) * 2)
    piece = connected_components(graph, directed=False)[1][triangles[:, 0]]
    triangles = triangles[piece == np.bincount(piece).argmax()]
    used, triangles = np.unique(triangles, return_inverse=True)
    return spots[used], triangles.reshape(-1, 3)


def write_stl(path: Path, points: Array, triangles: Indices) -> None:
    """Triangles as binary STL, in the unit of the points."""
    corners = points[triangles]
    rows = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    rows["n"] = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rows["v"] = corners
    path.write_bytes(bytes(80) + np.uint32(len(triangles)).tobytes() + rows.tobytes())


def arc(bend_radius: float, turn: float, count: int) -> Array:
    """Points on an arc of a circle from the origin along x, shape (count, 3)."""
    angle = np.linspace(0.0, turn, count)
    return np.column_stack(
        [bend_radius * np.sin(angle), bend_radius * (1.0 - np.cos(angle)), np.zeros(count)]
    )


def crossings(starts: Array, ends: Array, points: Array, triangles: Indices) -> Array:
    """How many triangles each segment goes through, shape (n,) (Moeller and Trumbore 1997)."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    one, two = b - a, c - a
    found = np.zeros(len(starts), dtype=np.int64)
    for i, (start, end) in enumerate(zip(starts, ends, strict=True)):
        way = end - start
        p = np.cross(way, two)
        scale = np.sum(one * p, axis=1)
        scale = np.where(scale == 0.0, np.inf, scale)
        off = start - a
        u = np.sum(off * p, axis=1) / scale
        q = np.cross(off, one)
        v = (q @ way) / scale
        t = np.sum(two * q, axis=1) / scale
        found[i] = np.sum((u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t >= 0.0) & (t <= 1.0))
    return found


def apart(starts: Array, ends: Array, points: Array, triangles: Indices) -> float:
    """Smallest distance between segments and triangles, to a hundredth of a segment's length.

    Points along each segment, and for each the distance to all triangles, one after the other:
    slow, and written from the definition of the nearest point of a triangle alone.
    """
    shares = np.linspace(0.0, 1.0, 9)
    spots = (starts[:, None] + shares[:, None] * (ends - starts)[:, None]).reshape(-1, 3)
    corners = points[triangles]
    least = np.inf
    for spot in spots:
        near = np.linalg.norm(corners.mean(axis=1) - spot, axis=1)
        reach = np.linalg.norm(corners - corners.mean(axis=1)[:, None], axis=2).max(axis=1)
        some = near - reach < min(least, (near + reach).min())
        for corner in corners[some]:
            least = min(least, _to_triangle(spot, corner))
    return least


def _to_triangle(spot: Array, corner: Array) -> float:
    base = np.column_stack([corner[1] - corner[0], corner[2] - corner[0]])
    u, v = np.linalg.lstsq(base, spot - corner[0], rcond=None)[0]
    if u >= 0.0 and v >= 0.0 and u + v <= 1.0:
        return float(np.linalg.norm(corner[0] + base @ [u, v] - spot))
    found = np.inf
    for k in range(3):
        a, side = corner[k], corner[(k + 1) % 3] - corner[k]
        t = np.clip((spot - a) @ side / (side @ side), 0.0, 1.0)
        found = min(found, float(np.linalg.norm(a + t * side - spot)))
    return found
