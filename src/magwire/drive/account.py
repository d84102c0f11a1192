"""What a person has done to a wire and its wall so far."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sight:
    """What is looked at after every step.

    Attributes
    ----------
    time, feed, twist
        Simulated time [s]; feed and angle of the guide [m, rad].
    points, forces
        Positions of the nodes, and force of the wall on each, shape (nodes, 3) [m, N].
    push, torque
        Force and torque of the guide on the wire [N, N m].
    field
        At the tip, shape (3,) [T].
    inputs
        Inputs of the actuator, shape (m,).
    clearance
        Smallest anywhere along the wire [m].
    """

    time: float
    feed: float
    twist: float
    points: Array
    forces: Array
    push: float
    torque: float
    field: Array
    inputs: Array
    clearance: float

    @property
    def tip_force(self) -> float:
        """Size of the wall's force on the tip node [N]."""
        return float(np.linalg.norm(self.forces[-1]))

    @property
    def wall_force(self) -> float:
        """Sizes of the wall's forces, summed over the wire [N]."""
        return float(np.linalg.norm(self.forces, axis=1).sum())


@dataclass(frozen=True)
class Account:
    """Sums over all steps that stand; those that were taken back are not in them.

    Attributes
    ----------
    time
        Simulated [s].
    path
        Way of the tip [m].
    peak_force
        Largest force of the wall on the wire, summed over it [N].
    impulse
        That force over time [N s].
    work
        Work of the guide on the wire, by feed and twist [J].
    retractions
        How often the guide began to go back.
    """

    time: float = 0.0
    path: float = 0.0
    peak_force: float = 0.0
    impulse: float = 0.0
    work: float = 0.0
    retractions: int = 0
    going_back: bool = False

    def after(self, before: Sight, now: Sight) -> Account:
        """The account after one more step."""
        fed, turned, took = now.feed - before.feed, now.twist - before.twist, now.time - before.time
        back = fed < 0.0 or (fed == 0.0 and self.going_back)
        push, torque = 0.5 * (before.push + now.push), 0.5 * (before.torque + now.torque)
        return replace(
            self,
            time=self.time + took,
            path=self.path + float(np.linalg.norm(now.points[-1] - before.points[-1])),
            peak_force=max(self.peak_force, now.wall_force),
            impulse=self.impulse + 0.5 * took * (before.wall_force + now.wall_force),
            work=self.work + push * fed + torque * turned,
            retractions=self.retractions + (back and not self.going_back),
            going_back=back,
        )
