"""How sharply a lumen's wall bulges inward, and so what a chord along it may lose (P-8)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import hessian_many, jets_many
from magwire.kernels.wall.sheet import MOUTH_RADIUS
from magwire.lumen.branch import Branch
from magwire.lumen.distance import Wall

Array = NDArray[np.float64]

SPACING = 0.25  # of the rings of points, over the radius
AROUND = 12  # points on a ring
SPOTS = 40_000  # of a wall of triangles that are looked at
STEPS = 3  # towards the points that are some way off a wall
RINGS = 20_000  # on a branch, at most
NEAR = 0.3  # points this near to the wall count as points of it, over the radius
FLARE = 0.3  # curvature of an outlet's flare, over its radius, as far out as wires lie on it
XX, XY, XZ, YY, YZ, ZZ = range(6)
SYMMETRIC = [XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ]


def largest_bulge(arrays: LumenArrays, branches: Sequence[Branch], inset: float) -> float:
    """Largest convex curvature of the gap at points that lie ``inset`` [m] off the wall [1/m].

    Along a chord the gap falls below the straight line between its values at the ends by at most an
    eighth of this times the chord's length squared. Found on rings of points along the branches; a
    rounded carina, which they may miss, bends by less than four over the width of the rounding, and
    the flare of an outlet by a third over its radius, where a wire leaves along the wall.
    """
    worst = 0.0
    for branch in branches:
        if branch.blend > 0.0:
            worst = max(worst, 4.0 / branch.blend)
        if branch.open_end:
            worst = max(worst, FLARE / float(branch.radius[-1]))
        points = _rings(branch, inset)
        gap, hessian = np.empty(len(points)), np.empty((len(points), 6))
        hessian_many(arrays, points, gap, hessian)
        there = gap < inset + NEAR * float(branch.radius.max())
        if np.any(there):
            matrices = hessian[there][:, SYMMETRIC].reshape(-1, 3, 3)
            worst = max(worst, float(np.linalg.eigvalsh(matrices)[:, -1].max()))
    return worst


def sheet_bulge(arrays: LumenArrays, wall: Wall, inset: float) -> float:
    """The same for a wall of triangles, looked for at points all over it, ``inset`` off it."""
    points = wall.spots[:: max(1, len(wall.spots) // SPOTS)].copy()
    count = len(points)
    gap, normal, hessian = np.empty(count), np.empty((count, 3)), np.empty((count, 6))
    for _ in range(STEPS):
        jets_many(arrays, points, gap, normal, hessian)
        points += np.where(np.isfinite(gap), inset - gap, 0.0)[:, None] * normal
    jets_many(arrays, points, gap, normal, hessian)
    there = np.abs(gap - inset) < NEAR * wall.radius[:: max(1, len(wall.spots) // SPOTS)]
    matrices = hessian[there][:, SYMMETRIC].reshape(-1, 3, 3)
    largest = float(np.linalg.eigvalsh(matrices)[:, -1].max(initial=0.0))
    radii = wall.arrays.ends[:, MOUTH_RADIUS]
    flare = max((FLARE / float(radius) for radius in radii), default=0.0)
    return max(largest, flare)


def _rings(branch: Branch, inset: float) -> Array:
    """Points around the centreline of a branch, ``inset`` off its wall, shape (n, 3) [m]."""
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
    return ring
