"""What a laboratory plays: inputs and feed against time, with what was planned there (P-27)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.advancer import Advancer
from magwire.errors import InputError, array

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Timetable:
    """Inputs of an actuator and the feed against time; linear between the times.

    Parameters
    ----------
    time
        Rising, shape (k,) [s].
    feed
        Length of wire past the entrance, shape (k,) [m].
    inputs
        Shape (k, m), in their ``units``.
    names, units
        Those of the inputs, in SI.
    tip
        Where the tip is planned to be, shape (k, 3) [m].
    flux_density
        What the actuator is planned to make there, shape (k, 3) [T]; NaN where nothing is planned,
        as while the currents rise before the wire moves.
    steps
        Places of the advancer's stepper, shape (k,); None if there is no ``advancer``.
    advancer
        The stepper.
    centreline, lumen_radius
        Those of the vessel, shape (n, 3) and (n,) [m]; empty if not known.

    Raises
    ------
    InputError
        If shapes do not fit or the times do not rise.
    """

    time: Array
    feed: Array
    inputs: Array
    names: tuple[str, ...]
    units: tuple[str, ...]
    tip: Array
    flux_density: Array
    steps: Integers | None = None
    advancer: Advancer | None = None
    centreline: Array = field(default_factory=lambda: np.zeros((0, 3)))
    lumen_radius: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        time = array("Timetable", "time", self.time, (None,), "s")
        if len(time) < 1 or np.any(np.diff(time) <= 0.0):
            raise InputError(
                "Input time of Timetable must hold at least one value and rise; received "
                f"{len(time)} values, the smallest rise {np.diff(time).min(initial=np.inf):.6g} s."
            )
        k, m, n = len(time), len(self.names), len(self.lumen_radius)
        array("Timetable", "feed", self.feed, (k,), "m")
        array("Timetable", "inputs", self.inputs, (k, m))
        array("Timetable", "tip", self.tip, (k, 3), "m")
        array("Timetable", "centreline", self.centreline, (n, 3), "m")
        array("Timetable", "lumen_radius", self.lumen_radius, (n,), "m")
        if np.shape(self.flux_density) != (k, 3):
            raise InputError(
                f"Input flux_density of Timetable must have shape ({k}, 3); "
                f"received shape {np.shape(self.flux_density)}."
            )
        if len(self.units) != m:
            raise InputError(
                f"Input units of Timetable must be those of {m} inputs; received {len(self.units)}."
            )
        if (self.steps is None) != (self.advancer is None):
            raise InputError(
                "Inputs steps and advancer of Timetable must be given together; received one."
            )
        if self.steps is not None:
            array("Timetable", "steps", self.steps, (k,))

    @property
    def feed_speed(self) -> Array:
        """Speed from each time to the next, shape (k,) [m/s]; 0 at the end."""
        return _rate(self.time, self.feed)

    @property
    def step_rate(self) -> Array | None:
        """Steps per second from each time to the next, shape (k,); None without an advancer."""
        return None if self.steps is None else _rate(self.time, self.steps.astype(np.float64))


def _rate(time: Array, values: Array) -> Array:
    rate: Array = np.append(np.diff(values) / np.diff(time), 0.0)
    return rate
