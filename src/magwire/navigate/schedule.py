"""A field schedule: the uniform flux density as a function of the feed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import array, finite, numbers, positive
from magwire.navigate.knots import between, rising, spaced

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Schedule:
    """A uniform flux density that is linear in the feed between knots (P-23).

    Parameters
    ----------
    feed
        Knots, rising, shape (k,) [m]; before the first and after the last the field stays.
    flux_density
        At the knots, shape (k, 3) [T].

    Raises
    ------
    InputError
        If the shapes do not fit or the knots do not rise.

    Examples
    --------
    >>> import magwire as mw
    >>> schedule = mw.Schedule(feed=[0.0, 0.1], flux_density=[[0.0, 0.0, 0.0], [0.0, 0.02, 0.0]])
    >>> schedule.at(0.05).tolist()
    [[0.0, 0.01, 0.0]]
    """

    feed: Array
    flux_density: Array

    def __post_init__(self) -> None:
        feed = rising("Schedule", "feed", self.feed, "m")
        flux = array("Schedule", "flux_density", self.flux_density, (len(feed), 3), "T")
        object.__setattr__(self, "feed", feed)
        object.__setattr__(self, "flux_density", flux)

    @classmethod
    def along(cls, course: Sequence[tuple[float, Array]]) -> Schedule:
        """A schedule from feeds [m] and fields [T] in the order of the motion, either way.

        Where a feed comes more than once, as in a pause, the last field counts.
        """
        fields = dict(course)
        knots = sorted(fields)
        return cls(np.array(knots), np.array([fields[feed] for feed in knots]))

    def at(self, feed: ArrayLike) -> Array:
        """Flux density at feeds, shape (n, 3) [T]."""
        where = np.atleast_1d(numbers("Schedule.at", "feed", feed))
        return between(self.feed, self.flux_density, where)

    def resampled(self, step: float) -> Schedule:
        """The schedule with knots every ``step`` [m] of feed, and at its end."""
        positive("Schedule.resampled", "step", step, "m")
        knots = spaced(self.feed, step)
        return Schedule(knots, self.at(knots))

    def scaled(self, factor: float) -> Schedule:
        """The schedule with all field values multiplied by a factor."""
        return Schedule(self.feed, finite("Schedule.scaled", "factor", factor) * self.flux_density)

    def turned(self, matrix: ArrayLike) -> Schedule:
        """The schedule with all field values multiplied by a matrix, shape (3, 3)."""
        return Schedule(
            self.feed, self.flux_density @ array("Schedule.turned", "matrix", matrix, (3, 3)).T
        )


def last_tries(feed: ArrayLike) -> NDArray[np.int64]:
    """Which records of a run led to the farthest feed, of what was tried again the last try.

    Parameters
    ----------
    feed
        In the order of the motion, at least one, shape (n,) [m].
    """
    fed = np.asarray(feed, dtype=np.float64)
    there = fed[: int(np.argmax(fed)) + 1]
    last = there[:-1] < np.minimum.accumulate(there[:0:-1])[::-1]
    return np.flatnonzero(np.append(last, True))
