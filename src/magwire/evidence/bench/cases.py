"""Marches through the scenarios of the library: stepping alone, and whole runs with a result."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Hashable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.operate import March
from magwire.results import Result
from magwire.scenario import load
from magwire.scenario.job import Job

NAMES = ("half-circle", "half-circle-narrow", "half-circle-wide", "sinusoid", "helix")
SHORT = 0.005  # time steps below this [s] make ten times as many
COUNTS = ("newton_iterations", "factorisations", "retries")


@dataclass(frozen=True)
class Extent:
    """How much is measured.

    ``push`` is the insertion over the wire's length, ``points`` those of a centreline,
    ``branch_points`` those of each of the three branches of a tree.
    """

    push: float
    time_steps: tuple[float, ...]
    nodes: tuple[int, ...]
    points: tuple[int, ...]
    branch_points: tuple[int, ...]


WHOLE = Extent(
    0.72,
    (0.001, 0.003, 0.01, 0.03, 0.1),
    (50, 100, 200, 400, 800, 1600),
    (200, 2_000, 20_000, 100_000),
    (5, 50, 500, 5_000, 33_333),
)
QUICK = Extent(0.3, (0.01, 0.1), (50, 100), (200, 2_000), (50, 500))
TREE = "left-branch"
RUBBING, FRICTION = ("half-circle", "sinusoid", "helix"), 0.1


@dataclass(frozen=True)
class Case:
    """One march: scenario of the library, dt [s], nodes, points of the centreline, friction."""

    name: str
    time_step: float = 0.01
    nodes: int = 100
    points: int = 200
    friction: float = 0.0

    def job(self, push: float) -> Job:
        """The scenario without steering, fed to ``push``."""
        settings = (
            "navigate.method=none",
            f"solver.time_step={self.time_step} s",
            f"wire.nodes={self.nodes}",
            f"lumen.points={self.points}",
            f"feed.distance={push * 100.0} mm",
            f"contact.friction.static={self.friction}",
        )
        return load(self.name, settings).build()


def step(case: Case, push: float) -> Sample:
    """Compiled stepping from X = 0 to the end, without a record; the set-up is timed apart."""
    began = time.perf_counter()
    job = case.job(push)
    system = job.simulation.system
    march = March(system, job.simulation.field, job.feed, time_step=case.time_step)
    _ = system.walls  # the lumen's grid is built when first asked for
    ready = time.perf_counter()
    converged = march.advance(march.steps)
    done = time.perf_counter()
    totals = march.plant.totals
    return {
        "setup": ready - began,
        "seconds": done - ready,
        "simulated": totals.steps * case.time_step,
        "steps": totals.steps,
        **{name: getattr(totals, name) for name in COUNTS},
        "peak": totals.max_tip_force / system.scales.force,
        "converged": converged,
    }


def record(push: float, folder: Path | None) -> Sample:
    """A whole run of the half-circle, with a result file in a folder or with none."""
    job = Case("half-circle").job(push)
    out = folder / "result.nc" if folder else None
    began = time.perf_counter()
    result = job.run(out)
    seconds = time.perf_counter() - began
    if out is not None:
        began = time.perf_counter()
        Result.load(out)
    return {
        "seconds": seconds,
        "reading": time.perf_counter() - began if out else 0.0,
        "records": result.time.size,
        "bytes": out.stat().st_size if out else 0,
    }


def cases(extent: Extent) -> dict[str, list[Case]]:
    """The cases of each table; one that is in several tables is measured once."""
    return {
        "cases": [Case(name, dt) for dt in extent.time_steps for name in NAMES],
        "nodes": [Case("half-circle", nodes=nodes) for nodes in extent.nodes],
        "points": [Case("half-circle", points=points) for points in extent.points],
        "tree": [Case(TREE, points=points) for points in extent.branch_points],
        "friction": [Case(name, friction=mu) for name in RUBBING for mu in (0.0, FRICTION)],
    }


def run_all(extent: Extent, repeats: int, tell: Callable[[str], None]) -> dict[str, Any]:
    """Rows of all tables: what was run, and its samples."""
    tables = cases(extent)
    with tempfile.TemporaryDirectory(prefix="magwire-bench-") as name:
        # What is compared with each other comes close together.
        jobs: dict[Hashable, Callable[[], Sample]] = {"no file": partial(record, extent.push, None)}
        jobs["file"] = partial(record, extent.push, Path(name))
        for table in ("points", "tree", "nodes", "friction", "cases"):
            jobs |= {case: partial(step, case, extent.push) for case in tables[table]}
        tell("warming up")
        warm_up(Path(name))
        slow = {case for case in tables["cases"] if case.time_step < SHORT}
        samples = interleaved(jobs, repeats, tell, slow=slow)
    rows = {
        table: [{**asdict(case), "samples": samples[case]} for case in chosen]
        for table, chosen in tables.items()
    }
    return {
        **rows,
        "writing": {
            "stepping": samples[Case("half-circle")],
            "no_file": samples["no file"],
            "file": samples["file"],
        },
    }


def warm_up(folder: Path) -> None:
    """Load or compile every kernel, and import every library, before anything is timed."""
    step(Case("half-circle"), 0.02)
    for out in (None, folder):
        record(0.02, out)
