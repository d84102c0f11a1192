"""MuJoCo and PyElastica on the same jobs: a step's time, and where the wire comes to rest.

The same is asked of all: the magnetic cantilever, magnetised all along, let go straight in a field
across it, and the wire pressed into the half-circle. What settles is damped alike, against the
velocities. An engine that is not installed is left out.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Hashable
from contextlib import redirect_stdout
from functools import partial
from importlib.util import find_spec
from typing import Any

import numpy as np

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.evidence.bench import elastica_rod
from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.evidence.verify import mujoco_rod
from magwire.evidence.verify.engines import settle
from magwire.evidence.verify.mujoco_rod import DAMPING
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire

LENGTH, RADIUS, BEND, TUBE = 0.1, 0.6e-3, 25e-3, 3e-3
MATERIAL: dict[str, Any] = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "density": 2000.0}
MAGNETIZATION, FIELD = 20e3, 4.0  # [A/m]; flux density, in EI/(M L^2)
PUSH = 0.72
NODES, COARSE = 100, 26  # MuJoCo's constraints are too stiff for more nodes against the wall
STEP, SHORT_STEP = 0.01, 3e-4  # dt [s]; MuJoCo's against the wall
DURATION, PRESSING = 6.0, 3.0  # until all is at rest [s]
CANTILEVER, PRESSED = "magnetic cantilever", f"half-circle, X = {PUSH:g}"


def wire() -> Wire:
    """The cantilever's wire."""
    return Wire.uniform(
        length=LENGTH,
        radius=RADIUS,
        nodes=NODES,
        magnetized_tip=LENGTH,
        magnetization=MAGNETIZATION,
        **MATERIAL,
    )


def across(made: Wire) -> np.ndarray[Any, np.dtype[np.float64]]:
    """The cantilever's field, across the wire [T]."""
    size = FIELD * made.bending_stiffness / (made.moment_per_length * made.length**2)
    return np.array([0.0, size, 0.0])


def cantilever_here() -> Sample:
    """The cantilever by magwire: time steps until it rests."""
    made = wire()
    tip, seconds = settle(made, across(made), STEP, DURATION)
    return _sample(seconds, tip)


def _sample(seconds: float, tip: Any) -> Sample:
    return {
        "seconds": float(seconds),
        "tip_x": float(tip[0]) / LENGTH,
        "tip_y": float(tip[1]) / LENGTH,
    }


def cantilever_mujoco(nodes: int) -> Sample:
    """The cantilever by MuJoCo."""
    made = wire()
    rod = mujoco_rod.Rod(length=LENGTH, nodes=nodes, radius=RADIUS, **MATERIAL)
    couple = (made.moment_per_length * rod.edge, across(made))
    done = mujoco_rod.settle(rod.model(STEP), DURATION, couple=couple)
    return _sample(done.step_seconds, done.nodes[-1])


def cantilever_elastica() -> Sample:
    """The cantilever by PyElastica."""
    made = wire()
    shape = {"length": LENGTH, "radius": RADIUS, **MATERIAL}
    couple = (made.moment_per_length, across(made))
    with redirect_stdout(sys.stderr):  # it may remark on small inertias
        tip, seconds, _ = elastica_rod.cantilever(shape, NODES, DURATION, DAMPING, couple)
    return _sample(seconds, tip)


def pressed_here() -> Sample:
    """The push into the half-circle by magwire: all steps of it, and the equilibrium at its end."""
    made = Wire.uniform(length=LENGTH, radius=RADIUS, nodes=NODES, **MATERIAL)
    sim = Simulation(made, Lumen.half_circle(BEND, TUBE), contact=Barrier(1e3, 0.02e-3))
    course = March(sim.system, sim.field, Feed(1e-3, PUSH * LENGTH), time_step=STEP)
    began = time.perf_counter()
    course.advance(course.steps)
    seconds = (time.perf_counter() - began) / course.steps
    return _sample(seconds, sim.equilibrium(PUSH * LENGTH).tip)


def pressed_mujoco() -> Sample:
    """The wire laid along the half-circle's centreline and let go, by MuJoCo."""
    rod = mujoco_rod.Rod(length=PUSH * LENGTH, nodes=COARSE, radius=RADIUS, **MATERIAL)
    walls = mujoco_rod.half_circle_walls(BEND, TUBE, 360)
    model = rod.model(SHORT_STEP, flat=True, walls=walls)
    begin = rod.start
    x = begin[:, 0].copy()
    angle = np.clip(x, 0.0, None) / BEND
    begin[:, 0] = np.where(x > 0.0, BEND * np.sin(angle), x)
    begin[:, 1] = BEND * (1.0 - np.cos(angle))
    done = mujoco_rod.settle(model, PRESSING, begin=begin)
    return _sample(done.step_seconds, done.nodes[-1])


def run_engines(repeats: int, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of the table: job, engine, nodes, time step, samples."""
    explicit = elastica_rod.time_step(
        LENGTH, NODES, MATERIAL["youngs_modulus"], MATERIAL["density"]
    )
    rows: list[tuple[str, str, int, float, Callable[[], Sample]]] = [
        (CANTILEVER, "magwire", NODES, STEP, cantilever_here)
    ]
    mujoco = find_spec("mujoco") is not None
    if mujoco:
        rows += [
            (CANTILEVER, "MuJoCo", nodes, STEP, partial(cantilever_mujoco, nodes))
            for nodes in (51, NODES)
        ]
    if find_spec("elastica") is not None:
        rows.append((CANTILEVER, "PyElastica", NODES, explicit, cantilever_elastica))
    rows.append((PRESSED, "magwire", NODES, STEP, pressed_here))
    if mujoco:
        rows.append((PRESSED, "MuJoCo", COARSE, SHORT_STEP, pressed_mujoco))
    jobs: dict[Hashable, Callable[[], Sample]] = {row[:3]: row[4] for row in rows}
    slow = {row[:3] for row in rows if row[1] == "PyElastica"}
    samples = interleaved(jobs, repeats, tell, slow=slow)
    return [
        {
            "job": job,
            "engine": engine,
            "nodes": nodes,
            "time_step": step,
            "samples": samples[job, engine, nodes],
        }
        for job, engine, nodes, step, _ in rows
    ]
