"""Files of vessels: centrelines and surfaces in the formats that people have.

Each format has a module with ``read(data, radius)``: bytes in, and a ``Drawing`` out or a
``FileFaultError``.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from magwire.files import LARGEST_TEXT, read_bytes
from magwire.vessel.files import (
    meshes,
    netcdf,
    simvascular,
    slicer,
    swc,
    tables,
    toml,
    tubetk,
    vtk,
    vtp,
)
from magwire.vessel.files.drawing import (
    LARGEST_FILE,
    Drawing,
    FileFaultError,
    Line,
    Surface,
    checked,
    refuse,
)

__all__ = ["FORMATS", "Drawing", "Line", "Surface", "load"]

FORMATS: dict[str, Callable[[bytes, str | None], Drawing]] = {
    ".vtp": vtp.read,
    ".vtk": vtk.read,
    ".csv": tables.read,
    ".tsv": tables.read,
    ".dat": tables.read,
    ".txt": tables.read,
    ".swc": swc.read,
    ".pth": simvascular.read,
    ".tre": tubetk.read,
    ".json": slicer.read,
    ".nc": netcdf.read,
    ".toml": toml.read,
    ".stl": lambda data, _: meshes.read(data, "stl"),
    ".ply": lambda data, _: meshes.read(data, "ply"),
    ".obj": lambda data, _: meshes.read(data, "obj"),
}
"""Readers by the end of the file's name."""
LARGE = (".vtp", ".vtk", ".stl", ".ply", ".obj")
"""Those of surfaces; centrelines take less."""


def load(path: str | Path, radius: str | None = None) -> Drawing:
    """What a file holds, in its own units.

    Parameters
    ----------
    path
        The file; the end of its name says which format it is in.
    radius
        Name of the array that holds the radius; one of the usual names if left out.

    Raises
    ------
    InputError
        If the file cannot be read, is of another format or holds nothing that can be used.
    """
    place = Path(path)
    reader = FORMATS.get(place.suffix.lower())
    if reader is None:
        known = ", ".join(FORMATS)
        raise refuse(path, f"must have one of the endings {known}; received {place.suffix!r}")
    try:
        if place.is_dir():
            raise FileFaultError("is a folder")
        most = LARGEST_FILE if place.suffix.lower() in LARGE else LARGEST_TEXT
        data = read_bytes(place, most)
        with np.errstate(all="ignore"):
            return checked(reader(data, radius))
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise refuse(path, f"cannot be read: {reason}") from None
    except FileFaultError as fault:
        raise refuse(path, str(fault)) from None
