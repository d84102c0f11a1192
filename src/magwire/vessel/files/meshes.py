"""Surface meshes (.stl, .ply, .obj), by trimesh."""

from __future__ import annotations

import io
import logging
import re
import warnings

import numpy as np

from magwire.errors import MagwireError
from magwire.vessel.files.drawing import Drawing, FileFaultError, Line, Surface, right_handed

HEAD = 1000  # bytes in which 3D Slicer says in which space a mesh is
SPACE = re.compile(rb"SPACE=(\w{3})")
FACES = re.compile(rb"^f\s", re.MULTILINE)


class MissingLibraryError(MagwireError):
    """An optional library that a file needs is not installed."""


def read(data: bytes, kind: str) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    kind
        "stl", "ply" or "obj".
    """
    space = SPACE.search(data[:HEAD])
    try:
        import trimesh
    except ImportError:
        raise MissingLibraryError(
            f"Reading a .{kind} file needs trimesh; install it with pip install 'magwire[vessels]'."
        ) from None
    if kind == "obj" and not FACES.search(data):
        return _polylines(data)
    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            mesh = trimesh.load_mesh(
                io.BytesIO(data), file_type=kind, process=False, maintain_order=True
            )
        points = np.asarray(mesh.vertices, dtype=np.float64).reshape(-1, 3)
        triangles = np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
    except Exception as error:  # a broken file may raise anything in there
        raise FileFaultError(f"is not a .{kind} file that can be read: {_first(error)}") from None
    points, notes = right_handed(points, space[1].decode() if space else "")
    return Drawing(surface=Surface(points, triangles), notes=notes)


def _polylines(data: bytes) -> Drawing:
    """The lines of an .obj file without faces: they have no radius."""
    points: list[list[float]] = []
    lines: list[list[int]] = []
    try:
        for row in data.decode("latin-1").splitlines():
            words = row.split()
            if words[:1] == ["v"]:
                points.append([float(word) for word in words[1:4]])
            elif words[:1] == ["l"]:
                lines.append([int(word.split("/")[0]) for word in words[1:]])
        places = np.array(points, dtype=np.float64).reshape(-1, 3)
        runs = [np.where(np.array(run) > 0, np.array(run) - 1, np.array(run)) for run in lines]
        made = tuple(Line("", places[run], np.full(len(run), np.nan)) for run in runs)
    except (ValueError, IndexError, OverflowError):
        raise FileFaultError("is not a .obj file whose lines can be read") from None
    return Drawing(tuple(line for line in made if len(line.points) > 1))


def _first(error: Exception) -> str:
    """The first line of an error, shortened."""
    lines = str(error).strip().splitlines() or [type(error).__name__]
    return lines[0].rstrip(".")[:120]
