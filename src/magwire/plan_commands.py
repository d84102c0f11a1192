"""What ``magwire plan`` does: to which outlets a wire gets, as a table, files and a map."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from magwire.contact import Barrier
from magwire.errors import InputError, one_of, positive
from magwire.files import write_whole
from magwire.lumen import Lumen
from magwire.lumen.names import meant
from magwire.lumen_commands import spot
from magwire.navigate.demands import Demands
from magwire.planning import Prospect, plan
from magwire.units import parse
from magwire.vessel import Source, Vessel
from magwire.wire import Wire

if TYPE_CHECKING:
    from magwire.scenario import Scenario

TABLES, MAP = ("plan.csv", "plan.json"), "plan.png"
FINE = 0.2  # edge length at least, over the smallest radius of the lumen
SAG = 0.025  # of an edge in the tightest bend at most, over the least room for the wire
FINEST = 0.5  # edge length at least, over the radius of the wire
MAGNET = 10.0  # length of the magnet, over the radius of the wire, if nothing else is said
TRUNK = 5.0  # length of a wire before it is fitted to its way, over that of its magnet
POISSON = 0.5
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


class Work(NamedTuple):
    """What is to be planned.

    Attributes
    ----------
    lumen, wire
        The lumen, and the wire that goes through it.
    demands, contact
        What the field must keep to, and the wall's barrier; one that fits if None.
    notes
        What was done to the vessel's file, a sentence each.
    vessel
        What the file holds; None for a scenario.
    """

    lumen: Lumen
    wire: Wire
    demands: Demands
    contact: Barrier | None
    notes: tuple[str, ...]
    vessel: Vessel | None


def of_file(source: Source, units: str | None, words: Words, options: dict[str, Any]) -> Work:
    """What to plan for a vessel's file.

    Parameters
    ----------
    source, units, options
        For ``Vessel.read``.
    words
        Texts by name: the wire's ``diameter``, ``modulus``, ``magnetization`` and ``magnet``, and
        the largest ``field``.
    """
    if words["diameter"] is None:
        raise InputError(
            "Input --wire must be the wire's diameter, such as '0.6 mm'; received none."
        )
    _read(words, "diameter", "diameter", "--wire")  # better said before the file is read
    vessel = Vessel.read(source, units, **options)
    lumen = vessel.lumen()
    demands = _demands(words, Demands())
    return Work(lumen, _wire(words, lumen), demands, None, vessel.record(), vessel)


def of_scenario(scenario: Scenario, words: Words) -> Work:
    """What to plan for a scenario: its lumen, its wire, its wall, and its steering's demands."""
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
    return Work(lumen, wire, demands, system.contact, scenario.notes, None)


def outlets(work: Work, targets: Sequence[str]) -> tuple[str, ...]:
    """The outlets that are asked for, each once; all of them if none is."""
    known = work.lumen.outlets
    if not targets or not known:
        return known or ("outlet",)
    if work.vessel is not None:
        found = [work.vessel.outlet(spot(target, "--target")) for target in targets]
        return tuple(dict.fromkeys(name for name in found if name is not None))
    names = (one_of("magwire plan", "--target", meant(name, known), known) for name in targets)
    return tuple(dict.fromkeys(names))


def carried_out(work: Work, names: Sequence[str]) -> Iterator[Prospect]:
    """Plan for one outlet after the other."""
    for name in names:
        yield from plan(
            work.lumen,
            work.wire,
            demands=work.demands,
            contact=work.contact,
            outlets=(name,) if work.lumen.outlets else (),
        )


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
