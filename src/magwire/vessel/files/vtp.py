"""VTK PolyData, XML (.vtp): lines or polygons, in every encoding that VTK writes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from magwire.files import write_whole
from magwire.vessel.files.arrays import Encoding
from magwire.vessel.files.drawing import (
    MOST_CELLS,
    Array,
    Drawing,
    FileFaultError,
    Indices,
    Line,
    may_be_radius,
)
from magwire.vessel.files.polydata import MARK, SPACE, PolyData, drawn, texts

APPENDED = re.compile(rb'<AppendedData\b[^>]*?encoding\s*=\s*"(\w+)"[^>]*>\s*_')

TEMPLATE = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt64">
<PolyData>
<FieldData>
<DataArray type="UInt8" Name="{mark}" NumberOfTuples="{bytes}" format="ascii">
{ends}
</DataArray>
</FieldData>
<Piece NumberOfPoints="{n}" NumberOfLines="{m}">
<PointData Scalars="MaximumInscribedSphereRadius">
<DataArray type="Float64" Name="MaximumInscribedSphereRadius" format="ascii">
{radius}
</DataArray>
</PointData>
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
{points}
</DataArray>
</Points>
<Lines>
<DataArray type="Int64" Name="connectivity" format="ascii">
{connectivity}
</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">
{offsets}
</DataArray>
</Lines>
</Piece>
</PolyData>
</VTKFile>
"""


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Name of the array that holds the radius; one of the usual names if left out.
    """
    root, encoding = _parse(data)
    if root.get("type") != "PolyData" or root.find("PolyData") is None:
        raise FileFaultError(f"is a VTK file of type {root.get('type')!r}; expected 'PolyData'")
    poly = PolyData.empty()._replace(fields=_fields(root, encoding))
    for piece in root.iterfind("PolyData/Piece"):
        poly = poly.joined(_piece(piece, encoding, radius))
    return drawn(poly, radius)


def write(path: Path, lines: Sequence[Line], ends: Sequence[str]) -> None:
    """Write lines as VMTK does, with the radius of each point.

    Parameters
    ----------
    path
        The file.
    lines
        In the unit that the file is to be in.
    ends
        Names of the entrance and of the lines' ends.
    """
    points = np.concatenate([line.points for line in lines])
    count = np.cumsum([len(line.points) for line in lines])
    codes = b"\0".join(name.encode() for name in ends) + b"\0"
    parts = {
        "ends": _numbers(np.frombuffer(codes, dtype=np.uint8)),
        "radius": _numbers(np.concatenate([line.radius for line in lines])),
        "points": _numbers(points.ravel()),
        "connectivity": _numbers(np.arange(len(points))),
        "offsets": _numbers(count),
    }
    head = {"mark": MARK, "n": len(points), "m": len(lines), "bytes": len(codes)}
    write_whole(path, TEMPLATE.format(**parts, **head))


def _numbers(values: NDArray[Any]) -> str:
    """Numbers as text that reads back to the same ones."""
    return " ".join(map(repr, values.tolist()))


def _fields(root: Element, encoding: Encoding) -> dict[str, tuple[str, ...]]:
    """Texts of the whole file, of those that mean something here."""
    found = {}
    for array in (*root.iterfind("PolyData/FieldData/*"), *root.iterfind("FieldData/*")):
        name = array.get("Name", "")
        if name in (MARK, SPACE):
            found[name] = texts(name, encoding.read(array))
    return found


def _parse(data: bytes) -> tuple[Element, Encoding]:
    """The XML without its appended block, and how its arrays are packed."""
    found = APPENDED.search(data)
    block, raw = b"", False
    if found is not None:
        raw = found[1] == b"raw"
        block = data[found.end() :]
        if not raw:
            block = b"".join(block.partition(b"</AppendedData")[0].split())
        data = data[: found.start()] + b"</VTKFile>"
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise FileFaultError(f"is not valid XML: {error}") from None
    return root, Encoding.of(root, block, raw=raw)


def _piece(piece: Element, encoding: Encoding, radius: str | None) -> PolyData:
    points = piece.find("Points/DataArray")
    if points is None:
        raise FileFaultError("has no points")
    places = np.asarray(encoding.read(points), dtype=np.float64)
    if places.ndim != 2 or places.shape[1] != 3:
        places = places.reshape(-1, 3) if places.size % 3 == 0 else np.zeros((0, 3))
    arrays: dict[str, Array] = {}
    for element in piece.iterfind("PointData/DataArray"):
        if element.get("NumberOfComponents") not in (None, "", "1"):
            continue
        name = element.get("Name", "")
        if not may_be_radius(name, radius):  # known by its name only: unpacking may cost a lot
            arrays[name] = np.broadcast_to(np.nan, len(places))
            continue
        values = np.asarray(encoding.read(element), dtype=np.float64)
        if len(values) == len(places):
            arrays[name] = values
    lines = _cells(piece.find("Lines"), encoding)
    polygons = _cells(piece.find("Polys"), encoding)
    return PolyData(places, arrays, lines, polygons, {})


def _cells(element: Element | None, encoding: Encoding) -> list[Indices]:
    """Point indices of each cell."""
    if element is None:
        return []
    parts = {array.get("Name"): array for array in element.iterfind("DataArray")}
    if "connectivity" not in parts or "offsets" not in parts:
        return []
    connectivity = np.asarray(encoding.read(parts["connectivity"])).astype(np.int64)
    offsets = np.asarray(encoding.read(parts["offsets"])).astype(np.int64)
    if len(offsets) > MOST_CELLS:
        raise FileFaultError(
            f"has {len(offsets)} cells, more than the {MOST_CELLS} that can be used"
        )
    stops = np.concatenate([[0], offsets])
    if np.any(np.diff(stops) < 0) or stops[-1] > len(connectivity):
        raise FileFaultError(
            "has cells with offsets that do not increase, or end past their points"
        )
    return [connectivity[a:b] for a, b in pairwise(stops.tolist())]
