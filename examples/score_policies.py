"""
Score policies
==============

Mean returns of the baselines and of a trained policy, with 95 percent intervals over 100 seeds.

The seeds are not those of training, nor are the anatomies of ``RandomVessel``. Each task takes a
file of weights that ``train_policy.py`` has written::

    python examples/score_policies.py HalfCircle --weights half-circle.npz --out scores.json

What is in the file of scores already stays there.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.env import WireVectorEnv, names
from magwire.env.baselines import Chance, Linear, Navigator, interval, retract, score, still
from magwire.env.ids import options_of

FIRST = 3_000_000
"""First of the seeds, at which nobody looked before; training draws its own from a generator."""


def scores(name: str, weights: NDArray[np.float64], episodes: int) -> dict[str, Any]:
    """Mean, half an interval and the rest of each policy."""
    policies = {
        "stand still": still,
        "retract": retract,
        "random": Chance(seed=0),
        "trained": Linear(weights),
        "navigator": Navigator(),
    }
    found, returns = {}, {}
    options = options_of(name, split="test")
    for kind, policy in policies.items():
        env = WireVectorEnv(episodes, autoreset_mode="Disabled", **options)
        total = score(env, policy, range(FIRST, FIRST + episodes))
        env.close()
        returns[kind] = total["returns"]
        mean, half = interval(returns[kind])
        found[kind] = {
            "mean": mean,
            "half_interval": half,
            "success": float(total["success"].mean()),
            "cost": float(total["costs"].mean()),
            "unconverged": int(total["unconverged"].sum()),
        }
        print(f"{name}: {kind} {mean:.2f} +- {half:.2f}, success {found[kind]['success']:.2f}")
    # Both have the same seeds, so what they differ by is known better than either.
    mean, half = interval(returns["navigator"] - returns["trained"])
    lead = {"mean": mean, "half_interval": half}
    return {"first_seed": FIRST, "episodes": episodes, "policies": found, "navigator_lead": lead}


def table(kept: dict[str, Any]) -> str:
    """The scores as a table of Markdown."""
    kinds = ("stand still", "retract", "random", "trained", "navigator")
    heads = ("task", *kinds, "navigator's lead")
    lines = ["| " + " | ".join(heads) + " |", "| --- " * len(heads) + "|"]
    for name, found in kept.items():
        policies, lead = [found["policies"][kind] for kind in kinds], found["navigator_lead"]
        cells = [f"{one['mean']:.2f} ± {one['half_interval']:.2f}" for one in policies]
        cells.append(f"{lead['mean']:.3f} ± {lead['half_interval']:.3f}")
        lines.append("| " + " | ".join([name, *cells]) + " |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Score as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[4])
    known = [name.removeprefix("magwire/").removesuffix("-v0") for name in names()]
    parser.add_argument("name", choices=known)
    parser.add_argument("--weights", type=Path, required=True)
    parser.add_argument("--episodes", type=int, default=100)
    parser.add_argument("--out", type=Path, required=True)
    chosen = parser.parse_args()
    kept = json.loads(chosen.out.read_text(encoding="utf-8")) if chosen.out.exists() else {}
    weights = np.load(chosen.weights)["weights"]
    kept[chosen.name] = scores(chosen.name, weights, chosen.episodes)
    chosen.out.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    print(table(kept))


if __name__ == "__main__":
    main()
