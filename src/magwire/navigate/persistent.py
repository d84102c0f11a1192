"""Steering in a tree that goes back and tries again where it got stuck or went astray."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from magwire.errors import whole
from magwire.lumen import Lumen
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.navigator import NavigationError, Navigator, Observation
from magwire.navigate.pilot import Knot
from magwire.navigate.schedule import Schedule
from magwire.navigate.stable import StableNavigator

Array = NDArray[np.float64]

ATTEMPTS = 4  # in one place
DENSITY = 4.0  # balls per smallest radius by which a path is known
CLOSE = 1e-9  # two feeds are the same [m]


def approaches(demands: Demands) -> tuple[Demands, ...]:
    """Demands to try one after the other: as given, nearer to the centreline, and farther off."""
    clearance = demands.tip_clearance
    return (
        demands,
        replace(demands, tip_clearance=0.5 * (1.0 + clearance)),
        replace(demands, tip_clearance=0.25 * clearance),
        replace(demands, stability_margin=10.0 * demands.stability_margin),
    )


class Ways:
    """The paths to all outlets as balls, to see in which of them a point is.

    Parameters
    ----------
    lumen
        A tree.
    """

    def __init__(self, lumen: Lumen) -> None:
        self.target = str(lumen.target)
        self._balls, self._arcs = {}, {}
        for name in lumen.outlets:
            tube = lumen.paths[name]
            count = int(DENSITY * tube.length / lumen.narrowest) + 2
            self._arcs[name] = np.linspace(0.0, tube.length, min(count, 4000))
            self._balls[name] = tube.curve.at(self._arcs[name])

    def deepest(self, name: str, point: Array) -> tuple[float, float, float]:
        """Gap of a point in the path to an outlet, arc parameter and radius there [m]."""
        balls = self._balls[name]
        gap = balls[:, 3] - np.linalg.norm(balls[:, :3] - point, axis=1)
        at = int(np.argmax(gap))
        return float(gap[at]), float(self._arcs[name][at]), float(balls[at, 3])

    def strayed(self, point: Array) -> str | None:
        """The other outlet on whose path a point is, if it is not on the path to the target."""
        gap, arc, radius = self.deepest(self.target, point)
        if gap > -tuned.RETRY.strayed * radius or arc == self._arcs[self.target][-1]:
            return None
        others = {name: self.deepest(name, point)[0] for name in self._balls if name != self.target}
        best = max(others, key=lambda name: others[name], default=None)
        return best if best is not None and others[best] > 0.0 else None

    def junction(self, low: float, high: float) -> float | None:
        """First arc parameter in a range where another path leaves the one to the target [m]."""
        own, found = self._balls[self.target], []
        for name, balls in self._balls.items():
            if name == self.target:
                continue
            shared = min(len(own), len(balls))
            apart = np.linalg.norm(own[:shared, :3] - balls[:shared, :3], axis=1)
            leaves = np.flatnonzero(apart > 0.5 * own[:shared, 3])
            if len(leaves) > 0 and low <= self._arcs[self.target][leaves[0]] <= high:
                found.append(float(self._arcs[self.target][leaves[0]]))
        return min(found, default=None)


def persistent(navigator: StableNavigator, attempts: int = ATTEMPTS) -> Navigator:
    """The navigator, with further attempts if the lumen is a tree."""
    lumen = navigator.model.system.lumen
    return PersistentNavigator(navigator, lumen, attempts) if lumen.outlets else navigator


class PersistentNavigator:
    """Goes back and tries again, with other demands, where it got stuck or went astray.

    Where the plan ends, or the tip turns out to be in another branch than the one to the target,
    the wire is retracted in the fields in which it came, some radii, and to before the junction if
    there is one. Then the tip is asked to keep nearer to the centreline, then it is given more
    room, then the wire is made stiffer; past the place, the first demands hold again.

    Parameters
    ----------
    navigator
        What it plans with.
    lumen
        The tree.
    attempts
        How often it tries in one place, at most 4.

    Attributes
    ----------
    notes
        What was tried again, a sentence each.
    """

    def __init__(self, navigator: StableNavigator, lumen: Lumen, attempts: int = ATTEMPTS) -> None:
        self.navigator = navigator
        self.notes: list[str] = []
        count = whole("PersistentNavigator", "attempts", attempts, minimum=1)
        self._approaches = approaches(navigator.demands)[:count]
        self._ways = Ways(lumen)
        self._trail: list[tuple[Knot, Array]] = []  # knots and fields on the way here
        self._back: Knot | None = None  # where to, while the wire is retracted
        self._way_back = self._last = Schedule(np.zeros(1), np.zeros((1, 3)))
        self._tried, self._trouble = 0, -float("inf")

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        if self._back is not None:
            if observation.feed > self._back.feed + CLOSE:
                return self._way_back
            self.navigator.resume(self._back, self._approaches[self._tried])
            self._back = None
        elif self._tried and observation.feed > self._trouble:
            self._tried = 0
            self.navigator.resume(self.navigator.knot, self._approaches[0])
        branch = self._ways.strayed(observation.tip)
        if branch is not None:
            raise NavigationError(
                f"At {observation.feed * 1e3:.4g} mm of feed the tip is on the path to '{branch}', "
                f"not to '{self._ways.target}'."
            )
        schedule = self.navigator.plan(observation, until)
        knot = self.navigator.knot
        while self._trail and self._trail[-1][0].feed >= knot.feed - CLOSE:
            self._trail.pop()
        self._trail.append((knot, schedule.at(knot.feed)[0]))
        self._last = schedule
        return schedule

    def go_back(self, seen: Observation, failure: NavigationError) -> float:
        """The feed to go back to [m]; see ``Persistent``."""
        _, arc, radius = self._ways.deepest(self._ways.target, seen.tip)
        if seen.feed > self._trouble:
            self._tried = 0
        self._tried += 1
        back = seen.feed - tuned.RETRY.step * radius * self._tried
        junction = self._ways.junction(arc - (seen.feed - back), arc)
        if junction is not None:
            back = min(back, seen.feed - (arc - junction) - tuned.RETRY.ahead * radius)
        knots = [knot for knot, _ in self._trail if knot.feed <= back]
        if self._tried == len(self._approaches) or not knots:
            raise NavigationError(" ".join([str(failure), *self._in_short()]))
        self._trouble = max(self._trouble, seen.feed + tuned.RETRY.past * radius)
        self._back = knots[-1]
        course = [(knot.feed, flux) for knot, flux in self._trail]
        course.append((seen.feed, self._last.at(seen.feed)[0]))
        self._way_back = Schedule.along(course)
        demands = self._approaches[self._tried]
        self.notes.append(
            f"{failure} The wire was taken back to {self._back.feed * 1e3:.4g} mm and fed again "
            f"with tip_clearance {demands.tip_clearance:.3g} and stability_margin "
            f"{demands.stability_margin:.3g} 1/s^2."
        )
        return self._back.feed

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None if that is not known."""
        return None if self._back is not None else self.navigator.expected_tip(feed)

    def _in_short(self) -> Sequence[str]:
        count = len(self.notes)
        return [f"It was tried again {count} time{'s' if count > 1 else ''}."] if count else []
