"""The part of the page on the speed of computing."""

from __future__ import annotations

from pathlib import Path

from magwire.evidence.reproduce import pictures, speed_claims, tables
from magwire.evidence.reproduce.chapter import Chapter, Part
from magwire.evidence.reproduce.page import Picture
from magwire.evidence.reproduce.runs import METHODS, Ask, Runs

LUMENS = ("half-circle-narrow", "half-circle", "half-circle-wide", "sinusoid", "helix")
STEERED = ("half-circle", "sinusoid", "helix")
TIME_STEPS = (0.1, 0.03, 0.01, 0.003, 0.001)
UPDATES = (0.1, 0.02, 0.005, 0.001)
PLANNERS = ("stable", "newton")
"""Who steers runs in quasi-static motion."""
FINE_UPDATES = (*UPDATES, 0.0001)
USUAL = 0.005
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


def planned(lumen: str, method: str, step: float) -> Ask:
    """The same in quasi-static motion."""
    usual = updated(lumen, method, step)
    return Ask(lumen, method, (*usual.changes, "solver.motion=quasi-static"))


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
    plans = {
        (lumen, method, step): runs[planned(lumen, method, step)]
        for lumen in STEERED
        for method in PLANNERS
        for step in FINE_UPDATES
    }
    pictures.speed(grid, steered, plans, images / "speed.png")
    chapter.blocks = [
        Picture(
            "images/speed.png",
            "Computing time over simulated time, one core. Left: passive pushing against the time "
            "step. Middle: steered runs against the update step; the paper's optimiser holds its "
            "field in between, the others plan every 0.005 at least and hand over a "
            "schedule, so that a rarer update costs and changes little. Right: the same where the "
            "simulation, too, goes from equilibrium to equilibrium.",
        ),
        f"Steered runs at δX = {USUAL:g}: time of an update, and computing time of the whole run "
        "over simulated time. In the helix the longest update of the least-field navigator is the "
        "one in which it searches for the swing; it is most of the run's time.",
        tables.pace_table(
            {
                (lumen, method): (
                    steered[lumen, method, USUAL],
                    plans.get((lumen, method, USUAL)),
                )
                for lumen in STEERED
                for method in METHODS
            }
        ),
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
    least = [key for key in plans if key[1] == "stable"]
    chapter.expect_complete(tuple(planned(*key) for key in least), runs)
    return chapter


PART = Part(
    (
        *WARM_UP,
        *(stepped(lumen, dt) for lumen in LUMENS for dt in TIME_STEPS),
        *(updated(lumen, m, step) for lumen in STEERED for m in METHODS for step in UPDATES),
        *(planned(lumen, m, s) for lumen in STEERED for m in PLANNERS for s in FINE_UPDATES),
    ),
    write,
)
