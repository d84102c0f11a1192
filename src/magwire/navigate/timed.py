"""Inputs of an actuator as functions of time: to hold, to rotate, to ramp."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator, Uniform
from magwire.engine.system import System
from magwire.errors import array, numbers
from magwire.navigate.inputs import Names, in_order, named, scaled
from magwire.navigate.knots import between, rising
from magwire.navigate.navigator import NavigationError, Prescribed

Array = NDArray[np.float64]
FIELD: Names = (("Bx", "T"), ("By", "T"), ("Bz", "T"))
UPDATE_EVERY = 5e-4  # feed after which it is looked up again, which changes nothing [m]


@dataclass(frozen=True, eq=False)
class TimedInputs:
    """Inputs that are linear in time between knots, whatever the wire does (P-23).

    Steering for ``Simulation.run``; a session's inputs are those of each step.

    Parameters
    ----------
    time
        Knots, rising, shape (k,) [s]; before the first and after the last the inputs stay.
    inputs
        At the knots, shape (k, m).
    names
        Name and SI unit of each input; if left out, the flux density of a uniform field [T].

    Raises
    ------
    InputError
        If the shapes do not fit or the knots do not rise.

    Examples
    --------
    >>> import magwire as mw
    >>> turn = mw.TimedInputs(time=[0.0, 2.0], inputs=[[0.0, 0.01, 0.0], [0.0, 0.0, 0.01]])
    >>> turn.over(1.0).tolist()
    [[0.0, 0.005, 0.005]]
    """

    time: Array
    inputs: Array
    names: Names = FIELD

    def __post_init__(self) -> None:
        time = rising("TimedInputs", "time", self.time, "s")
        inputs = array("TimedInputs", "inputs", self.inputs, (len(time), len(self.names)))
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "inputs", inputs)

    def over(self, time: ArrayLike) -> Array:
        """Inputs at times [s], shape (n, m)."""
        when = np.atleast_1d(numbers("TimedInputs.over", "time", time))
        return between(self.time, self.inputs, when)

    def at(self, feed: ArrayLike) -> Array:
        """There are none by the feed.

        Raises
        ------
        NavigationError
            Always: who asks is no run.
        """
        raise NavigationError(
            "These inputs go by the time of a run; in a session give its inputs to each step."
        )

    @property
    def update_every(self) -> float:
        """Feed between two observations [m]."""
        return UPDATE_EVERY

    def scaled(self, factor: float) -> TimedInputs:
        """The same with all inputs multiplied by a factor.

        Raises
        ------
        InputError
            If one of them is no strength, but where a magnet is.
        """
        inputs = scaled("TimedInputs", self.inputs, self.names, factor)
        return TimedInputs(self.time, inputs, self.names)

    def of(self, actuator: Actuator) -> TimedInputs:
        """The same for all inputs of an actuator, in its order; those not named stay idle.

        Raises
        ------
        InputError
            If the actuator has no input of a name, or has it in another unit.
        """
        inputs = in_order(actuator, self.inputs, self.names)
        return TimedInputs(self.time, inputs, named(actuator))

    def start(self, system: System) -> Prescribed:
        """Steering of a system: by its actuator's inputs, or by a uniform field.

        Raises
        ------
        InputError
            If they are not those of its actuator.
        """
        return Prescribed(self.of(system.actuator or Uniform()))
