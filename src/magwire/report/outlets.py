"""To which outlets a wire gets: a table in the terminal, files and a map."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from magwire.files import write_whole
from magwire.lumen import Lumen
from magwire.lumen.branch import Bend
from magwire.planning import Prospect

TABLES, MAP = ("plan.csv", "plan.json"), "plan.png"
COLUMNS = {
    "outlet": "",
    "reached": "",
    "length": "mm",
    "fed": "mm",
    "came": "mm",
    "narrowest": "mm",
    "narrowest_at": "mm",
    "tightest_bend": "mm",
    "peak_field": "mT",
    "tip_force": "mN",
    "wall_force": "mN",
    "patch_force": "mN",
    "force_patch": "mm",
    "push_force": "mN",
    "guide_torque": "mN m",
    "clearance": "mm",
    "reason": "",
}

HEADS = {
    "outlet": 0,
    "reached": 7,
    "tip at [mm]": 15,
    "fed [mm]": 8,
    "field [mT]": 10,
    "tip force [mN]": 14,
    "wire force [mN]": 15,
    "patch force [mN]": 16,
    "push [mN]": 9,
    "clearance [mm]": 14,
    "narrowest [mm]": 14,
    "tightest bend [mm]": 18,
}
"""Heads of the table in the terminal, and how wide the columns are; the first is as its names."""


def head(names: Sequence[str]) -> str:
    """The first row of the table, for outlets of these names."""
    return _line(list(HEADS), names)


def row(p: Prospect, names: Sequence[str]) -> str:
    """The row of an outlet, as it is printed when that is done."""
    bend = "straight" if math.isinf(p.bend.radius) else f"{1e3 * p.bend.radius:.3g}"
    at = "" if math.isinf(p.bend.radius) else f" at {p.bend.arc * 1e3:.4g}"
    cells = [
        p.outlet,
        "yes" if p.reached else "no",
        f"{1e3 * p.came:.1f} of {1e3 * p.length:.1f}",
        f"{1e3 * p.fed:.1f}",
        f"{1e3 * p.peak_field:.3g}",
        f"{1e3 * p.tip_force:.3g}",
        f"{1e3 * p.wall_force:.3g}",
        f"{1e3 * p.patch_force:.3g}",
        f"{1e3 * p.push_force:.3g}",
        "" if math.isnan(p.clearance) else f"{1e3 * p.clearance:.3g}",
        f"{p.narrowest * 1e3:.3g} at {p.narrowest_at * 1e3:.4g}",
        bend + at,
    ]
    return _line(cells, names)


def _line(cells: Sequence[str], names: Sequence[str]) -> str:
    first = max(len("outlet"), *map(len, names))
    rest = zip(cells[1:], list(HEADS.values())[1:], strict=True)
    sides = "<" + ">" * len(cells)
    texts = [f"{cell:{side}{width}}" for (cell, width), side in zip(rest, sides, strict=False)]
    return "  ".join([f"{cells[0]:<{first}}", *texts]).rstrip()


def reasons(prospects: Sequence[Prospect]) -> list[str]:
    """Why outlets are not reached, and what was tried again, a line each."""
    return [f"{p.outlet}: {p.reason}" for p in prospects if p.reason]


def save(lumen: Lumen, prospects: Sequence[Prospect], folder: Path, mark: str = "") -> list[Path]:
    """Write the table as CSV and JSON, as far as it has come, and the map; the files.

    Parameters
    ----------
    lumen
        The lumen, whose outlets the rows follow.
    prospects
        What is done, in any order.
    folder
        Where to.
    mark
        What the plan is known by when it is taken up again.
    """
    from magwire.plot import prospects as maps

    order = {name: k for k, name in enumerate(lumen.outlets)}
    prospects = sorted(prospects, key=lambda p: order.get(p.outlet, 0))
    rows = [_row(p) for p in prospects]
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([f"{n} [{unit}]" if unit else n for n, unit in COLUMNS.items()])
    writer.writerows(row.values() for row in rows)
    write_whole(folder / TABLES[0], text.getvalue())
    found = {"units": COLUMNS, "outlets": [_finite(row) for row in rows], "plan": mark}
    words = json.dumps(found, indent=2, allow_nan=False).removesuffix("\n}")
    courses = json.dumps([_course(p) for p in prospects], allow_nan=False)
    write_whole(folder / TABLES[1], f'{words},\n  "courses": {courses}\n}}\n')
    paths = lumen.paths or {"outlet": lumen.branches[0]}
    maps.save(
        {name: path.centreline() for name, path in paths.items()},
        {p.outlet: (p.arc, p.flux_density) for p in prospects},
        folder / MAP,
        trunks=[branch.centreline() for branch in lumen.trunks],
        surface=None if lumen.sheet is None else (lumen.sheet.points, lumen.sheet.triangles),
    )
    return files(folder)


def files(folder: Path) -> list[Path]:
    """What ``save`` writes to a folder."""
    return [folder / name for name in (*TABLES, MAP)]


def begun(folder: Path, mark: str | None = None) -> bool:
    """Whether a folder holds the beginning of a plan, or of the one with this mark."""
    try:
        found = json.loads((folder / TABLES[1]).read_text(encoding="utf-8"))
        return bool(found["plan"]) if mark is None else found["plan"] == mark
    except (OSError, ValueError, KeyError, TypeError):
        return False


def taken_up(folder: Path) -> list[Prospect]:
    """What ``save`` has written, to the last bit."""
    found = json.loads((folder / TABLES[1]).read_text(encoding="utf-8"))
    return [_prospect(course) for course in found["courses"]]


def _course(p: Prospect) -> dict[str, Any]:
    """A prospect in SI; JSON knows neither infinity nor NaN: these are words."""
    values: dict[str, Any] = {}
    for one in fields(p):
        value = getattr(p, one.name)
        if isinstance(value, np.ndarray):
            values[one.name] = value.tolist()
        elif isinstance(value, Bend):
            values[one.name] = [_number(value.radius), _number(value.arc)]
        else:
            values[one.name] = _number(value) if isinstance(value, float) else value
    return values


def _prospect(course: Mapping[str, Any]) -> Prospect:
    """What ``_course`` was made of."""
    values: dict[str, Any] = {}
    for one in fields(Prospect):
        value = course[one.name]
        if one.name == "bend":
            values[one.name] = Bend(float(value[0]), float(value[1]))
        elif isinstance(value, list):
            values[one.name] = np.array(value, dtype=np.float64)
        elif one.name in ("outlet", "reason", "reached"):
            values[one.name] = value
        else:
            values[one.name] = float(value)
    return Prospect(**values)


def _number(value: float) -> float | str:
    return value if math.isfinite(value) else str(value)


def _row(p: Prospect) -> dict[str, str | float | bool]:
    """One outlet in the units of ``COLUMNS``."""
    values = {
        "length": p.length,
        "fed": p.fed,
        "came": p.came,
        "narrowest": p.narrowest,
        "narrowest_at": p.narrowest_at,
        "tightest_bend": p.bend.radius,
        "peak_field": p.peak_field,
        "tip_force": p.tip_force,
        "wall_force": p.wall_force,
        "patch_force": p.patch_force,
        "force_patch": p.force_patch,
        "push_force": p.push_force,
        "guide_torque": p.guide_torque,
        "clearance": p.clearance,
    }
    numbers = {name: float(f"{1e3 * value:.6g}") for name, value in values.items()}
    return {"outlet": p.outlet, "reached": p.reached, **numbers, "reason": p.reason}


def _finite(row: Mapping[str, str | float | bool]) -> dict[str, str | float | bool | None]:
    """A row as JSON has it: it knows neither infinity nor NaN."""
    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in row.items()
    }
