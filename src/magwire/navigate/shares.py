"""What each of an actuator's inputs makes of a flux density."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator
from magwire.errors import array
from magwire.navigate.least_cost import prices_of


def shares_of(actuator: Actuator, place: ArrayLike) -> NDArray[np.float64]:
    """What each input makes of a flux density at the least cost, where no limit binds.

    Parameters
    ----------
    actuator
        What makes the field.
    place
        Shape (3,) [m].

    Returns
    -------
    array
        A matrix for each input, shape (m, 3, 3), by which the flux density is multiplied. Their sum
        is the part of it that the actuator makes: one, if it makes all directions.
    """
    where = array("shares_of", "place", place, (3,), "m")[None]
    by_input = actuator.response(where, actuator.idle)[0][0]
    root = np.sqrt(prices_of(actuator.inputs))
    inverse = np.linalg.pinv(by_input.T / root) / root[:, None]
    shares: NDArray[np.float64] = by_input[:, :, None] * inverse[:, None, :]
    return shares
