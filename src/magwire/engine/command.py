"""What a moving wire is told to do: by speeds, or by where guide and inputs end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array, finite, positive

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Command:
    """Speeds of the guide and inputs of the actuator over an interval of time.

    Parameters
    ----------
    feed_speed
        Speed of the guide [m/s]; negative retracts.
    twist_rate
        Rate of the guide about its axis [rad/s].
    inputs
        Inputs of the actuator at the interval's end, shape (m,), reached linearly; they stay as
        they are if left out.
    duration
        Length of the interval [s].
    """

    feed_speed: float = 0.0
    twist_rate: float = 0.0
    inputs: ArrayLike | None = None
    duration: float = 0.01

    def __post_init__(self) -> None:
        finite("Command", "feed_speed", self.feed_speed, "m/s")
        finite("Command", "twist_rate", self.twist_rate, "rad/s")
        positive("Command", "duration", self.duration, "s")
        if self.inputs is not None:
            object.__setattr__(self, "inputs", array("Command", "inputs", self.inputs, (None,)))


@dataclass(frozen=True)
class Drive:
    """Where guide and actuator are at the ends of time steps that follow each other.

    Parameters
    ----------
    feed
        Length of wire past the entrance, shape (k,) [m].
    twist
        Twist of the guide, shape (k,) [rad].
    inputs
        Inputs of the actuator, shape (k, m).
    time_step
        dt [s].
    inertia
        Without it the steps are equilibria one after the other (P-16).
    """

    feed: Array
    twist: Array
    inputs: Array
    time_step: float
    inertia: bool = True

    def __post_init__(self) -> None:
        if not len(self.feed) == len(self.twist) == len(self.inputs):
            raise InputError(
                "Inputs feed, twist and inputs of Drive must have a value for every step; received "
                f"{len(self.feed)}, {len(self.twist)} and {len(self.inputs)}."
            )

    def part(self, first: int, last: int) -> Drive:
        """Steps first ... last - 1 of these."""
        some = slice(first, last)
        return Drive(
            self.feed[some], self.twist[some], self.inputs[some], self.time_step, self.inertia
        )
