"""A wire with a curved tip that is turned in a bend: its end lags behind, and whips round."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import solveh_banded

Array = NDArray[np.float64]

MOST = 2000  # Newton steps
EXACT = 1e-10  # torque left over, in springs' torques per radian
FARTHEST = 0.3  # turn in one step [rad]: it goes down into the nearest well
HALVINGS = 40


def whipped(
    guide: ArrayLike,
    length: float,
    twisting: float,
    hold: Array,
    drag: Array,
) -> Array:
    """Angle of the far end of a wire while its near end is turned on and on.

    The wire lies taut along a bend, so that only its angle theta about its own axis is free. Its
    energy per length is GJ theta'^2/2 - EI kappa kappa_0 cos theta: of twist, and of a rest
    curvature kappa_0 in a bend of curvature kappa. Friction takes a torque per length where it
    turns. Each step of the guide ends at a minimum of the energy and of what friction takes, near
    where the wire was; no part of the wire ever turns back.

    Parameters
    ----------
    guide
        Angles of the near end [rad], rising from 0, where wire and bend agree.
    length
        Length of the wire [m].
    twisting
        Twisting stiffness GJ [N m^2].
    hold, drag
        Torques per length [N], EI kappa kappa_0 and that of friction, shape (n,), at places that
        divide the length evenly, the first one at the near end.

    Returns
    -------
    array
        Angle of the far end for each angle of the guide [rad].
    """
    count = len(hold)
    step = length / (count - 1)
    share = np.full(count, step)
    share[-1] = 0.5 * step
    chain = Chain(twisting / step, (share * hold)[1:], (share * drag)[1:])
    angle, ends = np.zeros(count - 1), []
    for first in np.asarray(guide, dtype=np.float64):
        angle = _settled(chain, angle, float(first))
        ends.append(float(angle[-1]))
    return np.array(ends)


class Chain(NamedTuple):
    """Springs between neighbours, wells and rubs on each: torques [N m]."""

    spring: float
    wells: Array
    rubs: Array

    def energy(self, angle: Array, first: float) -> float:
        """With what friction takes from angle 0 on [J]."""
        twist = np.diff(angle, prepend=first)
        held = float(self.wells @ (1.0 - np.cos(angle)) + self.rubs @ angle)
        return 0.5 * self.spring * float(twist @ twist) + held

    def slope(self, angle: Array, first: float) -> Array:
        """Its derivative."""
        torque = self.spring * np.diff(angle, prepend=first)
        result: Array = torque - np.append(torque[1:], 0.0) + self.wells * np.sin(angle)
        return result + self.rubs


def _settled(chain: Chain, low: Array, first: float) -> Array:
    """The minimum near where the wire was, of which no part turns back: Newton, projected."""
    angle = low.copy()
    stiff = np.full(len(low), 2.0 * chain.spring)
    stiff[-1] = chain.spring
    energy = chain.energy(angle, first)
    for _ in range(MOST):
        slope = chain.slope(angle, first)
        free = (angle > low) | (slope < 0.0)
        if float(np.abs(slope[free]).max(initial=0.0)) < EXACT * chain.spring:
            return angle
        both = free[1:] & free[:-1]
        band = np.zeros((2, len(low)))
        band[0, 1:] = np.where(both, -chain.spring, 0.0)
        curved = stiff + chain.wells * np.cos(angle)
        shift = 0.0
        while True:
            band[1] = np.where(free, curved + shift, 1.0)
            try:
                way = -solveh_banded(band, np.where(free, slope, 0.0))
                break
            except np.linalg.LinAlgError:
                shift = max(2.0 * shift, 1e-4 * chain.spring)
        part = min(1.0, FARTHEST / float(np.abs(way).max()))
        for _ in range(HALVINGS):
            there = np.maximum(angle + part * way, low)
            lower = chain.energy(there, first)
            if lower <= energy + 1e-4 * float(slope @ (there - angle)) + 1e-15 * chain.spring:
                break
            part *= 0.5
        angle, energy = there, lower
    raise RuntimeError(f"The wire did not come to rest for the guide at {first:g} rad.")
