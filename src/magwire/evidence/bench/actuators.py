"""What the field of coils costs: at points along a wire, and in its time steps."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from magwire.actuate import MPEM, Actuator, Box, Helmholtz, Pair, Pose
from magwire.actuate.calibration.multipoles import Calibration, CoilSources, Source
from magwire.engine.command import Drive
from magwire.engine.plant import Plant
from magwire.engine.system import System
from magwire.evidence.bench.repeats import Sample, interleaved
from magwire.kernels.sources.drive import drive
from magwire.kernels.sources.sample import sample_jets
from magwire.kernels.sources.table import new_strength
from magwire.scenario import load

POINTS, CALLS = 100, 200
STEP = 0.01  # dt [s]
WEAK = 1e-3  # inputs, too weak to matter [A]
MIDDLE = (0.0125, 0.025, 0.0)  # of the half-circle [m]
RADII = (0.08, 0.10, 0.12)  # of the pairs [m]


def eight_coils() -> MPEM:
    """Eight coils of 33 dipoles in all, as many as the calibration of OctoMag has."""
    coils: list[CoilSources] = []
    for k in range(8):
        turn, height = 0.25 * np.pi * k, 0.5 if k % 2 else -0.2
        axis = np.array([np.cos(turn), np.sin(turn), height])
        axis /= np.linalg.norm(axis)
        count = 5 if k == 0 else 4
        places = [(0.09 + 0.01 * n) * axis for n in range(count)]
        x, y, z = (-axis).tolist()
        sources = tuple(
            Source((a, b, c), (x, y, z), (1e-6,), ()) for a, b, c in np.array(places).tolist()
        )
        coils.append(CoilSources(f"Coil_{k}", sources))
    box = Box((-0.06,) * 3, (0.06,) * 3)
    calibration = Calibration("eight coils", tuple(coils), (), box)
    return MPEM(calibration=calibration, pose=Pose(translation=MIDDLE))


def helmholtz() -> Helmholtz:
    """Thin loops on three axes."""
    pairs = tuple(Pair(axis, radius, 200.0) for axis, radius in zip("xyz", RADII, strict=True))
    return Helmholtz(pairs=pairs, pose=Pose(translation=MIDDLE))


MADE: dict[str, Callable[[], Actuator]] = {
    "8 coils, 33 dipoles": eight_coils,
    "Helmholtz, 3 axes": helmholtz,
}


def asked(actuator: Actuator) -> Sample:
    """Flux density, gradient and second derivatives at points along the half-circle."""
    system = load("half-circle").build().simulation.system
    curve = system.path.branches[0].curve
    points = np.ascontiguousarray(curve.at(np.linspace(0.0, 0.9 * curve.length, POINTS))[:, :3])
    sources = actuator.arrays()
    strength, made = new_strength(sources), np.empty((POINTS, 30))
    drive(sources, np.ones(len(actuator.inputs)), strength)
    sample_jets(sources, strength, points, made)
    began = time.perf_counter()
    for _ in range(CALLS):
        sample_jets(sources, strength, points, made)
    return {"seconds": (time.perf_counter() - began) / CALLS}


def marched(system: System, push: float) -> Sample:
    """Passive steps of a wire, with inputs that are there and too weak to matter."""
    plant = Plant(system)
    steps = round(push * system.wire.length / (1e-3 * STEP))
    feed = np.linspace(0.0, push * system.wire.length, steps + 1)[1:]
    inputs = np.full((steps, len(plant.inputs)), WEAK if system.actuator else 0.0)
    began = time.perf_counter()
    done = plant.advance(Drive(feed, np.zeros(steps), inputs, STEP))
    seconds = time.perf_counter() - began
    return {"seconds": seconds / max(done, 1), "steps": done}


def run_actuators(push: float, repeats: int, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of the table: what makes the field, samples of points and of steps."""
    uniform = load("half-circle").build().simulation.system
    made = {name: make() for name, make in MADE.items()}
    systems = {"uniform": uniform}
    systems |= {name: replace(uniform, actuator=one) for name, one in made.items()}
    for system in systems.values():
        marched(system, 0.01)
    steps: dict[Hashable, Callable[[], Sample]] = {
        name: partial(marched, system, push) for name, system in systems.items()
    }
    points: dict[Hashable, Callable[[], Sample]] = {
        name: partial(asked, one) for name, one in made.items()
    }
    along, at = interleaved(steps, repeats, tell), interleaved(points, repeats, tell)
    return [{"what": name, "samples": along[name], "points": at.get(name, [])} for name in systems]
