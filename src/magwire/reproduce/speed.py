"""The part of the page on the speed of computing."""

from __future__ import annotations

from pathlib import Path

from magwire.reproduce import pictures, speed_claims
from magwire.reproduce.chapter import Chapter, Part
from magwire.reproduce.page import Picture
from magwire.reproduce.runs import METHODS, Ask, Runs

LUMENS = ("half-circle-narrow", "half-circle", "half-circle-wide", "sinusoid", "helix")
STEERED = ("half-circle", "sinusoid", "helix")
TIME_STEPS = (0.1, 0.03, 0.01, 0.003, 0.001)
UPDATES = (0.1, 0.02, 0.005, 0.001)
LENGTH = 100.0
"""Of the wire [mm]."""
FEW = "output.record_every=1 mm"
"""Records take time, too."""
WARM_UP = tuple(Ask("half-circle", m, (FEW, "feed.distance=6 mm")) for m in ("none", *METHODS))
"""Loads and, the first time, compiles what the measured runs need."""


def stepped(lumen: str, dt: float) -> Ask:
    """A passive run with a time step [s]."""
    return Ask(lumen, changes=(FEW, f"solver.time_step={1e3 * dt:g} ms"))


def updated(lumen: str, method: str, step: float) -> Ask:
    """A steered run with an update step."""
    return Ask(lumen, method, (FEW, f"navigate.update_every={LENGTH * step:g} mm"))


def write(runs: Runs, images: Path) -> Chapter:
    """The chapter."""
    chapter = Chapter("Computational speed")
    passive = {(lumen, dt): runs[stepped(lumen, dt)] for lumen in LUMENS for dt in TIME_STEPS}
    steered = {
        (lumen, method, step): runs[updated(lumen, method, step)]
        for lumen in STEERED
        for method in METHODS
        for step in UPDATES
    }
    grid = {key: run.outcome for key, run in passive.items()}
    pictures.speed(
        grid,
        {
            key: (run.outcome, run.steering / max(float(run.result.time[-1]), 1e-9))
            for key, run in steered.items()
        },
        images / "speed.png",
    )
    chapter.blocks = [
        Picture(
            "images/speed.png",
            "Computing time over simulated time, one core. Left: passive pushing against the time "
            "step. Right: steered runs against the update step; the paper's optimiser holds its "
            "field in between, the others plan ahead every 0.005 at least and hand over a "
            "schedule, so that a rarer update costs and changes little.",
        )
    ]
    paper = {
        (lumen, step): run.outcome
        for (lumen, method, step), run in steered.items()
        if method == "paper"
    }
    chapter.claims = [
        speed_claims.large_steps(grid),
        speed_claims.real_time(grid),
        speed_claims.contact_free_up_to(paper),
        speed_claims.controlled_in_real_time(paper),
    ]
    chapter.expect_complete(tuple(stepped(lumen, dt) for lumen, dt in passive), runs)
    return chapter


PART = Part(
    (
        *WARM_UP,
        *(stepped(lumen, dt) for lumen in LUMENS for dt in TIME_STEPS),
        *(updated(lumen, m, step) for lumen in STEERED for m in METHODS for step in UPDATES),
    ),
    write,
)
