"""The paper's figure of computing time: (A) against the time step, (B) against the update step."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.scenario import load

NAME = "half-circle"
FEW = "output.record_every=1 mm"


def whole(push: float, update: float) -> Sample:
    """A run steered by the paper's optimiser, with plant, records and result."""
    job = load(
        NAME,
        (
            "navigate.method=paper",
            f"navigate.update_every={100.0 * update:g} mm",
            f"feed.distance={100.0 * push:g} mm",
            FEW,
        ),
    ).build()
    began = time.perf_counter()
    result = job.run()
    return {
        "seconds": time.perf_counter() - began,
        "simulated": float(result.time[-1]),
        "contact_free": result.contact_free,
        "complete": result.status == "complete",
    }


def run_steered(
    updates: tuple[float, ...], push: float, repeats: int, tell: Callable[[str], None]
) -> list[dict[str, Any]]:
    """Rows of part (B): update step, samples."""
    jobs: dict[Hashable, Callable[[], Sample]] = {
        step: partial(whole, push, step) for step in updates
    }
    samples = interleaved(jobs, repeats, tell)
    return [{"update": step, "samples": samples[step]} for step in updates]
