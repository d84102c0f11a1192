"""Group 9: another engine, MuJoCo's elastic rod, side by side in one run."""

from __future__ import annotations

import time
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.sampling import sample
from magwire.evidence.verify import mujoco_rod
from magwire.evidence.verify.evidence import NODES, Curve, Line, Skipped
from magwire.field import UniformField
from magwire.kernels.march import Drive, Tally, march
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]
GROUP = "engines"
OLDEST = 4
L, RADIUS, BEND, TUBE = 0.1, 0.6e-3, 0.025, 3.6e-3
PUSH_STEP, SPEED = 0.01, 1e-3
"""Of magwire's push: time step [s] and speed [m/s]."""
MATERIAL = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "density": 2000.0}


def evidence(full: bool) -> Iterator[Line | Curve | Skipped]:
    """Lines and curves of the group; the push takes MuJoCo long, so only if ``full``."""
    missing = _missing()
    if missing:
        for case in ("magnetic cantilever", "half-circle push"):
            yield Skipped(GROUP, case, missing)
        return
    for b, degrees in ((3.0, 90.0), (8.0, 90.0), (3.0, 135.0)) if full else ((3.0, 90.0),):
        yield from _cantilever(b, degrees)
    if full:
        for feed in (0.3, 0.5, 0.7):
            yield from _push(feed)


def _missing() -> str:
    """Why there is nothing to compare with; empty if there is."""
    try:
        found = version("mujoco")
    except PackageNotFoundError:
        return "MuJoCo is not installed; pip install 'magwire[bench]' does it."
    if int(found.split(".")[0]) < OLDEST:
        return f"MuJoCo {found} has no such rod; version {OLDEST} or later is needed."
    return ""


def _wire(length: float, nodes: int) -> Wire:
    stuff: dict[str, Any] = {**MATERIAL, "magnetized_tip": length, "magnetization": 20e3}
    return Wire.uniform(length=length, radius=RADIUS, nodes=nodes, **stuff)


def _cantilever(b: float, degrees: float) -> Iterator[Line | Curve]:
    """A wire magnetised all along, let go straight in a field: 6 s of 10 ms, damped."""
    step, duration = 0.01, 6.0
    wire = _wire(L, NODES)
    size = b * wire.bending_stiffness / (wire.moment_per_length * L**2)
    flux = size * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0])
    theirs = []
    for nodes in (26, 51):
        rod = mujoco_rod.Rod(length=L, nodes=nodes, radius=RADIUS, **MATERIAL)
        couple = (wire.moment_per_length * rod.edge, flux)
        theirs.append(mujoco_rod.settle(rod.model(step), duration, couple=couple))
    edges = np.array([26, 51]) - 1.5
    weight = 1.0 / (1.0 - (edges[0] / edges[1]) ** 2)
    limit = weight * theirs[1].nodes[-1] + (1.0 - weight) * theirs[0].nodes[-1]
    ours, seconds = settle(_wire(L, 51), flux, step, duration)
    source = (
        f"MuJoCo {version('mujoco')}, 26 and 51 nodes extrapolated; with 51 nodes a step takes "
        f"{theirs[1].step_seconds * 1e6:.0f} µs, magwire's {seconds * 1e6:.0f} µs: "
        f"{theirs[1].step_seconds / seconds:.1f} times as long"
    )
    tip = Simulation(wire, Lumen.open_space()).equilibrium(L, flux).tip / L
    case = f"magnetic cantilever, field at {degrees:g}°, b = {b:g}"
    for i, axis in enumerate("xy"):
        yield Line(
            GROUP, case, f"tip {axis}", "L", float(limit[i] / L), source, float(tip[i]), 1e-3
        )  # fmt: skip
    yield Line(
        GROUP, f"{case}, after {duration:g} s", "tip at rest, 51 nodes each", "L", 0.0, source,
        float(np.linalg.norm(theirs[1].nodes[-1] - ours)) / L, 1e-3,
    )  # fmt: skip
    rest = Simulation(wire, Lumen.open_space()).equilibrium(L, flux)
    yield _shapes(case, theirs[1].nodes, rest.positions)


def settle(wire: Wire, flux: Array, step: float, duration: float) -> tuple[Array, float]:
    """Let a straight wire go in a field; it is damped as MuJoCo's is.

    Parameters
    ----------
    wire
        The wire.
    flux
        Uniform flux density, shape (3,) [T].
    step, duration
        Time step, and the time after which to look [s].

    Returns
    -------
    tuple
        Where the tip is, shape (3,) [m], and the wall time that a step took [s].
    """
    sim = Simulation(wire, Lumen.open_space(), damping=mujoco_rod.DAMPING)
    system, rest = sim.system, sim.equilibrium(wire.length)
    state = rest.point.state
    source = UniformField((float(flux[0]), float(flux[1]), float(flux[2])))
    model = system.new_terms(sample(system, source, state))
    steps = round(duration / step)
    limits, work = system.step_limits(), system.new_work()
    tally = Tally(np.zeros(4), np.zeros(3))
    clock = time.perf_counter()
    for count in (1, steps - 1):  # the first step may have to read compiled code
        if count > 1:
            clock = time.perf_counter()
        feed, still = np.ones(count), np.zeros((count, 3))
        drive = Drive(feed, np.zeros(count), still, step, system.damping, True)
        march(model, system.guide, state, work, limits, drive, tally)
    seconds = (time.perf_counter() - clock) / (steps - 1)
    if tally.counts[0] != steps:
        raise RuntimeError("magwire's cantilever did not come to its last step.")
    return state.q[-1, :3] * wire.length, seconds


def _push(feed: float) -> Iterator[Line | Curve]:
    """A wire pushed into the paper's half-circle, its surface against the wall.

    MuJoCo's wire cannot be fed: it has the length that is inside, is laid along the bend and let
    go. It lies in a channel with facets of half a degree and stays in the plane.
    """
    length, nodes, step, duration = feed * L, 26, 3e-4, 3.0
    rod = mujoco_rod.Rod(length=length, nodes=nodes, radius=RADIUS, **MATERIAL)
    model = rod.model(step, flat=True, walls=mujoco_rod.half_circle_walls(BEND, TUBE, 360))
    x = rod.start[:, 0]
    angle = np.clip(x, 0.0, None) / BEND
    begin = rod.start
    begin[:, 0] = np.where(x > 0.0, BEND * np.sin(angle), x)
    begin[:, 1] = BEND * (1.0 - np.cos(angle))
    theirs = mujoco_rod.settle(model, duration, begin=begin)
    ours, steps, seconds = _pushed(length)
    force = ours.plant.system.scales.force
    record = ours.plant.record()
    source = (
        f"MuJoCo {version('mujoco')}, {nodes} nodes, let go in the bend, at rest after "
        f"{theirs.steps} steps of {step * 1e3:g} ms, {theirs.step_seconds * 1e6:.0f} µs each; "
        f"magwire pushes {NODES} nodes there in {steps} steps of {PUSH_STEP * 1e3:g} ms, "
        f"{seconds * 1e6:.0f} µs each"
    )
    case = f"pushed {feed:g} L into the half-circle"
    for i, axis in enumerate("xy"):
        yield Line(
            GROUP, case, f"tip {axis}", "L", float(theirs.nodes[-1, i] / L), source,
            float(record.position[-1, i] / L), 1e-3,
        )  # fmt: skip
    yield Line(
        GROUP, case, "sum of wall forces", "EI/L²", theirs.wall_force / force, source,
        float(np.linalg.norm(record.contact_force, axis=1).sum()) / force, 0.05, relative=True,
    )  # fmt: skip
    yield _shapes(case, theirs.nodes, record.position)


def _pushed(length: float) -> tuple[March, int, float]:
    """A wire pushed so far, with inertia; number of steps, and the time that each took [s]."""
    sim = Simulation(
        _wire(L, NODES),
        Lumen.half_circle(BEND, TUBE),
        contact=Barrier(1e3, 0.02e-3),
        damping=mujoco_rod.DAMPING,
    )
    result = March(sim.system, UniformField(), Feed(SPEED, length), time_step=PUSH_STEP)
    result.advance(1)  # reads compiled code
    clock = time.perf_counter()
    result.advance(result.steps)
    return result, result.steps, (time.perf_counter() - clock) / (result.steps - 1)


def _shapes(case: str, theirs: Array, ours: Array) -> Curve:
    inside = ours[ours[:, 0] > -0.05 * L][:: max(1, NODES // 40)]
    return Curve(
        case[:1].upper() + case[1:],
        "x [L]",
        "y [L]",
        {
            "MuJoCo": (theirs[:, 0] / L, theirs[:, 1] / L, "line"),
            "magwire": (inside[:, 0] / L, inside[:, 1] / L, "points"),
        },
        equal=True,
    )
