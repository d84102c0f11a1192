"""A magnet's poses from feed to feed, and other places for it where there is no going on (P-28).

From one feed to the next the magnet is moved as little as can be. That is a local search, and the
place that is near at one feed may be a dead end at the next: a magnet that bends the tip from one
side of the vessel does not get to the other side while it holds the wire. So the whole course is
planned before the wire is fed on. Where it ends, poses all around the tip are tried at feeds that
went well, and the wire is fed on from each that holds it. One that gets farther is followed back
towards the course until the two meet.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Magnet
from magwire.engine.plant import Snapshot
from magwire.engine.status import Status
from magwire.navigate.direct import SPARE, Direct
from magwire.navigate.navigator import NavigationError

Array = NDArray[np.float64]
LOG = logging.getLogger(__name__)
"""Says how far the plan is, which may take a minute: whoever waits may listen."""

AROUND = 60  # directions from the tip in which a magnet is tried
BACK = (0.0, 0.02, 0.05, 0.1)  # before the end of a course, where it is, in the wire's length
FARTHER = 0.02  # by which another course has to get farther, in that length
MET = 1e-3  # change of a pose, in its units, by which two courses are the same
BETWEEN = 8  # steps between two places on a detour that are looked at
FREE = 1e30
SAME = 1.0 + 1e-6  # a speed that is larger by less is the same
CLOSE = 1e-9  # two feeds are the same [m]
OUTWARD = 2e-3  # steps away from a vessel [m]
WEAK = 1e-3  # flux density that turns no tip by much [T]


@dataclass(frozen=True, eq=False)
class Place:
    """Where a magnet is at a feed.

    Attributes
    ----------
    feed
        Length of wire inside the lumen [m].
    pose
        The magnet's inputs, shape (6,).
    snapshot
        Takes the model there.
    """

    feed: float
    pose: Array
    snapshot: Snapshot


class Arm:
    """Plans where a magnet is, feed after feed.

    Parameters
    ----------
    direct
        The wire's model, what is asked for, and the way to poses that do it.
    magnet
        What is moved.
    every
        Feed between two poses [m].
    """

    def __init__(self, direct: Direct, magnet: Magnet, every: float) -> None:
        self._direct, self._magnet, self._every = direct, magnet, every
        plant = direct.plant
        self._length = plant.system.wire.length
        self._slews = np.array([one.slew for one in magnet.inputs])
        self._speed, self._reach = 0.0, np.full(6, FREE)
        self.places = [Place(plant.feed, plant.inputs, plant.snapshot())]
        self._failure: str | None = None

    def plan(self, feed: float, until: float, goal: float, speed: float | None) -> list[Place]:
        """The places up to a feed [m], planned as far as the goal [m].

        Parameters
        ----------
        feed
            Where the wire is [m]; what lies before stays as it is.
        until, goal
            How far places are needed, and how far it pays to look ahead [m].
        speed
            That of the feed [m/s], if it is known.

        Raises
        ------
        NavigationError
            If no pose does what is asked for before ``until``.
        """
        if speed and abs(speed) > SAME * self._speed:
            self._speed = abs(speed)
            self._reach = np.minimum(self._slews * self._every / self._speed, FREE)
            self.places = [one for one in self.places if one.feed <= feed + CLOSE]
            self._failure = None
        if self._failure is None:
            self._extend(max(until, goal))
        if self._failure is not None and until > self.places[-1].feed + CLOSE:
            raise NavigationError(self._failure)
        return self.places

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None between two places."""
        here = next((one for one in self.places if abs(one.feed - feed) < CLOSE), None)
        if here is None:
            return None
        plant = self._direct.plant
        plant.restore(here.snapshot)
        tip: Array = plant.observe().tip
        return tip

    def _extend(self, end: float) -> None:
        course, why = self._follow(self.places[-1], end)
        self.places += course
        while why:
            detour = self._detour(end)
            if detour is None:
                self._failure = why
                return
            self.places, why = detour

    def _follow(self, start: Place, end: float) -> tuple[list[Place], str]:
        """Go on from a place with the least way; as far as that goes, and why not farther."""
        direct, plant = self._direct, self._direct.plant
        plant.restore(start.snapshot)
        found: list[Place] = []
        last = start
        while last.feed < end - CLOSE:
            LOG.info("planning at %.1f mm", 1e3 * last.feed)
            feed = min(last.feed + self._every, end)
            if feed > end - 1e-6 * self._every:
                feed = end
            if not direct.feed_to(feed) or not direct.improve(last.pose, self._reach):
                return found, direct.why(feed)
            last = self._here(feed)
            found.append(last)
        return found, ""

    def _here(self, feed: float) -> Place:
        """The place as it is, with a direction of length one."""
        plant = self._direct.plant
        pose = plant.inputs
        pose[3:] /= np.linalg.norm(pose[3:])
        plant.inputs = pose
        return Place(feed, pose, plant.snapshot())

    def _detour(self, end: float) -> tuple[list[Place], str] | None:
        """A course that gets farther than the one there is, and why not farther; None if none.

        Of those that get about as far as the farthest it is the one with the least way of the
        magnet.
        """
        reached, start = self.places[-1].feed, self.places[0].feed
        enough = FARTHER * self._length
        for back in BACK:
            feed = reached - back * self._length
            if feed <= start:
                break
            at = min(range(len(self.places)), key=lambda k: abs(self.places[k].feed - feed))
            ahead = [(place, *self._follow(place, end)) for place in self._around(self.places[at])]
            ahead.sort(key=lambda one: -_far(one[0], one[1]))
            found: list[tuple[list[Place], str]] = []
            farthest = end
            for place, course, why in ahead:
                far = _far(place, course)
                if (why and far <= reached + enough) or (found and far < farthest - enough):
                    break
                way = self._back_to_course(place)
                if way is not None:
                    farthest = farthest if found else far
                    found.append(([*way, *course], why))
            if found:
                return min(found, key=lambda one: self._way(one[0]))
        return None

    def _way(self, course: list[Place]) -> float:
        """The way of the magnet along a course, in what counts as one."""
        return sum(self._direct.apart(a.pose, b.pose) for a, b in pairwise(course))

    def _around(self, here: Place) -> list[Place]:
        """Other places of the magnet at a feed that do what is asked for."""
        direct, plant = self._direct, self._direct.plant
        plant.restore(here.snapshot)
        seen = plant.observe()
        flux = self._magnet.at(seen.tip[None], here.pose)[0][0]
        found: list[Place] = []
        for k, line in enumerate(directions(AROUND)):
            LOG.info("planning at %.1f mm, place %d of %d", 1e3 * here.feed, k + 1, AROUND)
            pose = self._aimed(seen.tip, line, flux)
            plant.restore(here.snapshot.with_inputs(pose))
            plant.inputs = pose
            if plant.settle(plant.system.step_limits())[0] is not Status.CONVERGED:
                continue
            if not direct.improve(pose, np.full(6, FREE)):
                continue
            place = self._here(here.feed)
            if all(direct.apart(place.pose, other.pose) > FARTHER for other in (here, *found)):
                found.append(place)
        return found

    def _aimed(self, tip: Array, line: Array, flux: Array) -> Array:
        """A pose in a direction from the tip with a flux density there, off the vessel."""
        start = np.concatenate((tip + line, line))
        wanted = flux if np.linalg.norm(flux) > WEAK else WEAK * line
        pose = self._magnet.aimed(start, tip, wanted)
        while self._direct.spare(pose) < SPARE:
            pose[:3] += OUTWARD * line
        return pose

    def _back_to_course(self, place: Place) -> list[Place] | None:
        """The way from the course to a place: the wire is drawn back until both are the same."""
        direct, plant = self._direct, self._direct.plant
        plant.restore(place.snapshot)
        way = [place]
        for old in reversed([one for one in self.places if one.feed < place.feed - CLOSE]):
            LOG.info("planning back at %.1f mm", 1e3 * old.feed)
            if not direct.feed_to(old.feed):
                return None
            if not direct.improve(way[-1].pose, self._reach, towards=old.pose):
                return None
            way.append(self._here(old.feed))
            if direct.apart(way[-1].pose, old.pose) < MET:
                kept = [one for one in self.places if one.feed < old.feed + CLOSE]
                there = [kept[-1], *way[-2::-1]]
                holds = all(self._holds(a, b) for a, b in pairwise(there))
                return [*kept, *there[1:]] if holds else None
        return None

    def _holds(self, start: Place, end: Place) -> bool:
        """Whether the tip stays off the wall on the straight way from one place to the next."""
        direct, plant = self._direct, self._direct.plant
        plant.restore(start.snapshot)
        for share in np.linspace(0.0, 1.0, BETWEEN + 1)[1:]:
            plant.inputs = start.pose + share * (end.pose - start.pose)
            if plant.settle(plant.system.step_limits())[0] is not Status.CONVERGED:
                return False
            if not direct.feed_to(start.feed + share * (end.feed - start.feed)):
                return False
            if not direct.is_off_wall() or direct.spare(plant.inputs) < 0.0:
                return False
        return True


def _far(place: Place, course: list[Place]) -> float:
    return course[-1].feed if course else place.feed


def directions(count: int) -> Array:
    """Unit vectors that are spread evenly, shape (count, 3)."""
    k = np.arange(count)
    z = 1.0 - (2.0 * k + 1.0) / count
    turn = k * np.pi * (3.0 - np.sqrt(5.0))
    flat = np.sqrt(1.0 - z * z)
    return np.stack((flat * np.cos(turn), flat * np.sin(turn), z), axis=1)
