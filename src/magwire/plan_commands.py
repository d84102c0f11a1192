"""What ``magwire plan`` does: to which outlets a wire gets, as a table, files and a map."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.errors import InputError, positive
from magwire.files import write_whole
from magwire.lumen import Lumen
from magwire.lumen_commands import spot
from magwire.navigate.demands import Demands
from magwire.planning import Prospect, plan
from magwire.units import parse
from magwire.vessel import Vessel
from magwire.wire import Wire

if TYPE_CHECKING:
    from rich.table import Table

    from magwire.scenario import Scenario

TABLES, MAP = ("plan.csv", "plan.json"), "plan.png"
FINE = 0.2  # edge length at least, over the smallest radius of the lumen
SAG = 0.025  # of an edge in the tightest bend at most, over the least room for the wire
FINEST = 0.5  # edge length at least, over the radius of the wire
MAGNET = 10.0  # length of the magnet, over the radius of the wire, if nothing else is said
TRUNK = 5.0  # length of a wire before it is fitted to its way, over that of its magnet
POISSON = 0.5
FILE_WIDTH = 160  # of the table where it does not go to a terminal
DENSITY = 2000.0  # plays no part in equilibria [kg/m^3]
DEFAULTS = {"modulus": "3 MPa", "magnetization": "128 kA/m"}
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

Words = Mapping[str, str | None]


def of_file(
    path: Path,
    words: Words,
    *,
    units: str | None,
    entrance: str | None,
    scale: float,
    watch: Callable[[str], None] | None,
) -> tuple[Lumen, list[Prospect]]:
    """Plan for a vessel's file.

    Parameters
    ----------
    path
        The file.
    words
        Texts by name: the wire's ``diameter``, ``modulus``, ``magnetization`` and ``magnet``, and
        the largest ``field``.
    units, entrance, scale
        For ``Vessel.read``.
    watch
        Called with the name of each outlet before it is tried.
    """
    if words["diameter"] is None:
        raise InputError(
            "Input --wire must be the wire's diameter, such as '0.6 mm'; received none."
        )
    _read(words, "diameter", "diameter", "--wire")  # better said before the file is read
    vessel = Vessel.read(path, units, entrance=spot(entrance, "--entrance"), scale=scale)
    lumen = vessel.lumen()
    return lumen, plan(lumen, _wire(words, lumen), demands=_demands(words, Demands()), watch=watch)


def of_scenario(
    scenario: Scenario, words: Words, *, watch: Callable[[str], None] | None
) -> tuple[Lumen, list[Prospect]]:
    """Plan for a scenario: its lumen, its wire, its wall, and what its steering must keep to."""
    job = scenario.build()
    system = job.simulation.system
    lumen, wire = system.lumen, system.wire
    if words["diameter"] is not None:
        radius = 0.5 * _read(words, "diameter", "diameter", "--wire")
        parts = (replace(part, radius=radius, end_radius=None) for part in wire.sections)
        wire = Wire(tuple(parts), wire.nodes)
    steered = {
        name: value
        for name in Demands.__dataclass_fields__
        if (value := getattr(scenario.navigate, name, None)) is not None
    }
    demands = _demands(words, Demands(**steered))
    return lumen, plan(lumen, wire, demands=demands, contact=system.contact, watch=watch)


def table(prospects: Sequence[Prospect]) -> Table:
    """The table for the terminal."""
    from rich.markup import escape
    from rich.table import Table

    patch = next((p.force_patch for p in prospects if math.isfinite(p.force_patch)), 0.0)
    shown = Table(box=None, pad_edge=False, header_style="bold")
    for head in (
        "outlet",
        "reached",
        "tip at [mm]",
        "fed [mm]",
        "field [mT]",
        "tip force [mN]",
        "wire force [mN]",
        f"on {1e3 * patch:.3g} mm [mN]" if patch else "on a patch [mN]",
        "push [mN]",
    ):
        shown.add_column(escape(head), justify="left" if head in ("outlet", "reached") else "right")
    for head in ("clearance [mm]", "narrowest [mm]", "tightest bend [mm]"):
        shown.add_column(escape(head), justify="right")
    for p in prospects:
        bend = "straight" if math.isinf(p.bend.radius) else f"{1e3 * p.bend.radius:.3g}"
        shown.add_row(
            escape(p.outlet),
            "[green]yes[/]" if p.reached else "[red]no[/]",
            f"{1e3 * p.came:.1f} of {1e3 * p.length:.1f}",
            f"{1e3 * p.fed:.1f}",
            f"{1e3 * p.peak_field:.3g}",
            f"{1e3 * p.tip_force:.3g}",
            f"{1e3 * p.wall_force:.3g}",
            f"{1e3 * p.patch_force:.3g}",
            f"{1e3 * p.push_force:.3g}",
            "" if math.isnan(p.clearance) else f"{1e3 * p.clearance:.3g}",
            f"{p.narrowest * 1e3:.3g} at {p.narrowest_at * 1e3:.4g}",
            bend if math.isinf(p.bend.radius) else f"{bend} at {p.bend.arc * 1e3:.4g}",
        )
    return shown


def reasons(prospects: Sequence[Prospect]) -> list[str]:
    """Why outlets are not reached, and what was tried again, a line each."""
    return [f"{p.outlet}: {p.reason}" for p in prospects if p.reason]


def save(lumen: Lumen, prospects: Sequence[Prospect], folder: Path) -> list[Path]:
    """Write the table as CSV and JSON, and the map; the files."""
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


def _wire(words: Words, lumen: Lumen) -> Wire:
    """A wire of one material with a magnet at its tip."""
    radius = 0.5 * _read(words, "diameter", "diameter", "--wire")
    modulus = _read(words, "modulus", "pressure", "--youngs-modulus")
    magnet = MAGNET * radius
    if words["magnet"] is not None:
        magnet = _read(words, "magnet", "length", "--magnetized-tip")
    edge = min(max(radius, FINE * lumen.narrowest), magnet)
    room, bend = lumen.narrowest - radius, min(bend.radius for bend in lumen.bend_radius())
    if room > 0.0:
        edge = min(edge, max(FINEST * radius, math.sqrt(8.0 * bend * SAG * room)))
    edges = max(round(TRUNK * magnet / edge), 8)
    return Wire.uniform(
        length=edges * edge,
        radius=radius,
        youngs_modulus=modulus,
        shear_modulus=modulus / (2.0 * (1.0 + POISSON)),
        density=DENSITY,
        nodes=edges + 1,
        magnetized_tip=magnet,
        magnetization=_read(words, "magnetization", "magnetization", "--magnetization"),
    )


def _demands(words: Words, given: Demands) -> Demands:
    """What the field must keep to, with the limit that was asked for."""
    if words["field"] is None:
        return given
    return replace(given, max_field=_read(words, "field", "flux_density", "--max-field"))


def _read(words: Words, name: str, dimension: str, option: str) -> float:
    """A positive quantity of an option."""
    value = parse(words[name] or DEFAULTS.get(name), dimension, option)
    return positive("magwire plan", option, value)
