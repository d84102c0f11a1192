"""Fields of other programs' objects, sampled into a map around the wire (P-25)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.grids import FieldGrid
from magwire.actuate.inputs import Box, Input
from magwire.actuate.map import Map
from magwire.actuate.pose import HERE, Pose
from magwire.errors import InputError, instance, offering, positive

Array = NDArray[np.float64]

FEWEST = 6  # points along an axis to begin with
FINER = 1.5  # how many more there are in the next grid
MOST = 300_000  # points of a grid: 7 MB for each input


class FieldObject(Protocol):
    """What gives a flux density at points, as magpylib's sources and collections do."""

    def getB(self, points: Array) -> Any:  # noqa: N802 - their name
        """Flux density, shape (n, 3) [T], at points, shape (n, 3) [m]."""


def sampled(
    sources: Mapping[Input, FieldObject],
    box: Box,
    *,
    tolerance: float = 1e-3,
    pose: Pose = HERE,
    max_power: float = float("inf"),
) -> tuple[Map, float]:
    """Sample the fields of objects, such as magpylib's collections, into a map.

    The grid is made finer until the map is good enough between its points.

    Parameters
    ----------
    sources
        For each input what makes the field of one unit of it, in the actuator's frame: a
        collection with 1 A in its coils.
    box
        Surroundings of the wire, in the actuator's frame. Outside of it there is no field; no
        source may be inside.
    tolerance
        Largest error over the largest flux density of the same input.
    pose, max_power
        See ``Actuator``.

    Returns
    -------
    tuple
        The actuator, and its error: the largest difference in the middles of the grid's cells,
        where it is largest, over the largest flux density of that input.

    Raises
    ------
    InputError
        If a field is no field, or 300,000 points are not enough.
    """
    positive("sampled", "tolerance", tolerance)
    instance("sampled", "box", box, Box)
    for one in sources.values():
        offering("sampled", "sources", one, [("getB",)], "objects with a getB, one for each input")
    low, high = np.array(box.low), np.array(box.high)
    counts = np.full(3, FEWEST)
    while True:
        axes = [np.linspace(a, b, n) for a, b, n in zip(low, high, counts, strict=True)]
        step = (high - low) / (counts - 1)
        points = _grid(axes)
        fields = tuple(
            FieldGrid(low, step, _flux(name, one, points).reshape(*counts, 3))
            for name, one in sources.items()
        )
        actuator = Map(fields=fields, controls=tuple(sources), max_power=max_power)
        middles = _grid([0.5 * (axis[1:] + axis[:-1]) for axis in axes])
        error = max(
            _error(actuator, k, middles, _flux(name, one, middles))
            for k, (name, one) in enumerate(sources.items())
        )
        if error <= tolerance:
            return replace(actuator, pose=pose), error
        counts = np.ceil(FINER * counts).astype(int)
        if counts.prod() > MOST:
            raise InputError(
                f"A map of {len(points)} points is off by {error:.2g} of its largest flux density, "
                f"and may be by {tolerance:g}: is a source inside of its box? Take a smaller box, "
                "or a larger tolerance."
            )


def write_grid(path: str | Path, grid: FieldGrid) -> None:
    """Write a field as CSV, as ``kind = "map"`` reads it: x, y, z [m], Bx, By, Bz [T]."""
    axes = [
        a + h * np.arange(n)
        for a, h, n in zip(grid.first, grid.step, grid.values.shape[:3], strict=True)
    ]
    rows = np.hstack([_grid(axes), grid.values.reshape(-1, 3)])
    np.savetxt(path, rows, fmt="%.17g", delimiter=",", header="x,y,z,Bx,By,Bz", comments="")


def _grid(axes: list[Array]) -> Array:
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _flux(control: Input, one: FieldObject, points: Array) -> Array:
    """Flux density of an object, checked."""
    flux = np.asarray(one.getB(points), dtype=np.float64)
    if flux.shape != points.shape or not np.all(np.isfinite(flux)):
        raise InputError(
            f"The field of input {control.name} must be {len(points)} rows of three finite "
            f"numbers; received an array of shape {flux.shape}"
            f"{'' if np.all(np.isfinite(flux)) else ' with values that are not finite'}."
        )
    return flux


def _error(actuator: Map, k: int, points: Array, flux: Array) -> float:
    """Largest difference of an input's map from a flux density, over the largest of that."""
    made = actuator.at(points, np.eye(len(actuator.controls))[k])[0]
    largest = float(np.linalg.norm(flux, axis=1).max())
    off = float(np.linalg.norm(made - flux, axis=1).max())
    return off / largest if largest > 0.0 else 0.0
