"""What steers: sees the wire now and then, and says which field comes next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.system import System
from magwire.errors import MagwireError

Array = NDArray[np.float64]


class NavigationError(MagwireError):
    """There is no field that does what is asked for; the message says where and why."""


@dataclass(frozen=True)
class Observation:
    """What a navigator is told of the wire.

    Attributes
    ----------
    feed
        Length of wire inside the lumen [m].
    tip, tip_direction
        Measured position [m] and unit direction of the tip, shape (3,).
    goal
        Feed at which the run ends [m], if that is known: how far it pays to look ahead.
    speed
        That of the feed at the moment [m/s], if that is known.
    """

    feed: float
    tip: Array
    tip_direction: Array
    goal: float | None = None
    speed: float | None = None


class Course(Protocol):
    """Inputs by the feed."""

    def at(self, feed: ArrayLike) -> Array:
        """Inputs at feeds, shape (n, m)."""
        ...


class Navigator(Protocol):
    """A way to steer. To add one, write a class with this method."""

    def plan(self, observation: Observation, until: float) -> Course:
        """The inputs from the observed feed to the feed ``until`` [m] of the next observation.

        Raises
        ------
        NavigationError
            If no field does what is asked for.
        """
        ...


@runtime_checkable
class Steering(Protocol):
    """A way to steer that has no wire yet, and therefore no memory: it makes navigators."""

    @property
    def update_every(self) -> float:
        """Feed between two observations [m]."""
        ...

    def start(self, system: System) -> Navigator:
        """The navigator of one run of a system.

        Raises
        ------
        InputError
            If this system cannot be steered so.
        """
        ...


@dataclass(frozen=True)
class Prescribed:
    """Steering by a schedule that is known beforehand, whatever the wire does (P-23).

    It is one of fields, or one of inputs for an actuator.
    """

    schedule: Course

    def plan(self, observation: Observation, until: float) -> Course:
        """The schedule itself."""
        return self.schedule
