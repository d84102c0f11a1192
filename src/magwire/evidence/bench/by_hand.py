"""Steps that are given from Python one by one, next to as many in one call of compiled code."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

import numpy as np

from magwire.engine.command import Drive
from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.scenario import load
from magwire.simulation import Simulation

HOW = ("in one call", "one by one", "and observed")
STEP, CALL = 0.01, 1000  # dt [s]; steps of a call
SPEEDS = 0.9e-3, 1.1e-3  # of the guide, in turn [m/s]
GROWTH = 1e-9  # of the field from step to step: other inputs every time, too weak to matter [T]


def stepped(simulation: Simulation, how: str, steps: int) -> Sample:
    """A wire with other feed speed and inputs in every step."""
    speeds = np.resize(SPEEDS, steps)
    inputs = np.zeros((steps, 3))
    inputs[:, 1] = GROWTH * np.arange(steps)
    feed, twist = STEP * np.cumsum(speeds), np.zeros(steps)
    with simulation.session(time_step=STEP) as wire:
        began = time.perf_counter()
        if how == HOW[0]:
            for k in range(0, steps, CALL):
                some = slice(k, k + CALL)
                wire.plant.advance(Drive(feed[some], twist[some], inputs[some], STEP))
        else:
            for speed, wanted in zip(speeds.tolist(), inputs, strict=True):
                wire.step(feed_speed=speed, inputs=wanted, duration=STEP)
                if how == HOW[2]:
                    wire.observe()
        seconds = time.perf_counter() - began
        return {"seconds": seconds, "steps": steps, "tip": wire.observe().tip.tolist()}


def run_by_hand(push: float, repeats: int, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of the table: how the steps are given, samples."""
    simulation = load("half-circle").build().simulation
    steps = round(push * 0.1 / (STEP * float(np.mean(SPEEDS))))
    stepped(simulation, HOW[0], CALL)
    jobs: dict[Hashable, Callable[[], Sample]] = {
        how: partial(stepped, simulation, how, steps) for how in HOW
    }
    samples = interleaved(jobs, repeats, tell)
    return [{"how": how, "samples": samples[how]} for how in HOW]
