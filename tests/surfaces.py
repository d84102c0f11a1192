"""Triangulations of tubes, and an independent test of whether anything is inside of triangles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

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
