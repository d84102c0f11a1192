"""Piecewise cubics through points, by end slopes or by the condition not-a-knot.

``scipy.interpolate`` has them, too, but to import it takes a third of the time in which a run gets
to its first step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cubic:
    """A piecewise cubic.

    Attributes
    ----------
    knots
        Where the pieces begin and the last one ends, shape (pieces + 1,).
    coefficients
        Shape (pieces, 4 powers of the distance from the piece's start, components).
    """

    knots: Array
    coefficients: Array

    def __call__(self, x: Array, derivative: int = 0) -> Array:
        """Values, or first derivatives, at points of shape (...), shape (..., components)."""
        inner = self.knots[1:-1]
        piece = np.searchsorted(inner, x, side="right")
        t = np.asarray(x - self.knots[piece])[..., None]
        a = np.moveaxis(self.coefficients[piece], -2, 0)
        if derivative == 1:
            slope: Array = (3.0 * a[3] * t + 2.0 * a[2]) * t + a[1]
            return slope
        value: Array = ((a[3] * t + a[2]) * t + a[1]) * t + a[0]
        return value


def hermite(knots: Array, values: Array, slopes: Array) -> Cubic:
    """The piecewise cubic with these values and slopes at the knots, shapes (n, components)."""
    h = np.diff(knots)[:, None]
    chord = np.diff(values, axis=0) / h
    bend = (3.0 * chord - 2.0 * slopes[:-1] - slopes[1:]) / h
    turn = (slopes[:-1] + slopes[1:] - 2.0 * chord) / h**2
    return Cubic(knots, np.stack([values[:-1], slopes[:-1], bend, turn], axis=1))


def spline(
    knots: Array, values: Array, begin: Array | None = None, end: Array | None = None
) -> Cubic:
    """The twice continuously differentiable piecewise cubic through points.

    Parameters
    ----------
    knots, values
        Shapes (n,), rising, and (n, components).
    begin, end
        Slope at either end, shape (components,); without it the two pieces there are one cubic
        (not-a-knot), or, of three points without slopes, both one parabola, or of two a line.
    """
    n = len(knots)
    h = np.diff(knots)[:, None]
    chord = np.diff(values, axis=0) / h
    if n == 2:
        begin = chord[0] if begin is None else begin
        end = chord[0] if end is None else end
    if n == 3 and begin is None and end is None:
        begin = chord[0] + (chord[0] - chord[1]) * h[0] / (h[0] + h[1])
    # Slopes m: the second derivative is continuous at the inner knots.
    upper, middle, lower = np.zeros(n), np.ones(n), np.zeros(n)
    right = np.zeros_like(values)
    upper[2:], lower[:-2] = h[:-1, 0], h[1:, 0]
    middle[1:-1] = 2.0 * (h[:-1, 0] + h[1:, 0])
    right[1:-1] = 3.0 * (h[1:] * chord[:-1] + h[:-1] * chord[1:])
    if begin is not None:
        right[0] = begin
    else:
        middle[0], upper[1], right[0] = _not_a_knot(h[0, 0], h[1, 0], chord[0], chord[1])
    if end is not None:
        right[-1] = end
    else:
        middle[-1], lower[-2], right[-1] = _not_a_knot(h[-1, 0], h[-2, 0], chord[-1], chord[-2])
    return hermite(knots, values, solve_banded((1, 1), np.stack([upper, middle, lower]), right))


def _not_a_knot(
    first: float, second: float, chord: Array, next_chord: Array
) -> tuple[float, float, Array]:
    """Row of the slopes for one cubic in the two pieces at an end, counted from there."""
    both = first + second
    right = ((first + 2.0 * both) * second * chord + first**2 * next_chord) / both
    return second, both, right
