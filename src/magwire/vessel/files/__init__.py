"""Files of vessels: centrelines and surfaces in the formats that people have.

Each format has a module with ``read(data, radius)``: bytes in, and a ``Drawing`` out or a
``FileFaultError``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from magwire.errors import InputError, described
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
BRANCHES = (".mrk.json", ".vtp", ".vtk", ".csv", ".tsv", ".dat", ".swc", ".pth", ".tre")
"""Endings of files that are taken from a folder."""
LARGE = (".vtp", ".vtk", ".stl", ".ply", ".obj")
"""Those of surfaces; centrelines take less."""


def load(source: str | Path | Sequence[str | Path], radius: str | None = None) -> Drawing:
    """What a file, the files of a folder, or several files hold, in their own unit.

    Parameters
    ----------
    source
        The file, the end of whose name says which format it is in; or files, or a folder of files,
        of one branch each.
    radius
        Name of the array that holds the radius; one of the usual names if left out.

    Raises
    ------
    InputError
        If the file cannot be read, is of another format or holds nothing that can be used.
    """
    if not isinstance(source, (str, Path)):
        files_of = isinstance(source, Sequence) and all(isinstance(p, (str, Path)) for p in source)
        if not files_of:
            raise InputError(
                "Input path of Vessel must be a file, a folder or a list of files; received "
                f"{described(source)}."
            )
        return _together([Path(path) for path in source], radius)
    place = Path(source)
    if place.is_dir():
        files = sorted(p for p in place.iterdir() if p.is_file() and _one_branch(p))
        if not files:
            raise refuse(place, f"is a folder without files that end in {', '.join(BRANCHES)}")
        return _together(files, radius)
    return _single(place, radius)


def _one_branch(path: Path) -> bool:
    return path.name.lower().endswith(BRANCHES) and not path.name.startswith(".")


def _together(files: Sequence[Path], radius: str | None) -> Drawing:
    """What several files hold, as one: their lines are called what the files are called."""
    if not files:
        raise refuse("", "is none at all; expected one or more")
    drawings = [_single(path, radius) for path in files]
    if len(drawings) == 1:
        return drawings[0]
    lines: list[Line] = []
    for path, drawing in zip(files, drawings, strict=True):
        if not drawing.lines or drawing.entrance:
            raise refuse(path, "does not hold lines that can be joined to those of other files")
        for attribute in ("unit", "radius_unit"):
            one, first = getattr(drawing, attribute), getattr(drawings[0], attribute)
            if one != first:
                raise refuse(path, f"is in {one or 'no unit'}, but '{files[0]}' in {first}")
        stem = path.name[: -len(".mrk.json")] if path.name.endswith(".mrk.json") else path.stem
        alone = len(drawing.lines) == 1
        lines += [x._replace(name=x.name or (stem if alone else "")) for x in drawing.lines]
    arrays = tuple(dict.fromkeys(name for drawing in drawings for name in drawing.arrays))
    notes = tuple(dict.fromkeys(note for drawing in drawings for note in drawing.notes))
    return drawings[0]._replace(lines=tuple(lines), arrays=arrays, notes=notes)


def _single(place: Path, radius: str | None) -> Drawing:
    """What one file holds."""
    reader = FORMATS.get(place.suffix.lower())
    if reader is None:
        known = ", ".join(FORMATS)
        raise refuse(place, f"must have one of the endings {known}; received {place.suffix!r}")
    try:
        if place.is_dir():
            raise FileFaultError("is a folder")
        most = LARGEST_FILE if place.suffix.lower() in LARGE else LARGEST_TEXT
        data = read_bytes(place, most)
        with np.errstate(all="ignore"):
            return checked(reader(data, radius))
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise refuse(place, f"cannot be read: {reason}") from None
    except FileFaultError as fault:
        raise refuse(place, str(fault)) from None
