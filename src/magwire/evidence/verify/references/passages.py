"""Round passages with a hard wall around centrelines given by formulas.

A passage is the union of the balls of radius R(w) about c(w). A point x is inside where

    h(x) = max over w of (R(w)^2 - |x - c(w)|^2) / 2 >= 0,

the same set as by R - |x - c|, but smooth on the centreline too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Curve = Callable[[Array], tuple[Array, Array, Array]]
"""Places c, c' and c'' at parameters w, each of shape (n, 3); c(0) is the origin."""

STEPS = 30


@dataclass(frozen=True)
class Passage:
    """A passage that begins at the origin.

    Attributes
    ----------
    curve
        The centreline.
    end
        Its last parameter.
    radius, taper
        R = radius + taper w.
    """

    curve: Curve
    end: float
    radius: float
    taper: float = 0.0

    @property
    def direction(self) -> Array:
        """Unit tangent at the entrance, shape (3,)."""
        tangent = self.curve(np.zeros(1))[1][0]
        return np.asarray(tangent / np.linalg.norm(tangent))

    def nearest(self, points: Array, guess: Array) -> Array:
        """Parameters of the deepest balls, by Newton's method from a guess, shape (n,)."""
        w = guess.copy()
        for _ in range(STEPS):
            slope, bend, _ = self._along(points, w)
            step = np.where(bend < 0.0, -slope / bend, 0.0)
            w, before = np.clip(w + np.clip(step, -0.1, 0.1), 0.0, self.end), w
            if np.abs(w - before).max() < 1e-13:
                break
        return w

    def room(self, points: Array, w: Array) -> tuple[Array, Array, Array]:
        """h, its gradient and its Hessian at points with their deepest balls.

        With psi the expression under the maximum, at psi_w = 0: grad h = psi_x and
        Hess h = psi_xx - psi_xw psi_wx / psi_ww, where psi_xx = -1 and psi_xw = c'.
        """
        _, bend, tangent = self._along(points, w)
        away = points - self.curve(w)[0]
        value = 0.5 * ((self.radius + self.taper * w) ** 2 - (away**2).sum(axis=1))
        moved = np.where((w > 0.0) & (w < self.end), -1.0 / bend, 0.0)
        hessian = moved[:, None, None] * tangent[:, :, None] * tangent[:, None, :] - np.eye(3)
        return value, -away, hessian

    def _along(self, points: Array, w: Array) -> tuple[Array, Array, Array]:
        """psi_w, psi_ww and c'."""
        c, c1, c2 = self.curve(w)
        away = points - c
        slope = (self.radius + self.taper * w) * self.taper + (away * c1).sum(axis=1)
        bend = self.taper**2 + (away * c2).sum(axis=1) - (c1**2).sum(axis=1)
        return slope, bend, c1


def circle(bend: float) -> Curve:
    """Circle of radius ``bend`` in the xy plane, from x towards +y; w is the arc length."""

    def curve(w: Array) -> tuple[Array, Array, Array]:
        s, c, o = np.sin(w / bend), np.cos(w / bend), np.zeros_like(w)
        return (
            bend * np.column_stack((s, 1.0 - c, o)),
            np.column_stack((c, s, o)),
            np.column_stack((-s, c, o)) / bend,
        )

    return curve


def cosine(amplitude: float, period: float) -> Curve:
    """Cosine in the xy plane: y = amplitude (cos(2 pi x / period) - 1); w is x."""
    k = 2.0 * np.pi / period

    def curve(w: Array) -> tuple[Array, Array, Array]:
        s, c, o, i = np.sin(k * w), np.cos(k * w), np.zeros_like(w), np.ones_like(w)
        return (
            np.column_stack((w, amplitude * (c - 1.0), o)),
            np.column_stack((i, -amplitude * k * s, o)),
            np.column_stack((o, -amplitude * k**2 * c, o)),
        )

    return curve


def helix(bend: float, pitch: float) -> Curve:
    """Helix of radius ``bend`` that climbs along z, its axis at (0, bend); w is the arc length."""
    rise = pitch / (2.0 * np.pi)
    k = 1.0 / np.hypot(bend, rise)

    def curve(w: Array) -> tuple[Array, Array, Array]:
        s, c, o, i = np.sin(k * w), np.cos(k * w), np.zeros_like(w), np.ones_like(w)
        return (
            np.column_stack((bend * s, bend * (1.0 - c), rise * k * w)),
            k * np.column_stack((bend * c, bend * s, rise * i)),
            k**2 * bend * np.column_stack((-s, c, o)),
        )

    return curve
