"""VTK PolyData, XML (.vtp): lines or polygons, in every encoding that VTK writes."""

from __future__ import annotations

import re
from itertools import pairwise
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from magwire.lumen.files.arrays import Encoding
from magwire.lumen.files.drawing import Array, Drawing, FileFault, Indices
from magwire.lumen.files.polydata import MARK, PolyData, drawn

APPENDED = re.compile(rb'<AppendedData\b[^>]*?encoding\s*=\s*"(\w+)"[^>]*>\s*_')


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
        raise FileFault(f"is a VTK file of type {root.get('type')!r}; expected 'PolyData'")
    poly = PolyData.empty()
    for piece in root.iterfind("PolyData/Piece"):
        poly = poly.joined(_piece(piece, encoding))
    names = {array.get("Name") for array in root.iterfind("PolyData/FieldData/DataArray")}
    return drawn(poly, radius, smooth=MARK in names)


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
        raise FileFault(f"is not valid XML: {error}") from None
    return root, Encoding.of(root, block, raw=raw)


def _piece(piece: Element, encoding: Encoding) -> PolyData:
    points = piece.find("Points/DataArray")
    if points is None:
        raise FileFault("has no points")
    places = np.asarray(encoding.read(points), dtype=np.float64)
    if places.ndim != 2 or places.shape[1] != 3:
        places = places.reshape(-1, 3) if places.size % 3 == 0 else np.zeros((0, 3))
    arrays: dict[str, Array] = {}
    for element in piece.iterfind("PointData/DataArray"):
        if int(element.get("NumberOfComponents") or 1) == 1:
            values = np.asarray(encoding.read(element), dtype=np.float64)
            if len(values) == len(places):
                arrays[element.get("Name", "")] = values
    lines = _cells(piece.find("Lines"), encoding)
    polygons = _cells(piece.find("Polys"), encoding)
    return PolyData(places, arrays, lines, polygons)


def _cells(element: Element | None, encoding: Encoding) -> list[Indices]:
    """Point indices of each cell."""
    if element is None:
        return []
    parts = {array.get("Name"): array for array in element.iterfind("DataArray")}
    if "connectivity" not in parts or "offsets" not in parts:
        return []
    connectivity = np.asarray(encoding.read(parts["connectivity"])).astype(np.int64)
    offsets = np.asarray(encoding.read(parts["offsets"])).astype(np.int64)
    stops = np.concatenate([[0], offsets])
    if np.any(np.diff(stops) < 0) or stops[-1] > len(connectivity):
        raise FileFault("has cells with offsets that do not increase, or end past their points")
    return [connectivity[a:b] for a, b in pairwise(stops.tolist())]
