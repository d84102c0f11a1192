"""Inputs of an actuator as functions of the feed, by their names and units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator
from magwire.errors import InputError, array, finite, numbers, positive

Array = NDArray[np.float64]
Names = tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False)
class InputSchedule:
    """Inputs of an actuator that are linear in the feed between knots.

    Parameters
    ----------
    feed
        Knots, rising, shape (k,) [m]; before the first and after the last the inputs stay.
    inputs
        At the knots, shape (k, m).
    names
        Name and SI unit of each input.

    Raises
    ------
    InputError
        If the shapes do not fit or the knots do not rise.
    """

    feed: Array
    inputs: Array
    names: Names

    def __post_init__(self) -> None:
        feed = array("InputSchedule", "feed", self.feed, (None,), "m")
        inputs = array("InputSchedule", "inputs", self.inputs, (len(feed), len(self.names)))
        if len(feed) == 0 or np.any(np.diff(feed) <= 0.0):
            raise InputError(
                "Input feed of InputSchedule must hold at least one value and rise; received "
                f"{len(feed)} values, the smallest rise {np.diff(feed).min(initial=np.inf):.6g} m."
            )
        object.__setattr__(self, "feed", feed)
        object.__setattr__(self, "inputs", inputs)

    def at(self, feed: ArrayLike) -> Array:
        """Inputs at feeds, shape (n, m)."""
        where = np.atleast_1d(numbers("InputSchedule.at", "feed", feed))
        columns = [np.interp(where, self.feed, column) for column in self.inputs.T]
        return np.stack(columns, axis=1)

    def resampled(self, step: float) -> InputSchedule:
        """The schedule with knots every ``step`` [m] of feed, and at its end."""
        positive("InputSchedule.resampled", "step", step, "m")
        first, last = float(self.feed[0]), float(self.feed[-1])
        knots = np.append(np.arange(first, last - 1e-9 * step, step), last)
        return InputSchedule(knots, self.at(knots), self.names)

    def scaled(self, factor: float) -> InputSchedule:
        """The schedule with all inputs multiplied by a factor.

        Raises
        ------
        InputError
            If one of them is no strength, but where a magnet is.
        """
        finite("InputSchedule.scaled", "factor", factor)
        posed = [name for name, unit in self.names if unit in ("m", "")]
        if posed and factor != 1.0:
            raise InputError(
                f"Input factor of InputSchedule.scaled must be 1 where {posed[0]} says how a "
                f"magnet lies; received {factor:g}."
            )
        return InputSchedule(self.feed, factor * self.inputs, self.names)

    def of(self, actuator: Actuator) -> InputSchedule:
        """The schedule of all inputs of an actuator, in its order; those not named stay idle.

        Raises
        ------
        InputError
            If the actuator has no input of a name, or has it in another unit.
        """
        known = {one.name: k for k, one in enumerate(actuator.inputs)}
        rows = np.tile(np.asarray(actuator.idle, dtype=np.float64), (len(self.feed), 1))
        for column, (name, unit) in zip(self.inputs.T, self.names, strict=True):
            if name not in known:
                raise InputError(
                    f"Inputs must be those of the actuator, {', '.join(known)}; received {name}."
                )
            own = actuator.inputs[known[name]].unit
            if unit != own:
                raise InputError(
                    f"Input {name} of the actuator is {_in_words(own)}; received {_in_words(unit)}."
                )
            rows[:, known[name]] = column
        return InputSchedule(
            self.feed, rows, tuple((one.name, one.unit) for one in actuator.inputs)
        )


def _in_words(unit: str) -> str:
    return f"in {unit}" if unit else "a plain number"
