"""The parts of the page with steering: three lumens, three branches."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.evidence.reproduce import active_claims, passive_claims, pictures, tables
from magwire.evidence.reproduce.chapter import Chapter, Part, why
from magwire.evidence.reproduce.claim import Claim
from magwire.evidence.reproduce.outcome import Outcome
from magwire.evidence.reproduce.page import Picture
from magwire.evidence.reproduce.runs import METHODS, REPLAYS, Ask, Run, Runs

if TYPE_CHECKING:
    import xarray as xr

BRANCHES = ("left", "middle", "right")
ANIMATED = "half-circle"
"""The navigation that moves on the page."""

SWING = (
    "In the helix a moderate field alone cannot keep the wire stable once its tip has turned by "
    "some 150 degrees. The least-field navigator therefore looks for a place from which the wire "
    "swings, its tip clear all the way, until the wall holds its body. It does so once, within one "
    "update. While the wire swings it is not at a stable equilibrium."
)

Claims = Callable[[Runs, Mapping[str, Outcome], float], list[Claim]]


def asks_for(scenario: str) -> tuple[Ask, ...]:
    """Without a field, with each navigator, and the replays of the least field."""
    steered = tuple(Ask(scenario, method) for method in METHODS)
    replays = tuple(Ask(scenario, "stable", replay=replay) for replay in REPLAYS)
    return (Ask(scenario), *steered, *replays)


def half_circle_claims(runs: Runs, steered: Mapping[str, Outcome], size: float) -> list[Claim]:
    """What the paper says of the steered half-circle."""
    return [
        active_claims.eliminated("Half-circle, (B)", "half-circle", steered),
        active_claims.on_the_centreline("Half-circle, (A)", steered["paper"], size),
        active_claims.nonlinear(steered["paper"]),
        active_claims.contact_interactions(steered["paper"]),
        passive_claims.experiment(
            "Half-circle, (A)", "In the experiment the steered tip does not touch the wall."
        ),
    ]


def sinusoid_claims(runs: Runs, steered: Mapping[str, Outcome], size: float) -> list[Claim]:
    """What the paper says of the steered sinusoid."""
    return [
        active_claims.eliminated("Sinusoid, (B)", "sinusoid", steered),
        active_claims.on_the_centreline("Sinusoid, (A)", steered["paper"], size),
        active_claims.pronounced_change(steered["paper"]),
        passive_claims.experiment(
            "Sinusoid, (A)", "In the experiment the steered tip does not touch the wall."
        ),
    ]


def helix_claims(runs: Runs, steered: Mapping[str, Outcome], size: float) -> list[Claim]:
    """What the paper says of the helix."""
    planar = {name: runs[Ask(name)].outcome for name in ("half-circle", "sinusoid")}
    return [
        passive_claims.higher_in_space(runs[Ask("helix")].outcome, planar),
        active_claims.eliminated("Helix, (C)", "helix", steered),
        active_claims.on_the_centreline("Helix, (B)", steered["paper"], size),
    ]


def write_case(scenario: str, claims: Claims, runs: Runs, images: Path) -> Chapter:
    """The chapter on one steered lumen."""
    chapter = Chapter(f"Active control: {scenario}")
    made = {method: runs[Ask(scenario, method)] for method in METHODS}
    file = f"{scenario}.png"
    later = ", ".join(
        f"{run.outcome.peak_field_from(active_claims.SETTLING):.0f} ({active_claims.NAMES[name]})"
        for name, run in made.items()
    )
    passive = runs[Ask(scenario)].result
    pictures.active(
        passive.dataset, {name: run.result.dataset for name, run in made.items()}, images / file
    )
    chapter.blocks = [
        *stops(made),
        *([SWING] if scenario == "helix" else []),
        pace(made["stable"]),
        Picture(
            f"images/{file}",
            f"The {scenario} without and with a field: shapes every 0.1 of X, tip "
            "force, and the field of each navigator. The lumen that is simulated has no virtual "
            "tube; Newton's method and the paper's optimiser plan with one, and begin with a spike "
            "of the field, where only a part of the magnet is out of the guide; the largest fields "
            f"from X = {active_claims.SETTLING:g} on are {later}.",
        ),
    ]
    if scenario == ANIMATED:
        chapter.blocks.append(animated(made["stable"], passive.dataset, images))
    outcomes = {name: run.outcome for name, run in made.items()}
    chapter.claims = claims(runs, outcomes, radius(runs, scenario))
    settle(chapter, scenario, runs)
    return chapter


def write_branches(runs: Runs, images: Path) -> Chapter:
    """The chapter on the tree."""
    chapter = Chapter("Active control: three branches")
    chapter.blocks.append(
        f"Without a field the wire goes into the {unsteered(runs)} branch, whichever is asked for: "
        "in the table of wall forces, those without a field are from the way there."
    )
    shown = {f"{b} branch": runs[Ask(f"{b}-branch", "stable")].result.dataset for b in BRANCHES}
    pictures.branches(shown, images / "branches.png")
    for branch in BRANCHES:
        scenario = f"{branch}-branch"
        made = {method: runs[Ask(scenario, method)] for method in METHODS}
        chapter.blocks += stops(made, f"{branch} branch, ")
        chapter.claims.append(
            active_claims.reaches(branch, made["paper"].outcome, radius(runs, scenario))
        )
        settle(chapter, scenario, runs)
    chapter.blocks.append(
        Picture(
            "images/branches.png",
            "Into the left, middle and right branch by the least field, and that field. The "
            "tree is magwire's own, with lengths and bends like those in the paper's picture.",
        )
    )
    return chapter


def pace(run: Run) -> str:
    """How long the navigator takes, in a sentence."""
    import numpy as np

    median = float(np.median(run.plans))
    return (
        f"The least field: {len(run.plans)} updates, {1e3 * median:.2g} ms in the median, "
        f"the longest {max(run.plans):.2g} s."
    )


def unsteered(runs: Runs) -> str:
    """The branch in which the wire ends that nobody steers."""
    ends = {b: float(runs[Ask(f"{b}-branch")].outcome.offset[-1]) for b in BRANCHES}
    return min(ends, key=ends.__getitem__)


def radius(runs: Runs, scenario: str) -> float:
    """Of the lumen at its entrance [m]."""
    return float(runs[Ask(scenario)].result.dataset["lumen_radius"].values[0])


def settle(chapter: Chapter, scenario: str, runs: Runs) -> None:
    """Rows of the tables, and promises that did not hold."""
    passive = runs[Ask(scenario)].outcome
    steered = {method: runs[Ask(scenario, method)].outcome for method in METHODS}
    chapter.reductions += tables.reduction_rows(scenario, passive, steered)
    replays = {
        replay.name: runs[ask].outcome
        for replay in REPLAYS
        if (ask := Ask(scenario, "stable", replay=replay)) in runs
    }
    chapter.replays.append(
        tables.replay_row(scenario, steered["stable"], replays, radius(runs, scenario))
    )
    chapter.expect_complete((Ask(scenario), Ask(scenario, "stable")), runs)
    held = {f"{scenario}, stable": steered["stable"]}
    held |= {f"{scenario}, stable, replayed {name}": run for name, run in replays.items()}
    for name, run in held.items():
        if run.peak > 0.0:
            chapter.broken.append(f"{name}: the tip touches with {1e3 * run.peak:.3g} mN.")
        elif name.count("replayed") and not run.complete:
            chapter.broken.append(f"{name}: the run ends early: {run.status}.")


def stops(made: Mapping[str, Run], before: str = "") -> list[str]:
    """A sentence for each navigator that stopped, in its own words."""
    words = [
        f"{before}{active_claims.NAMES[name]} stops: {why(run)}"
        for name, run in made.items()
        if not run.result.converged
    ]
    return [text[:1].upper() + text[1:] for text in words]


def animated(run: Run, passive: xr.Dataset, images: Path) -> Picture:
    """A small moving picture of a navigation."""
    from magwire.plot.animation import animate

    file = images / "navigation.gif"
    animate(run.result.dataset, file, passive=passive, width=720, seconds=8.0, rate=12)
    return Picture(
        "images/navigation.gif",
        f"The {ANIMATED} steered by the least field: the magnetised tip is dark, the arrow is the "
        "field. The command magwire animate makes such pictures, larger ones too, from any result.",
    )


HALF_CIRCLE = Part(asks_for("half-circle"), partial(write_case, "half-circle", half_circle_claims))
SINUSOID = Part(asks_for("sinusoid"), partial(write_case, "sinusoid", sinusoid_claims))
HELIX = Part(
    (Ask("half-circle"), Ask("sinusoid"), *asks_for("helix")),
    partial(write_case, "helix", helix_claims),
)
BRANCHING = Part(
    tuple(ask for branch in BRANCHES for ask in asks_for(f"{branch}-branch")), write_branches
)
