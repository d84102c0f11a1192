"""The paper's cases with friction, as a table: `python -m campaigns.friction_claims NAME MU`."""

from __future__ import annotations

import sys

import numpy as np

from magwire.results import Result
from magwire.scenario import load
from magwire.scenario.replays import replayed

NAMES = ("half-circle", "half-circle-narrow", "half-circle-wide", "sinusoid", "helix")
COEFFICIENTS = (0.0, 0.05, 0.1, 0.3)
COARSE = ("output.record_every=0.5 mm",)


def peaks(run: Result) -> tuple[float, float, float]:
    """Largest force on the tip, push at the guide, and smallest clearance of the tip [mm]."""
    unit = run.force_scale
    tip = run.clearance[:, -1]
    near = 1e3 * float(np.nanmin(tip)) if np.isfinite(tip).any() else np.nan
    return run.max_tip_force / unit, run.max_push_force / unit, near


def rows(name: str, coefficients: tuple[float, ...] = COEFFICIENTS) -> list[str]:
    """A line of the table for each coefficient: nobody steers; the frictionless plan does, and one
    that was made with friction.
    """
    plan = load(name, COARSE).run()
    lines = []
    for mu in coefficients:
        rubs = (f"contact.friction.static={mu}",)
        alone = load(name, (*COARSE, "navigate.method=none", *rubs)).run()
        steered = replayed(plan, rubs).run()
        tip, push, _ = peaks(alone)
        held, pushed, near = peaks(steered)
        kept = "yes" if steered.converged and held == 0.0 else "no"
        aware = load(name, (*COARSE, *rubs, "navigate.friction=model")).run()
        met, needed, off = peaks(aware)
        holds = "yes" if aware.converged and met == 0.0 else aware.status
        lines.append(
            f"| {name} | {mu:g} | {tip:.1f} | {push:.1f} | {alone.status} | "
            f"{held:.2g} | {pushed:.2g} | {near:.2f} | {kept} | "
            f"{met:.2g} | {needed:.2g} | {off:.2f} | {holds} |"
        )
        print(lines[-1], flush=True)
    return lines


if __name__ == "__main__":
    for chosen in [name for name in sys.argv[1:] if name in NAMES] or NAMES:
        rows(chosen, tuple(float(one) for one in sys.argv[1:] if one not in NAMES) or COEFFICIENTS)
