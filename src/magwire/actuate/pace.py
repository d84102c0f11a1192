"""How fast inputs change from one moment to the next, against what the hardware can (P-27)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.actuator import Actuator

Array = NDArray[np.float64]
ROUNDING = 1e-9
"""Part of a limit by which rounding may exceed it: conditioning guard, no allowance."""


@dataclass(frozen=True, eq=False)
class Pace:
    """Limits on the change of inputs, as arrays.

    Attributes
    ----------
    slew
        Largest rate of each input, shape (m,); infinite for the parts of a magnet's direction.
    resistance, inductance, supply
        Those of each coil's circuit, shape (m,) [ohm, H, V].
    turns
        First part of each magnet's direction, shape (p,).
    turning
        Largest angular speed of each magnet, shape (p,) [rad/s].
    """

    slew: Array
    resistance: Array
    inductance: Array
    supply: Array
    turns: tuple[int, ...]
    turning: Array

    @classmethod
    def of(cls, actuator: Actuator) -> Pace:
        """Those of an actuator's inputs."""
        inputs = actuator.inputs
        turns = tuple(int(k) + 3 for k in actuator.arrays().posed[:, 2])
        slew = np.array([one.slew for one in inputs])
        turning = slew[list(turns)]
        for k in turns:
            slew[k : k + 3] = math.inf
        return cls(
            slew,
            np.array([one.resistance for one in inputs]),
            np.array([one.inductance for one in inputs]),
            np.array([one.supply for one in inputs]),
            turns,
            turning,
        )

    def rates(self, u: Array, after: Array, dt: Array | float) -> Array:
        """|du/dt| from inputs ``u`` to ``after``, shape (..., m)."""
        found: Array = np.abs(after - u) / dt
        return found

    def voltages(self, u: Array, after: Array, dt: Array | float) -> Array:
        """Largest |L du/dt + R u| on the way from ``u`` to ``after``, shape (..., m) [V]."""
        rise = self.inductance * (after - u) / dt
        ends = np.abs(rise + self.resistance * u), np.abs(rise + self.resistance * after)
        found: Array = np.maximum(*ends)
        return found

    def angular_speeds(self, u: Array, after: Array, dt: Array | float) -> Array:
        """Angular speed of each magnet, shape (..., p) [rad/s]."""
        found: Array = np.empty((*u.shape[:-1], len(self.turns)))
        for i, k in enumerate(self.turns):
            a, b = u[..., k : k + 3], after[..., k : k + 3]
            sine = np.linalg.norm(np.cross(a, b), axis=-1)
            found[..., i] = np.arctan2(sine, (a * b).sum(axis=-1))
        found /= dt
        return found

    def kept(self, u: Array, after: Array, dt: float) -> bool:
        """Whether inputs can go straight from ``u`` to ``after``, shape (m,), within ``dt`` [s]."""
        more = 1.0 + ROUNDING
        return bool(
            np.all(self.rates(u, after, dt) <= self.slew * more)
            and np.all(self.voltages(u, after, dt) <= self.supply * more)
            and np.all(self.angular_speeds(u, after, dt) <= self.turning * more)
        )
