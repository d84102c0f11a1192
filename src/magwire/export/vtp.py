"""VTK's XML files of poly data and of collections over time, written with no VTK."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.files import write_whole

KINDS = {"f8": "Float64", "f4": "Float32", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
BLOCK = 1 << 15
"""Bytes of a block that is compressed: readers take them one by one."""


def write_vtp(
    path: Path,
    points: ArrayLike,
    *,
    lines: Iterable[ArrayLike] = (),
    triangles: ArrayLike | None = None,
    point_data: Mapping[str, NDArray[np.generic]],
) -> Path:
    """Write a poly data file: points, lines or triangles, and numbers at the points.

    Parameters
    ----------
    path
        The file.
    points
        Shape (n, 3) [m]; those in no line or triangle are written as vertices.
    lines
        Indices of the points of each line.
    triangles
        Indices of the points of each, shape (m, 3).
    point_data
        Numbers or vectors at the points by name, shape (n,) or (n, 3).
    """
    points = np.asarray(points)
    rows = [np.asarray(line) for line in lines]
    corners = np.zeros((0, 3), dtype=np.int64) if triangles is None else np.asarray(triangles)
    vertices = [] if rows or len(corners) else [np.array([k]) for k in range(len(points))]
    cells = [("Verts", vertices), ("Lines", rows), ("Strips", []), ("Polys", list(corners))]
    counts = " ".join(f'NumberOf{name}="{len(found)}"' for name, found in cells)
    body = "".join(_cells(name, found) for name, found in cells)
    numbers = "".join(_array(name, values) for name, values in point_data.items())
    write_whole(
        path,
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64" compressor="vtkZLibDataCompressor">\n'
        f'<PolyData>\n<Piece NumberOfPoints="{len(points)}" {counts}>\n'
        f"<Points>\n{_array('Points', points)}</Points>\n"
        f"<PointData>\n{numbers}</PointData>\n{body}</Piece>\n</PolyData>\n</VTKFile>\n",
    )
    return path


def write_pvd_list(path: Path, files: Iterable[tuple[float, str]]) -> Path:
    """Write a collection: a file for each time [s], by its name relative to the collection."""
    entries = "".join(
        f'<DataSet timestep="{float(time)!r}" group="" part="0" file={quoteattr(name)}/>\n'
        for time, name in files
    )
    write_whole(
        path,
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" '
        f'byte_order="LittleEndian">\n<Collection>\n{entries}</Collection>\n</VTKFile>\n',
    )
    return path


def _cells(name: str, cells: list[NDArray[Any]]) -> str:
    empty = np.zeros(0, dtype=np.int64)
    flat = np.concatenate(cells) if cells else empty
    ends = np.cumsum([len(cell) for cell in cells]) if cells else empty
    arrays = _array("connectivity", flat.astype("<i4")) + _array("offsets", ends.astype("<i4"))
    return f"<{name}>\n{arrays}</{name}>\n"


def _array(name: str, values: NDArray[np.generic]) -> str:
    kind = KINDS[values.dtype.str[1:]]
    width = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    text = _compressed(np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<")))
    return (
        f'<DataArray type="{kind}" Name={quoteattr(name)}{width} format="binary">'
        f"{text}</DataArray>\n"
    )


def _compressed(values: NDArray[np.generic]) -> str:
    """Blocks as VTK has them, behind their number, size, size of the last, and packed sizes.

    The last size is zero if that block is full.
    """
    data = values.tobytes()
    blocks = [zlib.compress(data[k : k + BLOCK]) for k in range(0, len(data), BLOCK)]
    header = np.array([len(blocks), BLOCK, len(data) % BLOCK, *map(len, blocks)], dtype="<u8")
    return (b64encode(header.tobytes()) + b64encode(b"".join(blocks))).decode("ascii")
