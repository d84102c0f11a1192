"""A navigator beside an operator: it gives the inputs, whoever feeds keeps the feed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.plant import Plant
from magwire.errors import positive
from magwire.navigate import Navigator, Observation
from magwire.navigate.navigator import Course

Array = NDArray[np.float64]

REST = 1e-12  # changes of feed that are none [m]


class Assist:
    """Inputs for a plant whose feed nobody knows beforehand.

    The navigator is asked anew whenever the wire has left the stretch that it planned for, or
    turned round.

    Parameters
    ----------
    navigator
        Who plans.
    plant
        The wire that it plans for.
    every
        Feed between two observations [m].
    """

    def __init__(self, navigator: Navigator, plant: Plant, every: float) -> None:
        self.navigator, self.plant = navigator, plant
        self.every = positive("Assist", "every", every, "m")
        self._schedule: Course | None = None
        self._stretch = (0.0, 0.0)

    def inputs(self, feed: float, speed: float) -> Array:
        """Inputs for a feed that is about to be reached.

        Parameters
        ----------
        feed
            Length of wire past the entrance, at the end of the next step [m].
        speed
            That of the guide [m/s]; negative retracts.

        Returns
        -------
        array
            Shape (m,).

        Raises
        ------
        NavigationError
            If no inputs do what is asked for.
        """
        now = self.plant.feed
        if abs(feed - now) <= REST:
            return self.plant.inputs
        begin, end = self._stretch
        inside = min(begin, end) - REST <= feed <= max(begin, end) + REST
        if self._schedule is None or not inside or (end - begin) * (feed - now) < 0.0:
            self._plan(now, feed, speed)
        assert self._schedule is not None
        result: Array = self._schedule.at(feed)[0]
        return result

    def _plan(self, now: float, feed: float, speed: float) -> None:
        """Plan from where the wire is to one observation farther, the way it goes."""
        ahead = np.copysign(max(self.every, abs(feed - now)), feed - now)
        whole = self.plant.system.wire.length
        until = float(np.clip(now + ahead, 0.0, whole))
        seen = self.plant.observe()
        goal = whole if feed > now else None
        told = Observation(now, seen.tip, seen.tip_direction, goal=goal, speed=speed)
        self._schedule = self.navigator.plan(told, until)
        self._stretch = (now, until)
