"""A timetable against the hardware before anybody plays it: limits, and the field (P-26, P-27)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.advancer import Advancer
from magwire.actuate.magnets import magnets
from magwire.actuate.pace import ROUNDING, Pace
from magwire.actuate.timetable import Timetable
from magwire.actuate.together import Together
from magwire.errors import InputError, positive

Array = NDArray[np.float64]
USUAL = 0.02
"""Tolerance on the field where none is given, over the largest planned one."""
POINTS = 401  # of the lumen, at most, that a magnet keeps away from


@dataclass(frozen=True)
class Violation:
    """A stretch of time in which one limit is not kept.

    Attributes
    ----------
    begin, end
        First and last moment of it [s].
    time, feed
        Where it is worst [s, m].
    kind
        "input", "power", "slew", "supply", "turning", "workspace", "keep-out", "speed", "steps" or
        "field".
    figure, limit
        The value there, and what it may be, in SI units.
    message
        A sentence.
    """

    begin: float
    end: float
    time: float
    feed: float
    kind: str
    figure: float
    limit: float
    message: str

    def __str__(self) -> str:
        """The sentence, with time and place."""
        when = f"At {self.time:.3f} s"
        if self.end > self.begin:
            when += f" (from {self.begin:.3f} to {self.end:.3f} s)"
        return f"{when}, {1e3 * self.feed:.4g} mm of feed, {self.message}"


@dataclass(frozen=True, eq=False)
class _Figure:
    """Something that has a limit: its values over time, and the words for one of them."""

    kind: str
    values: Array
    limit: float
    words: str  # with {0}: the value and {1}: the limit
    scale: float = 1.0
    least: bool = False  # whether the limit is a lower one

    def violations(self, table: Timetable) -> Iterator[Violation]:
        excess = self.limit - self.values if self.least else self.values - self.limit
        allowed = ROUNDING * abs(self.limit) if math.isfinite(self.limit) else 0.0
        bad = np.isnan(self.values) | (excess > allowed)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], bad, [False]))))
        for first, past in edges.reshape(-1, 2):
            worst = first + int(np.argmax(np.nan_to_num(excess[first:past], nan=math.inf)))
            value = float(self.values[worst])
            yield Violation(
                float(table.time[first]),
                float(table.time[past - 1]),
                float(table.time[worst]),
                float(table.feed[worst]),
                self.kind,
                value,
                self.limit,
                self._said(value),
            )

    def _said(self, value: float) -> str:
        digits = 4
        there, limit = self.scale * value, self.scale * self.limit
        while f"{there:.{digits}g}" == f"{limit:.{digits}g}" and digits < 17:
            digits += 1
        return self.words.format(f"{there:.{digits}g}", f"{limit:.{digits}g}")


def dry_run(
    table: Timetable,
    actuator: Actuator,
    *,
    tolerance: float | None = None,
    max_speed: float | None = None,
) -> tuple[Violation, ...]:
    """All that the hardware would not do, or not as planned, in the order of time.

    Parameters
    ----------
    table
        What is to be played.
    actuator
        The hardware as it is, with its saturation.
    tolerance
        How far the flux density at the tip may be off the planned one [T]; 2 percent of the largest
        planned one if left out.
    max_speed
        Fastest feed [m/s]; that of the table's advancer if left out.

    Raises
    ------
    InputError
        If the actuator has other inputs than the table; or keeps a magnet out of a lumen that the
        table does not know.
    """
    inputs = tuple((one.name, one.unit) for one in actuator.inputs)
    given = tuple(zip(table.names, table.units, strict=True))
    if inputs != given:
        raise InputError(
            f"The actuator must have the inputs of the schedule, {_listed(given)}; "
            f"received {_listed(inputs)}."
        )
    if tolerance is not None:
        positive("dry_run", "tolerance", tolerance, "T")
    if max_speed is not None:
        positive("dry_run", "max_speed", max_speed, "m/s")
    figures = [
        *_limits(table, actuator),
        *_paces(table, actuator),
        *_places(table, actuator),
        *_feeding(table, max_speed),
        _field(table, actuator, tolerance),
    ]
    found = [one for figure in figures for one in figure.violations(table)]
    return tuple(sorted(found, key=lambda one: (one.begin, one.time)))


def field_made(table: Timetable, actuator: Actuator) -> Array:
    """What an actuator makes at the planned tip, shape (k, 3) [T]."""
    made = np.empty_like(table.tip)
    for k, (tip, u) in enumerate(zip(table.tip, table.inputs, strict=True)):
        made[k] = actuator.at(tip[None], u)[0][0]
    return made


def usual_tolerance(table: Timetable) -> float:
    """2 percent of the largest planned field [T]; nothing is off where none is planned."""
    planned = np.linalg.norm(table.flux_density, axis=1)
    planned = planned[np.isfinite(planned)]
    return USUAL * float(planned.max(initial=0.0)) or math.inf


def _listed(inputs: tuple[tuple[str, str], ...]) -> str:
    return ", ".join(f"{name} [{unit}]" for name, unit in inputs) or "none"


def _limits(table: Timetable, actuator: Actuator) -> Iterator[_Figure]:
    for one, values in zip(actuator.inputs, table.inputs.T, strict=True):
        unit = f" {one.unit}".rstrip()
        words = f"input {one.name} is {{0}}{unit}; the limit is {{1}}{unit}."
        yield _Figure("input", values, one.high, words)
        yield _Figure("input", values, one.low, words, least=True)
    yield from _powers(table, actuator, "all coils", 0)


def _powers(table: Timetable, actuator: Actuator, name: str, first: int) -> Iterator[_Figure]:
    """Power of an actuator, and of each of its parts."""
    inputs = actuator.inputs
    if math.isfinite(actuator.max_power):
        some = table.inputs[:, first : first + len(inputs)]
        power = some**2 @ np.array([one.resistance for one in inputs])
        words = f"{name} take {{0}} W; the limit is {{1}} W."
        yield _Figure("power", power, actuator.max_power, words)
    for part in actuator.parts if isinstance(actuator, Together) else ():
        names = ", ".join(one.name for one in part.inputs)
        yield from _powers(table, part, names, first)
        first += len(part.inputs)


def _paces(table: Timetable, actuator: Actuator) -> Iterator[_Figure]:
    pace, dt = Pace.of(actuator), np.diff(table.time)[:, None]
    before, after = table.inputs[:-1], table.inputs[1:]
    rates, volts = pace.rates(before, after, dt), pace.voltages(before, after, dt)
    for k, one in enumerate(actuator.inputs):
        unit = f"{one.unit}/s" if one.unit else "1/s"
        slew = f"input {one.name} changes by {{0}} {unit}; the limit is {{1}} {unit}."
        supply = f"input {one.name} takes {{0}} V; its supply gives {{1}} V."
        yield _Figure("slew", _lasting(rates[:, k]), float(pace.slew[k]), slew)
        yield _Figure("supply", _lasting(volts[:, k]), float(pace.supply[k]), supply)
    angles = pace.angular_speeds(before, after, dt)
    for k, most in enumerate(pace.turning.tolist()):
        words = "the magnet turns by {0} deg/s; the limit is {1} deg/s."
        yield _Figure("turning", _lasting(angles[:, k]), most, words, scale=math.degrees(1.0))


def _lasting(values: Array) -> Array:
    """What holds from each time to the next, as values at the times."""
    return np.append(values, 0.0)


def _places(table: Timetable, actuator: Actuator) -> Iterator[_Figure]:
    words = "the tip is {0} mm outside of where the actuator is calibrated."
    yield _Figure("workspace", actuator.outside(table.tip), 0.0, words, scale=1e3)
    for magnet, first, points in magnets(actuator, table.centreline):
        if magnet.keep_out <= 0.0:
            continue
        if len(points) == 0:
            raise InputError(
                "The schedule must know the lumen, from which the actuator keeps a magnet away; "
                "received none: a NetCDF schedule has it."
            )
        some = np.unique(np.linspace(0, len(points) - 1, POINTS).astype(int))
        radius = table.lumen_radius[some]
        near = np.array(
            [
                float((magnet.distance(u, points[some]) - radius).min())
                for u in table.inputs[:, first : first + 6]
            ]
        )
        words = "the magnet is {0} mm from the vessel; it must keep {1} mm away."
        yield _Figure("keep-out", near, magnet.keep_out, words, scale=1e3, least=True)


def _feeding(table: Timetable, max_speed: float | None) -> Iterator[_Figure]:
    advancer = table.advancer
    most = advancer.max_speed if max_speed is None and advancer else max_speed or math.inf
    words = "the wire is fed by {0} mm/s; the limit is {1} mm/s."
    yield _Figure("speed", np.abs(table.feed_speed), most, words, scale=1e3)
    if table.steps is None or advancer is None:
        return
    yield from _stepping(table, table.steps, advancer)


def _stepping(table: Timetable, steps: NDArray[np.int64], advancer: Advancer) -> Iterator[_Figure]:
    """The stepper's own speed, which is one in its play, too, and where it brings the wire."""
    dt = np.diff(table.time)
    motor = np.abs(np.diff(steps)) * advancer.resolution / dt
    most = advancer.max_speed
    if math.isfinite(most):  # in whole steps a sample
        most = float(np.ceil(most * dt.max() / advancer.resolution - ROUNDING))
        most *= advancer.resolution / float(dt.max())
    words = "the advancer runs at {0} mm/s; the limit, in whole steps, is {1} mm/s."
    yield _Figure("speed", _lasting(motor), most, words, scale=1e3)
    away = np.abs(advancer.moved(steps, float(table.feed[0])) - table.feed)
    words = "the steps bring the wire {0} mm away from the feed; half of a step is {1} mm."
    yield _Figure("steps", away, 0.5 * advancer.resolution * (1 + 1e-6), words, scale=1e3)


def _field(table: Timetable, actuator: Actuator, tolerance: float | None) -> _Figure:
    planned = np.isfinite(table.flux_density).all(axis=1)
    away = np.linalg.norm(field_made(table, actuator) - table.flux_density, axis=1)
    most = usual_tolerance(table) if tolerance is None else tolerance
    words = "the field at the tip is {0} mT from the planned one; the tolerance is {1} mT."
    return _Figure("field", np.where(planned, away, 0.0), most, words, scale=1e3)
