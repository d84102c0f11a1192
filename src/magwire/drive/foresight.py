"""A navigator that plans while the wire moves: nobody waits for it but the feed."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future

import numpy as np
from numpy.typing import NDArray

from magwire.engine.plant import Plant
from magwire.navigate import NavigationError, Navigator, Observation
from magwire.navigate.navigator import Course
from magwire.operate.steering import Persistent

Array = NDArray[np.float64]

HORIZON = 3e-3
"""Feed that is planned at once [m]: half of it lies ahead when the next plan is asked for."""
REST = 1e-12  # changes of feed that are none [m]
AGAIN = 5e-4  # feed after which a plan that failed is tried again [m]


class Foresight:
    """Inputs for a wire, each stretch planned in a thread of its own.

    A navigator that would go back and try again cannot do so by itself: who feeds is told where to.

    Parameters
    ----------
    make
        Makes the navigator, in that thread.
    plant
        The wire that it plans for.
    """

    def __init__(self, make: Callable[[], Navigator], plant: Plant) -> None:
        self._make, self._plant = make, plant
        self._navigator: Navigator | None = None
        self._pending: Future[Course] | None = None
        self._asked = self._stretch = (0.0, 0.0)
        self._course: Course | None = None
        self._failed: tuple[float, float, NavigationError] | None = None
        self._back: float | None = None  # feed from which a persistent navigator tries again

    def inputs(self, feed: float, speed: float) -> Array | None:
        """Inputs for a feed [m] that the wire is about to come to; None while they are planned.

        Raises
        ------
        NavigationError
            If no inputs do what is asked for.
        """
        now = self._plant.feed
        way = float(np.sign(feed - now))
        self._take()
        if self._back is not None and self._failed is not None:
            if way > 0.0 and now > self._back + REST:
                raise NavigationError(
                    f"{self._failed[2]} Go back to {1e3 * self._back:.4g} mm: the navigator tries "
                    "again from there."
                )
            if way > 0.0:
                self._back = self._failed = self._course = None
        elif self._failed is not None:
            where, failed_way, failure = self._failed
            if failed_way == way and abs(where - now) < AGAIN:
                raise failure
            self._failed = None
        begin, end = self._stretch
        planned = min(begin, end) - REST <= feed <= max(begin, end) + REST
        onwards = (end - begin) * way > 0.0
        if self._course is None or not planned or not onwards:
            self._ask(now, way, speed)
            return None
        if abs(end - feed) < 0.5 * HORIZON:
            self._ask(now, way, speed)
        found: Array = np.atleast_2d(self._course.at(feed))[0]
        return found

    def _ask(self, now: float, way: float, speed: float) -> None:
        """Have a stretch ahead planned, if none is being planned and there is any."""
        whole = self._plant.system.wire.length
        until = float(np.clip(now + way * HORIZON, 0.0, whole))
        if self._pending is not None or (now, until) == self._stretch:
            return
        seen = self._plant.observe()
        goal = whole if way > 0.0 else None
        told = Observation(now, seen.tip, seen.tip_direction, goal=goal, speed=speed)
        self._asked = (now, until)
        self._pending = Future()
        words = (self._pending, told, until)  # nobody waits for a plan when the process ends
        threading.Thread(target=self._plan, args=words, name="magwire-plan", daemon=True).start()

    def _plan(self, plan: Future[Course], told: Observation, until: float) -> None:
        try:
            if self._navigator is None:
                self._navigator = self._make()
            plan.set_result(self._navigator.plan(told, until))
        except NavigationError as failure:
            plan.set_exception(self._persist(told, failure))
        except Exception as error:  # raised where the plan is taken up
            plan.set_exception(error)

    def _persist(self, told: Observation, failure: NavigationError) -> NavigationError:
        """Have a persistent navigator say where to go back to, if it does not give up."""
        if not isinstance(self._navigator, Persistent):
            return failure
        try:
            self._back = self._navigator.go_back(told, failure)
        except NavigationError as given_up:
            return given_up
        return failure

    def _take(self) -> None:
        """Take up what has been planned meanwhile."""
        if self._pending is None or not self._pending.done():
            return
        pending, self._pending = self._pending, None
        begin, end = self._asked
        try:
            self._course, self._stretch = pending.result(), self._asked
        except NavigationError as failure:
            self._failed = (begin, float(np.sign(end - begin)), failure)
