"""A course that is planned to its end before the wire sets out, without spikes (P-22).

Fields are planned one feed after the other. A wire that comes to a bend with its tip in one part of
its room may need far more field there than one that comes in another: where the field of a course
has a spike, other courses are planned around it, and the one with the least peak is kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from magwire.engine.feed import Feed
from magwire.navigate import tuned
from magwire.navigate.navigator import Observation
from magwire.navigate.pilot import Knot, norm
from magwire.navigate.stable import StableNavigator

CLOSE = 1e-9  # two feeds are the same [m]


def foresee(
    navigator: StableNavigator, feed: Feed, goal: float, *, level: bool = True
) -> Sequence[str]:
    """Plan a navigator's course to its end; the navigator has it from the entrance on.

    Parameters
    ----------
    navigator
        What plans, at the entrance.
    feed
        How the wire will be fed.
    goal
        How far along the path the tip is to come [m].
    level
        Whether spikes are taken out.

    Returns
    -------
    sequence of str
        Where the course is another one than that of the navigator alone, a sentence each.
    """
    course = _Course(navigator, feed.largest, goal)
    navigator.plan(Observation(0.0, np.zeros(3), np.zeros(3), speed=feed.fastest), 0.0)
    if course.go_on() and level:
        course.level()
    return course.notes


class _Course:
    """A course to where the tip is at the goal [m], or the wire fed by the farthest feed [m]."""

    def __init__(self, navigator: StableNavigator, farthest: float, goal: float) -> None:
        self.notes: list[str] = []
        self._navigator, self._farthest, self._goal = navigator, farthest, goal

    def level(self) -> None:
        """Take out spikes."""
        navigator = self._navigator
        for _ in range(tuned.SPIKE.rounds):
            course = navigator.knots
            sizes = np.array([norm(knot.flux) for knot in course])
            top = int(np.argmax(sizes))
            if not sizes[top] > tuned.SPIKE.over * _median(sizes):
                return
            better = self._around(course, top, sizes)
            navigator.take(course if better is None else better)
            if better is None:
                return

    def _around(
        self, course: list[Knot], top: int, sizes: NDArray[np.float64]
    ) -> list[Knot] | None:
        """A course that differs from another one around its peak, and has a smaller one."""
        demands, best = self._navigator.demands, None
        peak = tuned.SPIKE.gain * float(sizes[top])
        for clearance in clearances(demands.tip_clearance):
            found = self._detour(course, top, clearance, peak)
            if found is not None:
                best, peak = found, max(norm(knot.flux) for knot in found)
                weak = 1e3 / demands.weakening
                note = (
                    f"Planned with tip_clearance {clearance:.3g} around "
                    f"{1e3 * course[top].feed:.4g} mm of feed; with {demands.tip_clearance:.3g} "
                    f"it takes {weak * sizes[top]:.3g} mT there."
                )
        if best is not None:
            self.notes.append(note)
        return best

    def _detour(
        self, course: list[Knot], top: int, clearance: float, below: float
    ) -> list[Knot] | None:
        """A course with another clearance around its peak, if its field stays below a size [T]."""
        navigator, demands = self._navigator, self._navigator.demands
        reach, feed = navigator.model.reach, course[top].feed
        lead = [k for k, knot in enumerate(course) if knot.feed <= feed - tuned.SPIKE.lead * reach]
        first = lead[-1] if lead else 0
        navigator.resume(course[first], replace(demands, tip_clearance=clearance))
        done = self.go_on(below, feed + tuned.SPIKE.past * reach)
        begun = navigator.knots
        navigator.resume(begun[-1], demands)
        if not done or not self.go_on(below, join=course):
            return None
        return [*course[:first], *begun[:-1], *navigator.knots]

    def go_on(
        self, below: float = np.inf, until: float = np.inf, join: Sequence[Knot] = ()
    ) -> bool:
        """Plan on until a feed [m], the goal, or where another course goes on as this one.

        Returns whether it got there with fields that stay below a size [T].
        """
        navigator = self._navigator
        known = {round(knot.feed / CLOSE): k for k, knot in enumerate(join)}
        while True:
            last = navigator.knots[-1]
            if last.feed >= min(until, self._farthest - CLOSE):
                return True
            if not navigator.go_on(min(last.feed + navigator.plan_every, self._farthest)):
                return False
            now = navigator.knots[-1]
            if norm(now.flux) >= below:
                return False
            if now.feed == last.feed or navigator.model.tip_arc() >= self._goal:
                return True
            there = known.get(round(now.feed / CLOSE))
            if there is not None and self._same(join[there], now):
                rest = join[there + 1 :]
                navigator.take([*navigator.knots, *rest])
                return all(norm(knot.flux) < below for knot in rest)

    def _same(self, one: Knot, other: Knot) -> bool:
        """Whether the wire does the same at two planned fields of one feed."""
        a, b, numbers = one.view, other.view, tuned.SPIKE
        if a is None or b is None:
            return False
        return (
            norm(one.flux - other.flux) < numbers.same_field * self._navigator.unit
            and norm(a.offset - b.offset) < numbers.same_offset * a.radius
            and abs(np.log(a.eigenvalue / b.eigenvalue)) < numbers.same_stiffness
        )


def clearances(usual: float) -> tuple[float, ...]:
    """Clearances of the tip to try instead of another one: closer to the wall, and farther off."""
    return (
        tuned.SPIKE.farther * usual,
        usual + tuned.SPIKE.nearer * (1.0 - usual),
    )


def _median(sizes: NDArray[np.float64]) -> float:
    """Median of the fields that are not zero."""
    some = sizes[sizes > 0.0]
    return float(np.median(some)) if len(some) else float("inf")
