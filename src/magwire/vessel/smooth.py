"""A noisy way through a vessel made into a smooth one, and how far that moves it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solveh_banded
from scipy.sparse import diags_array
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array

STEP = 0.25  # of the points that come out, over the radius
PINNED = 1e8  # weight of the first and the last point
STEEPEST = 0.9  # largest |dR/dS| of the spline through what comes out
SHARPEST = 0.8  # largest radius of the lumen over that of its bend


class Smoothed(NamedTuple):
    """A smooth way.

    Attributes
    ----------
    points, radius
        Shapes (n, 3) and (n,).
    deviation
        Distance of each point that went in from the way, shape (m,).
    narrowed
        What was taken off the radius where the way bends or tapers too sharply, shape (n,).
    """

    points: Array
    radius: Array
    deviation: Array
    narrowed: Array


def smooth(points: Array, radius: Array, length: float) -> Smoothed:
    """A smooth way near given points.

    Waves along it that are longer than ``2 pi length`` radii stay, shorter ones go: the way c
    minimises the sum of |c - p|^2 and of the squares of its third derivative times ``length`` to
    the power of three, both with the arc length in radii. The radius is treated alike. It is then
    lowered where the lumen would be wider than its bend or would taper faster than a ball can.

    Parameters
    ----------
    points, radius
        Shapes (m, 3) and (m,).
    length
        In radii of the lumen.
    """
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    paces = steps * 0.5 * (1.0 / radius[1:] + 1.0 / radius[:-1])
    place = np.concatenate([[0.0], np.cumsum(paces)])
    count = max(round(place[-1] / STEP), 4)
    at = np.minimum(STEP * np.arange(count + 1), place[-1])  # the same for all ways through a trunk
    at[-1] = place[-1]
    if at[-2] >= at[-1]:
        at = np.linspace(0.0, place[-1], count + 1)
    values = np.column_stack([points, np.log(radius)])
    given = np.column_stack([np.interp(at, place, column) for column in values.T])
    found = _penalised(given, (length / STEP) ** 6)
    wide = np.exp(found[:, 3])
    usable = _usable(found[:, :3], wide)
    off = _distance(points, found[:, :3])
    return Smoothed(found[:, :3], usable, off, wide - usable)


def _penalised(values: Array, weight: float) -> Array:
    """Values with a penalty on their third differences; the ends stay where they are."""
    n = len(values)
    third = diags_array([-1.0, 3.0, -3.0, 1.0], offsets=[0, 1, 2, 3], shape=(n - 3, n))
    penalty = weight * (third.T @ third)
    weights = np.ones(n)
    weights[[0, -1]] = PINNED * (1.0 + weight)
    band = np.zeros((4, n))
    for k in range(4):
        band[3 - k, k:] = penalty.diagonal(k)
    band[3] += weights
    return np.asarray(solveh_banded(band, weights[:, None] * values))


def _usable(points: Array, radius: Array) -> Array:
    """The radius, lowered to what the bends and the taper of a union of balls allow."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    curve = CubicSpline(arc, points)
    first, second = curve(arc, 1), curve(arc, 2)
    speed = np.linalg.norm(first, axis=1)
    curvature = np.linalg.norm(np.cross(first, second), axis=1) / speed**3
    bent: Array = np.minimum(radius, SHARPEST / np.maximum(curvature, 1e-300))
    for steepest in STEEPEST * 0.85 ** np.arange(12):  # between its points a spline is steeper
        allowed = bent.copy()
        for i in range(1, len(arc)):
            allowed[i] = min(allowed[i], allowed[i - 1] + steepest * steps[i - 1])
        for i in range(len(arc) - 2, -1, -1):
            allowed[i] = min(allowed[i], allowed[i + 1] + steepest * steps[i])
        fine = np.linspace(0.0, arc[-1], 8 * len(arc))
        if np.abs(CubicSpline(arc, allowed)(fine, 1)).max() <= STEEPEST:
            break
    return allowed


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
