"""Measure magwire: one run, one thread, repeats interleaved (A B C A B C ...)."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

REPEATS = 5
UPDATES = (0.0025, 0.005, 0.01, 0.02)
STEERED = (0.0025, 0.005, 0.02)
SIDE_BY_SIDE = 24


def measure(
    *, repeats: int = REPEATS, quick: bool = False, tell: Callable[[str], None]
) -> dict[str, Any]:
    """All samples of all tables.

    Parameters
    ----------
    repeats
        How often each thing is measured; what takes long, less often.
    quick
        Show that it works: one repeat of a short feed, and only some of the tables in full.
    tell
        Called with what is being measured.
    """
    import numba

    from magwire.evidence.bench import (
        actuators,
        by_hand,
        cases,
        driving,
        engines,
        learning,
        many,
        paper,
        updates,
    )
    from magwire.evidence.bench.machine import load_average, machine
    from magwire.evidence.bench.starts import run_memory, run_starts

    numba.set_num_threads(1)
    extent = cases.QUICK if quick else cases.WHOLE
    count, few = (1, 1) if quick else (repeats, min(repeats, 3))
    began, before = time.perf_counter(), load_average()
    results = cases.run_all(extent, count, tell)
    results["by_hand"] = by_hand.run_by_hand(0.1 if quick else 0.5, count, tell)
    results["actuators"] = actuators.run_actuators(0.1 if quick else extent.push, count, tell)
    results["updates"] = updates.run_updates(
        UPDATES[1:2] if quick else UPDATES, 0.2 if quick else extent.push, few, tell
    )
    results["steered"] = paper.run_steered(
        STEERED[1:2] if quick else STEERED, 0.1 if quick else extent.push, few, tell
    )
    results["starts"] = run_starts(count, quick=quick, tell=tell)
    results["memory"] = run_memory(("half-circle",) if quick else ("half-circle", "helix"), tell)
    results["many"] = (
        [] if quick else many.run_side_by_side(SIDE_BY_SIDE, extent.push, min(few, 2), tell)
    )
    results["engines"] = [] if quick else engines.run_engines(min(few, 2), tell)
    results["learning"] = [] if quick else learning.run_learning(min(few, 3), tell)
    results["driving"] = [] if quick else driving.run_driving(tell)
    settings = {
        "repeats": count,
        "push": extent.push,
        "quick": quick,
        "load_average": [before, load_average()],
        "total_seconds": time.perf_counter() - began,
    }
    return {"machine": machine(), "settings": settings, **results}
