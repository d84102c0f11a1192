"""What a person holds down, turned into time steps that are safe to take."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.command import Command
from magwire.engine.observation import Observation
from magwire.engine.plant import Snapshot
from magwire.errors import ConvergenceError, array, positive
from magwire.navigate.navigator import NavigationError
from magwire.session import Session

Array = NDArray[np.float64]

DEAD_MAN = 0.3
"""Time after which what is held counts as let go unless it is said again [s]."""
KEPT = 600
"""Snapshots that are kept to go back to."""


@dataclass(frozen=True)
class Held:
    """What is held down: speeds of the guide [m/s, rad/s], and when it was said [s]."""

    feed_speed: float
    twist_rate: float
    since: float


class Pilot:
    """A session in the hands of a person, who may let go, push too hard, or vanish.

    Parameters
    ----------
    session
        The wire.
    limit
        Force of the wall on the wire, summed over it [N], from which the guide advances no more.
    every
        Time between two snapshots to go back to [s].
    clock
        Seconds that never run backwards.

    Attributes
    ----------
    message
        Why the last step was not the one asked for; empty if it was.
    """

    def __init__(
        self,
        session: Session,
        *,
        limit: float = math.inf,
        every: float = 0.5,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.session, self._clock = session, clock
        self.limit = limit if limit == math.inf else positive("Pilot", "limit", limit, "N")
        self._every = positive("Pilot", "every", every, "s")
        self._held = Held(0.0, 0.0, -math.inf)
        self._inputs: Array | None = None
        self._past: deque[Snapshot] = deque([session.snapshot()], maxlen=KEPT)
        self._due = session.plant.time + every
        self.message = ""

    def hold(self, feed_speed: float, twist_rate: float = 0.0) -> None:
        """Take speeds [m/s, rad/s] as held down, for ``DEAD_MAN`` seconds from now.

        Raises
        ------
        InputError
            If one is not finite; what was held before stays.
        """
        Command(feed_speed, twist_rate, None, self.session.time_step)  # says which it is
        self._held = Held(feed_speed, twist_rate, self._clock())

    def steer(self, inputs: ArrayLike | None) -> None:
        """Set the inputs, shape (m,), or leave them to the session's navigator if None.

        Raises
        ------
        InputError
            If they are not finite, or not as many as the actuator has.
        """
        shape = self.session.plant.inputs.shape
        self._inputs = None if inputs is None else array("Pilot", "inputs", inputs, shape)

    def tick(self) -> Observation:
        """Take one time step with what is held, and see what has become of the wire.

        A step that fails leaves the wire as it was and says why in ``message``.
        """
        self.message = ""
        held, feed = self._held, self._held.feed_speed
        twist = held.twist_rate
        if self._clock() - held.since > DEAD_MAN:
            feed = twist = 0.0
        if feed > 0.0 and self.session.observe().wall_force >= self.limit:
            feed = 0.0
            self.message = f"The wall's limit of {self.limit:.3g} N is reached: retract."
        try:
            self.session.step(feed, twist, self._inputs)
        except (ConvergenceError, NavigationError) as error:
            self.message = str(error)
        self._keep()
        return self.session.observe()

    def rewind(self, back: float) -> float:
        """Go back by a time [s], or as far as snapshots reach; returns the time come to [s].

        Whatever was held is let go.

        Raises
        ------
        InputError
            If the time is not positive.
        """
        until = self.session.plant.time - positive("Pilot", "back", back, "s")
        while len(self._past) > 1 and self._past[-1].time > until:
            self._past.pop()
        self.session.restore(self._past[-1])
        self._held = Held(0.0, 0.0, -math.inf)
        now = float(self.session.plant.time)
        self._due = now + self._every
        return now

    def _keep(self) -> None:
        if self.session.plant.time >= self._due:
            self._past.append(self.session.snapshot())
            self._due = self.session.plant.time + self._every
