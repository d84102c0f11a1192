"""The paper's cases with friction, as a table: `python -m campaigns.friction_claims`."""

from __future__ import annotations

import sys

import numpy as np

from magwire.results import Result
from magwire.scenario import load
from magwire.scenario.schedules import replayed

NAMES = ("half-circle", "half-circle-narrow", "half-circle-wide", "sinusoid", "helix")
COEFFICIENTS = (0.0, 0.05, 0.1, 0.3)
COARSE = ("output.record_every=0.5 mm",)


def peaks(run: Result) -> tuple[float, float, float]:
    """Largest force on the tip, push at the guide, and smallest clearance of the tip [mm]."""
    unit = run.force_scale
    tip = run.clearance[:, -1]
    near = 1e3 * float(np.nanmin(tip)) if np.isfinite(tip).any() else np.nan
    return run.max_tip_force / unit, run.max_push_force / unit, near


def rows(name: str) -> list[str]:
    """A line of the table for each coefficient: nobody steers, and the frictionless plan does."""
    plan = load(name, COARSE).run()
    lines = []
    for mu in COEFFICIENTS:
        rubs = (f"contact.friction.static={mu}",)
        alone = load(name, (*COARSE, "navigate.method=none", *rubs)).run()
        steered = replayed(plan, rubs).run()
        tip, push, _ = peaks(alone)
        held, pushed, near = peaks(steered)
        kept = "yes" if steered.converged and held == 0.0 else "no"
        lines.append(
            f"| {name} | {mu:g} | {tip:.1f} | {push:.1f} | {alone.status} | "
            f"{held:.2g} | {pushed:.2g} | {near:.2f} | {kept} |"
        )
        print(lines[-1], flush=True)
    return lines


if __name__ == "__main__":
    for chosen in sys.argv[1:] or NAMES:
        rows(chosen)
