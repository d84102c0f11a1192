"""Peak field of the least-field navigator against what is asked for, as a table (P-22).

Writes ``peak_fields.csv`` beside this script; ``draw.py`` makes the figure of it. Each plan is made
in quasi-static motion and replayed open loop in the dynamic simulation (P-23): as it is, and 3
percent too weak and too strong. Takes a few minutes, most of them in the helix.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from magwire.navigate import Prescribed, Schedule
from magwire.scenario import load

FILE = Path(__file__).with_name("peak_fields.csv")
COLUMNS = ("lumen", "tip_clearance", "stability_margin", "peak", "reached", "offset", "free")
CLEARANCES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7)
MARGINS = (0.1, 0.3, 1.0, 3.0, 10.0)
USUAL = (0.4, 1.0)
SCALES = (1.0, 0.97, 1.03)


def asked_for(lumen: str) -> Iterator[tuple[str, float, float]]:
    """Clearances at the usual margin, and margins at the usual clearance, each pair once."""
    pairs = [(clearance, USUAL[1]) for clearance in CLEARANCES]
    pairs += [(USUAL[0], margin) for margin in MARGINS if margin != USUAL[1]]
    for clearance, margin in pairs:
        yield lumen, clearance, margin


def measure(lumen: str, clearance: float, margin: float) -> tuple[object, ...]:
    """One row: peak of B*, push reached, and how the plan fares open loop."""
    keys = (f"navigate.tip_clearance={clearance}", f"navigate.stability_margin={margin} 1/s^2")
    scenario = load(lumen, (*keys, "solver.motion=quasi-static"))
    job = scenario.build()
    planned = job.run()
    peak = float(np.linalg.norm(planned.dataset["normalized_field"].values, axis=1).max())
    reached = float(planned.normalized_push[-1])
    if not planned.converged:
        return lumen, clearance, margin, f"{peak:.1f}", f"{reached:.3f}", "", ""
    schedule = Schedule(planned.feed, planned.dataset["field"].values)
    dynamic = load(lumen, ("navigate.method=none",)).build()
    offset, free = 0.0, True
    for scale in SCALES:
        steered = Prescribed(schedule.scaled(scale))
        run = dynamic.simulation.run(dynamic.feed, steered, time_step=dynamic.time_step)
        free &= run.converged and run.max_tip_force == 0.0
        offset = max(
            offset, float(run.tip_offset.max() / planned.dataset["lumen_radius"].values[0])
        )
    return lumen, clearance, margin, f"{peak:.1f}", f"{reached:.3f}", f"{offset:.3f}", int(free)


def main() -> None:
    """Compute all rows."""
    with FILE.open("w", newline="", encoding="utf-8") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(COLUMNS)
        for lumen in ("half-circle", "sinusoid", "helix"):
            for case in asked_for(lumen):
                table.writerow(measure(*case))
                out.flush()


if __name__ == "__main__":
    main()
