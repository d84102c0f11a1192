"""Coils that are not where they should be: the field of each is turned by a little."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import Input, Vector3
from magwire.actuate.pose import HERE, Pose
from magwire.actuate.tables import Desk
from magwire.errors import InputError, array


@dataclass(frozen=True, kw_only=True)
class Misaligned(Actuator):
    """An actuator whose fields are turned, that of each input by an angle of its own.

    Parameters
    ----------
    actuator
        As it should be.
    tilts
        Rotation vector for each input, about the actuator's origin, shape (m, 3) [rad].

    Raises
    ------
    InputError
        If there is not one tilt for each input, or an input is a magnet's.
    """

    actuator: Actuator
    tilts: tuple[Vector3, ...]

    def __post_init__(self) -> None:
        inputs = self.actuator.inputs
        if len(self.tilts) != len(inputs):
            raise InputError(
                f"Input tilts of Misaligned must be one for each of {len(inputs)} inputs; "
                f"received {len(self.tilts)}."
            )
        array("Misaligned", "tilts", self.tilts, (None, 3), "rad")
        tables = self.actuator.arrays()
        if len(tables.maps) and len(set(self.tilts)) > 1:
            raise InputError(
                "Fields of maps must be tilted alike, as they are on one grid; "
                f"received {len(set(self.tilts))} tilts."
            )
        if len(tables.posed):
            raise InputError(
                "The actuator of Misaligned must be of coils; received a magnet, whose arm stands "
                "at its pose."
            )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Those of the actuator."""
        return self.actuator.inputs

    @property
    def idle(self) -> NDArray[np.float64]:
        """Those of the actuator."""
        return self.actuator.idle

    def lay(self, desk: Desk) -> None:
        """Lay the actuator with a turned frame for each input."""
        turns = tuple(_turn(tilt) for tilt in self.tilts)
        self.actuator.lay(desk.within(self.actuator.pose).tilted(turns))

    def outside(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far points are outside of the actuator's workspace [m]."""
        where = array("Misaligned", "points", points, (None, 3), "m")
        return self.actuator.outside(self.pose.own(where))


def _turn(tilt: Vector3) -> Pose:
    angle = float(np.linalg.norm(tilt))
    return Pose.turned(tilt, angle) if angle > 0.0 else HERE
