"""How sharply a lumen's wall bulges inward, and so what a chord along it may lose (P-8)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from magwire.kernels.arrays import BulgeGrid
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import hessian_many, jets_many
from magwire.kernels.wall.sheet import MOUTH_POINT, MOUTH_RADIUS
from magwire.lumen.branch import Branch
from magwire.lumen.distance import Wall, build
from magwire.lumen.sheet import Sheet

Array = NDArray[np.float64]

SPACING = 0.25  # of the rings of points, over the radius
AROUND = 12  # points on a ring
SPOTS = 40_000  # of a wall of triangles that are looked at
STEPS = 3  # towards the points that are some way off a wall
CUBES = 1_000_000  # by which bulges of a wall of triangles are known, at most
REACHED = 2  # cubes around one whose bulges count in it
OPENING = 2.0  # how far around an open end the bulge is not known, over its radius
RINGS = 20_000  # on a branch, at most
NEAR = 0.3  # points this near to the wall count as points of it, over the radius
FLARE = 0.3  # curvature of an outlet's flare, over its radius, as far out as wires lie on it
XX, XY, XZ, YY, YZ, ZZ = range(6)
SYMMETRIC = [XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ]


class Bulge(NamedTuple):
    """How sharply a branch's wall bulges inward.

    Attributes
    ----------
    arc, curvature
        Arc parameters, evenly spaced [m], and the largest convex curvature of the gap there [1/m],
        shapes (n,).
    """

    arc: Array
    curvature: Array


def bulges(arrays: LumenArrays, branches: Sequence[Branch], inset: float) -> list[Bulge]:
    """Largest convex curvature of the gap at points that lie ``inset`` [m] off the wall, by place.

    Along a chord the gap falls below the straight line between its values at the ends by at most an
    eighth of this times the chord's length squared. Found on rings of points along the branches; a
    rounded carina, which they may miss, bends by less than four over the width of the rounding
    where the wall of one branch meets another's, and the flare of an outlet by a third over its
    radius, where a wire leaves along the wall.
    """
    rounding = _rounding(branches)
    found = []
    for own, branch in enumerate(branches):
        arc, points = _rings(branch, inset)
        gap, hessian = np.empty(len(points)), np.empty((len(points), 6))
        nearest = np.empty(len(points), dtype=np.int32)
        hessian_many(arrays, points, gap, nearest, hessian)
        there = gap < inset + NEAR * float(branch.radius.max())
        matrices = hessian[there][:, SYMMETRIC].reshape(-1, 3, 3)
        sharpest = np.zeros(len(points))
        sharpest[there] = np.linalg.eigvalsh(matrices)[:, -1]
        curvature = np.maximum(sharpest.reshape(-1, AROUND).max(axis=1), 0.0)
        if branch.open_end:
            end = arc >= branch.length - float(branch.radius[-1])
            curvature[end] = np.maximum(curvature[end], FLARE / float(branch.radius[-1]))
        meets = np.any((nearest != own).reshape(-1, AROUND), axis=1)
        if len(branches) > 1:
            curvature[meets] = np.maximum(curvature[meets], rounding)
        found.append(Bulge(arc, curvature))
    return found


def largest(found: Sequence[Bulge], branches: Sequence[Branch]) -> float:
    """The largest curvature anywhere, with every carina and flare [1/m]."""
    rings = [float(bulge.curvature.max()) for bulge in found]
    flares = [FLARE / float(branch.radius[-1]) for branch in branches if branch.open_end]
    return max([*rings, *flares, _rounding(branches)], default=0.0)


def widened(bulge: Bulge, reach: float) -> Array:
    """The largest curvature within a reach [m] of each place, and beyond to the next but one."""
    spacing = bulge.arc[1] - bulge.arc[0]
    far = math.ceil(reach / spacing) + 2
    padded = np.pad(bulge.curvature, far, mode="edge")
    values: Array = sliding_window_view(padded, 2 * far + 1).max(axis=1)
    return values


def sheet_bulge(arrays: LumenArrays, wall: Wall, inset: float) -> float:
    """The same for a wall of triangles, looked for at points all over it, ``inset`` off it."""
    sharpest = float(_sharpness(arrays, wall, inset)[1].max(initial=0.0))
    radii = wall.arrays.ends[:, MOUTH_RADIUS]
    flare = max((FLARE / float(radius) for radius in radii), default=0.0)
    return max(sharpest, flare)


def sheet_bulges(
    arrays: LumenArrays, sheet: Sheet, branches: Sequence[Branch], inset: float, edge: float
) -> BulgeGrid:
    """The same by place, [1/m] and [m]: the largest within an edge [m], and up to two of them away.

    Where no wall is that near, the wall is as far away as an edge is long, and what is seen of a
    bulge there bends by less than one over that. At open ends it is not known.
    """
    from scipy.ndimage import maximum_filter  # slow to import, and for triangles only

    wall = build(sheet, branches)
    points, sharpest = _sharpness(arrays, wall, inset)
    low, high = points.min(axis=0), points.max(axis=0)
    cube = max(edge, float(np.prod(high - low + edge) / CUBES) ** (1.0 / 3.0))
    low = low - (REACHED + 1) * cube
    shape = np.ceil((high - low) / cube).astype(np.int64) + REACHED + 1
    value = np.full(tuple(shape), -np.inf)
    np.maximum.at(value, tuple(((points - low) / cube).astype(np.int64).T), sharpest)
    value = maximum_filter(value, 2 * REACHED + 1, mode="nearest")
    value[value == -np.inf] = min(1.0 / cube, float(sharpest.max(initial=0.0)))
    middles = low + (np.moveaxis(np.indices(value.shape), 0, -1) + 0.5) * cube
    for row in wall.arrays.ends:
        off = np.linalg.norm(middles - row[MOUTH_POINT : MOUTH_POINT + 3], axis=-1)
        value[off < OPENING * row[MOUTH_RADIUS] + 2.0 * cube] = -1.0
    x0, y0, z0 = (float(corner) for corner in low)
    return BulgeGrid(value, x0, y0, z0, 1.0 / cube)


def _sharpness(arrays: LumenArrays, wall: Wall, inset: float) -> tuple[Array, Array]:
    """Points all over a wall of triangles, ``inset`` off it, and how it bulges there [m, 1/m]."""
    every = max(1, len(wall.spots) // SPOTS)
    points = wall.spots[::every].copy()
    count = len(points)
    gap, normal, hessian = np.empty(count), np.empty((count, 3)), np.empty((count, 6))
    for _ in range(STEPS):
        jets_many(arrays, points, gap, normal, hessian)
        points += np.where(np.isfinite(gap), inset - gap, 0.0)[:, None] * normal
    jets_many(arrays, points, gap, normal, hessian)
    there = np.abs(gap - inset) < NEAR * wall.radius[::every]
    matrices = hessian[there][:, SYMMETRIC].reshape(-1, 3, 3)
    return points[there], np.maximum(np.linalg.eigvalsh(matrices)[:, -1], 0.0)


def _rounding(branches: Sequence[Branch]) -> float:
    """Curvature of the narrowest rounding of a carina, if there is one [1/m]."""
    return max((4.0 / branch.blend for branch in branches if branch.blend > 0.0), default=0.0)


def _rings(branch: Branch, inset: float) -> tuple[Array, Array]:
    """Arc parameters (n,) and points around each, ``inset`` off the wall (n AROUND, 3) [m]."""
    spacing = SPACING * float(branch.radius.min())
    count = min(RINGS, max(2, int(np.ceil(branch.length / spacing))))
    s = np.linspace(0.0, branch.length, count)
    at, along = branch.curve.at(s), branch.curve.at(s, 1)[:, :3]
    least = np.eye(3)[np.argmin(np.abs(along), axis=1)]
    first = np.cross(along, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(along, first) / np.linalg.norm(along, axis=1)[:, None]
    angle = 2.0 * np.pi * np.arange(AROUND) / AROUND
    across = first[:, None] * np.cos(angle)[:, None] + second[:, None] * np.sin(angle)[:, None]
    radius = np.maximum(at[:, 3] - inset, 0.0)
    ring: Array = (at[:, None, :3] + radius[:, None, None] * across).reshape(-1, 3)
    return s, ring
