"""Lines as read, without repeated points, spikes and points that have no radius."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.interpolate import Akima1DInterpolator
from scipy.ndimage import median_filter

from magwire.vessel.files.drawing import Array, FileFaultError, Line

REPEATED = 1e-7  # smallest distance of neighbouring points, over the length of the line
WINDOW = 5  # points whose median a spike stands out from
OUTLYING = 6.0  # distance of a spike from that median, over what is usual along the line
NOTABLE = 0.5  # and over the radius
JUMP = 1.6  # factor by which the radius of a spike is off the median
CLOSE = 0.05  # distance of points that are as good as one, over the radius
STEP = 0.12  # of the points that come out, over the radius
MOST = 200_000  # points of a line that come out


class Cleaned(NamedTuple):
    """A line with points close enough for its radius, and how many points were thrown out."""

    line: Line
    dropped: int


def clean(line: Line, number: int) -> Cleaned:
    """A line without what cannot belong to a vessel, and with points every ``STEP`` radii.

    Parameters
    ----------
    line
        As read, in any unit.
    number
        What messages call it.

    Raises
    ------
    FileFaultError
        If more than a tenth of its points have no radius, or its radius is of another scale.
    """
    points, radius = line.points, line.radius
    good = np.isfinite(radius) & (radius > 0.0) & np.isfinite(points).all(axis=1)
    if len(good) == 1:
        raise FileFaultError(f"has only one point in line {number}")
    if good.sum() < max(2.0, 0.9 * len(good)):
        raise FileFaultError(
            f"has no positive radius at {len(good) - int(good.sum())} of {len(good)} points of "
            f"line {number}"
        )
    points, radius = _distinct(points[good], radius[good])
    keep = ~_spikes(points, radius)
    points, radius = _distinct(points[keep], radius[keep])
    if len(points) < 2:
        raise FileFaultError(f"has a line {number} without two distinct points")
    radius = _without_jumps(radius)
    dropped = len(line.points) - len(points)
    points, radius = _thinned(points, radius)
    return Cleaned(_dense(Line(line.name, points, radius), number), dropped)


def _distinct(points: Array, radius: Array) -> tuple[Array, Array]:
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    kept = np.concatenate([[True], steps > REPEATED * steps.sum()])
    return points[kept], radius[kept]


def _spikes(points: Array, radius: Array) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Points that are far from the median of their neighbours: shape (n,)."""
    if len(points) < 2 * WINDOW:
        return np.zeros(len(points), dtype=bool)
    middle = median_filter(points, size=(WINDOW, 1), mode="nearest")
    off = np.linalg.norm(points - middle, axis=1)
    usual = np.median(np.linalg.norm(np.diff(points, axis=0), axis=1))
    found: np.ndarray[tuple[int], np.dtype[np.bool_]] = (off > OUTLYING * usual) & (
        off > NOTABLE * radius
    )
    found[[0, -1]] = False
    return found


def _without_jumps(radius: Array) -> Array:
    """The radius with the median of the neighbours where it stands out from it."""
    if len(radius) < 2 * WINDOW:
        return radius
    middle = median_filter(radius, size=WINDOW, mode="nearest")
    jumps = (radius > JUMP * middle) | (radius < middle / JUMP)
    return np.where(jumps, middle, radius)


def _thinned(points: Array, radius: Array) -> tuple[Array, Array]:
    """The means of points that are closer together than ``CLOSE``; the ends as they are."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    paces = np.concatenate([[0.0], np.cumsum(2.0 * steps / (radius[1:] + radius[:-1]))])
    cell = np.floor(paces / CLOSE)
    cell[0], cell[-1] = -1.0, np.inf
    first = np.flatnonzero(np.diff(cell, prepend=-2.0) != 0.0)
    count = np.diff(np.append(first, len(points)))
    means = np.add.reduceat(np.column_stack([points, radius]), first, axis=0) / count[:, None]
    return means[:, :3], means[:, 3]


def _dense(line: Line, number: int) -> Line:
    """Points close enough for the radius, by a spline that does not overshoot."""
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    narrow = np.minimum(line.radius[1:], line.radius[:-1])
    parts = np.ceil(steps / (STEP * narrow))
    if not parts.sum() <= MOST:
        raise FileFaultError(
            f"has a line {number} of length {steps.sum():.4g} with a radius down to "
            f"{line.radius.min():.4g}; expected at most {MOST} points {STEP:g} radii apart"
        )
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    if not np.all(np.diff(arc) > 0.0):
        raise FileFaultError(
            f"has a line {number} of length {steps.sum():.4g} with a step of {steps.min():.4g}; "
            "expected steps that the length grows by"
        )
    count = parts.astype(np.int64)
    piece = np.repeat(np.arange(len(count)), count)
    share = (np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)) / count[piece]
    wanted = np.append(arc[piece] + share * steps[piece], arc[-1])
    values = np.column_stack([line.points, np.log(line.radius)])
    if len(arc) < 4:
        found = np.column_stack([np.interp(wanted, arc, column) for column in values.T])
    else:
        found = np.asarray(Akima1DInterpolator(arc, values)(wanted))
    return Line(line.name, found[:, :3], np.exp(found[:, 3]))
