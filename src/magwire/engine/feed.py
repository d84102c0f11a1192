"""How the wire is pushed: feed speed and twist at the guide as functions of time (P-15)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array, finite, positive
from magwire.units import show

Array = NDArray[np.float64]


class Feed:
    """Pushing at constant speed; ``Feed.table`` makes any other course.

    Parameters
    ----------
    speed
        Feed speed [m/s].
    distance
        Insertion length in the end [m].
    twist
        Angle by which the wire is turned about its axis where it leaves the guide [rad].

    Attributes
    ----------
    times, speeds, twists
        The course: speed and twist are linear in time between these, shape (n,) [s, m/s, rad].

    Examples
    --------
    >>> import magwire as mw
    >>> mw.Feed(speed=1e-3, distance=0.075)
    <Feed: 75 mm in 75 s, at up to 1 mm/s>
    """

    def __init__(self, speed: float, distance: float, *, twist: float = 0.0) -> None:
        speed = positive("Feed", "speed", speed, "m/s")
        distance = positive("Feed", "distance", distance, "m")
        twist = finite("Feed", "twist", twist, "rad")
        self._set([0.0, distance / speed], [speed, speed], [twist, twist])

    @classmethod
    def table(
        cls, times: Sequence[float], speeds: Sequence[float], twists: Sequence[float] | None = None
    ) -> Feed:
        """A course given by points in time; a negative speed retracts.

        Parameters
        ----------
        times
            From 0 on, rising, shape (n,) [s].
        speeds
            Feed speed at these times, linear between them, shape (n,) [m/s].
        twists
            Twist at these times, shape (n,) [rad]; none if left out.

        Raises
        ------
        InputError
            If times do not start at 0 and rise, or the wire would be pulled out of the guide.
        """
        feed = cls.__new__(cls)
        knots = array("Feed", "times", times, (None,), "s")
        feed._set(knots, speeds, np.zeros(len(knots)) if twists is None else twists)
        return feed

    def _set(self, times: ArrayLike, speeds: ArrayLike, twists: ArrayLike) -> None:
        self.times: Array = array("Feed", "times", times, (None,), "s")
        self.speeds: Array = array("Feed", "speeds", speeds, self.times.shape, "m/s")
        self.twists: Array = array("Feed", "twists", twists, self.times.shape, "rad")
        if len(self.times) < 2 or self.times[0] != 0.0 or np.any(np.diff(self.times) <= 0.0):
            raise InputError(
                f"Input times of Feed must start at 0 s and rise; received {self.times.tolist()} s."
            )
        moved = 0.5 * (self.speeds[1:] + self.speeds[:-1]) * np.diff(self.times)
        self._fed: Array = np.concatenate(([0.0], np.cumsum(moved)))
        least = float(self._extremes().min())
        if least < -1e-9:
            raise InputError(
                "Input speeds of Feed must not pull the wire out of the guide; "
                f"received a course down to a feed of {least:.6g} m."
            )

    def _extremes(self) -> Array:
        """Feed at the knots and where the speed changes sign between them [m]."""
        turns = []
        for i in range(len(self.times) - 1):
            before, after = self.speeds[i], self.speeds[i + 1]
            if before * after < 0.0:
                part = before / (before - after)
                turns.append(self.times[i] + part * (self.times[i + 1] - self.times[i]))
        return self.at(np.concatenate((self.times, turns)))

    @property
    def duration(self) -> float:
        """Time at which the course ends [s]."""
        return float(self.times[-1])

    def __repr__(self) -> str:
        last = float(self._fed[-1])
        words = f"<Feed: {show(self.largest, 'length')}"
        if last < self.largest:
            words += f", back to {show(last, 'length')},"
        words += f" in {show(self.duration, 'time')}, at up to {show(self.fastest, 'speed')}"
        low, high = float(self.twists.min()), float(self.twists.max())
        if low != high:
            words += f", twisted {show(low, 'angle')} to {show(high, 'angle')}"
        elif low != 0.0:
            words += f", twisted {show(low, 'angle')}"
        return f"{words}>"

    @property
    def largest(self) -> float:
        """Largest feed of the course [m]."""
        return float(self._extremes().max())

    @property
    def fastest(self) -> float:
        """Largest speed in either direction [m/s]."""
        return float(np.abs(self.speeds).max())

    def at(self, time: ArrayLike) -> Array:
        """Feed at times, shape (k,) [m]; constant after the end of the course."""
        t = np.clip(np.asarray(time, dtype=np.float64), 0.0, self.times[-1])
        i = np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, len(self.times) - 2)
        span = self.times[i + 1] - self.times[i]
        part = (t - self.times[i]) / span
        before, after = self.speeds[i], self.speeds[i + 1]
        result: Array = self._fed[i] + span * part * (before + 0.5 * part * (after - before))
        return result

    def twist_at(self, time: ArrayLike) -> Array:
        """Twist of the guide at times, shape (k,) [rad]."""
        return np.interp(np.asarray(time, dtype=np.float64), self.times, self.twists)
