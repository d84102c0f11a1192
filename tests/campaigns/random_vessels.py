"""Random actions in random vessels: no exception, no NaN, no node outside the wall.

    python -m campaigns.random_vessels --steps 1000000

Counts what happened, and ends with status 1 if anything did that must not.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np

from magwire.env import WireVectorEnv
from magwire.env.ids import options_of

WIRES = 64
ROUND_OFF = 1e-9
"""By how far a node may seem to be outside the wall [m]."""


def main() -> int:
    """Step until there were as many steps as asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    env = WireVectorEnv(WIRES, autoreset_mode="SameStep", **options_of("RandomVessel"))
    env.reset(seed=chosen.seed)
    chance = np.random.default_rng(chosen.seed)
    push = chance.uniform(-0.2, 1.0, WIRES)
    done = episodes = unconverged = bad = 0
    nearest = np.inf
    began = time.perf_counter()
    while done < chosen.steps:
        actions = chance.uniform(-1.0, 1.0, (WIRES, 5))
        actions[:, 0] = push
        observed, rewards, terminated, truncated, info = env.step(actions.astype(np.float32))
        ended = terminated | truncated
        push = np.where(ended | (chance.random(WIRES) < 0.02), chance.uniform(-1, 1, WIRES), push)
        done, episodes = done + WIRES, episodes + int(ended.sum())
        if ended.any():
            unconverged += int(info["final_info"]["unconverged"].sum())
        clearance = env.episodes.batch.observe().clearance
        nearest = min(nearest, float(clearance.min()))
        bad += int(not (np.isfinite(observed).all() and np.isfinite(rewards).all()))
        bad += int((clearance < -ROUND_OFF).sum())
    seconds = time.perf_counter() - began
    print(
        f"{done} steps, {episodes} episodes, {unconverged} unconverged, {bad} bad; smallest "
        f"clearance {1e6 * nearest:.2f} um; {seconds:.0f} s."
    )
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
