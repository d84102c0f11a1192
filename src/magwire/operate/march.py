"""A plant whose guide follows a script (P-15)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Hardware, Uniform
from magwire.engine.command import Drive
from magwire.engine.feed import Feed
from magwire.engine.plant import Plant
from magwire.engine.record import Record
from magwire.engine.system import System
from magwire.errors import InputError, positive
from magwire.field import FieldSource

Array = NDArray[np.float64]

AHEAD = 1000
"""Steps whose feed and twist are asked of a script at once, at least."""


class March:
    """A wire on its way into the lumen as a script says, one time step after the other.

    Parameters
    ----------
    system
        Wire, lumen and wall.
    source
        The outside field.
    feed
        The script: course of the guide.
    time_step
        dt [s].
    inertia
        Without it the steps are equilibria: the quasi-static march.
    hardware
        What stands between the inputs that are asked for and those that the plant gets; nothing if
        left out.

    Attributes
    ----------
    plant
        The wire itself.
    step, steps
        Time steps done, and to do in all.
    """

    def __init__(
        self,
        system: System,
        source: FieldSource,
        feed: Feed,
        *,
        time_step: float,
        inertia: bool = True,
        hardware: Hardware | None = None,
    ) -> None:
        self.time_step = positive("Simulation", "time_step", time_step, "s")
        self._length = system.wire.length
        if feed.largest > self._length * (1.0 + 1e-9):
            raise InputError(
                f"Input distance of Feed must be at most the wire's length "
                f"{self._length:.6g} m; received {feed.largest:.6g} m."
            )
        self.steps = max(1, int(np.ceil(feed.duration / time_step - 1e-9)))
        self.step = 0
        self._script, self._inertia = feed, inertia
        self._detour: Array = np.zeros(0)  # feeds of the next steps, before the script goes on
        self._detoured = 0
        self._known: tuple[int, Array, Array] = (0, np.zeros(0), np.zeros(0))
        first, twist = self._course(1, first=0)
        self.plant = Plant(system, source, feed=float(first[0]), twist=float(twist[0]))
        self._inputs: Array = self.plant.inputs[None]
        self._line = (
            None
            if hardware is None
            else hardware.line(system.actuator or Uniform(), time_step, self.plant.inputs)
        )
        self.plant.record()

    def _course(self, count: int, *, first: int | None = None) -> tuple[Array, Array]:
        """Feed [m] and twist at the ends of the next steps of the script, shape (count,)."""
        first = self.step - self._detoured + 1 if first is None else first
        begin, feed, twist = self._known
        if not begin <= first <= begin + len(feed) - count:
            ends = (first + np.arange(max(count, AHEAD))) * self.time_step
            ends = np.minimum(ends, self._script.duration)
            feed = np.minimum(self._script.at(ends), self._length)
            begin, twist = first, self._script.twist_at(ends)
            self._known = (begin, feed, twist)
        there = slice(first - begin, first - begin + count)
        return feed[there], twist[there]

    def _ahead(self, count: int) -> tuple[Array, Array]:
        """Feed [m] and twist at the ends of the next steps, shape (count,)."""
        back = self._detour[:count]
        if len(back) == 0:
            return self._course(count)
        feed, twist = self._course(count - len(back))
        return (
            np.concatenate((back, feed)),
            np.concatenate((np.full(len(back), self.plant.twist), twist)),
        )

    @property
    def goal(self) -> float:
        """Largest feed of the course [m]."""
        return min(self._script.largest, self._length)

    def feeds(self, last: int) -> Array:
        """Feed at the ends of the steps from now on up to ``last``, shape (last - step,) [m]."""
        feed = self._ahead(min(last, self.steps) - self.step)[0]
        ends: Array = feed / self._length * self._length  # as the plant will say
        return ends

    def steer(self, inputs: Array) -> None:
        """Set the inputs at the end of each of the next steps.

        Parameters
        ----------
        inputs
            Shape (k, m); after these steps the last ones stay.
        """
        self._inputs = inputs

    def go_back(self, feed: float, multiple: int) -> None:
        """Put a detour into the course: back to a feed [m] and on to the present one again.

        Both ways take the same number of steps, a ``multiple`` of this many, none longer than the
        longest of the course.
        """
        now = self.plant.feed
        pace = self._script.fastest * self.time_step
        count = multiple * max(1, int(np.ceil((now - feed) / (pace * multiple) - 1e-9)))
        way = np.linspace(now, feed, count + 1)
        self._detour = np.concatenate((way[1:], way[-2::-1], self._detour))
        self.steps += 2 * count

    def advance(self, steps: int) -> bool:
        """Do at most this many more time steps; whether all of them converged."""
        count = min(steps, self.steps - self.step)
        feed, twist = self._ahead(count)
        inputs = self._inputs[:count]
        if len(inputs) < count:
            inputs = np.concatenate((inputs, inputs[-1:].repeat(count - len(inputs), axis=0)))
        made = inputs if self._line is None else self._line.made(inputs)
        done = self.plant.advance(Drive(feed, twist, made, self.time_step, self._inertia))
        self._inputs = self._inputs[min(done, len(self._inputs) - 1) :]
        back = min(done, len(self._detour))
        self._detour, self._detoured = self._detour[back:], self._detoured + back
        self.step += done
        self.plant.time = self.step * self.time_step
        return done == count

    def records(self, every: int) -> Iterator[Record]:
        """March to the end, with a record at the start and after every so many steps."""
        yield self.plant.record()
        while self.step < self.steps:
            converged = self.advance(every)
            yield self.plant.record()
            if not converged:
                return
