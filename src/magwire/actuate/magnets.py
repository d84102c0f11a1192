"""The permanent magnets of an actuator, and how near they are."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.magnet import Magnet
from magwire.actuate.together import Together

Array = NDArray[np.float64]


def magnets(
    actuator: Actuator, points: Array, first: int = 0
) -> Iterator[tuple[Magnet, int, Array]]:
    """Magnets that are moved, the first input of each, and points, shape (n, 3), in its frame."""
    if isinstance(actuator, Magnet):
        yield actuator, first, points
    if isinstance(actuator, Together):
        own = actuator.pose.own(points)
        for part in actuator.parts:
            yield from magnets(part, own, first)
            first += len(part.inputs)


def nearest_magnet(actuator: Actuator | None, u: Array, points: Array) -> float:
    """Distance of points, shape (n, 3), from the nearest magnet's surface [m].

    Negative inside; infinite without a magnet.
    """
    if actuator is None or len(points) == 0:
        return math.inf
    near = [
        float(magnet.distance(u[first : first + 6], seen).min())
        for magnet, first, seen in magnets(actuator, points)
    ]
    return min(near, default=math.inf)
