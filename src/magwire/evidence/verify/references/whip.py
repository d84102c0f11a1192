"""A wire with a curved tip that is turned in a bend: its end lags behind, and whips round."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize

Array = NDArray[np.float64]


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
        Of the wire [m].
    twisting
        GJ [N m^2].
    hold, drag
        EI kappa kappa_0 and the torque of friction per length [N], shape (n,), at places that
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
    spring, wells, rubs = twisting / step, (share * hold)[1:], (share * drag)[1:]
    unit = twisting / length

    def energy(free: Array, first: float) -> tuple[float, Array]:
        angle = np.concatenate(([first], free))
        twist = np.diff(angle)
        torque = spring * twist
        slope = torque.copy()
        slope[:-1] -= torque[1:]
        slope += wells * np.sin(free) + rubs
        value = 0.5 * float(torque @ twist) + float(wells @ (1.0 - np.cos(free)) + rubs @ free)
        return value / unit, slope / unit

    angle, ends = np.zeros(count - 1), []
    for first in np.asarray(guide, dtype=np.float64):
        found = minimize(
            energy,
            angle,
            args=(float(first),),
            jac=True,
            method="L-BFGS-B",
            bounds=[(low, None) for low in angle],
            options={"maxiter": 20_000, "maxfun": 40_000, "ftol": 1e-15, "gtol": 1e-7},
        )
        angle = found.x
        ends.append(float(angle[-1]))
    return np.array(ends)
