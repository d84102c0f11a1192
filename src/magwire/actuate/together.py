"""Actuators that act together, and inputs that are held, such as Earth's field (P-24)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import Input
from magwire.actuate.tables import Desk, Slot
from magwire.errors import InputError, array


@dataclass(frozen=True, kw_only=True)
class Held(Actuator):
    """A background: an actuator whose inputs do not change.

    Parameters
    ----------
    actuator
        What is held.
    values
        Its inputs, shape (K,), in their units.
    """

    actuator: Actuator
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        values = array("Held", "values", self.values, (len(self.actuator.inputs),))
        object.__setattr__(self, "values", tuple(values.tolist()))

    @property
    def inputs(self) -> tuple[Input, ...]:
        """None."""
        return ()

    def lay(self, desk: Desk) -> None:
        """Lay what is held, each input at its value."""
        slots = tuple(Slot(-1, value) for value in self.values)
        self.actuator.lay(desk.within(self.actuator.pose, slots))

    def outside(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far points are outside of the held actuator's workspace [m]."""
        where = array("Held", "points", points, (None, 3), "m")
        return self.actuator.outside(self.pose.own(where))


@dataclass(frozen=True, kw_only=True)
class Together(Actuator):
    """Several actuators at once; their inputs one after the other.

    Parameters
    ----------
    parts
        At least one. An input's name may occur once.
    """

    parts: tuple[Actuator, ...]

    def __post_init__(self) -> None:
        names = [i.name for part in self.parts for i in part.inputs]
        twice = sorted({name for name in names if names.count(name) > 1})
        if not self.parts:
            raise InputError("Input parts of Together must have an actuator; received none.")
        if twice:
            raise InputError(
                "Inputs of actuators that act together must have names of their own; "
                f"received {', '.join(twice)} twice."
            )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Those of all parts."""
        return tuple(i for part in self.parts for i in part.inputs)

    @property
    def idle(self) -> NDArray[np.float64]:
        """Those of all parts."""
        return np.concatenate([part.idle for part in self.parts])

    def lay(self, desk: Desk) -> None:
        """Lay each part with its own inputs."""
        first = 0
        for part in self.parts:
            count = len(part.inputs)
            part.lay(desk.within(part.pose, desk.slots[first : first + count]))
            first += count

    def violations(self, u: ArrayLike) -> tuple[str, ...]:
        """Those of each part, and of all together."""
        said = list(super().violations(u))
        values, first = np.array(u, dtype=np.float64), 0
        for part in self.parts:
            count = len(part.inputs)
            said += part.violations(values[first : first + count])
            first += count
        return tuple(dict.fromkeys(said))

    def outside(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far points are outside of the workspace of any part [m]."""
        where = array("Together", "points", points, (None, 3), "m")
        own = self.pose.own(where)
        each = [super().outside(where), *(part.outside(own) for part in self.parts)]
        farthest: NDArray[np.float64] = np.max(each, axis=0)
        return farthest
