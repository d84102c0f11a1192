"""Where a wall that moves is at a time, from what a result says of it (P-40)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.contact.motion import gone, recorded

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


def moved(data: xr.Dataset, points: Array, time: float | None) -> Array:
    """Where points of the wall have gone at a time [s] from where they are at rest [mm]."""
    motions = recorded(data)
    if time is None or not motions:
        return points
    return 1e3 * gone(motions, 1e-3 * points, data["way"].values[0], time)


def reach(data: xr.Dataset) -> tuple[Array, Array]:
    """How far the wall goes towards lower and towards higher coordinates, shapes (3,) [mm]."""
    ways = np.array([np.zeros(3), *(1e3 * np.asarray(one.amplitude) for one in recorded(data))])
    return np.minimum(ways, 0.0).sum(axis=0), np.maximum(ways, 0.0).sum(axis=0)
