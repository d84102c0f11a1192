"""Measured fields on regular grids, from CSV, NetCDF and VTK images."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.image import read_image
from magwire.actuate.netcdf import read_netcdf
from magwire.errors import InputError, array, described
from magwire.files import read_bytes

Array = NDArray[np.float64]
LARGEST = 256 * 1024 * 1024
"""Bytes of a file of a field."""
ROUNDING = 1e-4
"""Positions may be off their place on the grid by this share of its step."""
WIDEST = 10.0
"""Side of a field around a wire [m], beyond which its unit is another one: a guard, no limit."""
PICKLED = (".pkl", ".pickle", ".npy", ".npz", ".joblib", ".dill")


@dataclass(frozen=True, eq=False)
class FieldGrid:
    """Values on a regular grid.

    Parameters
    ----------
    first, step
        First point and distances of the points, shape (3,) [m].
    values
        Flux density, shape (i, j, k, 3) [T]; at least four points along each axis.

    Raises
    ------
    InputError
        If a shape does not fit, or a value is not finite.
    """

    first: Array
    step: Array
    values: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "first", array("FieldGrid", "first", self.first, (3,), "m"))
        object.__setattr__(self, "step", array("FieldGrid", "step", self.step, (3,), "m"))
        values = array("FieldGrid", "values", self.values, (None, None, None, 3), "T")
        object.__setattr__(self, "values", values)
        if not np.all(self.step > 0.0):
            raise InputError(
                f"Input step of FieldGrid must be positive; received {self.step.tolist()} m."
            )
        if min(values.shape[:3]) < 4:
            raise InputError(
                "A map must have at least 4 points along each axis; "
                f"received {' x '.join(map(str, values.shape[:3]))}."
            )

    @property
    def last(self) -> Array:
        """The corner opposite of the first point, shape (3,) [m]."""
        return np.asarray(self.first + self.step * (np.array(self.values.shape[:3]) - 1))


def read_grid(path: str | Path) -> FieldGrid:
    """Read a field from a file, by the end of its name.

    Parameters
    ----------
    path
        .csv: columns x, y, z [m] and Bx, By, Bz [T], with their names in the first row, points in
        any order; .nc: NetCDF, 3 or 4, with variables x, y, z [m] and Bx, By, Bz [T] over them;
        .vti: a VTK image in ASCII, with one array of three components [T] over its points, origin
        and spacing [m], its axes along x, y and z.

    Raises
    ------
    InputError
        With one sentence, if it cannot be used. Pickles are refused: they can run anything.
    """
    place = Path(path)
    ending = place.suffix.lower()
    if ending in PICKLED:
        raise InputError(
            f"Map '{place}' must be .csv, .nc or .vti; received {ending}, which may hold a pickle "
            "and is not opened."
        )
    readers = {".csv": _csv, ".nc": _netcdf, ".vti": _image}
    if ending not in readers:
        raise InputError(f"Map '{place}' must be .csv, .nc or .vti; received '{ending}'.")
    try:
        data = read_bytes(place, LARGEST)
    except FileNotFoundError:
        raise InputError(f"Map '{place}' does not exist.") from None
    except OSError as error:
        raise InputError(f"Map '{place}' cannot be read: {error}.") from None
    grid = readers[ending](data, f"Map '{place}'")
    size = grid.last - grid.first
    if size.max() > WIDEST:
        raise InputError(
            f"Map '{place}' must be in metres; received one that is "
            f"{' x '.join(f'{x:.3g}' for x in size)} m large."
        )
    return grid


def regular(points: ArrayLike, flux: ArrayLike, name: str) -> FieldGrid:
    """Points in any order, shape (n, 3) [m], with values, shape (n, 3) [T], put on their grid."""
    where = array(name, "points", points, (None, 3), "m")
    values = array(name, "field", flux, (len(where), 3), "T")
    index, first, step, count = np.empty(where.shape, dtype=np.int64), [], [], []
    for axis in range(3):
        sorted_ = np.sort(where[:, axis])
        jumps = np.diff(sorted_)
        span = float(sorted_[-1] - sorted_[0])
        large = jumps[jumps > ROUNDING * span] if span > 0.0 else jumps[:0]
        if not len(large):
            raise InputError(f"{name} must have more than one {'xyz'[axis]}; received one.")
        n = len(large) + 1
        h = span / (n - 1)
        place = (where[:, axis] - sorted_[0]) / h
        index[:, axis] = np.rint(place)
        if np.abs(place - index[:, axis]).max() > 100 * ROUNDING:
            raise InputError(
                f"{name} must be on a regular grid; its {'xyz'[axis]} are not evenly spaced."
            )
        first.append(sorted_[0])
        step.append(h)
        count.append(n)
    grid = np.full((*count, 3), np.nan)
    grid[tuple(index.T)] = values
    missing = int(np.isnan(grid[..., 0]).sum())
    if missing or len(where) != np.prod(count):
        raise InputError(
            f"{name} must have one value at each of {' x '.join(map(str, count))} points; "
            f"received {len(where)}, and {missing} points have none."
        )
    return FieldGrid(np.array(first), np.array(step), grid)


def _csv(data: bytes, name: str) -> FieldGrid:
    try:
        lines = [row for row in data.decode("utf-8-sig").splitlines() if row.strip()]
    except UnicodeDecodeError:
        raise InputError(f"{name} is no text.") from None
    heads = [head.strip().strip('"') for head in lines[0].split(",")] if lines else []
    wanted = ("x", "y", "z", "Bx", "By", "Bz")
    missing = [head for head in wanted if head not in heads]
    if missing:
        raise InputError(
            f"{name} lacks the column {', '.join(missing)}: its first row must have the names "
            f"{','.join(wanted)}, with commas between them; received "
            f"{described(lines[0] if lines else '')}."
        )
    if len(lines) < 2:
        raise InputError(f"{name} must have a row for each point; received none.")
    try:
        rows = np.loadtxt(lines[1:], delimiter=",", ndmin=2, dtype=np.float64)
    except ValueError:
        raise InputError(f"{name} must have numbers in every row, as many as columns.") from None
    if rows.shape[1] != len(heads):
        raise InputError(f"{name} must have {len(heads)} columns; received {rows.shape[1]}.")
    broken = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(broken):
        raise InputError(
            f"{name} must have finite numbers in every row; received "
            f"{described(lines[1 + int(broken[0])])}."
        )
    columns = rows[:, [heads.index(head) for head in wanted]]
    return regular(columns[:, :3], columns[:, 3:], name)


def _netcdf(data: bytes, name: str) -> FieldGrid:
    return regular(*read_netcdf(data, name), name)


def _image(data: bytes, name: str) -> FieldGrid:
    return FieldGrid(*read_image(data, name))
