"""Tables of points: CSV, TSV and the .dat tables of VMTK, one row per point."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from magwire.units import DIMENSIONS
from magwire.vessel.files.drawing import Drawing, FileFaultError, Line, pick_radius

Splitter = Callable[[str], list[str]]
AXES = ("x", "y", "z")
GROUPS = ("line", "branch", "vessel", "centerlineids", "centerlineid", "groupids", "name")
"""Names of columns that say which line a point belongs to."""
PARAVIEW = {f"points{mark}{k}": axis for mark in ":_" for k, axis in enumerate(AXES)}
HEAD = re.compile(r'^\s*"?\s*([^\[(]+?)\s*(?:[\[(]\s*(\w+)\s*[\])])?\s*"?\s*$')


class Heads(NamedTuple):
    """Names of the columns, the unit of the points, and those of other columns, where stated."""

    names: list[str]
    unit: str | None
    others: dict[str, str]


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
    heads = _heads(split(rows[0]))
    if heads.names:
        rows = rows[1:]
    else:
        heads = Heads([*AXES, "radius"][: len(split(rows[0]))], None, {})
    columns = _columns(heads.names, rows, split)
    missing = [axis for axis in AXES if axis not in columns]
    if missing:
        raise FileFaultError(
            f"lacks the column {' and '.join(missing)} among {', '.join(heads.names)[:200]}"
        )
    return _drawing(columns, radius, heads)


def _splitter(row: str) -> Splitter:
    for mark in (",", ";", "\t"):
        if mark in row:
            return lambda text: [part.strip() for part in text.split(mark)]
    return str.split


def _heads(words: list[str]) -> Heads:
    """What the first row says; no names if it is of numbers."""
    try:
        [float(word) for word in words]
    except ValueError:
        pass
    else:
        return Heads([], None, {})
    names, units, others = [], set(), {}
    for word in words:
        match = HEAD.match(word)
        name, unit = (match[1], match[2]) if match else (word, None)
        low = name.strip('" ').lower()
        axis = PARAVIEW.get(low, low)
        names.append(axis if axis in AXES else name.strip('" '))
        if unit in DIMENSIONS["length"].units:
            if axis in AXES:
                units.add(unit)
            else:
                others[names[-1]] = str(unit)
    if len(units) > 1:
        raise FileFaultError(f"has points in {' and '.join(sorted(units))}; expected one unit")
    return Heads(names, units.pop() if units else None, others)


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


def _drawing(columns: dict[str, list[str]], radius: str | None, heads: Heads) -> Drawing:
    points = np.column_stack([_numbers(axis, columns[axis]) for axis in AXES])
    others = tuple(name for name in columns if name not in AXES)
    name = pick_radius(others, radius)
    values = np.full(len(points), np.nan) if name is None else _numbers(name, columns[name])
    units = {"unit": heads.unit, "radius_unit": heads.others.get(name or "")}
    group = next((head for head in others if head.lower() in GROUPS and head != name), None)
    if group is None:
        return Drawing((Line("", points, values),), arrays=others, **units)
    labels = np.array(columns[group])
    named = group.lower() in ("branch", "vessel", "name", "line")
    order = list(dict.fromkeys(columns[group]))
    lines = (
        Line(label if named else "", points[labels == label], values[labels == label])
        for label in order
    )
    kept = tuple(line for line in lines if len(line.points) > 1)
    return Drawing(kept, arrays=others, **units)
