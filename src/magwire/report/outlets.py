"""To which outlets a wire gets: a table in the terminal, files and a map."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.files import write_whole
from magwire.lumen import Lumen
from magwire.planning import Prospect

if TYPE_CHECKING:
    pass

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


def save(lumen: Lumen, prospects: Sequence[Prospect], folder: Path) -> list[Path]:
    """Write the table as CSV and JSON, as far as it has come, and the map; the files."""
    from magwire.plot import prospects as maps

    rows = [_row(p) for p in prospects]
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([f"{n} [{unit}]" if unit else n for n, unit in COLUMNS.items()])
    writer.writerows(row.values() for row in rows)
    write_whole(folder / TABLES[0], text.getvalue())
    found = {"units": COLUMNS, "outlets": [_finite(row) for row in rows]}
    write_whole(folder / TABLES[1], json.dumps(found, indent=2) + "\n")
    paths = lumen.paths or {"outlet": lumen.branches[0]}
    maps.save(
        {name: path.centreline() for name, path in paths.items()},
        {p.outlet: (p.arc, p.flux_density) for p in prospects},
        folder / MAP,
    )
    return [folder / name for name in (*TABLES, MAP)]


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
