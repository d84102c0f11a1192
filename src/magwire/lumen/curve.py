"""Twice continuously differentiable centrelines with uniform knots in arc length."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from magwire.lumen.spline import Cubic, hermite, spline

Array = NDArray[np.float64]

ACCURACY = 1e-7  # of the resampled curve, over the smallest radius of the lumen
NODES, WEIGHTS = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True, eq=False)
class Curve:
    """A centreline and its radius as cubic pieces of equal arc length.

    Attributes
    ----------
    coefficients
        Shape (pieces, 4 powers of the distance from the piece's start, 4 components x y z R).
    spacing
        Arc length of a piece [m].
    """

    coefficients: Array
    spacing: float

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return self.spacing * len(self.coefficients)

    def at(self, s: Array, derivative: int = 0) -> Array:
        """Point and radius, or their derivative, at arc parameters.

        Parameters
        ----------
        s
            Arc parameter, shape (n,) [m]; past the ends the curve goes on straight.
        derivative
            0, 1 or 2.

        Returns
        -------
        Shape (n, 4): x, y, z and R.
        """
        a, t, beyond = self._pieces(s)
        if derivative == 2:
            return _second(a, t, beyond)
        first = _first(a, t)
        return first if derivative == 1 else _point(a, t) + beyond * first

    def jet(self, s: Array) -> tuple[Array, Array, Array]:
        """What ``at`` gives, to the bit, for the derivatives 0, 1 and 2."""
        a, t, beyond = self._pieces(s)
        first = _first(a, t)
        return _point(a, t) + beyond * first, first, _second(a, t, beyond)

    def _pieces(self, s: Array) -> tuple[Array, Array, Array]:
        """Coefficients, where on its piece each arc parameter is, and how far it is past an end."""
        inside = np.minimum(np.maximum(s, 0.0), self.length)
        piece = np.minimum((inside / self.spacing).astype(np.int64), len(self.coefficients) - 1)
        t = (inside - piece * self.spacing)[:, None]
        return self.coefficients[piece], t, (s - inside)[:, None]

    def place(self, s: float) -> tuple[Array, Array]:
        """Point with radius and their derivative at one arc parameter, shapes (4,).

        To the bit what ``at`` gives, in a tenth of the time.
        """
        inside = min(max(s, 0.0), self.length)
        piece = min(int(inside / self.spacing), len(self.coefficients) - 1)
        t, beyond = inside - piece * self.spacing, s - inside
        point, slope = np.empty(4), np.empty(4)
        for c, (a, b, square, cube) in enumerate(self.coefficients[piece].T.tolist()):
            slope[c] = first = (3.0 * cube * t + 2.0 * square) * t + b
            point[c] = ((cube * t + square) * t + b) * t + a + beyond * first
        return point, slope

    def knots(self) -> Array:
        """Arc parameters of the pieces' ends, shape (pieces + 1,) [m]."""
        return np.linspace(0.0, self.length, len(self.coefficients) + 1)

    def sharpest_bends(self) -> tuple[Array, Array]:
        """Curvature at the knots, shape (pieces + 1,) [1/m], and the knots' arc parameters [m].

        The second derivative is linear within a piece: it is largest at a knot.
        """
        s = self.knots()
        first, second = self.at(s, 1)[:, :3], self.at(s, 2)[:, :3]
        speed = np.linalg.norm(first, axis=1)
        return np.linalg.norm(np.cross(first, second), axis=1) / speed**3, s


def _point(a: Array, t: Array) -> Array:
    point: Array = ((a[:, 3] * t + a[:, 2]) * t + a[:, 1]) * t + a[:, 0]
    return point


def _first(a: Array, t: Array) -> Array:
    first: Array = (3.0 * a[:, 3] * t + 2.0 * a[:, 2]) * t + a[:, 1]
    return first


def _second(a: Array, t: Array, beyond: Array) -> Array:
    second: Array = 6.0 * a[:, 3] * t + 2.0 * a[:, 2]
    second[beyond[:, 0] != 0.0] = 0.0
    return second


def fit(points: Array, radius: Array, tangents: tuple[Array | None, Array | None]) -> Curve:
    """Curve through points, C2 in point and radius.

    A cubic spline over chord length gives arc lengths, one over those the curve, and that is
    resampled to as many equal pieces as it takes to follow it within ``ACCURACY``. The
    number of pieces therefore follows from the curve, not from the number of points.

    Parameters
    ----------
    points, radius
        Shapes (q, 3) and (q,) [m].
    tangents
        Unit tangents at begin and end, shape (3,), where they are known.
    """
    chords = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    lengths = _arc_lengths(spline(chords, points))[0]
    source = _spline(lengths, np.column_stack([points, radius]), tangents)
    return _resample(source, ACCURACY * float(radius.min()))


def _spline(lengths: Array, values: Array, tangents: tuple[Array | None, Array | None]) -> Cubic:
    """Spline of points and radius over arc length; not-a-knot where no tangent is given."""
    radius = spline(lengths, values[:, 3:])
    begin, end = (
        None if tangent is None else np.append(tangent, radius(at, 1))
        for tangent, at in zip(tangents, (lengths[0], lengths[-1]), strict=True)
    )
    return spline(lengths, values, begin, end)


def _arc_lengths(curve: Cubic) -> tuple[Array, Array, Array]:
    """Arc lengths at the knots of a curve, and at a finer set of parameters, and those."""
    knots = curve.knots
    parts = max(1, ceil(64 / (len(knots) - 1)))
    fine = np.interp(np.arange((len(knots) - 1) * parts + 1) / parts, np.arange(len(knots)), knots)
    half = 0.5 * np.diff(fine)
    at = fine[:-1, None] + half[:, None] * (1.0 + NODES)
    speed = np.linalg.norm(curve(at, 1)[..., :3], axis=-1)
    lengths = np.concatenate([[0.0], np.cumsum(half * (speed @ WEIGHTS))])
    return lengths[::parts], lengths, fine


def _resample(source: Cubic, accuracy: float) -> Curve:
    """Equal pieces of arc length, as many as follow the source within ``accuracy``."""
    _, lengths, fine = _arc_lengths(source)
    speed = np.linalg.norm(source(fine, 1)[:, :3], axis=1)
    parameter = hermite(lengths, fine[:, None], 1.0 / speed[:, None])
    middles = 0.5 * (lengths[1:] + lengths[:-1])
    checks = np.concatenate([lengths, middles])
    wanted = source(parameter(checks)[:, 0])
    most = 4 * (len(source.knots) - 1) + 256
    pieces = 16
    while True:
        s = np.linspace(0.0, lengths[-1], pieces + 1)
        u = parameter(s)[:, 0]
        u[0], u[-1] = fine[0], fine[-1]
        ends = source(u[[0, -1]], 1) / np.linalg.norm(source(u[[0, -1]], 1)[:, :3], axis=1)[:, None]
        equal = spline(s, source(u), ends[0], ends[1])
        curve = Curve(np.ascontiguousarray(equal.coefficients), float(lengths[-1]) / pieces)
        error = float(np.abs(curve.at(checks) - wanted).max())
        if error <= accuracy or pieces >= most:
            return curve
        growth = min(max(1.1 * (error / accuracy) ** 0.25, 1.3), 4.0)
        pieces = min(ceil(pieces * growth), most)
