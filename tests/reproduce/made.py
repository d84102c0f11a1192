"""Made-up runs, as numbers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from magwire.evidence.reproduce.outcome import Outcome

UNIT = 3.054e-5
PUSH = np.linspace(0.0, 0.72, 721)


def outcome(force: Any = 0.0, field: Any = 0.0, **changes: Any) -> Outcome:
    """A run whose normalised tip force and field are given as numbers or functions of the push."""
    values = force(PUSH) if callable(force) else np.full(len(PUSH), float(force))
    across = field(PUSH) if callable(field) else np.full(len(PUSH), float(field))
    tip = UNIT * values
    run = Outcome(
        time=100.0 * PUSH,
        push=PUSH,
        tip_force=tip,
        wall_force=2.0 * tip,
        peak=float(tip.max()),
        field=np.column_stack([across, 0.0 * across, 0.0 * across]),
        offset=np.full(len(PUSH), 1e-5),
        unit=UNIT,
        pace=0.01,
    )
    return replace(run, **changes)


def stopped(run: Outcome, push: float) -> Outcome:
    """The same run as it would be if its navigator had stopped."""
    return replace(run.until(push), status="no field", message="At 30 mm there is no field.")
