"""Claims about steering."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.reproduce.claim import Claim, judged, percent
from magwire.evidence.reproduce.outcome import Outcome

Array = NDArray[np.float64]
NAMES = {"paper": "the paper's optimiser", "newton": "Newton's method", "stable": "least field"}
"""What the ways to steer are called on the page."""
TUBE = 0.01
"""Radius of the virtual tube in the lumen's radius."""
SETTLING = 0.1
"""Push up to which the paper's optimiser finds its first field, and nothing is compared."""


def tip_word(run: Outcome) -> str:
    """How the tip of a run fared, in a few words."""
    end = "" if run.complete else f", stops at X = {run.push[-1]:.3f}"
    return f"F* up to {run.largest:.1f}{end}" if run.peak > 0.0 else f"F* = 0{end or ' throughout'}"


def eliminated(where: str, lumen: str, runs: Mapping[str, Outcome]) -> Claim:
    """No force on the tip under control: by the paper's optimiser, or by another navigator."""
    free = [name for name, run in runs.items() if run.contact_free]
    found = "; ".join(f"{NAMES[name]}: {tip_word(run)}" for name, run in runs.items())
    return Claim(
        where,
        f"Control eliminates the contact force of the tip in the {lumen}.",
        found[:1].upper() + found[1:] + ".",
        judged("paper" in free, bool(free)),
        "yes if the paper's optimiser keeps the tip off the wall to the end, partly if only "
        "another navigator does",
    )


def on_the_centreline(where: str, run: Outcome, radius: float) -> Claim:
    """The tip within the virtual tube of the planner, in the plant, which has none."""
    offset = float(run.offset.max(initial=0.0))
    part = offset / (TUBE * radius)
    return Claim(
        where,
        "The tip follows the centreline within the virtual tube, ξ = 0.01 R.",
        f"With the paper's optimiser the tip is up to {1e3 * offset:.3f} mm off the centreline; "
        f"ξ is {1e3 * TUBE * radius:.3f} mm.",
        judged(run.complete and part <= 1.0, run.complete and offset < 0.2 * radius),
        "yes within ξ, partly within 0.2 R, to the end; measured without the tube, the field stays "
        "as it is between two updates",
    )


def nonlinear(run: Outcome) -> Claim:
    """Deviation of the field's components from straight lines, over their range."""
    later = run.push > SETTLING
    part = _bend(run.push[later], run.field[later])
    return Claim(
        "Half-circle, (C)",
        "The optimal field is extremely nonlinear in X although the curvature is constant.",
        f"From X = {SETTLING:g} on the components leave their best straight lines by up to "
        f"{percent(part)} of their range (the paper's optimiser).",
        judged(part > 0.2, part > 0.05),
        "yes above 20 %, partly above 5 %; how much is extreme is not said",
    )


def contact_interactions(run: Outcome) -> Claim:
    """Whether there is any contact that could make the field of the half-circle nonlinear."""
    force = float(run.wall_force.max(initial=0.0))
    return Claim(
        "Half-circle, (C)",
        "The nonlinearity comes from the coupling of elasticity and magnetic torque and from "
        "non-smooth contact.",
        f"With the paper's optimiser the whole wire presses on the wall with "
        f"{1e3 * force:.3g} mN at most.",
        judged(force > 0.0, fair=True),
        "yes if the wall bears a force, partly if not: then the coupling alone does it",
    )


def pronounced_change(run: Outcome) -> Claim:
    """Where the field changes fastest, over 0.02 of push."""
    later = run.push > SETTLING
    push = run.push[later]
    steps = np.arange(push[0], push[-1] - 0.02, 0.002) if len(push) else np.zeros(0)
    if len(steps) == 0:
        where, ratio = np.nan, np.nan
    else:
        size = np.linalg.norm(run.field_at(steps + 0.02) - run.field_at(steps), axis=1)
        where = float(steps[size.argmax()] + 0.01)
        ratio = float(size.max() / np.median(size))
    return Claim(
        "Sinusoid, (C)",
        "The optimal field changes pronouncedly around X ≈ 0.5.",
        f"It changes fastest at X = {where:.2f}, {ratio:.1f} times as fast as in the median "
        "(the paper's optimiser).",
        judged(abs(where - 0.5) < 0.06 and ratio > 2.0, abs(where - 0.5) < 0.12 and ratio > 1.5),
        "yes within 0.06 of 0.5 and above twice the median, partly within 0.12 and above 1.5 times",
    )


def reaches(branch: str, run: Outcome, radius: float) -> Claim:
    """Whether a branch is entered, without contact of the tip."""
    inside = run.complete and float(run.offset[-1]) < radius
    return Claim(
        "Bifurcation",
        f"Control steers the tip into the {branch} branch.",
        f"The paper's optimiser: {tip_word(run)}; at the end the tip is "
        f"{1e3 * float(run.offset[-1]):.2f} mm from the branch's centreline.",
        judged(inside and run.contact_free, inside),
        "yes if in the branch to the end without contact of the tip, partly if with; the tree is "
        "magwire's own, the paper gives no formula",
    )


def _bend(push: Array, field: Array) -> float:
    """Largest deviation of a component from its best straight line, over its range."""
    parts = []
    for b in field.T:
        extent = float(np.ptp(b)) if len(b) else 0.0
        if extent > 1e-2 * float(np.abs(field).max(initial=0.0)) and len(push) > 2:
            line = np.polynomial.Polynomial.fit(push, b, 1)
            parts.append(float(np.abs(b - line(push)).max()) / extent)
    return max(parts, default=0.0)
