"""Time the steps of two checkouts side by side, and compare where the wires are.

    python tests/campaigns/compare_speed.py OLD NEW [--repeats 5] [--only NAME ...] [--dt 0.01]

OLD and NEW are checkouts of magwire; the Python that runs this must have magwire's dependencies.
Both stay open in an interpreter each and do the same jobs in turn, OLD first in every other repeat:
what slows the machine down meets both. Jobs: passive marches through scenarios of the library, and
the first second of the magnetic cantilever. Prints for each job the processor time of a step
(least of the repeats), their ratio, Newton iterations and factorisations a step, and how far
apart the nodes and the tip forces are.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

CANTILEVER = "cantilever"
JOBS = ("half-circle", "sinusoid", "helix", CANTILEVER)
PUSH = 72.0  # mm


def plant_of(name: str, dt: float) -> tuple[Any, Any]:
    """A plant at the start of a job, and its drive."""
    from magwire.engine.command import Drive
    from magwire.engine.plant import Plant
    from magwire.evidence.bench.engines import across, wire
    from magwire.evidence.verify.mujoco_rod import DAMPING
    from magwire.field import UniformField
    from magwire.lumen import Lumen
    from magwire.operate import March
    from magwire.scenario import load
    from magwire.simulation import Simulation

    if name == CANTILEVER:
        made = wire()
        sim = Simulation(made, Lumen.open_space(), damping=DAMPING)
        source = UniformField(tuple(across(made).tolist()))
        plant = Plant(sim.system, source, feed=made.length)
        steps = round(1.0 / dt)
        still = np.full(steps, made.length)
        return plant, Drive(still, np.zeros(steps), np.zeros((steps, 3)), dt)
    settings = (
        "navigate.method=none",
        f"solver.time_step={dt} s",
        f"feed.distance={PUSH} mm",
    )
    job = load(name, settings).build()
    march = March(job.simulation.system, job.simulation.field, job.feed, time_step=dt)
    return march, None


def serve() -> None:
    """Do jobs as they are asked for on standard input; one line of JSON each."""
    import time

    for line in sys.stdin:
        name, dt = json.loads(line)
        plant, drive = plant_of(name, dt)
        _ = plant.system.walls if drive is not None else plant.plant.system.walls
        began = time.process_time()
        if drive is None:
            plant.advance(plant.steps)
        else:
            plant.advance(drive)
        seconds = time.process_time() - began
        plant = plant if drive is not None else plant.plant
        totals = plant.totals
        answer = {
            "seconds": seconds,
            "steps": totals.steps,
            "iterations": totals.newton_iterations,
            "factorisations": totals.factorisations,
            "retries": totals.retries,
            "peak": totals.max_tip_force,
            "mean": totals.mean_tip_force,
            "nodes": (plant.state.q[1:, :3] * plant.system.wire.length * 1e3).tolist(),
        }
        print(json.dumps(answer), flush=True)


class Build:
    """An interpreter that runs a checkout."""

    def __init__(self, checkout: Path) -> None:
        environment = {**os.environ, "PYTHONPATH": str(checkout.resolve() / "src")}
        self._process = subprocess.Popen(
            [sys.executable, str(Path(__file__).resolve()), "--serve"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )

    def do(self, name: str, dt: float) -> dict[str, Any]:
        """The answer to a job."""
        sent, back = self._process.stdin, self._process.stdout
        assert sent is not None
        assert back is not None
        print(json.dumps((name, dt)), file=sent, flush=True)
        line = back.readline()
        if not line:
            raise SystemExit(f"{name}: the interpreter ended")
        answer: dict[str, Any] = json.loads(line)
        return answer

    def close(self) -> None:
        """Let the interpreter end."""
        self._process.communicate()


def compare(name: str, old: list[dict[str, Any]], new: list[dict[str, Any]]) -> str:
    """A line about a job."""
    a, b = old[0], new[0]
    step = [min(s["seconds"] / s["steps"] for s in kind) for kind in (old, new)]
    apart = np.abs(np.array(a["nodes"]) - np.array(b["nodes"])).max()
    force = abs(b["peak"] - a["peak"]) / a["peak"] if a["peak"] else 0.0
    mean = abs(b["mean"] - a["mean"]) / a["mean"] if a["mean"] else 0.0
    counts = [
        f"{s['iterations'] / s['steps']:.2f}/{s['factorisations'] / s['steps']:.2f}" for s in (a, b)
    ]
    return (
        f"{name:20s} {1e3 * step[0]:8.4f} {1e3 * step[1]:8.4f} ms {step[0] / step[1]:6.2f} x   "
        f"iterations/factors {counts[0]} -> {counts[1]}   "
        f"retries {a['retries']:.0f} -> {b['retries']:.0f}   "
        f"apart {apart:.1e} mm   forces {force:.1e} peak, {mean:.1e} mean"
    )


def main() -> int:
    """Compare."""
    if sys.argv[1:] == ["--serve"]:
        serve()
        return 0
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", nargs="*", default=JOBS)
    parser.add_argument("--dt", type=float, default=0.01, help="time step [s]")
    options = parser.parse_args()
    builds = [Build(options.old), Build(options.new)]
    for name in options.only:
        for build in builds:
            build.do(name, options.dt)  # compiles
        answers: list[list[dict[str, Any]]] = [[], []]
        for repeat in range(options.repeats):
            for k in (0, 1) if repeat % 2 == 0 else (1, 0):
                answers[k].append(builds[k].do(name, options.dt))
        print(compare(name, *answers), flush=True)
    for build in builds:
        build.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
