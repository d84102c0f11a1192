"""Measured maps of a field, scaled by inputs (P-25)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.grids import FieldGrid, read_grid
from magwire.actuate.inputs import Box, Input
from magwire.actuate.tables import Desk
from magwire.errors import InputError, instance

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Map(Actuator):
    """Fields on one grid, each times its input, interpolated with continuous second derivatives.

    Outside of the grid there is no field: it is NaN there, and ``outside`` says how far.

    Parameters
    ----------
    fields
        Field for one unit of each input.
    controls
        The inputs, in the same order.
    """

    fields: tuple[FieldGrid, ...]
    controls: tuple[Input, ...]

    def __post_init__(self) -> None:
        if not self.fields or len(self.fields) != len(self.controls):
            raise InputError(
                "Map must have one field for each input; "
                f"received {len(self.fields)} and {len(self.controls)}."
            )
        for one in self.controls:
            instance("Map", "controls", one, Input)
        names = [one.name for one in self.controls]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise InputError(
                f"Inputs of a Map must have names of their own; received {', '.join(twice)} twice."
            )
        lead = self.fields[0]
        for other in self.fields[1:]:
            if lead.values.shape != other.values.shape or not (
                np.array_equal(lead.first, other.first) and np.array_equal(lead.step, other.step)
            ):
                raise InputError("All fields of a Map must be on one grid; received two grids.")
        if self.workspace is None:
            box = Box(tuple(lead.first.tolist()), tuple(lead.last.tolist()))
            object.__setattr__(self, "workspace", box)

    @classmethod
    def read(cls, files: Mapping[Input, str | Path]) -> Map:
        """Maps from files, one for each input."""
        return cls(fields=tuple(read_grid(p) for p in files.values()), controls=tuple(files))

    @property
    def inputs(self) -> tuple[Input, ...]:
        """What scales the fields."""
        return self.controls

    def lay(self, desk: Desk) -> None:
        """Lay the coefficients of the splines."""
        for k, field in enumerate(self.fields):
            coefficients = np.stack([spline(field.values[..., c]) for c in range(3)])
            desk.map(k, coefficients, field.first, field.step)

    def faults(self) -> tuple[float, float]:
        """Largest divergence and curl of the maps inside of the grid, over the largest gradient.

        A measured field has some; a large value says that a map is wrong or too coarse.
        """
        divergence = curl = size = 0.0
        for k in range(len(self.fields)):
            u = np.eye(len(self.fields))[k]
            _, g = self.at(self._centres(), u)
            divergence = max(divergence, float(np.abs(np.trace(g, axis1=1, axis2=2)).max()))
            curl = max(curl, float(np.abs(g - g.transpose(0, 2, 1)).max()))
            size = max(size, float(np.abs(g).max()))
        return (divergence / size, curl / size) if size > 0.0 else (0.0, 0.0)

    def _centres(self) -> Array:
        """Centres of the grid's cells, in space."""
        lead = self.fields[0]
        axes = [
            first + step * (np.arange(n - 1) + 0.5)
            for first, step, n in zip(lead.first, lead.step, lead.values.shape[:3], strict=True)
        ]
        own = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        placed: Array = own @ self.pose.matrix.T + self.pose.shift
        return placed


def spline(values: Array) -> Array:
    """Coefficients of the cubic spline through values, shape (i, j, k), shape (i+2, j+2, k+2).

    At the ends the third derivative is continuous one point inside ("not a knot"), so that cubic
    polynomials are met exactly.
    """
    for axis in range(3):
        n = values.shape[axis]
        matrix = np.zeros((n + 2, n + 2))
        for i in range(n):
            matrix[i + 1, i : i + 3] = 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0
        matrix[0, :5] = matrix[-1, -5:] = 1.0, -4.0, 6.0, -4.0, 1.0
        lines = np.moveaxis(values, axis, 0)
        right = np.zeros((n + 2, *lines.shape[1:]))
        right[1:-1] = lines
        solved = np.linalg.solve(matrix, right.reshape(n + 2, -1)).reshape(right.shape)
        values = np.moveaxis(solved, 0, axis)
    return np.ascontiguousarray(values)
