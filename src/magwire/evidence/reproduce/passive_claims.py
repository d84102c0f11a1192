"""Claims about pushing without a field, and about the authors' earlier curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.reproduce.claim import Claim, judged, percent
from magwire.evidence.reproduce.outcome import Outcome

Array = NDArray[np.float64]


def experiment(where: str, what: str) -> Claim:
    """A claim about the paper's own experiments."""
    return Claim(
        where,
        what,
        "-",
        "not checked",
        "the measurements are not published; magwire has been compared with no experiment",
    )


def touches(run: Outcome, first_contact: float | None) -> Claim:
    """Physical contact in the sinusoid; the first contact is a push."""
    found = first_contact is not None and run.largest > 0.0
    return Claim(
        "Sinusoid, passive",
        "There is physical contact between wire and lumen.",
        f"From X = {first_contact:.2f} on some node touches; the tip with F* up to "
        f"{run.largest:.1f}."
        if found
        else "The wire never touches.",
        judged(found),
        "yes if a force of the wall acts on the tip",
    )


def first_stage(run: Outcome) -> Claim:
    """The first stage of contact in the sinusoid and where it ends."""
    stages = run.contacts()
    gone = run.force_at(0.5) == 0.0
    end = stages[0][1] if stages else np.nan
    ended = bool(stages) and end < run.push[-1]
    return Claim(
        "Sinusoid, passive, (B)",
        "The tip first touches with relatively large forces; this stage ends at X ≈ 0.5.",
        f"The first stage is from X = {stages[0][0]:.2f} to {end:.2f}, with F* up to "
        f"{run.largest_from(*stages[0]):.1f}; "
        + ("no force at X = 0.5." if gone else f"F* = {float(run.force_at(0.5)):.1f} at X = 0.5.")
        if stages
        else "The tip never touches.",
        judged(ended and abs(end - 0.5) < 0.05, ended and gone),
        "yes if it ends within 0.05 of 0.5, partly if there is no force at 0.5",
    )


def valley(run: Outcome, arc: float) -> Claim:
    """Where the tip touches again; the valley is at an arc length, in L."""
    stages = run.contacts()
    begin = stages[1][0] if len(stages) > 1 else np.nan
    return Claim(
        "Sinusoid, passive, (B)",
        "At the valley, where the tangent turns sharply, the contact forces rise again.",
        f"The valley is {arc:.2f} along the centreline; the second stage starts at X = {begin:.2f}."
        if len(stages) > 1
        else "There is no second stage of contact.",
        judged(abs(begin - arc) < 0.05),
        "yes within 0.05; the wire is nearly as long as the centreline, so X at the valley is "
        "about its arc length",
    )


def second_peak(run: Outcome) -> Claim:
    """The peak past the valley."""
    peak = run.largest_from(0.5)
    return Claim(
        "Sinusoid, passive, (B)",
        "There F* increases significantly to 40.",
        f"F* = {peak:.1f} at most past X = 0.5.",
        judged(abs(peak - 40.0) < 2.0, abs(peak - 40.0) < 10.0),
        f"{100.0 * (peak / 40.0 - 1.0):+.0f} %; yes if within 5 %, partly if within 25 %; an "
        "independent calculation with a hard wall gives 45.1",
    )


def danger(name: str, run: Outcome) -> Claim:
    """A judgement that nothing in a simulation can confirm."""
    return Claim(
        "Half-circle, (B)",
        "Passive pushing poses a significant risk by excessive tip forces.",
        f"The force on the tip is {1e3 * run.peak:.2f} mN at most in the {name}.",
        "not checked",
        "the paper names no force that a vessel bears",
    )


def higher_in_space(helix: Outcome, planar: Mapping[str, Outcome]) -> Claim:
    """The helix against the planar lumens."""
    highest = max(run.largest for run in planar.values())
    others = ", ".join(f"{run.largest:.1f} ({name})" for name, run in planar.items())
    ratio = helix.largest / highest
    return Claim(
        "Helix, (C)",
        "The largest contact force is significantly higher than in the planar lumens.",
        f"F* = {helix.largest:.1f} against {others}.",
        judged(ratio > 1.25, ratio > 1.0),
        f"{ratio:.2f} times the largest of them; yes above 1.25, partly above 1",
    )


def authors_force(name: str, run: Outcome, curve: Array, entry: float) -> Claim:
    """A force curve of the authors' earlier geometry, shape (n, 2), against ours."""
    difference = np.abs(run.force_at(curve[:, 0] + entry) - curve[:, 1])
    part = float(difference.max() / curve[:, 1].max())
    return Claim(
        "Earlier figures",
        f"{name}, passive: F* up to {curve[:, 1].max():.1f}.",
        f"F* = {float(run.force_at(curve[:, 0] + entry).max()):.1f} at most at the same pushes; "
        f"largest difference {percent(part)} of the peak.",
        judged(part < 0.05, part < 0.1),
        "yes below 5 %, partly below 10 % all along the curve",
    )


def authors_shapes(distances: Sequence[float]) -> Claim:
    """Mean distances of the drawn shapes from ours, in L."""
    worst = max(distances)
    return Claim(
        "Earlier figures",
        f"{len(distances)} shapes of the wire in two half-circles.",
        f"The mean distance from magwire's shape is at most {worst:.4f} L.",
        judged(worst < 0.005, worst < 0.01),
        "yes below 0.005 L, half of the tube's radius; partly below the whole",
    )


def authors_field(theirs: Array, ours: Array) -> Claim:
    """Components of B* across the tip at the same pushes, shape (n,)."""
    part = float(np.abs(theirs - ours).max() / np.abs(theirs).max())
    return Claim(
        "Earlier figures",
        "Half-circle, controlled: the field across the tip for X from 0.1 to 0.35.",
        f"The field of Newton's method differs by {percent(part)} of the peak at most.",
        judged(part < 0.05, part < 0.1),
        "yes below 5 %, partly below 10 %; the component along the tip is free, and the printed "
        "sign is the opposite",
    )
