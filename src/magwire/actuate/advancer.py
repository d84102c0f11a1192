"""A stepper that feeds the wire: whole steps, and play when it turns round."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import nonnegative, positive, refuse

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Advancer:
    """A stepper with play.

    Parameters
    ----------
    resolution
        Feed of one step [m].
    backlash
        How far it has to turn, when it turns round, before the wire moves [m].
    max_speed
        [m/s].

    Raises
    ------
    InputError
        If a value is not positive, or the backlash negative.
    """

    resolution: float
    backlash: float = 0.0
    max_speed: float = math.inf

    def __post_init__(self) -> None:
        positive("Advancer", "resolution", self.resolution, "m")
        nonnegative("Advancer", "backlash", self.backlash, "m")
        if not self.max_speed > 0.0:
            raise refuse("Advancer", "max_speed", "positive", self.max_speed, "m/s")

    def steps(self, motor: ArrayLike) -> Integers:
        """The whole step that is nearest to a place of the stepper [m]."""
        place = np.asarray(motor, dtype=np.float64) / self.resolution
        whole: Integers = np.floor(place + 0.5).astype(np.int64)
        return whole

    def moved(self, steps: ArrayLike, feed: float = 0.0) -> Array:
        """Feed that a course of the stepper makes, shape (k,) [m].

        Parameters
        ----------
        steps
            Places of the stepper, shape (k,), of which the first pushes without play.
        feed
            Feed at the first of them [m].
        """
        motor = (np.asarray(steps, dtype=np.float64) - np.asarray(steps).flat[0]) * self.resolution
        made = np.empty(len(motor))
        now = 0.0
        for k, place in enumerate(motor.tolist()):
            now = min(max(now, place), place + self.backlash)
            made[k] = feed + now
        return made
