"""Claims about the speed of computing."""

from __future__ import annotations

import math
from collections.abc import Mapping

from magwire.evidence.reproduce.active_claims import tip_word
from magwire.evidence.reproduce.claim import Claim, judged, percent
from magwire.evidence.reproduce.outcome import Outcome

Grid = Mapping[tuple[str, float], Outcome]
"""Runs by lumen and by time step [s], or by update step."""


def large_steps(runs: Grid) -> Claim:
    """Time steps of 0.1 s in all lumens, and how far the peak is from that of 10 ms."""
    coarse = {lumen: run for (lumen, dt), run in runs.items() if dt == 0.1}
    done = all(run.complete for run in coarse.values())
    off = max(abs(run.largest / runs[lumen, 0.01].largest - 1.0) for lumen, run in coarse.items())
    return Claim(
        "Speed, (A)",
        "Time steps up to 0.1 s are supported in all cases.",
        f"{sum(run.complete for run in coarse.values())} of {len(coarse)} lumens run through at "
        f"dt = 0.1 s; the peak force is within {percent(off)} of that at 10 ms.",
        judged(done and off < 0.02, done),
        "yes if all runs come to the end with the same peak within 2 %, partly if with another",
    )


def real_time(runs: Grid) -> Claim:
    """Relative compute time above dt = 0.003 s."""
    paces = {dt: max(r.pace for (_, d), r in runs.items() if d == dt) for _, dt in runs}
    checked = max(pace for dt, pace in paces.items() if dt >= 0.003)
    finest = min(paces)
    return Claim(
        "Speed, (A)",
        "The relative compute time falls below 1 when dt > 0.003 s.",
        f"At most {checked:.3f} for dt of 0.003 s and more, {paces[finest]:.3f} at {finest:g} s.",
        judged(checked < 1.0),
        "yes below 1; machine and code are others, so where it crosses 1 differs",
    )


def contact_free_up_to(runs: Grid) -> Claim:
    """No contact of the tip at an update step of 0.1, with the paper's optimiser."""
    coarse = {lumen: run for (lumen, step), run in runs.items() if step == 0.1}
    good = [run.contact_free for run in coarse.values()]
    found = "; ".join(f"{lumen}: {tip_word(run)}" for lumen, run in coarse.items())
    every = sorted({step for _, step in runs})
    held = [s for s in every if all(r.contact_free for (_, d), r in runs.items() if d == s)]
    return Claim(
        "Speed, (B)",
        "Contact is eliminated in all three cases if δX ≤ 0.1.",
        f"The paper's optimiser at δX = 0.1: {found}. Free in all cases at: "
        + (", ".join(f"{s:g}" for s in held) or "none of the steps")
        + ".",
        judged(all(good), any(good)),
        "yes if free in all cases, partly if in some; the field stays as it is between two updates",
    )


def controlled_in_real_time(runs: Grid) -> Claim:
    """Relative compute time of runs with the paper's optimiser at update steps from 0.005 on."""
    paces = [run.pace for (_, step), run in runs.items() if step >= 0.005]
    pace = max((pace for pace in paces if not math.isnan(pace)), default=math.nan)
    return Claim(
        "Speed, (B)",
        "Control is real-time when δX is larger than 0.005.",
        f"Plant and the paper's optimiser take at most {pace:.3f} of the simulated time.",
        judged(pace < 1.0),
        "yes below 1, on one core of the machine named above; runs that stop count as far as they "
        "go",
    )
