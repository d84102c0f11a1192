"""The ends of a wall of triangles: it goes on straight there, and opens (P-8)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.kernels.wall.closest import Triangles
from magwire.kernels.wall.sheet import MOUTH_COLUMNS, MOUTH_NORMAL, MOUTH_POINT, MOUTH_RADIUS
from magwire.lumen.branch import Branch
from magwire.lumen.sheet import Sheet, search_tree

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

ROUND_OFF = 1.01  # how far a point of an end's wall may be from its axis, over its farthest point
NEAR, FAR = 2.0, 5.0  # lengths of the straight walls past the plane of an end, over its radius


class Mouths(NamedTuple):
    """A wall that goes on past its ends.

    Attributes
    ----------
    tree
        The wall with what was added, to be searched.
    ends
        Shape (ends, 7); columns as named in ``kernels.wall.sheet``.
    widest
        Largest distance of each end's rim from its axis, shape (ends,) [m].
    """

    tree: Triangles
    ends: Array
    widest: Array

    def past(self, end: int, points: Array) -> tuple[Array, Array]:
        """How far points are past an end's plane, and from its axis, shapes (n,) [m]."""
        row = self.ends[end]
        axis = row[MOUTH_NORMAL : MOUTH_NORMAL + 3]
        away = points - row[MOUTH_POINT : MOUTH_POINT + 3]
        along = away @ axis
        return along, np.linalg.norm(away - along[:, None] * axis, axis=1)

    def mine(self, end: int, points: Array, before: ArrayLike = 0.0) -> NDArray[np.bool_]:
        """Whether points of the wall are past an end's plane, or at most ``before`` it [m]."""
        along, off = self.past(end, points)
        found: NDArray[np.bool_] = along >= -np.asarray(before)
        found &= off < ROUND_OFF * self.widest[end]
        return found


class _Course(NamedTuple):
    """Where a path ends, and the direction in which it would go on, shapes (3,)."""

    point: Array
    outward: Array


def open_up(sheet: Sheet, branches: Sequence[Branch]) -> Mouths:
    """The wall with a straight tube from each of its rims.

    It runs along the path that ends there, or across the rim if none does. The plane of the end is
    where both path and rim have ended.
    """
    courses = _courses(branches)
    points, triangles = [sheet.points], [sheet.triangles]
    beyond = [np.zeros(len(sheet.triangles), dtype=bool)]
    ends, widest = np.zeros((len(sheet.rims), MOUTH_COLUMNS)), np.zeros(len(sheet.rims))
    courses = _courses(branches)
    count = len(sheet.points)
    for k, rim in enumerate(sheet.rims):
        corners = sheet.points[rim]
        axis, far = _axis(sheet, rim, courses)
        centre = corners.mean(axis=0)
        along = (corners - centre) @ axis
        across = corners - centre - along[:, None] * axis
        area = 0.5 * np.linalg.norm(np.cross(across, np.roll(across, -1, axis=0)).sum(axis=0))
        radius = float(np.sqrt(area / np.pi))
        plane = max(float(along.max()), far)
        ends[k, MOUTH_POINT : MOUTH_POINT + 3] = centre + plane * axis
        ends[k, MOUTH_NORMAL : MOUTH_NORMAL + 3] = axis
        ends[k, MOUTH_RADIUS] = radius
        widest[k] = float(np.linalg.norm(across, axis=1).max())
        last = rim
        for reach in (NEAR, FAR):
            ring = count + np.arange(len(rim))
            points.append(centre + across + (plane + reach * radius) * axis)
            triangles += _ribbon(last, ring)
            beyond.append(np.full(2 * len(rim), reach == FAR))
            last, count = ring, count + len(rim)
    tree = search_tree(np.concatenate(points), np.concatenate(triangles), np.concatenate(beyond))
    return Mouths(tree, ends, widest)


def _ribbon(rim: Indices, ring: Indices) -> list[Indices]:
    """Triangles from a rim to a ring past it, turned as those before the rim are."""
    after, beside = np.roll(rim, -1), np.roll(ring, -1)
    return [np.column_stack([after, rim, ring]), np.column_stack([after, ring, beside])]


def _courses(branches: Sequence[Branch]) -> list[_Course]:
    """The open ends of all branches."""
    found = []
    for branch in branches:
        at = branch.curve.at(np.array([0.0, branch.length]))[:, :3]
        along = branch.curve.at(np.array([0.0, branch.length]), 1)[:, :3]
        along /= np.linalg.norm(along, axis=1)[:, None]
        if branch.open_begin:
            found.append(_Course(at[0], -along[0]))
        if branch.open_end:
            found.append(_Course(at[1], along[1]))
    return found


def _axis(sheet: Sheet, rim: Indices, courses: list[_Course]) -> tuple[Array, float]:
    """The direction out of a rim, and how far past its middle the path ends that leads there.

    The path may have been made longer, by an entry: then its end lies far out, but on its axis.
    """
    corners = sheet.points[rim]
    centre = corners.mean(axis=0)
    reach = float(np.linalg.norm(corners - centre, axis=1).max())
    best, found = np.inf, None
    for course in courses:
        away = course.point - centre
        along = float(away @ course.outward)
        off = float(np.linalg.norm(away - along * course.outward))
        if off < reach and along > -reach and abs(along) + off < best:
            best, found = abs(along) + off, (course.outward, along)
    if found is not None:
        return found
    normal = np.cross(corners - centre, np.roll(corners, -1, axis=0) - centre).sum(axis=0)
    normal /= np.linalg.norm(normal)
    around = np.isin(sheet.triangles, rim).any(axis=1)
    beside = sheet.points[sheet.triangles[around]].mean(axis=(0, 1)) - centre
    return (normal if normal @ beside < 0.0 else -normal), 0.0
