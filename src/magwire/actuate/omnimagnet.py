"""Three coils at one point (A. Petruska and J. Abbott, IEEE Transactions on Magnetics 50, 2014)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import UNLIMITED, Circuit, Input, Vector3, current
from magwire.actuate.tables import Desk
from magwire.errors import array

PER_MOMENT = 1.25663706127e-6 / (4.0 * math.pi)
"""mu0/(4 pi) [T m/A]."""


@dataclass(frozen=True, kw_only=True)
class Omnimagnet(Actuator):
    """Three nested coils around a core, seen from afar: a dipole with three currents.

    Parameters
    ----------
    moments
        Moment of each coil, along x, y and z, for one ampere, shape (3,) [A m^2/A].
    position
        Centre [m].
    max_current
        Of each coil [A].
    circuits
        The electrical side of each coil.
    """

    moments: Vector3
    position: Vector3 = (0.0, 0.0, 0.0)
    max_current: float = math.inf
    circuits: tuple[Circuit, Circuit, Circuit] = (UNLIMITED, UNLIMITED, UNLIMITED)

    def __post_init__(self) -> None:
        array("Omnimagnet", "moments", self.moments, (3,), "m^2")
        array("Omnimagnet", "position", self.position, (3,), "m")

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Three currents [A]."""
        pairs = zip("xyz", self.circuits, strict=True)
        return tuple(current(f"I{c}", self.max_current, circuit) for c, circuit in pairs)

    def lay(self, desk: Desk) -> None:
        """Three dipoles at one point."""
        for k, unit in enumerate(np.eye(3)):
            desk.dipole(k, self.position, PER_MOMENT * self.moments[k] * unit)
