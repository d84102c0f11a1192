"""Tubes in NetCDF (.nc), as magwire writes them; version 3, which any NetCDF library reads."""

from __future__ import annotations

import io
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from magwire.files import write_whole
from magwire.vessel.files.drawing import Drawing, FileFaultError, Line, are_ends


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Not used: the radius has its variable.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            file = netcdf_file(io.BytesIO(data), "r", mmap=False)
            ends = file.ends.decode().split("\n")
            points = np.array(file.variables["point"][:], dtype=np.float64).reshape(-1, 3)
            wide = np.array(file.variables["radius"][:], dtype=np.float64).reshape(-1)
            owner = np.array(file.variables["line"][:], dtype=np.int64).reshape(-1)
    except Exception:  # a broken file may raise anything in there
        raise FileFaultError("is not a NetCDF file of a vessel") from None
    if not len(points) == len(wide) == len(owner) or not are_ends(ends):
        raise FileFaultError("is not a NetCDF file of a vessel: its variables do not fit together")
    if len(ends) < 2 or not np.array_equal(np.unique(owner), np.arange(len(ends) - 1)):
        raise FileFaultError("is not a NetCDF file of a vessel: it must have one line for each end")
    lines = (Line(name, points[owner == i], wide[owner == i]) for i, name in enumerate(ends[1:]))
    return Drawing(tuple(lines), unit="m", entrance=ends[0])


def write(path: Path, lines: Sequence[Line], ends: Sequence[str]) -> None:
    """Write tubes.

    Parameters
    ----------
    path
        The file.
    lines
        In metres.
    ends
        Names of the entrance and of the lines' ends.
    """
    points = np.concatenate([line.points for line in lines])
    owner = np.repeat(np.arange(len(lines), dtype=np.int32), [len(x.points) for x in lines])
    # In memory first: the library does not bear a full disk.
    whole = io.BytesIO()
    with netcdf_file(whole, "w") as file:
        file.ends = "\n".join(ends).encode()
        file.createDimension("points", len(points))
        file.createDimension("xyz", 3)
        for name, dims, values, unit, text in (
            ("point", ("points", "xyz"), points, "m", "points of the centrelines"),
            ("radius", ("points",), np.concatenate([x.radius for x in lines]), "m", "radius"),
            ("line", ("points",), owner, "1", "number of the line, from the entrance to its end"),
        ):
            variable = file.createVariable(name, values.dtype.newbyteorder(">"), dims)
            variable[:] = values
            variable.units, variable.long_name = unit.encode(), text.encode()
        file.flush()
        data = whole.getvalue()  # closing the one closes the other
    write_whole(path, data)
