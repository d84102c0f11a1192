"""A noisy path through a vessel made into a smooth one that stays inside of the vessel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solveh_banded
from scipy.ndimage import maximum_filter1d
from scipy.spatial import KDTree

from magwire.vessel.balls import Original
from magwire.vessel.files.drawing import Array

STEP = 0.25  # of the points that come out, over the radius
PINNED = 1e8  # weight of the first and the last point
STEEPEST = 0.9  # largest |dR/dS| of the spline through what comes out
SHARPEST = 0.8  # largest radius of the lumen over that of its bend
OUTSIDE = 0.04  # how far a ball may reach out of what the file says, over its radius
WHOLE = 0.5  # part of the smallest radius that has to be left
GENTLE = 4  # points over which what the radius loses sets in
RAISED = (1.5, 2.0, 3.0, 4.0)  # factors on the length of smoothing, around bends too sharp for it
AROUND = 4.0  # half the path along which it is raised, over the radius


class Smoothed(NamedTuple):
    """A smooth path.

    Attributes
    ----------
    points, radius
        Shapes (n, 3) and (n,).
    deviation
        Distance of each point that went in from the path, shape (m,).
    narrowed
        What was taken off the radius, since the path bends or tapers too sharply or comes too close
        to the wall there, shape (n,).
    raised
        Largest factor on the length of smoothing.
    """

    points: Array
    radius: Array
    deviation: Array
    narrowed: Array
    raised: float

    @property
    def whole(self) -> bool:
        """Whether enough of the radius is left all along."""
        wide = self.radius + self.narrowed
        return bool(np.all(self.radius >= WHOLE * wide.min()))


def smooth(
    points: Array,
    radius: Array,
    length: float,
    original: Original | None = None,
    paces: Array | None = None,
) -> Smoothed:
    """A smooth path near given points.

    Waves along it that are longer than ``2 pi length`` radii stay, shorter ones go: the path c
    minimises the sum of |c - p|^2 and of the squares of its third derivative times ``length`` to
    the power of three, both with the arc length in radii. The radius is treated alike. It is then
    lowered where the lumen would be wider than its bend, would taper faster than a ball can, or
    would reach out of what the file says by more than ``OUTSIDE`` of the radius. Where too little
    is left of it, the length is raised there, and only there.

    Parameters
    ----------
    points, radius
        Shapes (m, 3) and (m,).
    length
        In radii of the lumen.
    original
        The vessel as the file has it; if left out, the wall may be anywhere.
    paces
        Arc length in radii at each point, shape (m,), from zero at the first one if left out. The
        points that come out are ``STEP`` apart in it.
    """
    if paces is None:
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        along = steps * 0.5 * (1.0 / radius[1:] + 1.0 / radius[:-1])
        paces = np.concatenate([[0.0], np.cumsum(along)])
    count = max(round((paces[-1] - paces[0]) / STEP), 4)
    at = np.minimum(paces[0] + STEP * np.arange(count + 1), paces[-1])
    at[-1] = paces[-1]
    if at[-2] >= at[-1]:
        at = np.linspace(paces[0], paces[-1], count + 1)
    values = np.column_stack([points, np.log(radius)])
    given = np.column_stack([np.interp(at, paces, column) for column in values.T])
    factors, last = np.ones(len(at)), float(at[-1] - at[-2]) / float(at[1] - at[0])
    found = _tried(given, length * factors, last, original)
    for raised in RAISED:
        if found.whole:
            break
        closed = at[found.radius < WHOLE * (found.radius + found.narrowed).min()]
        apart = np.abs(at[:, None] - closed).min(axis=1)
        bump = np.clip(1.5 - apart / AROUND, 0.0, 1.0)
        factors = np.maximum(factors, 1.0 + (raised - 1.0) * bump**2 * (3.0 - 2.0 * bump))
        found = _tried(given, length * factors, last, original)
    off = _distance(points, found.points)
    return found._replace(deviation=off, raised=float(factors.max()))


def _tried(given: Array, lengths: Array, last: float, original: Original | None) -> Smoothed:
    """The path with a length of smoothing at each of its points; the last step is of its own."""
    found = _penalised(given, (lengths[:-3] / STEP) ** 6, last)
    wide = np.exp(found[:, 3])
    inner = wide
    if original is not None:
        far = wide - original.depth(found[:, :3]) - OUTSIDE * wide
        inner = wide - _gentle(np.maximum(far, 0.0))
    usable = _usable(found[:, :3], inner)
    return Smoothed(found[:, :3], usable, np.zeros(0), wide - usable, 1.0)


def _gentle(lost: Array) -> Array:
    """What the radius loses, nowhere less, without kinks: the wall's gradient would jump there."""
    window = np.hanning(2 * GENTLE + 3)[1:-1]
    widened = np.pad(maximum_filter1d(lost, 2 * GENTLE + 1), GENTLE, mode="edge")
    smooth = np.convolve(widened, window / window.sum(), mode="valid")
    smooth[[0, -1]] = lost[[0, -1]]
    return smooth


def _penalised(values: Array, weights: Array, last: float) -> Array:
    """Values with a penalty on each of their third differences; the ends stay where they are.

    They are one apart, but for the last one, which is ``last`` from the one before.
    """
    n = len(values)
    third, places = (-1.0, 3.0, -3.0, 1.0), np.array([0.0, 1.0, 2.0, 2.0 + last])
    apart = places[:, None] - places + np.eye(4)
    end = 6.0 / apart.prod(axis=1)  # divided differences; (-1, 3, -3, 1) where last is one
    fidelity = np.ones(n)
    fidelity[[0, -1]] = PINNED * (1.0 + weights.max())
    band = np.zeros((4, n))
    for k in range(4):
        for i in range(4 - k):  # row j of the differences has third[i] at j + i
            band[3 - k, i + k : i + k + n - 4] += third[i] * third[i + k] * weights[:-1]
            band[3 - k, i + k + n - 4] += end[i] * end[i + k] * weights[-1]
    band[3] += fidelity
    found = np.asarray(solveh_banded(band, fidelity[:, None] * values))
    found[[0, -1]] = values[[0, -1]]  # to the last digit
    return found


def _usable(points: Array, radius: Array) -> Array:
    """The radius, lowered to what the bends and the taper of a union of balls allow."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    curve = CubicSpline(arc, points)
    first, second = curve(arc, 1), curve(arc, 2)
    speed = np.linalg.norm(first, axis=1)
    curvature = np.linalg.norm(np.cross(first, second), axis=1) / speed**3
    bent: Array = np.minimum(radius, SHARPEST / np.maximum(curvature, 1e-300))
    bent = np.maximum(bent, 0.01 * float(radius.max()))  # closed, and refused as such
    fine = np.linspace(0.0, arc[-1], 8 * len(arc))
    for steepest in STEEPEST * 0.85 ** np.arange(12):  # between its points a spline is steeper
        up = np.minimum.accumulate(bent - steepest * arc) + steepest * arc
        down = np.minimum.accumulate((bent + steepest * arc)[::-1])[::-1] - steepest * arc
        allowed = np.minimum(up, down)
        if np.abs(CubicSpline(arc, allowed)(fine, 1)).max() <= STEEPEST:
            break
    return np.asarray(allowed)


def _distance(points: Array, way: Array) -> Array:
    """Distance of points from a polyline, shape (n,)."""
    nearest = KDTree(way).query(points)[1]
    best = np.full(len(points), np.inf)
    for shift in (-1, 0):
        a = way[np.clip(nearest + shift, 0, len(way) - 2)]
        b = way[np.clip(nearest + shift, 0, len(way) - 2) + 1]
        along = b - a
        t = np.sum((points - a) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300)
        foot = a + np.clip(t, 0.0, 1.0)[:, None] * along
        best = np.minimum(best, np.linalg.norm(points - foot, axis=1))
    return best
