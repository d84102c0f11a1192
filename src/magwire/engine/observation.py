"""What can be seen of a moving wire at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Observation(NamedTuple):
    """A moving wire as it is seen, cheaply, after any step.

    Attributes
    ----------
    time
        Simulated [s].
    feed, twist
        Length of wire past the entrance [m]; angle of the guide [rad].
    tip, tip_direction
        Position [m] and unit tangent of the tip, shape (3,).
    tip_force
        Size of the wall force on the tip node [N].
    wall_force
        Sizes of the forces of the wall, summed over the wire [N].
    patch_force
        The largest such sum over a stretch of 5 mm, or of two edges if they are longer [N].
    clearance
        Smallest clearance of the nodes past the guide [m]; infinity if the guide holds them all.
    inputs
        Inputs of the actuator, shape (m,).
    """

    time: float
    feed: float
    twist: float
    tip: Array
    tip_direction: Array
    tip_force: float
    wall_force: float
    patch_force: float
    clearance: float
    inputs: Array
