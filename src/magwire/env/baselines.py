"""Policies to compare with: standing still, retracting, chance, and the built-in navigator.

A policy is asked for the actions of all wires of a vector environment; ``score`` has it play whole
episodes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from magwire.engine.feed import Feed
from magwire.env.anatomy import Anatomy
from magwire.env.vector_env import WireVectorEnv
from magwire.navigate import Schedule
from magwire.scenario import schedule_of

Array = NDArray[np.float64]


class Policy(Protocol):
    """Who acts."""

    def __call__(self, env: WireVectorEnv, observed: Any) -> Array:
        """Actions of all wires, shape (n, 2 + m)."""
        ...


def still(env: WireVectorEnv, observed: Any) -> Array:
    """Nothing is done."""
    return np.zeros(env.action_space.shape or ())


def retract(env: WireVectorEnv, observed: Any) -> Array:
    """The wire is drawn back at full speed."""
    actions = np.zeros(env.action_space.shape or ())
    actions[:, 0] = -1.0
    return actions


class Chance:
    """Actions at random, evenly over the action space.

    Parameters
    ----------
    seed
        That of the chance.
    """

    def __init__(self, seed: int = 0) -> None:
        self._chance = np.random.default_rng(seed)

    def __call__(self, env: WireVectorEnv, observed: Any) -> Array:
        """Actions of all wires, shape (n, 2 + m)."""
        return self._chance.uniform(-1.0, 1.0, env.action_space.shape)


class Linear:
    """Actions that are linear in what is observed.

    Parameters
    ----------
    weights
        Shape (actions, observed + 1), or of one such for each wire, shape (n, ...); the last column
        counts without regard to what is observed.
    """

    def __init__(self, weights: Array) -> None:
        self.weights = np.asarray(weights, dtype=np.float64)

    def __call__(self, env: WireVectorEnv, observed: Any) -> Array:
        """Actions of all wires, shape (n, 2 + m)."""
        seen = np.hstack([observed, np.ones((len(observed), 1))])
        return np.asarray(np.sum(self.weights * seen[:, None], axis=-1))


class Navigator:
    """The field that the scenario's own navigator finds for an anatomy, at full speed of the feed.

    The navigator runs the scenario once for every anatomy, at the speed of the episodes and with
    its model of the wire; the episode then follows the field that it found at each feed. It is told
    the anatomy, and measures the field, as no learner does: what the actuator makes of what it is
    asked for is known from the action before.
    """

    def __init__(self) -> None:
        self._plans: dict[int, tuple[Anatomy, Schedule]] = {}

    def __call__(self, env: WireVectorEnv, observed: Any) -> Array:
        """Actions of all wires, shape (n, 2 + m)."""
        now, task = env.episodes, env.task
        feeds = now.batch.observe().feed + task.feed_speed * task.action_time
        plans = [self._plan(anatomy, task.feed_speed) for anatomy in now.anatomies]
        fields = np.stack([plan.at(feed)[0] for plan, feed in zip(plans, feeds, strict=True)])
        actions = np.zeros(env.action_space.shape or ())
        actions[:, 0] = 1.0
        actions[:, 2:] = now.share_of(fields / now.measured_factors())
        return actions

    def _plan(self, anatomy: Anatomy, speed: float) -> Schedule:
        key = id(anatomy)
        if key not in self._plans:  # kept with its anatomy, so that no other one gets its id
            feed = Feed(speed, anatomy.job.feed.largest)
            self._plans[key] = anatomy, schedule_of(replace(anatomy.job, feed=feed).run())
        return self._plans[key][1]


def score(env: WireVectorEnv, policy: Policy, seeds: Sequence[int]) -> dict[str, Array]:
    """Play one episode in each wire to its end.

    Parameters
    ----------
    env
        The wires.
    policy
        Who acts.
    seeds
        Those of the episodes, as many as there are wires.

    Returns
    -------
    dict
        ``returns``, ``costs`` [N], the sum over actions, ``success``, ``progress``,
        ``unconverged`` and ``length``, each of shape (len(seeds),).
    """
    observed, _ = env.reset(seed=list(seeds))
    n = env.num_envs
    names = ("returns", "costs", "success", "progress", "unconverged", "length")
    total = {name: np.zeros(n) for name in names}
    running = np.ones(n, dtype=bool)
    while running.any():
        actions = policy(env, observed)
        env.episodes.act(actions, running)
        observed, info = env.observed(), env.episodes.info
        total["returns"] += env.episodes.reward
        total["costs"] += np.where(running, info["cost"], 0.0)
        total["length"] += running
        total["unconverged"] += running & info["unconverged"]
        ended = running & (env.episodes.terminated | env.episodes.truncated)
        for name in ("success", "progress"):
            total[name][ended] = info[name][ended]
        running &= ~ended
    return total


def interval(values: Array) -> tuple[float, float]:
    """Mean, and half the width of its 95 percent interval (normal approximation)."""
    spread = float(np.std(values, ddof=1)) if len(values) > 1 else float("nan")
    return float(np.mean(values)), 1.96 * spread / float(np.sqrt(len(values)))
