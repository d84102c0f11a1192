"""The tables of time steps: by case, by nodes, by points of the centreline."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from magwire.evidence.bench.columns import PICKS, Row, counts, iterations, passes, step_times, table
from magwire.evidence.bench.repeats import exponent, median

CASES_NOTE = (
    "Compiled stepping alone; every dt covers the same feed; nodes on the guide are no unknowns.\n"
    "dt below 5 ms in every other repeat. F*: force on the tip node, times L^2/EI.\n"
    "This is the paper's figure of relative compute time against dt: one over x real time."
)
POINTS_NOTE = "Set-up: scenario, models, the lumen's grid; once in a run."
FRICTION_NOTE = (
    "Ratio: a step with friction over one without. F*: force on the tip node, times L^2/EI."
)
BY_HAND_NOTE = "Other feed speed and inputs in every step. Ratio: over a step of a call of 1,000."
ACTUATORS_NOTE = (
    "Points: flux density, gradient and second derivatives at 100 points along a wire.\n"
    "Ratio: a step over one in a uniform field. 33 dipoles: as many as OctoMag's calibration has."
)
TREE_NOTE = "With very few points to a branch the spline through them is another tube."


def by_case(rows: Sequence[Row], push: float) -> Table:
    made = table(
        f"1  Time step by case and dt: N = 100, Q = 200, passive, X = 0 to {push:g}",
        *("case", "dt [ms]", "steps", "ms/step", "min", "Newton\n/step", "factor.\n/step"),
        *("retries", "x real\ntime", "peak F*"),
    )
    last = rows[0]["time_step"]
    for row in rows:
        samples, dt = row["samples"], row["time_step"]
        if dt != last:
            made.add_section()
            last = dt
        made.add_row(
            row["name"],
            f"{1e3 * dt:g}",
            f"{samples[0]['steps']}",
            *step_times(samples),
            *counts(samples),
            f"{samples[0]['simulated'] / median(samples, 'seconds'):.0f}",
            f"{samples[0]['peak']:.2f}",
        )
    return made


def by_friction(rows: Sequence[Row]) -> Table:
    """Each case with friction next to the same without."""
    made = table(
        "13  Friction: passive, dt = 10 ms",
        *("case", "mu", "ms/step", "min", "ratio", "ratio\nof min", "Newton\n/step"),
        *("factor.\n/step", "retries", "peak F*"),
    )
    smooth = {row["name"]: row["samples"] for row in rows if row["friction"] == 0.0}
    for row in rows:
        samples, without = row["samples"], smooth[row["name"]]
        ratios = [pick(samples, "seconds") / pick(without, "seconds") for pick in PICKS]
        made.add_row(
            row["name"],
            f"{row['friction']:g}",
            *step_times(samples),
            *(f"{ratio:.2f}" for ratio in ratios),
            *counts(samples),
            f"{samples[0]['peak']:.2f}",
        )
    return made


def by_hand(rows: Sequence[Row]) -> Table:
    """Steps from Python next to those of one call."""
    made = table(
        "15  Steps given from Python: half-circle, N = 100, passive to 50 mm, dt = 10 ms",
        *("steps", "us/step", "min", "ratio", "ratio\nof min"),
    )
    called = rows[0]["samples"]
    for row in rows:
        samples = row["samples"]
        times = [pick(samples, "seconds") for pick in PICKS]
        ratios = [spent / pick(called, "seconds") for spent, pick in zip(times, PICKS, strict=True)]
        made.add_row(
            row["how"],
            *(f"{1e6 * spent / samples[0]['steps']:.1f}" for spent in times),
            *(f"{ratio:.2f}" for ratio in ratios),
        )
    return made


def by_actuator(rows: Sequence[Row]) -> Table:
    """What a field of coils costs next to a uniform one."""
    made = table(
        "16  Fields of coils: half-circle, N = 100, passive, dt = 10 ms",
        *("field", "us/step", "min", "ratio", "ratio\nof min", "us /\n100 points", "min"),
    )
    uniform = rows[0]["samples"]
    for row in rows:
        times = [pick(row["samples"], "seconds") for pick in PICKS]
        ratios = [
            spent / pick(uniform, "seconds") for spent, pick in zip(times, PICKS, strict=True)
        ]
        at = [f"{1e6 * pick(row['points'], 'seconds'):.1f}" for pick in PICKS if row["points"]]
        made.add_row(
            row["what"],
            *(f"{1e6 * spent:.1f}" for spent in times),
            *(f"{ratio:.2f}" for ratio in ratios),
            *(at or ["-", "-"]),
        )
    return made


def by_nodes(rows: Sequence[Row]) -> Table:
    made = table(
        "2  Against the number of nodes N: half-circle, dt = 10 ms",
        *("N", "ms/step", "min", "Newton\n/step", "factor.\n/step", "retries"),
        *("us /\niteration", "us /\npass", "peak F*"),
    )
    for row in rows:
        samples = row["samples"]
        made.add_row(
            f"{row['nodes']}",
            *step_times(samples),
            *counts(samples),
            f"{1e6 * median(samples, 'seconds') / iterations(samples):.1f}",
            f"{1e6 * median(samples, 'seconds') / passes(samples):.1f}",
            f"{samples[0]['peak']:.2f}",
        )
    return made


def exponents(rows: Sequence[Row]) -> str:
    """Fits of time ~ N^p, and what the columns mean."""
    sizes, runs = [row["nodes"] for row in rows], [row["samples"] for row in rows]
    work = (
        ("step", lambda samples: samples[0]["steps"]),
        ("iteration", iterations),
        ("pass", passes),
    )
    texts = []
    for name, count in work:
        fits = [
            exponent(sizes, [pick(samples, "seconds") / count(samples) for samples in runs])
            for pick in PICKS
        ]
        texts.append(f"{fits[0]:.3f} per {name} (min {fits[1]:.3f})")
    return (
        f"p in N^p: {', '.join(texts)}.\n"
        "Pass: evaluation of the residual, 1 + Newton iterations in each attempt at a step.\n"
        "F*: with nodes closer than the wall's activation gap, the tip's neighbours bear a part."
    )


def by_points(rows: Sequence[Row]) -> Table:
    """Against the points of a single centreline."""
    return _against_points(
        rows, "3  Against the number of centreline points Q: half-circle, dt = 10 ms", "Q", 1
    )


def by_tree(rows: Sequence[Row]) -> Table:
    """Against the points of a tree, all branches together."""
    return _against_points(
        rows,
        "4  Against the size of a tree of three branches: left-branch, dt = 10 ms",
        "points",
        3,
    )


def _against_points(rows: Sequence[Row], title: str, name: str, branches: int) -> Table:
    first = rows[min(1, len(rows) - 1)] if branches > 1 else rows[0]
    made = table(
        title,
        *(name, "ms/step", "min", f"ratio to\n{branches * first['points']}", "ratio\nof min"),
        *("Newton\n/step", "factor.\n/step", "retries", "set-up\n[ms]", "peak F*"),
    )
    for row in rows:
        samples = row["samples"]
        ratios = [pick(samples, "seconds") / pick(first["samples"], "seconds") for pick in PICKS]
        made.add_row(
            f"{branches * row['points']}",
            *step_times(samples),
            *(f"{ratio:.3f}" for ratio in ratios),
            *counts(samples),
            f"{1e3 * median(samples, 'setup'):.0f}",
            f"{samples[0]['peak']:.2f}",
        )
    return made
