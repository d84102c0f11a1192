"""Where a wall that moves is at a time, from what a result says of it (P-40)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.contact.motion import WallMotion

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

PASSES = 60
"""Of finding where the tissue has gone: each halves the error at least."""


def motions(data: xr.Dataset) -> list[WallMotion]:
    """The displacements of the tissue; none of a wall at rest."""
    text = str(data.attrs.get("wall_motion", ""))
    rows = [[float(number) for number in row.split()] for row in text.split(";") if row.strip()]
    return [WallMotion(tuple(row[:3]), row[3], row[4]) for row in rows]


def moved(data: xr.Dataset, points: Array, time: float | None) -> Array:
    """Where points of the wall have gone at a time [s] from where they are at rest [mm]."""
    displacements = motions(data)
    if time is None or not displacements:
        return points
    entrance, rest = data["centreline"].values[0], 1e-3 * points
    there = rest
    for _ in range(PASSES):
        there = rest + np.sum([one.at(there, entrance, time) for one in displacements], axis=0)
    result: Array = 1e3 * there
    return result


def reach(data: xr.Dataset) -> tuple[Array, Array]:
    """How far the wall goes towards lower and towards higher coordinates, shapes (3,) [mm]."""
    ways = np.array([np.zeros(3), *(1e3 * np.asarray(one.amplitude) for one in motions(data))])
    return np.minimum(ways, 0.0).sum(axis=0), np.maximum(ways, 0.0).sum(axis=0)
