"""Which ball of a lumen a point is in, and how deep."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import gap_many
from magwire.lumen.branch import Branch
from magwire.lumen.grid import build

if TYPE_CHECKING:
    from scipy.spatial import KDTree

Array = NDArray[np.float64]
Indices = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Search:
    """Finds points, shape (n, 3) [m], in branches of balls."""

    branches: tuple[Branch, ...]

    @cached_property
    def arrays(self) -> LumenArrays:
        """The branches as the kernels take them, in metres; built on first use."""
        return build(self.branches)

    def near(self, points: Array) -> tuple[Array, Array, Indices]:
        """Gap, arc parameter and branch, shapes (n,); nan and -1 where no voxel holds a point."""
        gap, arc = np.empty(len(points)), np.empty(len(points))
        branch = np.empty(len(points), dtype=np.int32)
        gap_many(self.arrays, points, gap, arc, branch)
        return gap, arc, branch

    def anywhere(self, points: Array) -> tuple[Array, Indices]:
        """Arc parameter [m] and branch, shapes (n,); far outside they are those of the nearest."""
        _, arc, branch = self.near(points)
        lost = np.flatnonzero(branch < 0)
        if len(lost) > 0 and self.branches:
            tree, samples = self._samples
            nearest = tree.query(points[lost])[1]
            arc[lost], branch[lost] = samples[nearest, 0], samples[nearest, 1].astype(np.int32)
            for index, part in enumerate(self.branches):
                here = lost[branch[lost] == index]
                arc[here] += part.beyond(points[here], arc[here])
        return arc, branch

    def offset(self, points: Array) -> Array:
        """Distance from the centreline, shape (n,) [m]; nan without a branch."""
        arc, branch = self.anywhere(points)
        distance = np.full(len(points), np.nan)
        for index, part in enumerate(self.branches):
            here = branch == index
            centre = part.curve.at(arc[here])[:, :3]
            distance[here] = np.linalg.norm(points[here] - centre, axis=1)
        return distance

    @cached_property
    def _samples(self) -> tuple[KDTree, Array]:
        """Points of all centrelines for points that no voxel holds: tree, and arc and branch."""
        from scipy.spatial import KDTree  # slow to import, and seldom asked for

        points, tags = [], []
        for index, branch in enumerate(self.branches):
            s = np.linspace(0.0, branch.length, 4 * len(branch.curve.coefficients) + 1)
            points.append(branch.curve.at(s)[:, :3])
            tags.append(np.column_stack([s, np.full(len(s), float(index))]))
        return KDTree(np.concatenate(points)), np.concatenate(tags)
