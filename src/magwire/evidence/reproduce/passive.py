"""The parts of the page without steering: set-up, passive pushing, the authors' earlier curves."""

from __future__ import annotations

from pathlib import Path

from magwire.evidence.published import curve
from magwire.evidence.reproduce import authors, passive_claims, pictures, setup_claims
from magwire.evidence.reproduce.chapter import Chapter, Part
from magwire.evidence.reproduce.claim import Claim
from magwire.evidence.reproduce.overlay import overlay, shape
from magwire.evidence.reproduce.page import Picture
from magwire.evidence.reproduce.runs import Ask, Run, Runs

HALF_CIRCLES = {
    "2R/L = 0.04": Ask("half-circle-narrow"),
    "2R/L = 0.06": Ask("half-circle"),
    "2R/L = 0.08": Ask("half-circle-wide"),
}
HALF_CIRCLE, SINUSOID = Ask("half-circle"), Ask("sinusoid")
FINER = {
    "200 nodes": Ask("half-circle", changes=("wire.nodes=200",)),
    "400 points": Ask("half-circle", changes=("lumen.points=400",)),
    "dt = 5 ms": Ask("half-circle", changes=("solver.time_step=5 ms",)),
}
FAST = Ask("half-circle", changes=("feed.speed=2 mm/s", "solver.time_step=5 ms"))
SNAPSHOTS = "The text gives no X for the shapes in this figure: they are drawn every 0.1."


def write_setup(runs: Runs, images: Path) -> Chapter:
    """The chapter on the set-up."""
    from magwire.scenario import load

    chapter = Chapter("Setup")
    base = runs[HALF_CIRCLE].outcome
    wire = load("half-circle").wire.build()
    chapter.claims = [
        setup_claims.moment(wire.moment_per_length),
        setup_claims.half_circle_entrance(),
        setup_claims.sinusoid_extent(),
        setup_claims.helix_length(),
        setup_claims.helix_entrance(),
        setup_claims.quasi_static(base, runs[FAST].outcome),
        setup_claims.fine_enough(base, {name: runs[ask].outcome for name, ask in FINER.items()}),
    ]
    chapter.expect_complete(SETUP.asks, runs)
    return chapter


def write_passive(runs: Runs, images: Path) -> Chapter:
    """The chapter on pushing without a field."""
    chapter = Chapter("Passive pushing")
    tubes = {name: runs[ask].result.dataset for name, ask in HALF_CIRCLES.items()}
    pictures.passive(tubes, images / "passive-half-circles.png")
    sinusoid = runs[SINUSOID]
    pictures.passive({"2R/L = 0.06": sinusoid.result.dataset}, images / "passive-sinusoid.png")
    chapter.blocks = [
        Picture(
            "images/passive-half-circles.png",
            "Half-circles of three widths, pushed without a field: shapes and normalised tip "
            f"force. {SNAPSHOTS}",
        ),
        Picture(
            "images/passive-sinusoid.png",
            "The sinusoid, pushed without a field: shapes and normalised tip force. " + SNAPSHOTS,
        ),
    ]
    outcome = sinusoid.outcome
    first = sinusoid.result.first_contact
    length = float(sinusoid.result.dataset.attrs["length_scale"])
    chapter.claims = [
        passive_claims.experiment(
            "Half-circles, passive", "Experiment and simulation agree excellently."
        ),
        passive_claims.danger("half-circle of 2R/L = 0.06", runs[HALF_CIRCLE].outcome),
        passive_claims.experiment(
            "Sinusoid, passive", "Experiment and simulation agree qualitatively."
        ),
        passive_claims.touches(outcome, None if first is None else first / length),
        passive_claims.first_stage(outcome),
        passive_claims.valley(outcome, valley_arc() / length),
        passive_claims.second_peak(outcome),
    ]
    chapter.expect_complete(PASSIVE.asks, runs)
    return chapter


def valley_arc() -> float:
    """Arc length of the sinusoid's centreline at its lowest point [m]."""
    import numpy as np

    from magwire.scenario import load

    lumen = load("sinusoid").lumen.build()
    points, _ = lumen.centreline(points=4001)
    arc = np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))
    return float(arc[int(np.argmin(points[:, 1])) - 1])


def write_authors(runs: Runs, images: Path) -> Chapter:
    """The chapter on the authors' earlier curves."""
    chapter = Chapter("The authors' earlier curves")
    found = {
        "half-circle": runs[authors.HALF_CIRCLE],
        "sinusoid": runs[authors.SINUSOID],
        "narrow bend": runs[authors.NARROW_BEND],
        "steered": runs[authors.STEERED],
    }
    overlay(found, images / "authors.png")
    chapter.blocks = [
        "The authors have published drawings of an earlier version of the paper: half-circles of "
        "centreline radius 0.2 L (and 0.1 L, left bend in the picture of shapes) and the sinusoid "
        "y = 0.1 L (cos(10 x/L) - 1), in tubes of radius 0.01 L with a straight entry of 0.15 L. "
        "Here magwire runs in that geometry. The peaks, 39 and 83, are not those of the paper's "
        "own lumens. The legend of their drawing has 'with' and 'without' control swapped: the "
        "zeros are with control. Their field has the opposite sign.",
        Picture(
            "images/authors.png",
            "The authors' earlier curves (symbols, broad lines; read from vector drawings) and "
            "magwire (lines). Of the field only the component across the tip is determined.",
        ),
    ]
    chapter.claims = authors_claims(found)
    chapter.expect_complete(AUTHORS.asks, runs)
    return chapter


def authors_claims(found: dict[str, Run]) -> list[Claim]:
    """Curves, shapes and field of the authors against ours."""
    claims: list[Claim] = []
    for name in ("half-circle", "sinusoid"):
        without = curve(f"control_{name.replace('-', '')}_force", "blue_triangle")
        claims.append(
            passive_claims.authors_force(
                name.capitalize(), found[name].outcome, without, authors.ENTRY
            )
        )
    distances = [
        authors.distance(line, shape(found[name], push))
        for drawing, name in (("planar_case1", "narrow bend"), ("planar_case3", "half-circle"))
        for push, line in authors.drawn_shapes(drawing)
    ]
    claims.append(passive_claims.authors_shapes(distances))
    push, field = authors.field()
    within = (push > 0.1) & (push < 0.35)
    ours = found["steered"].outcome.field_at(push[within] + authors.ENTRY)
    claims.append(
        passive_claims.authors_field(
            authors.across(push[within], field[within]), authors.across(push[within], ours)
        )
    )
    return claims


SETUP = Part((HALF_CIRCLE, FAST, *FINER.values()), write_setup)
PASSIVE = Part((*HALF_CIRCLES.values(), SINUSOID), write_passive)
AUTHORS = Part(
    (authors.HALF_CIRCLE, authors.NARROW_BEND, authors.SINUSOID, authors.STEERED), write_authors
)
