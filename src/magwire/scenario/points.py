"""Centreline points from a CSV file, put into the scenario in place of the file's name."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

from magwire import units
from magwire.files import read_text

AXES = ("x", "y", "z")


def inline(lumen: dict[str, Any], folder: Path) -> tuple[dict[str, Any], list[str]]:
    """The lumen table with the points of its file in it.

    Parameters
    ----------
    lumen
        The table as read, with the key ``file``.
    folder
        What a relative file name starts from.

    Returns
    -------
    tuple
        The table with ``points`` and ``radius`` in place of ``file`` and ``units``, and the faults
        found; with a fault, the table lacks points and radius.
    """
    rest = {key: value for key, value in lumen.items() if key not in ("file", "units")}
    faults = [
        f"Input lumen.{key} cannot stand next to lumen.file; remove one of them."
        for key in ("points",)
        if key in lumen
    ]
    unit = lumen.get("units")
    if unit is None:
        faults.append("Input lumen.units is missing; expected the unit of lumen.file such as 'mm'.")
    else:
        faults += unit_faults(unit)
    path = lumen["file"]
    if not isinstance(path, str):
        faults.append(f"Input lumen.file must be the name of a CSV file; received {path!r}.")
        return rest, faults
    columns = AXES if "radius" in lumen else (*AXES, "radius")
    rows, more = _read(folder / path, path, columns)
    faults += more
    if faults:
        return {key: value for key, value in rest.items() if key != "points"}, faults
    rest["points"] = [[f"{row[axis]} {unit}" for axis in AXES] for row in rows]
    if "radius" not in lumen:
        rest["radius"] = [f"{row['radius']} {unit}" for row in rows]
    return rest, []


def unit_faults(unit: Any) -> list[str]:
    """What is wrong with the unit of a lumen's file; nothing if it is one of length."""
    known = units.DIMENSIONS["length"].units
    if unit in known:
        return []
    words = ", ".join(f"'{name}'" for name in known)
    return [f"Input lumen.units must be one of {words}; received {unit!r}."]


def _read(
    path: Path, name: str, columns: tuple[str, ...]
) -> tuple[list[dict[str, str]], list[str]]:
    try:
        text = read_text(path)
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        return [], [f"Input lumen.file '{name}' cannot be read: {reason}."]
    except UnicodeDecodeError:
        return [], [f"Input lumen.file '{name}' is not a text file."]
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    reader = csv.DictReader(lines, skipinitialspace=True)
    heads = [head.strip() for head in reader.fieldnames or []]
    reader.fieldnames = heads
    absent = [column for column in columns if column not in heads]
    if absent:
        return [], [
            f"Input lumen.file must have the columns {', '.join(columns)}; "
            f"'{name}' lacks {' and '.join(absent)}."
        ]
    rows, faults = [], []
    for number, row in enumerate(reader, start=1):
        rows.append({column: (row[column] or "").strip() for column in columns})
        faults += [
            f"Input lumen.file must hold finite numbers; received {text!r} for {column} "
            f"in row {number} of '{name}'."
            for column, text in rows[-1].items()
            if not _is_finite(text)
        ]
    return rows, faults


def _is_finite(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False
