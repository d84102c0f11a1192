"""What an update of the control costs: the navigators alone, without a plant."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

import numpy as np

from magwire.engine.system import System
from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.navigate import NavigationError, Navigator, Observation
from magwire.navigate.newton import NewtonNavigator
from magwire.navigate.paper import PaperNavigator
from magwire.navigate.stable import StableNavigator
from magwire.scenario import load

METHODS = ("paper", "newton", "stable")
NAME = "half-circle"


def navigator(method: str, system: System, every: float) -> Navigator:
    """A navigator that finds one field in each update."""
    if method == "paper":
        return PaperNavigator(system)
    if method == "newton":
        return NewtonNavigator(system, plan_every=every)
    return StableNavigator(system, plan_every=every)


def course(method: str, system: System, update: float, push: float) -> Sample:
    """Updates from X = 0 to the end: time of each, and equilibria solved.

    What is observed plays no part: the wire is where the model has it.
    """
    length = system.wire.length
    steering: Any = navigator(method, system, update * length)
    times, stopped = [], ""
    for number in range(round(push / update)):
        feed, until = number * update * length, (number + 1) * update * length
        seen = Observation(feed, np.zeros(3), np.array([1.0, 0.0, 0.0]))
        began = time.perf_counter()
        try:
            steering.plan(seen, until)
        except NavigationError as error:
            stopped = str(error)
            break
        times.append(time.perf_counter() - began)
    return {
        "updates": len(times),
        "seconds": float(np.median(times)),
        "longest": float(np.max(times)),
        "total": float(np.sum(times)),
        "solves": steering.model.solves,
        "reached": len(times) * update,
        "stopped": bool(stopped),
    }


def run_updates(
    steps: tuple[float, ...], push: float, repeats: int, tell: Callable[[str], None]
) -> list[dict[str, Any]]:
    """Rows of the table: method, update step dX over the wire's length, samples."""
    system = load(NAME).build().simulation.system
    for method in METHODS:
        course(method, system, max(steps), 2.0 * max(steps))
    jobs: dict[Hashable, Callable[[], Sample]] = {
        (step, method): partial(course, method, system, step, push)
        for step in steps
        for method in METHODS
    }
    samples = interleaved(jobs, repeats, tell)
    return [
        {"method": method, "update": step, "samples": samples[step, method]}
        for step in steps
        for method in METHODS
    ]
