"""Tables of points: CSV, TSV and the .dat tables of VMTK, one row per point."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

from magwire.units import DIMENSIONS
from magwire.vessel.files.drawing import Drawing, FileFaultError, Line, pick_radius

Splitter = Callable[[str], list[str]]
AXES = ("x", "y", "z")
GROUPS = ("line", "branch", "vessel", "centerlineids", "centerlineid", "groupids", "name")
"""Names of columns that say which line a point belongs to."""
HEAD = re.compile(r'^\s*"?\s*([^\[(]+?)\s*(?:[\[(]\s*(\w+)\s*[\])])?\s*"?\s*$')


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file. The first row names the columns; without names they are x, y, z
        and radius.
    radius
        Name of the column that holds the radius; one of the usual names if left out.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise FileFaultError("is not a text file") from None
    rows = [row for row in text.splitlines() if row.strip() and not row.lstrip().startswith("#")]
    if not rows:
        raise FileFaultError("is empty")
    split = _splitter(rows[0])
    heads, unit = _heads(split(rows[0]))
    if heads:
        rows = rows[1:]
    else:
        heads = [*AXES, "radius"][: len(split(rows[0]))]
    columns = _columns(heads, rows, split)
    missing = [axis for axis in AXES if axis not in columns]
    if missing:
        raise FileFaultError(
            f"lacks the column {' and '.join(missing)} among {', '.join(heads)[:200]}"
        )
    return _drawing(columns, radius, unit)


def _splitter(row: str) -> Splitter:
    for mark in (",", ";", "\t"):
        if mark in row:
            return lambda text: [part.strip() for part in text.split(mark)]
    return str.split


def _heads(words: list[str]) -> tuple[list[str], str | None]:
    """Names of the columns, and the unit that they state; no names if these are numbers."""
    try:
        [float(word) for word in words]
    except ValueError:
        pass
    else:
        return [], None
    names, units = [], set()
    for word in words:
        match = HEAD.match(word)
        name, unit = (match[1], match[2]) if match else (word, None)
        low = name.strip('" ').lower()
        axis = {"points:0": "x", "points:1": "y", "points:2": "z"}.get(low, low)
        names.append(axis if axis in AXES else name.strip('" '))
        if axis in AXES and unit in DIMENSIONS["length"].units:
            units.add(unit)
    return names, units.pop() if len(units) == 1 else None


def _columns(heads: list[str], rows: list[str], split: Splitter) -> dict[str, list[str]]:
    cells = [split(row) for row in rows]
    for number, row in enumerate(cells, start=1):
        if len(row) != len(heads):
            raise FileFaultError(f"has {len(row)} columns in row {number}; expected {len(heads)}")
    return {head: [row[i] for row in cells] for i, head in enumerate(heads)}


def _numbers(name: str, texts: list[str]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    try:
        return np.array(texts, dtype=np.float64)
    except (ValueError, OverflowError):
        for number, text in enumerate(texts, start=1):
            try:
                float(text)
            except ValueError:
                raise FileFaultError(
                    f"has {text[:30]!r} for {name} in row {number}; expected a number"
                ) from None
        raise FileFaultError(f"has a column {name} that is not of numbers") from None


def _drawing(columns: dict[str, list[str]], radius: str | None, unit: str | None) -> Drawing:
    points = np.column_stack([_numbers(axis, columns[axis]) for axis in AXES])
    others = tuple(name for name in columns if name not in AXES)
    name = pick_radius(others, radius)
    values = np.full(len(points), np.nan) if name is None else _numbers(name, columns[name])
    group = next((head for head in others if head.lower() in GROUPS and head != name), None)
    if group is None:
        return Drawing((Line("", points, values),), unit=unit, arrays=others)
    labels = np.array(columns[group])
    named = group.lower() in ("branch", "vessel", "name", "line")
    order = list(dict.fromkeys(columns[group]))
    lines = (
        Line(label if named else "", points[labels == label], values[labels == label])
        for label in order
    )
    return Drawing(tuple(line for line in lines if len(line.points) > 1), unit=unit, arrays=others)
