"""A march that a navigator steers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.record import Record
from magwire.navigate import Course, NavigationError, Navigator, Observation
from magwire.operate.march import March

Array = NDArray[np.float64]


@runtime_checkable
class Persistent(Protocol):
    """A navigator that may go back and try again where it found no field."""

    def go_back(self, seen: Observation, failure: NavigationError) -> float:
        """The feed to go back to [m].

        Raises
        ------
        NavigationError
            If it gives up.
        """
        ...


@runtime_checkable
class Timed(Protocol):
    """A course whose inputs are functions of the time, not of the feed."""

    def over(self, time: ArrayLike) -> Array:
        """Inputs at times [s], shape (n, m)."""
        ...


@runtime_checkable
class Modelled(Protocol):
    """A navigator that knows where the tip should be."""

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None if that is not known."""
        ...


def steered_records(
    march: March, navigator: Navigator, *, every: int, update: int
) -> Iterator[Record]:
    """March to the end under a navigator.

    Parameters
    ----------
    march
        The plant.
    navigator
        Who says which field comes next.
    every
        Time steps between two records.
    update
        Time steps between two observations.

    Yields
    ------
    Record
        At the start and after every so many steps; the last one where a step failed.

    Raises
    ------
    NavigationError
        If the navigator finds no field.
    """
    plant = march.plant
    if plant.system.actuator is not None:
        _set_out(march, navigator, update)
    yield plant.record()
    seen, gone = observe(march), float("nan")
    while march.step < march.steps:
        if march.step % update == 0:
            feeds = march.feeds(march.step + update)
            seen = _told(march, seen, feeds)
            try:
                schedule = navigator.plan(seen, float(feeds[-1]))
            except NavigationError as failure:
                if not isinstance(navigator, Persistent):
                    raise
                march.go_back(navigator.go_back(seen, failure), update)
                continue
            ends = (march.step + 1 + np.arange(len(feeds))) * march.time_step
            march.steer(_inputs(schedule, feeds, ends))
        step = min(every - march.step % every, update - march.step % update)
        converged = march.advance(step)
        if march.step % update == 0 or march.step == march.steps:
            seen = observe(march)
            gone = float(np.fmax(gone, departure(navigator, seen)))
        if march.step % every == 0 or march.step == march.steps or not converged:
            yield plant.record(gone)
            gone = float("nan")
        if not converged:
            return


def _inputs(course: Course, feed: ArrayLike, time: ArrayLike) -> Array:
    """Inputs at feeds [m], or at times [s], shape (n, m)."""
    return course.over(time) if isinstance(course, Timed) else course.at(feed)


def _told(march: March, seen: Observation, feeds: Array) -> Observation:
    """An observation with where the run ends and how fast the wire is fed."""
    speed = float(feeds[-1] - seen.feed) / (len(feeds) * march.time_step)
    return replace(seen, goal=march.goal, speed=speed)


def _set_out(march: March, navigator: Navigator, update: int) -> None:
    """Bring an actuator to its first inputs before the wire is fed, if there are any."""
    feeds = march.feeds(march.step + update)
    seen = _told(march, observe(march), feeds)
    try:
        course = navigator.plan(seen, float(feeds[-1]))
    except NavigationError:  # it is told when the march is on
        return
    plant = march.plant
    plant.inputs = _inputs(course, seen.feed, 0.0)[0]
    if plant.released:
        plant.settle(plant.system.step_limits())


def observe(march: March) -> Observation:
    """What a navigator is told of the plant."""
    seen = march.plant.observe()
    return Observation(seen.feed, seen.tip, seen.tip_direction)


def departure(navigator: Navigator, seen: Observation) -> float:
    """Distance of the tip from where the navigator expects it [m]; NaN if it does not say."""
    tip = navigator.expected_tip(seen.feed) if isinstance(navigator, Modelled) else None
    return float("nan") if tip is None else float(np.linalg.norm(seen.tip - tip))
