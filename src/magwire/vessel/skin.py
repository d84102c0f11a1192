"""Signed distance from the triangles of a surface."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from magwire.kernels.wall.closest import Triangles
from magwire.lumen.sheet import nearest, search_tree
from magwire.vessel.files.drawing import Array, Indices


@dataclass(frozen=True, eq=False)
class Skin:
    """A surface of triangles, with its inside where its points' lines run.

    Parameters
    ----------
    points, triangles
        Shapes (n, 3) and (m, 3), all turned the same way round.
    inside
        Points that are inside for certain, shape (k, 3): they tell the sides apart.
    """

    points: Array
    triangles: Indices
    inside: Array

    def depth(self, points: Array) -> Array:
        """How deep points, shape (n, 3), are inside, shape (n,); negative outside."""
        return self._sign * self._signed(points)

    @cached_property
    def _sign(self) -> float:
        return float(np.sign(np.median(self._signed(self.inside)))) or 1.0

    @cached_property
    def _tree(self) -> Triangles:
        return search_tree(self.points, self.triangles, np.zeros(len(self.triangles), dtype=bool))

    def _signed(self, points: Array) -> Array:
        """Distance, negative on the side that normals point to, shape (n,)."""
        return nearest(self._tree, np.ascontiguousarray(points)).depth
