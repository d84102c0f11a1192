"""Tables of numbers: wall forces without and with a field, and schedules that are replayed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from magwire.evidence.reproduce.active_claims import NAMES
from magwire.evidence.reproduce.outcome import Outcome
from magwire.evidence.reproduce.page import Table
from magwire.evidence.reproduce.runs import REPLAYS, Run

TUBES = {"stable": "none", "newton": "planner only", "paper": "planner only"}
"""Where there is a virtual tube; the plant never has one."""
REDUCTION = (
    "lumen",
    "steering",
    "virtual tube",
    "up to X",
    "tip, peak [mN]",
    "tip, ∫F dt [mN s]",
    "whole wire, peak [mN]",
    "whole wire, ∫F dt [mN s]",
)
PACE = (
    "lumen",
    "steering",
    "update, median [ms]",
    "update, longest [s]",
    "run, dynamic",
    "run, quasi-static",
)


def reduction_rows(
    lumen: str, passive: Outcome, steered: Mapping[str, Outcome]
) -> list[tuple[str, ...]]:
    """How much less the wall bears with a field, a row for each navigator.

    A run that stops is compared with the passive one up to where it stops.
    """
    rows: list[tuple[str, ...]] = []
    for name, run in steered.items():
        end = float(run.push[-1])
        base = passive.until(end)
        rows.append(
            (
                lumen,
                NAMES[name],
                TUBES[name],
                f"{end:.3f}" + ("" if run.complete else " (stops)"),
                _change(base.peak, run.peak),
                _change(_impulse(base, tip=True), _impulse(run, tip=True)),
                _change(float(base.wall_force.max()), float(run.wall_force.max())),
                _change(_impulse(base, tip=False), _impulse(run, tip=False)),
            )
        )
    return rows


def replay_row(
    lumen: str, source: Outcome, replays: Mapping[str, Outcome], radius: float
) -> tuple[str, ...]:
    """How a schedule of the least field fares when nobody watches, in a lumen of a radius [m]."""
    if not source.complete:
        return (lumen, *("no schedule to the end" for _ in REPLAYS))
    return (lumen, *(_fate(run, radius) for run in replays.values()))


def reduction_table(rows: list[tuple[str, ...]]) -> Table:
    """The table of wall forces."""
    return Table(REDUCTION, tuple(rows))


def pace_table(made: Mapping[tuple[str, str], tuple[Run, Run | None]]) -> Table:
    """Times of navigators, from runs in dynamic and in quasi-static motion by lumen and method."""
    rows = []
    for (lumen, method), (run, plan) in made.items():
        spent = np.array(run.plans)
        rows.append(
            (
                lumen,
                NAMES[method],
                f"{1e3 * float(np.median(spent)):.2f}",
                f"{float(spent.max()):.2g}",
                _pace(run),
                "-" if plan is None else _pace(plan),
            )
        )
    return Table(PACE, tuple(rows))


def _pace(run: Run) -> str:
    return f"{run.outcome.pace:.3f}" + ("" if run.outcome.complete else " (stops)")


def replay_table(rows: list[tuple[str, ...]]) -> Table:
    """The table of replays."""
    return Table(("lumen", *(replay.name for replay in REPLAYS)), tuple(rows))


def _fate(run: Outcome, radius: float) -> str:
    if run.contact_free:
        return f"free, tip within {float(run.offset.max(initial=0.0)) / radius:.2f} R"
    if not run.complete:
        return f"{run.status} at X = {run.push[-1]:.3f}"
    first = run.contacts()
    where = f" from X = {first[0][0]:.3f} on" if first else ""
    return f"touches{where}, F* up to {run.largest:.1f}"


def _impulse(run: Outcome, *, tip: bool) -> float:
    """Force over time [N s]."""
    force = run.tip_force if tip else run.wall_force
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(run.time)))


def _change(before: float, after: float) -> str:
    numbers = f"{_milli(before)} → {_milli(after)}"
    if before == 0.0:
        return numbers
    change = 100.0 * (after / before - 1.0)
    if after > 0.0:  # -100 % is said of nothing but zero
        change = max(change, -99.9)
    digits = 1 if -100.0 < change < -99.0 else 0
    return f"{numbers} ({change:+.{digits}f}\u00a0%)"


def _milli(newtons: float) -> str:
    return f"{1e3 * newtons:.3g}"
