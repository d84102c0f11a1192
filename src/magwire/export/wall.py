"""The lumen's wall as triangles, and the pressure on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from magwire.contact import WallMotion
from magwire.contact.motion import gone

Array = NDArray[np.float64]
SIDES = 20
"""Corners of a ring."""
RINGS, FEWEST = 240, 20
"""Rings of all branches together at most, and those of a branch that are kept in any case."""
HIDDEN = 0.985
"""Part of another branch's radius within which a corner is no wall: a junction is open."""
SPREAD = 0.8
"""Radius of the disc that a node's force is spread over, over that of the lumen: as in pages."""


@dataclass(frozen=True)
class Wall:
    """The wall of all branches.

    Attributes
    ----------
    points
        Corners, shape (n, 3) [m].
    triangles
        Which corners each has, shape (m, 3).
    radius
        Radius of the lumen at each corner, shape (n,) [m].
    """

    points: Array
    triangles: NDArray[np.int64]
    radius: Array

    def moved(self, motions: Sequence[WallMotion], entrance: Array, time: float) -> Wall:
        """The wall where it is at a time [s]; itself if it does not move."""
        if not motions:
            return self
        return replace(self, points=gone(motions, self.points, entrance, time))

    @cached_property
    def _areas(self) -> Array:
        """A third of the triangles around each corner, shape (n,) [m^2]."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6.0
        weights = np.repeat(third, 3)
        found: Array = np.zeros(len(self.points))
        np.add.at(found, self.triangles.ravel(), weights)
        return found

    @cached_property
    def _seen(self) -> tuple[NDArray[np.int64], KDTree]:
        """Corners that have a wall, and the same to look for what is near."""
        seen = np.flatnonzero(self._areas)
        return seen, KDTree(self.points[seen])

    def pressure(self, position: Array, force: Array, skin: float) -> Array:
        """Pressure at the corners, shape (n,) [Pa].

        The force on each node goes to where it presses, a wire's radius ``skin`` [m] away, spread
        over a disc. Its integral over the wall is the sum of the forces' sizes, whatever the mesh.

        Parameters
        ----------
        position, force
            Nodes, shape (nodes, 3) [m], and the forces of the wall on them, shape (nodes, 3) [N].
        skin
            Distance from the node to the wire's surface [m].
        """
        found, area = np.zeros(len(self.points)), self._areas
        seen, tree = self._seen
        size = np.linalg.norm(force, axis=1)
        for node in np.flatnonzero(size):
            there = position[node] - force[node] * (skin / size[node])
            nearest = seen[tree.query(there)[1]]
            reach = SPREAD * self.radius[nearest]
            near = seen[np.asarray(tree.query_ball_point(there, reach), dtype=np.int64)]
            if near.size == 0:  # the mesh is coarser than the disc
                near = np.array([nearest])
            away = np.linalg.norm(self.points[near] - there, axis=1) / max(reach, 1e-300)
            weight = np.maximum(1.0 - away**2, 1e-9) ** 2
            found[near] += size[node] * weight / float(weight @ area[near])
        return found


def wall(branches: list[Array]) -> Wall:
    """The wall around branches, each of points and radius, shape (q, 4) [m].

    What lies inside of another branch is left out.
    """
    most = max(RINGS // len(branches), FEWEST)
    tubes = [_thinned(branch, most) for branch in branches]
    points, triangles, offset = [], [], 0
    for which, tube in enumerate(tubes):
        corners = _rings(tube)
        others = [other for k, other in enumerate(branches) if k != which]
        hidden = np.zeros(len(corners), dtype=bool)
        for other in others:
            away = np.linalg.norm(corners[:, None] - other[:, :3], axis=2)
            hidden |= np.any(away < HIDDEN * other[:, 3], axis=1)
        ribbons = _ribbons(len(tube))
        triangles.append(ribbons[~hidden[ribbons].all(axis=1)] + offset)
        points.append(corners)
        offset += len(corners)
    radius = np.concatenate([np.repeat(tube[:, 3], SIDES) for tube in tubes])
    return Wall(np.concatenate(points), np.concatenate(triangles), radius)


def of_surface(points: Array, triangles: NDArray[np.int64], branches: list[Array]) -> Wall:
    """A wall that is a surface: its corners, its triangles, and the branches in it."""
    balls = np.concatenate(branches)
    radius = balls[KDTree(balls[:, :3]).query(points)[1], 3]
    return Wall(points, np.asarray(triangles, dtype=np.int64), radius)


def _thinned(branch: Array, most: int) -> Array:
    keep = np.unique(np.linspace(0, len(branch) - 1, most).round().astype(int))
    found: Array = branch[keep]
    return found


def _rings(tube: Array) -> Array:
    """Corners around the points of a branch, the normal carried along without twisting."""
    slope = np.gradient(tube[:, :3], axis=0)
    tangent = slope / np.linalg.norm(slope, axis=1, keepdims=True)
    across = np.eye(3)[np.argmin(np.abs(tangent[0]))]
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    rings = []
    for row, along in zip(tube, tangent, strict=True):
        across = across - along * (across @ along)
        across /= np.linalg.norm(across)
        circle = np.outer(np.cos(angle), across) + np.outer(np.sin(angle), np.cross(along, across))
        rings.append(row[:3] + row[3] * circle)
    return np.concatenate(rings)


def _ribbons(rings: int) -> NDArray[np.int64]:
    """Triangles between rings, facing outwards, shape (m, 3)."""
    first = (np.arange(rings - 1)[:, None] * SIDES + np.arange(SIDES)).ravel()
    beside = first - first % SIDES + (first + 1) % SIDES
    lower = np.stack([first, beside, first + SIDES], axis=1)
    upper = np.stack([beside, beside + SIDES, first + SIDES], axis=1)
    return np.concatenate([lower, upper])
