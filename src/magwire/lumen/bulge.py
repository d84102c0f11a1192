"""How sharply a lumen's wall bulges inward: what a chord between two clear points may lose (P-8)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import hessian_many
from magwire.lumen.branch import Branch

Array = NDArray[np.float64]

SPACING = 0.25  # of the rings of points, over the radius
AROUND = 12  # points on a ring
RINGS = 20_000  # on a branch, at most
NEAR = 0.3  # points this near to the wall count as points of it, over the radius
XX, XY, XZ, YY, YZ, ZZ = range(6)
SYMMETRIC = [XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ]


def largest_bulge(arrays: LumenArrays, branches: Sequence[Branch], inset: float) -> float:
    """Largest convex curvature of the gap at points that lie ``inset`` [m] off the wall [1/m].

    Along a chord the gap falls below the straight line between its values at the ends by at most an
    eighth of this times the chord's length squared. Found on rings of points along the branches; a
    rounded carina, which they may miss, bends by less than four over the width of the rounding.
    """
    worst = 0.0
    for branch in branches:
        if branch.blend > 0.0:
            worst = max(worst, 4.0 / branch.blend)
        points = _rings(branch, inset)
        gap, hessian = np.empty(len(points)), np.empty((len(points), 6))
        hessian_many(arrays, points, gap, hessian)
        there = gap < inset + NEAR * float(branch.radius.max())
        if np.any(there):
            matrices = hessian[there][:, SYMMETRIC].reshape(-1, 3, 3)
            worst = max(worst, float(np.linalg.eigvalsh(matrices)[:, -1].max()))
    return worst


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
