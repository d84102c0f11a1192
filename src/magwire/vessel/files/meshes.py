"""Surface meshes (.stl, .ply, .obj), by trimesh."""

from __future__ import annotations

import io
import logging
import warnings

import numpy as np

from magwire.errors import MagwireError
from magwire.vessel.files.drawing import Drawing, FileFaultError, Surface


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
    try:
        import trimesh
    except ImportError:
        raise MissingLibraryError(
            f"Reading a .{kind} file needs trimesh; install it with pip install 'magwire[vessels]'."
        ) from None
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
    return Drawing(surface=Surface(points, triangles) if len(triangles) else None)


def _first(error: Exception) -> str:
    """The first line of an error, shortened."""
    lines = str(error).strip().splitlines() or [type(error).__name__]
    return lines[0].rstrip(".")[:120]
