"""A lumen that lies beside where it was thought to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import array, positive
from magwire.lumen.branch import Branch
from magwire.lumen.lazy import Lazy
from magwire.lumen.lumen import Lumen
from magwire.lumen.sheet import Sheet

Array = NDArray[np.float64]

PARTS = 16.0  # into which a ramp is cut at least, so that a spline follows it
SMALL = 1e-4  # part of a piece of the curve over which its direction is taken


def displaced(lumen: Lumen, shift: ArrayLike, ramp: float) -> Lumen:
    """The lumen moved aside, but for its entrance, where the guide is.

    At a distance r from the entrance it is moved by the shift times 10 s^3 - 15 s^4 + 6 s^5 of
    s = r/ramp, and by all of it beyond, as the wall that moves does (P-40). Radii stay as they are.

    Parameters
    ----------
    lumen
        The lumen.
    shift
        Shape (3,) [m].
    ramp
        Distance from the entrance from which on it is moved in full [m].
    """
    way = array("displaced", "shift", shift, (3,), "m")
    rise = _Rise(lumen.entrance, positive("displaced", "ramp", ramp, "m"))
    sheet = lumen.sheet
    moved = None if sheet is None else Sheet(_moved(sheet.points, way, rise), sheet.triangles)
    return replace(
        lumen,
        branches=tuple(_branch(branch, way, rise) for branch in lumen.branches),
        paths=Lazy({name: partial(_path, lumen.paths, name, way, rise) for name in lumen.paths}),
        sheet=moved,
    )


class _Rise(NamedTuple):
    """The part of the shift that points take."""

    entrance: Array
    ramp: float

    def at(self, points: Array) -> Array:
        """At points, shape (n, 3) [m]; shape (n, 1)."""
        away = np.linalg.norm(points - self.entrance, axis=1)
        s = np.minimum(away / self.ramp, 1.0)[:, None]
        rise: Array = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        return rise


def _moved(points: Array, way: Array, rise: _Rise) -> Array:
    return points + rise.at(points) * way


def _path(paths: Mapping[str, Branch], name: str, way: Array, rise: _Rise) -> Branch:
    return _branch(paths[name], way, rise)


def _branch(branch: Branch, way: Array, rise: _Rise) -> Branch:
    """A branch through points of its curve, where they have gone to."""
    curve = branch.curve
    count = max(len(curve.coefficients), ceil(PARTS * curve.length / rise.ramp))
    at = curve.at(np.linspace(0.0, curve.length, count + 1))
    ends = np.array([0.0, curve.length])
    points, along = curve.at(ends)[:, :3], SMALL * curve.spacing * curve.at(ends, 1)[:, :3]
    begin, end = _moved(points + along, way, rise) - _moved(points - along, way, rise)
    return replace(
        branch,
        points=_moved(at[:, :3], way, rise),
        radius=at[:, 3],
        begin_tangent=begin,
        end_tangent=end,
    )
