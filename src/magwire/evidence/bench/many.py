"""How runs scale over processes, and over threads of one process for comparison."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Hashable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.many import run_many
from magwire.scenario import Scenario, load


def scenarios(count: int, push: float) -> list[Scenario]:
    """Steered half-circles of slightly different width."""
    return [
        load(
            "half-circle",
            (f"lumen.radius={3.0 + 0.5 * n / count} mm", f"feed.distance={100 * push} mm"),
        )
        for n in range(count)
    ]


def processes(jobs: list[Scenario], workers: int) -> Sample:
    """With the start of the processes."""
    began = time.perf_counter()
    done = run_many(jobs, workers=workers, watch=lambda _: None)
    seconds = time.perf_counter() - began
    return {
        "seconds": seconds,
        "complete": sum(outcome.complete for outcome in done),
        "load": _load(),
    }


def threads(jobs: list[Scenario], workers: int) -> Sample:
    """In this process, which has the kernels loaded."""
    began = time.perf_counter()
    with ThreadPoolExecutor(workers) as pool:
        done = list(pool.map(lambda job: job.run().status, jobs))
    return {
        "seconds": time.perf_counter() - began,
        "complete": done.count("complete"),
        "load": _load(),
    }


def run_side_by_side(
    count: int, push: float, repeats: int, tell: Callable[[str], None]
) -> list[dict[str, Any]]:
    """Rows of the table: how, workers, samples."""
    made = scenarios(count, push)
    jobs: dict[Hashable, Callable[[], Sample]] = {
        (how.__name__, workers): partial(how, made, workers)
        for how in (processes, threads)
        for workers in (1, 2)
    }
    samples = interleaved(jobs, repeats, tell)
    return [
        {"how": how, "workers": workers, "runs": count, "samples": samples[how, workers]}
        for how in ("processes", "threads")
        for workers in (1, 2)
    ]


def _load() -> float:
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
