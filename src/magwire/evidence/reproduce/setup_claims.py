"""Claims about the set-up: its numbers, its printed formulas, and how fine it has to be."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.reproduce.claim import Claim, judged, percent
from magwire.evidence.reproduce.outcome import Outcome

Array = NDArray[np.float64]
SAME = 0.02
"""Change of the force, over its peak, up to which two runs count as the same."""


def moment(per_length: float) -> Claim:
    """The magnetic moment per length of the tip [A m] (P-6)."""
    return Claim(
        "Setup",
        "The remanent magnetisation of the tip is 0.1448 A·m.",
        f"128 kA/m over the section of 0.6 mm radius: {per_length:.4f} A·m² per metre of wire.",
        judged(abs(per_length - 0.1448) < 5e-4),
        "yes within 0.0005; the unit makes it a moment per length, a magnetisation would be in A/m",
    )


def half_circle_entrance() -> Claim:
    """The printed half-circle starts at w = 0, where its tangent is not the x axis."""
    angle = _angle_to_x(np.array([-np.sin(0.0), np.cos(0.0), 0.0]))
    return Claim(
        "Eq. of the half-circle",
        "X = 0.25 cos ω, Y = 0.25 sin ω + 0.25, ω from 0 to π; the wire is fed along the x axis, "
        "the tangent at the entrance.",
        f"The tangent of this formula at ω = 0 is at {angle:.0f}° to the x axis.",
        judged(angle < 1.0),
        "yes below 1°; a shift of ω by π/2 is missing: with it, as in the paper's helix, the "
        "tangent is x",
    )


def sinusoid_extent() -> Claim:
    """The printed range of the sinusoid, in lengths of the wire, against its one length."""
    x = np.linspace(0.0, 80.0, 200_001)
    y = 0.15 * np.cos(np.pi * x / 40.0) - 0.15
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    return Claim(
        "Eq. of the sinusoid",
        "Y/L = 0.15 cos(π X / 40 L) - 0.15 for X/L from 0 to 80.",
        f"This lumen is {length:.1f} wires long.",
        judged(length < 1.0),
        "yes if shorter than the wire; X was in millimetres: with π X/(0.4 L) and X/L from 0 to "
        "0.8 it is",
    )


def helix_length() -> Claim:
    """Arc length of the printed helix."""
    radius, rise = 0.1, 0.1 / (2.0 * np.pi)
    w = np.linspace(0.0, 0.9 / np.hypot(radius, rise), 20_001)
    points = np.column_stack([radius * np.sin(w), radius * (1.0 - np.cos(w)), rise * w])
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return Claim(
        "Eq. of the helix",
        "Radius 0.1, pitch 0.1, total length 0.9 (in L).",
        f"The printed formula has an arc length of {length:.3f}.",
        judged(abs(length - 0.9) < 1e-3),
        "yes within 0.001",
    )


def helix_entrance() -> Claim:
    """The printed helix starts off the x axis."""
    angle = _angle_to_x(np.array([0.1, 0.0, 0.1 / (2.0 * np.pi)]))
    return Claim(
        "Numerical setup",
        "The wire is fed along the x axis, which is the tangent at the lumen's entrance.",
        f"True in the plane; the helix starts at {angle:.1f}° to the x axis.",
        judged(angle < 0.1, angle < 15.0),
        "yes below 0.1°, partly below 15°; both cannot hold in the helix, magwire feeds along the "
        "tangent",
    )


def quasi_static(slow: Outcome, fast: Outcome) -> Claim:
    """Whether the speed of feeding matters; the fast run is fed twice as fast."""
    push = slow.push[slow.push <= fast.push[-1]]
    change = float(np.abs(slow.force_at(push) - fast.force_at(push)).max()) / slow.largest
    return Claim(
        "Numerical setup",
        "The insertion is slow enough for a quasi-static analysis.",
        f"Fed twice as fast, F* along the half-circle changes by {percent(change)} of its peak.",
        judged(slow.complete and fast.complete and change < SAME),
        f"yes below {percent(SAME)}; the density, 2000 kg/m³, is not in the paper",
    )


def fine_enough(base: Outcome, finer: Mapping[str, Outcome]) -> Claim:
    """Whether twice the nodes, twice the centreline points and half the time step change much."""
    changes = {name: abs(run.largest / base.largest - 1.0) for name, run in finer.items()}
    found = ", ".join(f"{name} {percent(change)}" for name, change in changes.items())
    done = base.complete and all(run.complete for run in finer.values())
    return Claim(
        "Numerical setup",
        "N = 100, Q = 200 and dt = 10 ms are chosen by a convergence study.",
        f"The peak of F* in the half-circle, {base.largest:.1f}, changes by: {found}.",
        judged(done and max(changes.values()) < SAME, done and max(changes.values()) < 0.1),
        f"yes below {percent(SAME)} each, partly below 10 %",
    )


def _angle_to_x(tangent: Array) -> float:
    return float(np.degrees(np.arccos(tangent[0] / np.linalg.norm(tangent))))
