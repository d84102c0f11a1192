"""Environments of Gymnasium: steps a second with contact, in a batch and alone, and resets.

An action is one step of 10 ms; inputs change by up to 0.5 mT and the feed turns round at random.
Deep: between 50 and 70 mm of feed in the half-circle, in contact. Whole episodes: from the mouth to
the goal, and again. MuJoCo's ``rollout`` has a rod of as many nodes in a channel of the same
half-circle, observes nothing and rewards nothing, and takes as many of its own steps as 10 ms have;
they are as long as its constraints allow with so many nodes: those of the table of other engines,
times its nodes over these.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from functools import partial
from importlib.util import find_spec
from typing import Any

import numpy as np

from magwire.evidence.bench.repeats import Sample, interleaved

WIRES, DEEP_STEPS, LONG_STEPS = 64, 150, 1500
NEAR, FAR = 50e-3, 70e-3  # feeds between which it goes [m]
TURNS = 0.05  # how likely the feed turns round in a step
DT, CONTROL = 7e-5, 0.01  # MuJoCo's step; an action [s]
MUJOCO_STEPS = 40
FED = 6  # the number of an observation that is the feed, over what is far


def options(*, deep: bool) -> dict[str, Any]:
    """Fields of the task."""
    return {
        "scenario": "half-circle",
        "action_time": CONTROL,
        "input_rate": 0.05,
        "actions": 10**6 if deep else 1500,
        "goal": 2.0 if deep else 0.95,
        "starts": (NEAR, 55e-3, 60e-3, 65e-3, FAR) if deep else (0.0,),
    }


class Driver:
    """Actions: inputs at random, a feed that turns round at random and at the ends."""

    def __init__(self, wires: int, *, deep: bool) -> None:
        self._chance = np.random.default_rng(0)
        self._speed = np.ones(wires)
        self._deep = deep

    def actions(self, feeds: Any) -> Any:
        """Of all wires, shape (n, 5)."""
        made = self._chance.uniform(-1.0, 1.0, (len(feeds), 5))
        if self._deep:
            turned = self._chance.random(len(feeds)) < TURNS
            self._speed = np.where(turned, -self._speed, self._speed)
            self._speed = np.where(feeds > FAR, -1.0, np.where(feeds < NEAR, 1.0, self._speed))
        made[:, 0] = self._speed
        return made.astype(np.float32)


def batch(threads: int, *, deep: bool, steps: int) -> Sample:
    """Steps a second of a vector environment."""
    from magwire.env import WireVectorEnv

    env = WireVectorEnv(WIRES, autoreset_mode="SameStep", threads=threads, **options(deep=deep))
    seen, _ = env.reset(seed=0)
    driver = Driver(WIRES, deep=deep)
    wires = env.episodes.batch
    far = wires.observe().feed.max() / max(float(seen[:, FED].max()), 1e-6)
    before = _iterations(wires)
    began = time.perf_counter()
    for _ in range(steps):
        seen = env.step(driver.actions(far * seen[:, FED]))[0]
    seconds = time.perf_counter() - began
    count = WIRES * steps
    newton = (_iterations(wires) - before) / count if deep else float("nan")
    env.close()
    return {"rate": count / seconds, "newton": newton}


def alone(steps: int) -> Sample:
    """Steps a second of a single environment, deep in contact."""
    from magwire.env import WireEnv

    env = WireEnv(**options(deep=True))
    seen, _ = env.reset(seed=0)
    driver, wires = Driver(1, deep=True), env.episodes.batch
    far = wires.observe().feed[0] / seen[FED]
    before = _iterations(wires)
    began = time.perf_counter()
    for _ in range(steps):
        seen = env.step(driver.actions(far * seen[None, FED])[0])[0]
    seconds = time.perf_counter() - began
    return {"rate": steps / seconds, "newton": (_iterations(wires) - before) / steps}


def resets(count: int, *, new: bool) -> Sample:
    """Resets a second of a single environment: of a known anatomy, or each of a new random one."""
    from magwire.env import WireEnv
    from magwire.env.ids import options_of

    env = WireEnv(**options_of("RandomVessel")) if new else WireEnv(**options(deep=False))
    env.reset(seed=0)
    began = time.perf_counter()
    for _ in range(count):
        env.reset()
    seconds = time.perf_counter() - began
    return {"rate": count / seconds, "newton": float("nan")}


def _iterations(wires: Any) -> int:
    return sum(wires.plant(i).totals.newton_iterations for i in range(len(wires)))


def mujoco(threads: int) -> Sample:
    """Actions a second of MuJoCo's rollout."""
    import mujoco
    from mujoco import rollout

    from magwire.evidence.bench.engines import BEND, LENGTH, MATERIAL, NODES, PUSH, RADIUS, TUBE
    from magwire.evidence.verify import mujoco_rod

    rod = mujoco_rod.Rod(length=PUSH * LENGTH, nodes=NODES, radius=RADIUS, **MATERIAL)
    walls = mujoco_rod.half_circle_walls(BEND, TUBE, 360)
    model = rod.model(DT, flat=True, walls=walls)
    data = [mujoco.MjData(model) for _ in range(threads)]
    _lay(model, data[0], rod.start, BEND)
    size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    first = np.zeros(size)
    mujoco.mj_getState(model, data[0], first, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    states = np.tile(first, (WIRES, 1))
    began = time.perf_counter()
    with rollout.Rollout(nthread=threads) as pool:
        pool.rollout(model, data, states, nstep=MUJOCO_STEPS)
    seconds = time.perf_counter() - began
    return {"rate": WIRES * MUJOCO_STEPS * DT / CONTROL / seconds, "newton": float("nan")}


def _lay(model: Any, data: Any, nodes: Any, bend: float) -> None:
    """Lay the straight rod along the half-circle's centreline."""
    import mujoco

    mujoco.mj_forward(model, data)
    bodies = model.flex_vertbodyid
    free = np.flatnonzero(bodies > 0)
    joints = model.body_jntadr[bodies[free]][:, None] + np.arange(2)
    angle = np.clip(nodes[:, 0], 0.0, None) / bend
    there = nodes.copy()
    there[:, 0] = np.where(nodes[:, 0] > 0.0, bend * np.sin(angle), nodes[:, 0])
    there[:, 1] = bend * (1.0 - np.cos(angle))
    data.qpos[model.jnt_qposadr[joints]] = (there - data.flexvert_xpos)[free, :2]


def run_learning(repeats: int, tell: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of the table: what, threads, samples; none without Gymnasium."""
    if find_spec("gymnasium") is None:
        return []
    deep, whole = f"batch of {WIRES}, 50 to 70 mm", f"batch of {WIRES}, whole episodes"
    rows: list[tuple[str, int, Callable[[], Sample]]] = [
        (deep, threads, partial(batch, threads, deep=True, steps=DEEP_STEPS)) for threads in (1, 2)
    ]
    rows += [
        (whole, 2, partial(batch, 2, deep=False, steps=LONG_STEPS)),
        ("one alone, 50 to 70 mm", 1, partial(alone, 20 * DEEP_STEPS)),
        ("resets, known anatomy", 1, partial(resets, 200, new=False)),
        ("resets, new random vessel", 1, partial(resets, 10, new=True)),
    ]
    if find_spec("mujoco") is not None:
        rows.append(("MuJoCo's rollout of 64", 2, partial(mujoco, 2)))
    batch(1, deep=True, steps=1)  # compiles
    jobs: dict[Hashable, Callable[[], Sample]] = {row[:2]: row[2] for row in rows}
    samples = interleaved(jobs, repeats, tell)
    return [
        {"what": what, "threads": threads, "samples": samples[what, threads]}
        for what, threads, _ in rows
    ]
