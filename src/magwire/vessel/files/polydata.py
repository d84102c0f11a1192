"""Points, lines and polygons as VTK's files have them, and the drawing that they make."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.vessel.files.drawing import (
    Array,
    Drawing,
    FileFaultError,
    Indices,
    Line,
    Surface,
    are_ends,
    chains,
    pick_radius,
    right_handed,
    unit_of,
)

SPACE = "SPACE"
"""Field array with which 3D Slicer says in which space the points of a model are."""
MARK = "magwire-ends"
"""Field array with the names of the entrance and of the lines' ends, in a file of magwire's."""


class PolyData(NamedTuple):
    """A VTK data set.

    Attributes
    ----------
    points
        Shape (n, 3).
    arrays
        Numbers at the points by name, shape (n,) each.
    lines, polygons
        Point indices of each cell.
    fields
        Texts of the data set by the name of their array.
    """

    points: Array
    arrays: dict[str, Array]
    lines: list[Indices]
    polygons: list[Indices]
    fields: dict[str, tuple[str, ...]]

    @classmethod
    def empty(cls) -> PolyData:
        """No points at all."""
        return cls(np.zeros((0, 3)), {}, [], [], {})

    def joined(self, other: PolyData) -> PolyData:
        """The data set with another one behind it."""
        if len(self.points) == 0:
            return other._replace(fields={**other.fields, **self.fields})
        shift = len(self.points)
        shared = [name for name in self.arrays if name in other.arrays]
        return PolyData(
            np.concatenate([self.points, other.points]),
            {name: np.concatenate([self.arrays[name], other.arrays[name]]) for name in shared},
            [*self.lines, *(cell + shift for cell in other.lines)],
            [*self.polygons, *(cell + shift for cell in other.polygons)],
            {**other.fields, **self.fields},
        )


def texts(name: str, values: NDArray[Any]) -> tuple[str, ...]:
    """The texts in an array of their bytes, each with a zero behind it."""
    try:
        whole = bytes(int(code) % 256 for code in values.ravel().tolist()).decode()
    except (ValueError, OverflowError):
        raise FileFaultError(f"has an array {name!r} that cannot be decoded") from None
    return tuple(text for text in whole.split("\0") if text)


def drawn(poly: PolyData, radius: str | None) -> Drawing:
    """The lines of a data set or, if it has none, its surface.

    Parameters
    ----------
    poly
        The data set.
    radius
        Name of the array that holds the radius; one of the usual names if left out.
    """
    ends, space = poly.fields.get(MARK, ()), poly.fields.get(SPACE, ("",))[0]
    places, turned = right_handed(poly.points, space)
    poly = poly._replace(points=places)
    for cell in (*poly.lines, *poly.polygons):
        if cell.size and (cell.min() < 0 or cell.max() >= len(poly.points)):
            raise FileFaultError(
                f"has a cell of points {cell.min()} to {cell.max()}, but {len(poly.points)} points"
            )
    names = tuple(poly.arrays)
    lines = [cell for cell in poly.lines if cell.size > 1]
    if not lines:
        triangles = [_fan(cell) for cell in poly.polygons if cell.size > 2]
        corners = np.concatenate(triangles) if triangles else np.zeros((0, 3), dtype=np.int64)
        used, indices = np.unique(corners, return_inverse=True)
        surface = Surface(poly.points[used], indices.reshape(-1, 3).astype(np.int64))
        return Drawing(surface=surface if triangles else None, arrays=names, notes=turned)
    if all(cell.size == 2 for cell in lines) and len(lines) > 1:
        lines = chains(np.array(lines), len(poly.points))
    name = pick_radius(names, radius)
    values = np.full(len(poly.points), np.nan) if name is None else poly.arrays[name]
    made = len(ends) == len(lines) + 1 and are_ends(ends)
    called = ends[1:] if made else ("",) * len(lines)
    return Drawing(
        tuple(
            Line(name, poly.points[cell], values[cell])
            for name, cell in zip(called, lines, strict=True)
        ),
        arrays=names,
        unit="mm" if made else None,
        entrance=ends[0] if made else "",
        radius_unit=unit_of(name),
        notes=turned,
    )


def _fan(cell: Indices) -> Indices:
    """Triangles of a polygon, all with its first corner."""
    return np.column_stack([np.full(cell.size - 2, cell[0]), cell[1:-1], cell[2:]])
