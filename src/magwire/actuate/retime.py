"""A plan against time as the hardware can follow it: sampled evenly, slower where it must (P-27).

The way of feed and inputs through each other stays as planned; only when it is where changes. So
currents never lag behind the wire, and the field along the way is the planned one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.advancer import Advancer
from magwire.actuate.pace import Pace
from magwire.actuate.timetable import Timetable
from magwire.errors import InputError, positive

Array = NDArray[np.float64]
HALVINGS = 30
MOST = 2_000_000  # samples of a plan: it takes a minute, and its table half a gigabyte
STALLED = 1e-6
"""Part of a sample below which a plan does not get on: what it asks for can never be reached."""


def retime(
    plan: Timetable, actuator: Actuator, *, rate: float, advancer: Advancer | None = None
) -> Timetable:
    """The same course in samples that keep the limits on rates of change.

    It begins with the actuator idle and the wire at rest. Where inputs or advancer cannot follow,
    the course is slowed down; where the advancer turns round, it waits for its play.

    Parameters
    ----------
    plan
        The course, with the planned times.
    actuator
        What makes the field.
    rate
        Samples per second [1/s].
    advancer
        The stepper that feeds the wire; any feed can be reached at any speed without one.

    Raises
    ------
    InputError
        If the actuator has other inputs, an input can never be held or reached, or there would be
        millions of samples.
    """
    names = tuple(one.name for one in actuator.inputs)
    if names != plan.names:
        raise InputError(
            f"Input actuator of retime must have the plan's inputs, {', '.join(plan.names)}; "
            f"received {', '.join(names) or 'none'}."
        )
    dt = 1.0 / positive("retime", "rate", rate, "1/s")
    lasts = float(plan.time[-1] - plan.time[0])
    if lasts * rate > MOST:
        raise InputError(
            f"Input rate of retime must be at most {MOST / lasts:.4g} 1/s for a plan of "
            f"{lasts:.4g} s; received {rate:g} 1/s."
        )
    course = _led_in(plan, actuator, dt)
    walk = _Walk(course, Pace.of(actuator), dt, advancer)
    walk.go()
    at = np.array(walk.nominal)
    feed = np.interp(at, course.time, course.feed)
    return replace(
        course,
        time=np.arange(len(at), dtype=np.float64) * dt,
        feed=feed,
        inputs=_along(course, course.inputs, at),
        tip=_along(course, course.tip, at),
        flux_density=_along(course, course.flux_density, at),
        steps=None if advancer is None else advancer.steps(np.array(walk.motor) - feed[0]),
        advancer=advancer,
    )


def _along(course: Timetable, values: Array, at: Array) -> Array:
    return np.stack([np.interp(at, course.time, column) for column in values.T], axis=1)


def _led_in(plan: Timetable, actuator: Actuator, dt: float) -> Timetable:
    """The plan with poses' directions of length 1, and with the way from the idle inputs ahead."""
    inputs, idle = plan.inputs.copy(), actuator.idle.copy()
    for k in Pace.of(actuator).turns:
        inputs[:, k : k + 3] /= np.linalg.norm(inputs[:, k : k + 3], axis=1, keepdims=True)
        idle[k : k + 3] /= np.linalg.norm(idle[k : k + 3])
    if np.allclose(inputs[0], idle, rtol=0.0, atol=1e-12):
        return replace(plan, inputs=inputs, steps=None, advancer=None)
    nothing = np.full((1, 3), np.nan)
    return replace(
        plan,
        time=np.concatenate(([plan.time[0] - dt], plan.time)),
        feed=np.concatenate((plan.feed[:1], plan.feed)),
        inputs=np.concatenate((idle[None], inputs)),
        tip=np.concatenate((plan.tip[:1], plan.tip)),
        flux_density=np.concatenate((nothing, plan.flux_density)),
        steps=None,
        advancer=None,
    )


@dataclass
class _Walk:
    """Sample after sample along a course, each as far as the limits let it."""

    course: Timetable
    pace: Pace
    dt: float
    advancer: Advancer | None

    def __post_init__(self) -> None:
        feed = self.course.feed
        moving = np.sign(np.diff(feed))
        some = np.flatnonzero(moving)
        turns = some[1:][moving[some[1:]] != moving[some[:-1]]]
        self._turns: Array = self.course.time[turns]
        self._moves, self._signs = some, moving[some]
        self.nominal = [float(self.course.time[0])]
        self.motor = [float(feed[0])]

    def go(self) -> None:
        """To the end of the course."""
        end = float(self.course.time[-1])
        while self.nominal[-1] < end:
            now = self.nominal[-1]
            aim = self._engaged(now)
            if aim != self.motor[-1]:
                self._take_up(aim)
                continue
            stops = self._turns[self._turns > now]
            last = min([now + self.dt, end, *stops[:1].tolist()])
            last = end if end - last < 1e-9 * self.dt else last
            self._step(now, last)

    def _step(self, now: float, last: float) -> None:
        far = last
        if not self._kept(now, last):
            near = now
            for _ in range(HALVINGS):
                middle = 0.5 * (near + far)
                near, far = (middle, far) if self._kept(now, middle) else (near, middle)
            far = near
        if far - now < STALLED * self.dt:
            raise self._stuck(now, last)
        self.nominal.append(far)
        way = self._way(now)
        self.motor.append(self._place(far, way))

    def _kept(self, now: float, then: float) -> bool:
        if self.advancer is not None:
            way = self._way(now)
            moved = abs(self._place(then, way) - self._place(now, way))
            if moved > self.advancer.max_speed * self.dt * (1.0 + 1e-9):
                return False
        a, b = self._inputs(now), self._inputs(then)
        return self.pace.kept(a, b, self.dt)

    def _inputs(self, at: float) -> Array:
        course = self.course
        i = int(np.clip(np.searchsorted(course.time, at) - 1, 0, len(course.time) - 2))
        part = (at - course.time[i]) / (course.time[i + 1] - course.time[i])
        found: Array = course.inputs[i] + part * (course.inputs[i + 1] - course.inputs[i])
        return found

    def _way(self, now: float) -> float:
        """Direction in which the wire moves next; the last one at the end, forwards in a pause."""
        if len(self._signs) == 0:
            return 1.0
        segment = int(np.searchsorted(self.course.time, now, side="right")) - 1
        which = int(np.searchsorted(self._moves, segment))
        return float(self._signs[min(which, len(self._signs) - 1)])

    def _place(self, at: float, way: float) -> float:
        """Place of the stepper [m] when it pushes or pulls the wire at a planned time."""
        feed = float(np.interp(at, self.course.time, self.course.feed))
        play = 0.0 if self.advancer is None else self.advancer.backlash
        return feed if way > 0.0 else feed - play

    def _engaged(self, now: float) -> float:
        return self._place(now, self._way(now))

    def _take_up(self, aim: float) -> None:
        """Turn the stepper through its play while all else waits."""
        assert self.advancer is not None
        most = self.advancer.max_speed * self.dt
        left = aim - self.motor[-1]
        self.nominal.append(self.nominal[-1])
        self.motor.append(aim if abs(left) <= most else self.motor[-1] + np.copysign(most, left))

    def _stuck(self, now: float, last: float) -> InputError:
        """The error where a supply cannot hold what is planned: all other limits let through."""
        a, b = self._inputs(now), self._inputs(last)
        share = self.pace.resistance * np.maximum(np.abs(a), np.abs(b)) / self.pace.supply
        worst = int(np.argmax(share))
        held = self.pace.supply[worst] / self.pace.resistance[worst]
        feed = 1e3 * float(np.interp(now, self.course.time, self.course.feed))
        return InputError(
            f"At {feed:.4g} mm of feed input {self.course.names[worst]} goes from {a[worst]:.6g} "
            f"to {b[worst]:.6g} {self.course.units[worst]}; its supply of "
            f"{self.pace.supply[worst]:g} V holds {held:.6g} {self.course.units[worst]} at most."
        )
