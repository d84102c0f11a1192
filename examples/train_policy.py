"""
Train a policy
==============

A linear policy that learns to steer on a CPU in minutes, by augmented random search.

Its actions are linear in what is observed. In each iteration it is tried with random changes, each
added and subtracted, in as many wires at once; then it goes along the changes that did best, by how
much better they did than their opposites: algorithm ARS V1-t of Mania, Guy and Recht, "Simple
random search of static linear policies is competitive for reinforcement learning", NeurIPS 2018.
Changes and steps get smaller as it goes. It needs numpy only::

    python examples/train_policy.py HalfCircle --out half-circle.npz

Anatomies and seeds of training are not those of ``score_policies.py``, which makes the table of
scores.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magwire.env import WireVectorEnv, names
from magwire.env.baselines import Linear, score
from magwire.env.ids import options_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Search:
    """How to search: directions in an iteration, how many of them count, size of a change, step."""

    iterations: int = 15
    directions: int = 8
    best: int = 4
    change: float = 0.1
    step: float = 0.1


def train(name: str, search: Search, seed: int, tell: Callable[[str], None] = print) -> Array:
    """Weights for an environment, from nothing."""
    chance = np.random.default_rng(seed)
    wires = 2 * search.directions
    env = WireVectorEnv(wires, autoreset_mode="Disabled", **options_of(name))
    shape = (env.single_action_space.shape[0], env.single_observation_space.shape[0] + 1)
    weights = np.zeros(shape)
    weights[0, -1] = 0.5  # to begin with, it pushes
    for iteration in range(search.iterations):
        finer = 1.0 - 0.8 * iteration / search.iterations
        change = chance.standard_normal((search.directions, *shape))
        size = finer * search.change
        tried = np.concatenate([weights + size * change, weights - size * change])
        seeds = np.tile(chance.integers(0, 2**31, search.directions), 2).tolist()
        returns = score(env, Linear(tried), seeds)["returns"]
        up, down = np.split(returns, 2)
        best = np.argsort(-np.maximum(up, down))[: search.best]
        spread = max(float(np.std(np.concatenate([up[best], down[best]]))), 1e-6)
        gain = np.einsum("k,kij->ij", (up - down)[best], change[best])
        weights = weights + finer * search.step / (search.best * spread) * gain
        tell(f"{name} {iteration + 1}: mean return {returns.mean():.2f}, best {returns.max():.2f}")
    env.close()
    return weights


def main() -> None:
    """Train as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[4])
    known = [name.removeprefix("magwire/").removesuffix("-v0") for name in names()]
    parser.add_argument("name", choices=known)
    parser.add_argument("--iterations", type=int, default=Search.iterations)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, required=True)
    chosen = parser.parse_args()
    weights = train(chosen.name, Search(iterations=chosen.iterations), chosen.seed)
    np.savez(chosen.out, weights=weights)
    print(f"Weights of {chosen.name} are in {chosen.out}.")


if __name__ == "__main__":
    main()
