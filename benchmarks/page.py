"""The page that is printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from repeats import Sample, column, exponent, least, median
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

WIDTH = 100
Row = dict[str, Any]
Pick = Callable[[Sequence[Sample], str], float]
PICKS: tuple[Pick, ...] = (median, least)
TIMES = ("setup", "seconds")

CASES_NOTE = (
    "Compiled stepping alone; every dt covers the same feed; nodes on the guide are no unknowns.\n"
    "dt = 1 ms in every other repeat. F*: force on the tip node, times L^2/EI."
)
POINTS_NOTE = "Set-up: scenario, models, the lumen's grid; once in a run."
STARTS_NOTE = "First step: of what `magwire run half-circle` does. Cold: nothing compiled yet."

# What it is, which start, from which mark to which.
STARTS = (
    ("import magwire", "import", "python", "magwire"),
    ("  and every public name", "names", "python", "names"),
    ("warm start: process to first step", "warm", None, "step"),
    ("  Python itself", "warm", None, "python"),
    ("  imports, scenario read and checked", "warm", "python", "scenario"),
    ("  models built", "warm", "scenario", "models"),
    ("  result file opened, first step", "warm", "models", "step"),
    ("cold start: process to first step", "cold", None, "step"),
)


def show(results: dict[str, Any]) -> None:
    console = Console(highlight=False)
    if not console.is_terminal:
        console = Console(highlight=False, width=WIDTH)
    for line in heading(results):
        console.print(line)
    push, quick = results["settings"]["push"], results["settings"]["quick"]
    for made, note in (
        (by_case(results["cases"], push), CASES_NOTE),
        (by_nodes(results["nodes"]), exponents(results["nodes"])),
        (by_points(results["points"]), POINTS_NOTE),
        (by_start(results["starts"]), STARTS_NOTE),
        (by_writing(results["writing"]), ""),
    ):
        console.print()
        console.print(made, end="")
        console.print(note)
    console.print(closing(results))
    if quick:
        console.print("--quick: one repeat of a short feed; the times are no measurement.")


def heading(results: dict[str, Any]) -> list[str]:
    at, settings = results["machine"], results["settings"]
    before, after = (f"{x:.2f}" if x is not None else "-" for x in settings["load_average"])
    packages = ", ".join(f"{name} {at[name]}" for name in ("numpy", "numba", "scipy"))
    return [
        f"[bold]magwire {at['magwire']}[/] on {at['cpu']}, {at['cores']} cores, {at['system']}",
        f"{at['python']}, {packages}, llvmlite {at['llvmlite']}",
        f"1 thread; {settings['repeats']} interleaved repeats: median, and min next to it; "
        f"load average {before} before, {after} after",
    ]


def closing(results: dict[str, Any]) -> str:
    rows = [row for name in ("cases", "nodes", "points") for row in results[name]]
    equal = all(same(row["samples"]) for row in rows)
    counts = "are the same in all repeats" if equal else "DIFFER between repeats"
    return f"Counts and peaks {counts}. Measured in {results['settings']['total_seconds']:.0f} s."


def same(samples: Sequence[Sample]) -> bool:
    """Whether everything but the time is equal."""
    untimed = [{k: v for k, v in s.items() if k not in TIMES} for s in samples]
    return all(one == untimed[0] for one in untimed)


def table(title: str, *columns: str) -> Table:
    made = Table(
        title=title,
        box=box.SIMPLE_HEAD,
        title_justify="left",
        title_style="bold",
        padding=(0, 1),
        collapse_padding=True,
        pad_edge=False,
    )
    for number, name in enumerate(columns):
        side = "right" if number else "left"
        made.add_column(escape(name), justify=side, vertical="bottom", no_wrap=True)
    return made


def per_step(samples: Sequence[Sample], pick: Pick = median) -> float:
    """Wall time of a step [ms]."""
    return 1e3 * pick(samples, "seconds") / samples[0]["steps"]


def iterations(samples: Sequence[Sample]) -> float:
    return samples[0]["newton_iterations"]


def passes(samples: Sequence[Sample]) -> float:
    """Evaluations of the residual: one to begin with in each attempt, one after each iteration."""
    first = samples[0]
    return first["steps"] + first["retries"] + first["newton_iterations"]


def counts(samples: Sequence[Sample]) -> list[str]:
    """Iterations and factorisations per step, retries; a march that broke off says so."""
    first = samples[0]
    retries = f"{first['retries']}"
    if not first["converged"]:
        retries = f"[red]stopped at step {first['steps']}[/]"
    return [
        f"{first['newton_iterations'] / first['steps']:.2f}",
        f"{first['factorisations'] / first['steps']:.2f}",
        retries,
    ]


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
            f"{per_step(samples):.4f}",
            f"{per_step(samples, least):.4f}",
            *counts(samples),
            f"{samples[0]['simulated'] / median(samples, 'seconds'):.0f}",
            f"{samples[0]['peak']:.2f}",
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
            f"{per_step(samples):.4f}",
            f"{per_step(samples, least):.4f}",
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
    made = table(
        "3  Against the number of centreline points Q: half-circle, dt = 10 ms",
        *(
            "Q",
            "ms/step",
            "min",
            f"ratio to\nQ = {rows[0]['points']}",
            "ratio\nof min",
            "Newton\n/step",
        ),
        *("factor.\n/step", "retries", "set-up\n[ms]", "peak F*"),
    )
    for row in rows:
        samples = row["samples"]
        ratios = [pick(samples, "seconds") / pick(rows[0]["samples"], "seconds") for pick in PICKS]
        made.add_row(
            f"{row['points']}",
            f"{per_step(samples):.4f}",
            f"{per_step(samples, least):.4f}",
            *(f"{ratio:.3f}" for ratio in ratios),
            *counts(samples),
            f"{1e3 * median(samples, 'setup'):.0f}",
            f"{samples[0]['peak']:.2f}",
        )
    return made


def by_start(starts: dict[str, list[Sample]]) -> Table:
    made = table(
        "4  Starts, each in a fresh process",
        *("", "s", "min", "repeats"),
    )
    for name, key, begin, end in STARTS:
        if key not in starts:
            made.add_row(name, "left out", "", "0")
            continue
        spans = [{"s": s[end] - (s[begin] if begin else 0.0)} for s in starts[key]]
        made.add_row(name, f"{median(spans, 's'):.3f}", f"{least(spans, 's'):.3f}", f"{len(spans)}")
    if "cold" in starts:
        compiling = median(starts["cold"], "step") - median(starts["warm"], "step")
        made.add_row("  compiling: cold less warm", f"{compiling:.3f}", "", "")
    return made


def by_writing(writing: dict[str, list[Sample]]) -> Table:
    made = table(
        "5  What recording and the result file cost: half-circle, dt = 10 ms",
        *("", "s", "min", "records", "file\n[kB]", "added, part\nof the whole"),
    )
    whole = median(writing["file"], "seconds")
    before = 0.0
    for name, key in (
        ("stepping alone", "stepping"),
        ("Simulation.run without out", "no_file"),
        ("Simulation.run with out", "file"),
    ):
        samples = writing[key]
        seconds = median(samples, "seconds")
        made.add_row(
            name,
            f"{seconds:.3f}",
            f"{least(samples, 'seconds'):.3f}",
            f"{samples[0].get('records', 0):.0f}",
            f"{max(column(samples, 'bytes')) / 1e3:.0f}" if key == "file" else "",
            f"{100 * (seconds - before) / whole:+.0f} %",
        )
        before = seconds
    back = median(writing["file"], "reading")
    made.add_row(
        "  of it: reading the file back",
        f"{back:.3f}",
        f"{least(writing['file'], 'reading'):.3f}",
        *("", "", f"{100 * back / whole:+.0f} %"),
    )
    return made
