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
from magwire.planning import Prospect, Trial

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
    "robust_reached": "",
    "robust_tried": "",
    "robust_clearance": "mm",
    "robust_tip_force": "mN",
    "robust_peak_field": "mT",
    "robust_failed": "",
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
ROBUST = {
    "outlet": 0,
    "reached when off": 16,
    "least clearance [mm]": 20,
    "tip force [mN]": 14,
    "largest field [mT]": 18,
}
"""The same of the table of what was tried."""


def head(names: Sequence[str]) -> str:
    """The first row of the table, for outlets of these names."""
    return _line(list(HEADS), HEADS, names)


def robust_head(names: Sequence[str]) -> str:
    """The first row of the table of what was tried, for outlets of these names."""
    return _line(list(ROBUST), ROBUST, names)


def robust_row(p: Prospect, names: Sequence[str]) -> str:
    """What was tried of the way to an outlet, as it is printed when that is done."""
    held = sum(trial.reached for trial in p.trials)
    cells = [p.outlet, f"{held} of {len(p.trials)}"]
    cells += [f"{1e3 * value:.3g}" for value in _worst(p.trials)]
    return _line(cells, ROBUST, names)


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
    return _line(cells, HEADS, names)


def _line(cells: Sequence[str], heads: Mapping[str, int], names: Sequence[str]) -> str:
    first = max(len("outlet"), *map(len, names))
    rest = zip(cells[1:], list(heads.values())[1:], strict=True)
    sides = "<" + ">" * len(cells)
    texts = [f"{cell:{side}{width}}" for (cell, width), side in zip(rest, sides, strict=False)]
    return "  ".join([f"{cells[0]:<{first}}", *texts]).rstrip()


def reasons(prospects: Sequence[Prospect]) -> list[str]:
    """Why outlets are not reached, and what was tried again, a line each."""
    return [f"{p.outlet}: {p.reason}" for p in prospects if p.reason]


def failures(prospects: Sequence[Prospect]) -> list[str]:
    """What was tried and did not get there, and why, a line each."""
    return [
        f"{p.outlet}, {t.change}: not reached. {t.reason}"
        for p in prospects
        for t in p.trials
        if not t.reached
    ]


def _worst(trials: Sequence[Trial]) -> tuple[float, float, float]:
    """Smallest clearance [m], largest tip force [N] and largest field [T] of all that was tried."""
    if not trials:
        return math.nan, math.nan, math.nan
    clearances = [t.clearance for t in trials if not math.isnan(t.clearance)]
    return (
        min(clearances, default=math.nan),
        max(t.tip_force for t in trials),
        max(t.peak_field for t in trials),
    )


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
        elif isinstance(value, tuple):
            values[one.name] = [_trial(trial) for trial in value]
        else:
            values[one.name] = _number(value) if isinstance(value, float) else value
    return values


def _trial(trial: Trial) -> dict[str, Any]:
    """A trial in SI."""
    values = {one.name: getattr(trial, one.name) for one in fields(trial)}
    return {n: _number(v) if isinstance(v, float) else v for n, v in values.items()}


def _prospect(course: Mapping[str, Any]) -> Prospect:
    """What ``_course`` was made of."""
    values: dict[str, Any] = {}
    for one in fields(Prospect):
        value = course[one.name]
        if one.name == "bend":
            values[one.name] = Bend(float(value[0]), float(value[1]))
        elif one.name == "trials":
            values[one.name] = tuple(
                Trial(**trial | {"clearance": float(trial["clearance"])}) for trial in value
            )
        elif isinstance(value, list):
            shape = (-1, 3) if one.name == "field_components" else -1
            values[one.name] = np.array(value, dtype=np.float64).reshape(shape)
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
    clearance, tip_force, peak_field = _worst(p.trials)
    return {
        "outlet": p.outlet,
        "reached": p.reached,
        **{name: _rounded(value) for name, value in values.items()},
        "reason": p.reason,
        "robust_reached": sum(trial.reached for trial in p.trials),
        "robust_tried": len(p.trials),
        "robust_clearance": _rounded(clearance),
        "robust_tip_force": _rounded(tip_force),
        "robust_peak_field": _rounded(peak_field),
        "robust_failed": "; ".join(trial.change for trial in p.trials if not trial.reached),
    }


def _rounded(value: float) -> float:
    """In thousandths of SI, to six digits."""
    return float(f"{1e3 * value:.6g}")


def _finite(row: Mapping[str, str | float | bool]) -> dict[str, str | float | bool | None]:
    """A row as JSON has it: it knows neither infinity nor NaN."""
    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in row.items()
    }
