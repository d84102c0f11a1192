"""TubeTK (.tre): tubes in MetaIO's format, as text or binary."""

from __future__ import annotations

import re

import numpy as np

from magwire.vessel.files.drawing import MOST_POINTS, Array, Drawing, FileFaultError, Line

WIDTHS = {"MET_FLOAT": 4, "MET_DOUBLE": 8}
"""Bytes of a number in binary data, by its type."""
RADII = ("r", "R", "radius", "Radius", "rad", "Rad", "s", "S")
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
    tubes: list[tuple[Array, dict[str, str]]] = []
    head: dict[str, str] = {}
    parts: dict[str, dict[str, str]] = {}
    place = 0
    while found := ENTRY.match(data, place):
        key, value = found[1].decode(), found[2].decode("latin-1").strip()
        place = found.end()
        if key == "ObjectType":
            head = {}
        head[key] = value
        if key == "ID" and value != "-1":
            parts[value] = head
        if key == "Points":
            try:
                points, place = _points(data, place, head)
            except (ValueError, OverflowError, IndexError):
                raise FileFaultError("has a tube whose points cannot be read") from None
            tubes.append((points, head))
    if not tubes:
        raise FileFaultError("holds no tube")
    lines = [_line(points, head, _frames(head, parts)) for points, head in tubes if len(points) > 1]
    return Drawing(tuple(lines), unit="mm")


def _points(data: bytes, place: int, head: dict[str, str]) -> tuple[Array, int]:
    """Numbers of all points of a tube, shape (n, columns), and where the file goes on."""
    count, columns = int(head["NPoints"]) if "NPoints" in head else -1, len(_columns(head))
    if not 0 <= count <= MOST_POINTS:
        raise ValueError
    if head.get("BinaryData", "False").lower() == "true":
        order = ">" if head.get("BinaryDataByteOrderMSB", "False").lower() == "true" else "<"
        width = _width(data, place, count * columns, head.get("ElementType", ""))
        size = width * count * columns
        if place + size > len(data):
            raise ValueError
        numbers = np.frombuffer(data[place : place + size], dtype=f"{order}f{width}")
        following = data.find(b"ObjectType", place + size)
        return (
            numbers.astype(np.float64).reshape(count, columns),
            len(data) if following < 0 else following,
        )
    rows = []
    for _ in range(count):
        end = data.find(b"\n", place)
        end = len(data) if end < 0 else end
        rows.append(data[place:end].split())
        place = end + 1
        if place > len(data) + 1:
            raise ValueError
    return np.array(rows, dtype=np.float64).reshape(count, -1)[:, :columns], place


def _width(data: bytes, place: int, count: int, stated: str) -> int:
    """Bytes of a number: 4, or 8 where the file says so or the next object begins only there.

    MetaIO writes numbers of its element type, but not always which that is.
    """
    if stated in WIDTHS:
        return WIDTHS[stated]
    for width in WIDTHS.values():
        rest = data[place + width * count :].lstrip(b"\r\n")
        if place + width * count <= len(data) and (not rest or rest.startswith(b"ObjectType")):
            return width
    return WIDTHS["MET_FLOAT"]


def _columns(head: dict[str, str]) -> list[str]:
    columns = head.get("PointDim", "x y z r").split()
    if not {"x", "y", "z"} <= set(columns):
        raise FileFaultError("has a tube without the columns x, y and z")
    return columns


def _frames(head: dict[str, str], parts: dict[str, dict[str, str]]) -> list[dict[str, str]]:
    """A tube's entries, and those of what it is a part of, from within; a parent of -1 is none."""
    chain = [head]
    while (above := parts.get(chain[-1].get("ParentID", ""))) is not None:
        if any(above is one for one in chain):
            raise FileFaultError(
                f"has a tube that is a part of itself, ParentID {head['ParentID']}"
            )
        chain.append(above)
    return chain


def _line(points: Array, head: dict[str, str], frames: list[dict[str, str]]) -> Line:
    """A tube where it is: stretched by the spacing, turned by the matrix, moved by the offset.

    Then by matrix and offset of what it is a part of. So does ITK 5.4 with points; the offset holds
    the centre of rotation already. Of a matrix that stretches, the radius takes the mean.
    ITK 5.4.7's own radius in world space shrinks by turning, and its reader loses frames of parts.
    """
    columns = _columns(head)
    spacing = _numbers(head, "ElementSpacing", "1 1 1")
    places, stretch = points[:, [columns.index(axis) for axis in "xyz"]] * spacing, spacing[0]
    for frame in frames:
        turn = _numbers(frame, "TransformMatrix", "1 0 0 0 1 0 0 0 1").reshape(3, 3)
        places = places @ turn.T + _numbers(frame, "Offset", "0 0 0")
        stretch = stretch * abs(float(np.linalg.det(turn))) ** (1.0 / 3.0)
    wide = next((columns.index(name) for name in RADII if name in columns), None)
    radius = np.full(len(points), np.nan) if wide is None else points[:, wide] * stretch
    return Line(head.get("Name", ""), places, radius)


def _numbers(head: dict[str, str], key: str, usual: str) -> Array:
    """The numbers of an entry, as many as it usually has."""
    words = head.get(key, usual).split()
    try:
        values = np.array(words, dtype=np.float64)
    except ValueError:
        raise FileFaultError(f"has a tube whose {key} is not of numbers") from None
    if len(words) != len(usual.split()):
        raise FileFaultError(f"has a tube whose {key} has not {len(usual.split())} numbers")
    return values
