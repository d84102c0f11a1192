"""How far a magnet on an arm can steer the sinusoid: a search over its poses that knows no course.

``python -m campaigns.magnet_poses DISTANCE [FEED ...]`` holds the tip in a virtual tube that is
nearly as wide as the lumen, puts the magnet of half-circle-magnet into random poses all around it,
no nearer to the vessel than a distance [mm], and improves each until the tube has nothing to hold
and the smallest eigenvalue without it is positive. It shares the equilibria with the navigator, and
neither its programmes nor the least way: a feed at which none of many poses holds the tip is out of
reach wherever the magnet comes from.
"""

from __future__ import annotations

import sys
from dataclasses import replace

import daqp
import numpy as np
from scipy.linalg import eig_banded

from magwire.actuate import Magnet
from magwire.engine.plant import Plant, Snapshot
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.tube import tube_force
from magwire.navigate.demands import Demands
from magwire.navigate.navigator import Observation
from magwire.navigate.stable import StableNavigator
from magwire.scenario import load

Array = np.ndarray

POSES = 300  # that are tried at a feed
ROUNDS = 60
ROOM, GAP = 2.9e-3, 0.2e-3  # of the tube; it holds the tip from ROOM - GAP on [m]
UNITS = np.array([0.1, 0.1, 0.1, 0.3, 0.3, 0.3])  # of positions [m] and directions
ENOUGH = 100.0  # an eigenvalue that need not be larger [1/s^2]
FREE = 2e-3  # force of the tube that counts as none [EI/L^2]
PRICES = (30.0, 3e4)  # of that force, and of coming too near [1/0.1 m]
PROBE = 1e-3


class Held:
    """A wire with its tip in the tube, and the same wire without."""

    def __init__(self, system: System, magnet: Magnet) -> None:
        self.magnet, smooth = magnet, system.smooth
        length = system.wire.length
        tube = system.new_tube(system.path, GAP)._replace(
            gap=GAP / length, offset=(system.path.narrowest - ROOM) / length
        )
        self.plant, self._free = Plant(smooth, tube=tube), Plant(smooth)
        self._limits = system.step_limits()
        self._force = system.scales.force * length**2 / system.wire.bending_stiffness
        way = system.path.branches[0].curve
        self._vessel = way.at(np.linspace(0.0, way.length, 201))

    def distances(self, pose: Array) -> Array:
        """Of the magnet from the wall [m]."""
        return self.magnet.distance(pose, self._vessel[:, :3]) - self._vessel[:, 3]

    def settle(self) -> bool:
        """Find the equilibrium in the tube."""
        return self.plant.settle(self._limits)[0] is Status.CONVERGED

    def seen(self) -> Array:
        """Smallest eigenvalue without the tube [1/s^2], and the force of the tube [EI/L^2]."""
        force, slope = np.zeros(3), np.zeros((3, 3))
        tube_force(self.plant.model.rod, self.plant.model.tube, self.plant.state, force, slope)
        self._free.restore(self.plant.snapshot())
        return np.append(lowest(self._free), force * self._force)

    def merit(self, seen: Array) -> float:
        """What is to become small."""
        close = max(0.0, self.magnet.keep_out - float(self.distances(self.plant.inputs).min()))
        pressed = PRICES[0] * float(np.linalg.norm(seen[1:])) + PRICES[1] * close / 0.1
        return pressed - min(float(seen[0]), ENOUGH) / 50.0


def lowest(plant: Plant) -> float:
    """Smallest eigenvalue of the tangent against the lumped mass, of either sign [1/s^2]."""
    state, held = plant.state, int(plant.mouth.held)
    last = 4 * (len(state.q) - held + 1) - 1
    still = Motion(0.0, plant.work.target)
    assemble(plant.model, state, plant.mouth, still, plant.work.gradient, plant.work.band)
    rod, rows = plant.model.rod, np.arange(FIRST, last)
    node = held - 1 + rows // 4
    edge = np.minimum(node, len(rod.inertia) - 1)
    root = 1.0 / np.sqrt(np.where(rows % 4 == 3, rod.inertia[edge], rod.mass[node]))
    band = plant.work.band[FIRST:last]
    lower = np.zeros((11, len(rows)))
    for k in range(11):
        lower[k, : len(rows) - k] = band[: len(rows) - k, k] * root[: len(rows) - k] * root[k:]
    found = eig_banded(lower, lower=True, eigvals_only=True, select="i", select_range=(0, 0))
    return float(found[0])


def improve(held: Held) -> Array:
    """Change the pose until neither force nor eigenvalue gets better; what is seen then."""
    plant, trust = held.plant, 0.4
    seen = held.seen()
    for _ in range(ROUNDS):
        pose, before, merit = plant.inputs, plant.snapshot(), held.merit(seen)
        slopes, near = np.zeros((4, 6)), np.zeros((201, 6))
        now = held.distances(pose)
        for k in range(6):
            moved = pose + PROBE * UNITS[k] * np.eye(6)[k]
            near[:, k] = (held.distances(moved) - now) / PROBE
            plant.inputs = moved
            if held.settle():
                slopes[:, k] = (held.seen() - seen) / PROBE
            plant.restore(before)
        nearest = np.argsort(now)[:12]
        room = (now[nearest] - held.magnet.keep_out) / 0.1
        while trust > 2e-3:
            change = programme(seen, slopes, (near[nearest] / 0.1, room), trust)
            pose_then = pose + change * UNITS
            pose_then[3:] /= np.linalg.norm(pose_then[3:])
            plant.inputs = pose_then
            then = held.seen() if held.settle() else None
            if then is not None and held.merit(then) < merit - 1e-6:
                seen, trust = then, min(0.5, 2.0 * trust)
                break
            plant.restore(before)
            trust *= 0.3
        else:
            break
    return seen


def programme(seen: Array, slopes: Array, away: tuple[Array, Array], trust: float) -> Array:
    """Change of a pose, in its units: least force, no nearer, the largest eigenvalue."""
    rows, room = away
    count, force = len(rows), slopes[1:]
    slack = np.eye(3)
    conditions = np.vstack(
        [
            np.hstack([force, -slack, np.zeros((3, 1))]),
            np.hstack([-force, -slack, np.zeros((3, 1))]),
            np.hstack([-rows, np.zeros((count, 3)), -np.ones((count, 1))]),
        ]
    )
    wish = -slopes[0] / 50.0 if seen[0] < ENOUGH else np.zeros(6)
    solution, _, flag, _ = daqp.solve(
        np.diag(np.concatenate([np.full(6, 1e-2), np.full(4, 1e-3)])),
        np.concatenate([wish, np.full(3, PRICES[0]), [PRICES[1]]]),
        np.ascontiguousarray(conditions),
        np.concatenate([np.full(6, trust), np.full(4, 1e3), -seen[1:], seen[1:], room]),
        np.concatenate([np.full(6, -trust), np.zeros(4), np.full(6 + count, -1e30)]),
        np.zeros(16 + count, dtype=np.int32),
    )
    return np.asarray(solution[:6]) if flag > 0 else np.zeros(6)


def tried(held: Held, start: Snapshot, flux: Array, rng: np.random.Generator) -> Array | None:
    """What a random pose comes to: eigenvalue, force, distance [mm] and the pose."""
    plant, magnet = held.plant, held.magnet
    tip = start.state.q[-1, :3] * plant.system.wire.length
    line = rng.normal(size=3)
    line /= np.linalg.norm(line)
    wanted = flux + 0.3 * np.linalg.norm(flux) * rng.normal(size=3)
    pose = magnet.aimed(np.concatenate([tip + line, line]), tip, wanted)
    while held.distances(pose).min() < magnet.keep_out:
        pose[:3] += 2e-3 * line
    plant.restore(start.with_inputs(pose))
    plant.inputs = pose
    if not held.settle():
        return None
    seen = improve(held)
    near = 1e3 * held.distances(plant.inputs).min()
    return np.concatenate([[seen[0], np.linalg.norm(seen[1:]), near], plant.inputs])


def main(distance: float, feeds: list[float]) -> None:
    """Print what is found at each feed [mm]."""
    system = load("sinusoid").build().simulation.system
    seen = load("half-circle-magnet").build().simulation.system.actuator
    assert isinstance(seen, Magnet)
    magnet = replace(seen, keep_out=1e-3 * distance)
    planner = StableNavigator(system, demands=Demands(stability_margin=20.0))
    told = Observation(0.0, np.zeros(3), np.array([1.0, 0.0, 0.0]), goal=0.072, speed=1e-3)
    planner.plan(told, 0.072)
    knots = {round(1e4 * knot.feed): knot for knot in planner._knots}
    held, rng = Held(replace(system, actuator=magnet), magnet), np.random.default_rng(3)
    for feed in feeds:
        knot = knots[round(10.0 * feed)]
        ends = [tried(held, knot.snapshot, knot.flux / 0.95, rng) for _ in range(POSES)]
        kept = np.array([end for end in ends if end is not None and end[2] > distance - 0.1])
        free = kept[:, 1] < FREE
        holds = kept[free & (kept[:, 0] > 0.0)]
        pressed = kept[kept[:, 0] > 0.0][:, 1]
        shaky = kept[kept[:, 1] < 0.1][:, 0]
        print(
            f"{feed:g} mm of feed, {distance:g} mm away: {len(holds)} of {len(kept)} poses hold "
            f"the tip. The tube helps a stable wire with {pressed.min(initial=np.inf):.3g} EI/L^2 "
            f"at least; where it helps with less than 0.1, the largest eigenvalue is "
            f"{shaky.max(initial=-np.inf):.3g} 1/s^2.",
            flush=True,
        )
        for end in holds[np.argsort(-holds[:, 0])][:2]:
            print(f"  {np.round(1e3 * end[3:6], 1)} mm, {np.round(end[6:], 2)}: {end[0]:.4g} 1/s^2")


if __name__ == "__main__":
    main(float(sys.argv[1]), [float(word) for word in sys.argv[2:]] or [60.0, 66.0, 69.0, 72.0])
