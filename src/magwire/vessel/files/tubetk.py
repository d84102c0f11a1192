"""TubeTK (.tre): tubes in MetaIO's format, as text or binary."""

from __future__ import annotations

import re

import numpy as np

from magwire.vessel.files.drawing import MOST_POINTS, Array, Drawing, FileFaultError, Line

ENTRY = re.compile(rb"[ \t]*(\w+)[ \t]*=[ \t]*([^\r\n]*)\r?\n")


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Not used: the radius has its column.
    """
    lines: list[Line] = []
    head: dict[str, str] = {}
    place = 0
    while found := ENTRY.match(data, place):
        key, value = found[1].decode(), found[2].decode("latin-1").strip()
        place = found.end()
        if key == "ObjectType":
            head = {}
        head[key] = value
        if key == "Points":
            try:
                points, place = _points(data, place, head)
            except (ValueError, OverflowError, IndexError):
                raise FileFaultError("has a tube whose points cannot be read") from None
            lines.append(_line(points, head))
    if not lines:
        raise FileFaultError("holds no tube")
    return Drawing(tuple(line for line in lines if len(line.points) > 1), unit="mm")


def _points(data: bytes, place: int, head: dict[str, str]) -> tuple[Array, int]:
    """Numbers of all points of a tube, shape (n, columns), and where the file goes on."""
    count, columns = int(head["NPoints"]) if "NPoints" in head else -1, len(_columns(head))
    if not 0 <= count <= MOST_POINTS:
        raise ValueError
    if head.get("BinaryData", "False").lower() == "true":
        order = ">" if head.get("BinaryDataByteOrderMSB", "False").lower() == "true" else "<"
        size = 4 * count * columns
        if place + size > len(data):
            raise ValueError
        numbers = np.frombuffer(data[place : place + size], dtype=order + "f4")
        place += size
        while data[place : place + 1] in (b"\n", b"\r"):
            place += 1
        return numbers.astype(np.float64).reshape(count, columns), place
    rows = []
    for _ in range(count):
        end = data.find(b"\n", place)
        end = len(data) if end < 0 else end
        rows.append(data[place:end].split())
        place = end + 1
        if place > len(data) + 1:
            raise ValueError
    return np.array(rows, dtype=np.float64).reshape(count, -1)[:, :columns], place


def _columns(head: dict[str, str]) -> list[str]:
    columns = head.get("PointDim", "x y z r").split()
    if not {"x", "y", "z"} <= set(columns):
        raise FileFaultError("has a tube without the columns x, y and z")
    return columns


def _line(points: Array, head: dict[str, str]) -> Line:
    """A tube where it is: points are stretched by the spacing and moved by the offset."""
    columns = _columns(head)
    try:
        spacing = np.array(head.get("ElementSpacing", "1 1 1").split(), dtype=np.float64)
        offset = np.array(head.get("Offset", "0 0 0").split(), dtype=np.float64)
    except ValueError:
        raise FileFaultError("has a tube whose spacing or offset is not of numbers") from None
    if spacing.shape != (3,) or offset.shape != (3,):
        raise FileFaultError("has a tube whose spacing or offset has not three numbers")
    places = points[:, [columns.index(axis) for axis in "xyz"]] * spacing + offset
    wide = next((columns.index(name) for name in ("r", "R") if name in columns), None)
    radius = np.full(len(points), np.nan) if wide is None else points[:, wide] * spacing[0]
    return Line(head.get("Name", ""), places, radius)
