"""Inputs of an actuator as functions of the feed, by their names and units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator
from magwire.errors import InputError, array, finite, numbers, positive
from magwire.navigate.knots import between, rising, spaced

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
        feed = rising("InputSchedule", "feed", self.feed, "m")
        inputs = array("InputSchedule", "inputs", self.inputs, (len(feed), len(self.names)))
        object.__setattr__(self, "feed", feed)
        object.__setattr__(self, "inputs", inputs)

    def at(self, feed: ArrayLike) -> Array:
        """Inputs at feeds, shape (n, m)."""
        where = np.atleast_1d(numbers("InputSchedule.at", "feed", feed))
        return between(self.feed, self.inputs, where)

    def resampled(self, step: float) -> InputSchedule:
        """The schedule with knots every ``step`` [m] of feed, and at its end."""
        positive("InputSchedule.resampled", "step", step, "m")
        knots = spaced(self.feed, step)
        return InputSchedule(knots, self.at(knots), self.names)

    def scaled(self, factor: float) -> InputSchedule:
        """The schedule with all inputs multiplied by a factor.

        Raises
        ------
        InputError
            If one of them is no strength, but where a magnet is.
        """
        inputs = scaled("InputSchedule", self.inputs, self.names, factor)
        return InputSchedule(self.feed, inputs, self.names)

    def of(self, actuator: Actuator) -> InputSchedule:
        """The schedule of all inputs of an actuator, in its order; those not named stay idle.

        Raises
        ------
        InputError
            If the actuator has no input of a name, or has it in another unit.
        """
        inputs = in_order(actuator, self.inputs, self.names)
        return InputSchedule(self.feed, inputs, named(actuator))


def scaled(owner: str, inputs: Array, names: Names, factor: float) -> Array:
    """Inputs multiplied by a factor, shape (k, m).

    Raises
    ------
    InputError
        If one of them is no strength, but where a magnet is.
    """
    finite(f"{owner}.scaled", "factor", factor)
    posed = [name for name, unit in names if unit in ("m", "")]
    if posed and factor != 1.0:
        raise InputError(
            f"Input factor of {owner}.scaled must be 1 where {posed[0]} says how a magnet lies; "
            f"received {factor:g}."
        )
    return factor * inputs


def named(actuator: Actuator) -> Names:
    """Names and units of an actuator's inputs."""
    return tuple((one.name, one.unit) for one in actuator.inputs)


def in_order(actuator: Actuator, inputs: Array, names: Names) -> Array:
    """All inputs of an actuator, from those with names, shape (k, m); others stay idle.

    Raises
    ------
    InputError
        If the actuator has no input of a name, or has it in another unit.
    """
    known = {one.name: k for k, one in enumerate(actuator.inputs)}
    rows = np.tile(np.asarray(actuator.idle, dtype=np.float64), (len(inputs), 1))
    for column, (name, unit) in zip(inputs.T, names, strict=True):
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
    return rows


def _in_words(unit: str) -> str:
    return f"in {unit}" if unit else "a plain number"
