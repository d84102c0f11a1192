"""One branch of a lumen: a tube of varying radius around a curved centreline."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array, nonnegative
from magwire.lumen.curve import Curve, fit

Array = NDArray[np.float64]

REPEATED = 1e-9  # smallest distance of neighbouring points, over the length of the polyline
STEEPEST = 0.95  # largest |dR/dS|; at 1 each ball swallows the one before
# Conditioning guards: arithmetic and memory end beyond them, long before any vessel does.
FARTHEST = 1e6  # coordinate of a point [m]
SLENDEREST = 1e5  # length over the smallest radius
SMALLEST = 1e-12  # radius [m]


class Bend(NamedTuple):
    """The sharpest bend of a branch.

    Attributes
    ----------
    radius
        Radius of curvature of the centreline [m]; infinite for a straight branch.
    arc
        Arc parameter where it is [m].
    """

    radius: float
    arc: float


@dataclass(frozen=True, eq=False)
class Branch:
    """A tube through given points of its centreline.

    Parameters
    ----------
    points
        Points of the centreline from the entrance on, shape (q, 3) [m]; at least two.
    radius
        Radius of the lumen [m], one number or one for each point, shape (q,).
    begin_tangent, end_tangent
        Directions of the centreline at its ends, shape (3,), where they are known; otherwise they
        follow from the points.
    open_begin, open_end
        Whether the ends are open. An open end has no cap: past its plane there is no wall.
    blend
        Width over which the wall is rounded into those of the branches before it in a lumen [m].

    Raises
    ------
    InputError
        If points are missing, repeated or not finite, if a radius is not positive, or if the lumen
        is as wide as its sharpest bend.

    Notes
    -----
    (P-8), (P-9) of the theory pages: the centreline is a C2 cubic spline, not a polyline.
    """

    points: Array
    radius: Array
    begin_tangent: Array | None = field(default=None, kw_only=True)
    end_tangent: Array | None = field(default=None, kw_only=True)
    open_begin: bool = field(default=True, kw_only=True)
    open_end: bool = field(default=True, kw_only=True)
    blend: float = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        points = _points(self.points)
        radius = _radius(self.radius, points)
        set_field = object.__setattr__
        set_field(self, "points", _fixed(points))
        set_field(self, "radius", _fixed(radius))
        set_field(self, "begin_tangent", _unit("begin_tangent", self.begin_tangent))
        set_field(self, "end_tangent", _unit("end_tangent", self.end_tangent))
        set_field(self, "blend", nonnegative("Branch", "blend", self.blend, "m"))
        self._check_radius()
        self._check_bends()

    @cached_property
    def curve(self) -> Curve:
        """The centreline and the radius as functions of arc length."""
        return fit(self.points, self.radius, (self.begin_tangent, self.end_tangent))

    @property
    def length(self) -> float:
        """Arc length of the centreline [m]."""
        return self.curve.length

    @property
    def entrance(self) -> Array:
        """First point of the centreline, shape (3,) [m]."""
        first: Array = self.points[0].copy()
        return first

    @property
    def direction(self) -> Array:
        """Unit tangent at the entrance, shape (3,)."""
        tangent = self.curve.coefficients[0, 1, :3]
        return np.asarray(tangent / np.linalg.norm(tangent))

    def bend_radius(self) -> Bend:
        """Smallest radius of curvature of the centreline, and where it is."""
        curvature, s = self.curve.sharpest_bends()
        worst = int(np.argmax(curvature))
        sharpest = float(curvature[worst])
        straight = sharpest * self.length < 1e-9
        return Bend(float("inf") if straight else 1.0 / sharpest, float(s[worst]))

    def centreline(self, points: int | None = None) -> tuple[Array, Array]:
        """Centreline and radius, shapes (q, 3) and (q,) [m].

        The points given, or as many as asked for at equal arc length.
        """
        if points is None:
            return self.points.copy(), self.radius.copy()
        at = self.curve.at(np.linspace(0.0, self.length, points))
        return at[:, :3], at[:, 3]

    def beyond(self, points: Array, arc: Array) -> Array:
        """How far points that are nearest to an open end lie past its plane, shape (n,) [m].

        Negative past the begin; zero for points whose arc parameter is not that of an open end.
        """
        ends = self.curve.at(arc), self.curve.at(arc, 1)[:, :3]
        along = np.sum((points - ends[0][:, :3]) * ends[1], axis=1)
        past = np.zeros(len(points))
        if self.open_begin:
            past = np.where(arc <= 0.0, np.minimum(along, 0.0), past)
        if self.open_end:
            past = np.where(arc >= self.length, np.maximum(along, 0.0), past)
        return past

    def with_entry(self, length: float) -> Branch:
        """The branch with a straight tube of ``length`` [m] in front of its entrance."""
        step = float(np.linalg.norm(self.points[1] - self.points[0]))
        count = max(1, round(length / step))
        before = -length * np.arange(count, 0, -1) / count
        points = self.points[0] + before[:, None] * self.direction
        return Branch(
            np.concatenate([points, self.points]),
            np.concatenate([np.full(count, self.radius[0]), self.radius]),
            begin_tangent=self.direction,
            end_tangent=self.end_tangent,
            open_begin=self.open_begin,
            open_end=self.open_end,
            blend=self.blend,
        )

    def _check_radius(self) -> None:
        """Refuse a radius that the spline drives to zero or that changes too fast."""
        s = np.linspace(0.0, self.length, 4 * len(self.curve.coefficients) + 1)
        radius = self.curve.at(s)[:, 3]
        worst = int(np.argmin(radius))
        if radius[worst] <= 0.0:
            raise InputError(
                "Input radius of Branch must stay positive between its points; the spline through "
                f"them falls to {radius[worst]:.6g} m at arc length {s[worst]:.6g} m."
            )
        slope = np.abs(self.curve.at(s, 1)[:, 3])
        worst = int(np.argmax(slope))
        if slope[worst] > STEEPEST:
            raise InputError(
                f"Input radius of Branch must change by at most {STEEPEST:g} m per metre of arc "
                f"length; received {slope[worst]:.6g} at arc length {s[worst]:.6g} m."
            )

    def _check_bends(self) -> None:
        """Refuse a bend that is sharper than the lumen is wide."""
        curvature, s = self.curve.sharpest_bends()
        radius = self.curve.at(s)[:, 3]
        worst = int(np.argmax(curvature * radius))
        if curvature[worst] * radius[worst] >= 1.0:
            x, y, z = self.curve.at(s[[worst]])[0, :3]
            raise InputError(
                "Input points of Branch must bend with a radius larger than the lumen's; received "
                f"a bend of radius {1.0 / curvature[worst]:.6g} m in a lumen of radius "
                f"{radius[worst]:.6g} m at arc length {s[worst]:.6g} m, "
                f"near ({x:.6g}, {y:.6g}, {z:.6g}) m."
            )


def _points(value: ArrayLike) -> Array:
    """Points of a centreline, checked."""
    points = array("Branch", "points", value, (None, 3), "m")
    if len(points) < 2:
        raise InputError(
            f"Input points of Branch must be at least two points; received {len(points)}."
        )
    far = float(np.abs(points).max())
    if far > FARTHEST:
        raise InputError(
            f"Input points of Branch must be within {FARTHEST:g} m of the origin; "
            f"received {far:.6g} m."
        )
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    close = np.flatnonzero(steps <= REPEATED * steps.sum())
    if len(close) > 0:
        i = int(close[0])
        x, y, z = points[i]
        raise InputError(
            f"Input points of Branch must be distinct; points {i} and {i + 1} are both "
            f"({x:.6g}, {y:.6g}, {z:.6g}) m."
        )
    return points


def _radius(value: ArrayLike, points: Array) -> Array:
    """Radius at each point, checked."""
    shape = (len(points),) if np.ndim(value) > 0 else ()
    radius = np.broadcast_to(array("Branch", "radius", value, shape, "m"), (len(points),)).copy()
    if radius.min() <= 0.0:
        i = int(np.argmin(radius))
        where = f" at point {i}" if np.ndim(value) > 0 else ""
        raise InputError(
            f"Input radius of Branch must be positive; received {radius[i]:.10g} m{where}."
        )
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    least = max(length / SLENDEREST, SMALLEST)
    if radius.min() < least:
        raise InputError(
            f"Input radius of Branch must be at least {least:.3g} m for its length of "
            f"{length:.6g} m; received {radius.min():.3g} m at point {int(np.argmin(radius))}."
        )
    return radius


def _unit(name: str, value: ArrayLike | None) -> Array | None:
    """A direction of length one, checked."""
    if value is None:
        return None
    vector = array("Branch", name, value, (3,))
    size = float(np.linalg.norm(vector))
    if size == 0.0:
        raise InputError(f"Input {name} of Branch must not be zero; received {vector.tolist()}.")
    return _fixed(vector / size)


def _fixed(value: Array) -> Array:
    """The array, made read-only: what was checked stays as it was."""
    value.flags.writeable = False
    return value
