"""On what plans hang: python -m campaigns.planner_studies meshes FOLDER | clearances.

``meshes FOLDER``: peak fields [mT] to all outlets of the coronary files of a folder, by the length
of the edges. ``clearances``: peak field in the synthetic arch, by ``tip_clearance``: of the
scenario as it is run, and of plans to all of its outlets. Rows of tables, with the largest peak
over the smallest.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

import magwire as mw
from magwire.cli.errand import Work, of_file, of_scenario
from magwire.scenario import load

EDGES = (0.15e-3, 0.2e-3, 0.25e-3, 0.3e-3)
CLEARANCES = (0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6)
FILES = {
    "coronary_lca_centerlines_multimoda.vtp": {"entrance": (19.2e-3, -188.6e-3, 1751.9e-3)},
    "coronary_721A_centreline_dbihar.vtk": {},
}


def meshed(wire: mw.Wire, edge: float) -> mw.Wire:
    """The wire on edges of a length, its shaft longer or shorter by less than one."""
    count = round(wire.length / edge)
    first = wire.sections[0]
    shaft = replace(first, length=first.length + count * edge - wire.length)
    return mw.Wire((shaft, *wire.sections[1:]), count + 1)


def peak(work: Work, outlet: str) -> tuple[str, float]:
    """What a table says of the way to an outlet, and its peak field [mT]; NaN if not reached."""
    outlets = (outlet,) if work.lumen.outlets else ()
    (found,) = mw.plan(work.lumen, work.wire, demands=work.demands, outlets=outlets)
    if not found.reached:
        return f"no, {1e3 * found.came:.1f} mm", float("nan")
    touch = "" if found.tip_force == 0.0 else f" ({1e3 * found.tip_force:.2g} mN)"
    return f"{1e3 * found.peak_field:.1f}{touch}", 1e3 * found.peak_field


def row(name: str, answers: Sequence[tuple[str, float]]) -> None:
    """Print a row, with the largest peak over the smallest."""
    peaks = [size for _, size in answers]
    ratio = f"{max(peaks) / min(peaks):.3f}" if np.isfinite(peaks).all() else "-"
    print(f"| {name} | {' | '.join(word for word, _ in answers)} | {ratio} |", flush=True)


def meshes(folder: str) -> None:
    """All outlets of the coronary files, by the length of the edges."""
    for file, options in FILES.items():
        words = dict.fromkeys(("field", "modulus", "magnetization", "magnet"))
        work = of_file(Path(folder) / file, "mm", words | {"diameter": "0.6 mm"}, options)
        made = [work._replace(wire=meshed(work.wire, edge)) for edge in EDGES]
        for outlet in work.lumen.outlets:
            row(f"{file.split('_')[1]}, `{outlet}`", [peak(one, outlet) for one in made])


def clearances() -> None:
    """The arch, by how far the tip is to stay from its wall."""
    scenario = load("aortic-arch")
    row("as run", [run(clearance) for clearance in CLEARANCES])
    work = of_scenario(scenario, dict.fromkeys(("diameter", "field")))
    for outlet in work.lumen.outlets:
        demands = [replace(work.demands, tip_clearance=clearance) for clearance in CLEARANCES]
        row(f"`{outlet}`", [peak(work._replace(demands=one), outlet) for one in demands])


def run(clearance: float) -> tuple[str, float]:
    """The scenario, with another clearance of the tip."""
    result = load("aortic-arch", [f"navigate.tip_clearance={clearance}"]).run()
    size = 1e3 * float(np.linalg.norm(result.field, axis=1).max())
    if result.status != "complete":
        return f"{result.status}, {size:.1f}", float("nan")
    touch = "" if result.max_tip_force == 0.0 else f" ({1e3 * result.max_tip_force:.2g} mN)"
    return f"{size:.1f}{touch}", size


if __name__ == "__main__":
    STUDIES: dict[str, Callable[..., None]] = {"meshes": meshes, "clearances": clearances}
    STUDIES[sys.argv[1]](*sys.argv[2:])
