"""The page that is printed."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from magwire.errors import ResultError
from magwire.evidence.bench import marches, others
from magwire.evidence.bench.repeats import Sample

WIDTH = 100
TIMES = ("setup", "seconds")


def show(results: dict[str, Any], console: Console | None = None) -> None:
    """Print the page, on standard output if nothing else is said."""
    if console is None:
        console = Console(highlight=False)
        if not console.is_terminal:
            console = Console(highlight=False, width=WIDTH)
    for line in heading(results):
        console.print(line)
    for made, note in tables(results):
        console.print(f"\n[bold]{made.title}[/]")
        made.title = None  # rich would break it to the width of the table
        console.print(made, end="")
        if note:
            console.print(note)
    console.print(closing(results))
    if results["settings"]["quick"]:
        console.print("--quick: one repeat of a short feed; the times are no measurement.")


def load(path: Path) -> dict[str, Any]:
    """Samples from a file that ``magwire bench --json`` printed.

    Raises
    ------
    ResultError
        If it is none.
    """
    try:
        results: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ResultError(f"File '{path}' holds no samples of magwire bench: {error}.") from None
    if not isinstance(results, dict) or "settings" not in results:
        raise ResultError(f"File '{path}' holds no samples of magwire bench.")
    return results


def text(results: dict[str, Any]) -> str:
    """The page as plain text."""
    paper = io.StringIO()
    show(results, Console(file=paper, highlight=False, width=WIDTH, color_system=None))
    return "\n".join(line.rstrip() for line in paper.getvalue().splitlines()) + "\n"


def tables(results: dict[str, Any]) -> Iterator[tuple[Table, str]]:
    """All tables that there are samples for, each with its note."""
    push = results["settings"]["push"]
    yield marches.by_case(results["cases"], push), marches.CASES_NOTE
    yield marches.by_nodes(results["nodes"]), marches.exponents(results["nodes"])
    yield marches.by_points(results["points"]), marches.POINTS_NOTE
    yield marches.by_tree(results["tree"]), marches.TREE_NOTE
    yield others.by_update(results["updates"], push), others.UPDATES_NOTE
    yield others.by_steered(results["steered"]), others.STEERED_NOTE
    yield others.by_start(results["starts"]), others.STARTS_NOTE
    yield others.by_writing(results["writing"]), ""
    if results["memory"]:
        yield others.by_memory(results["memory"]), ""
    if results["many"]:
        yield others.by_workers(results["many"]), others.MANY_NOTE
    if results["engines"]:
        yield others.by_engine(results["engines"]), others.ENGINES_NOTE
    if results.get("learning"):  # samples of older builds have none
        yield others.by_environment(results["learning"]), others.LEARNING_NOTE
    if results.get("friction"):  # samples of earlier versions have none
        yield marches.by_friction(results["friction"]), marches.FRICTION_NOTE
    if results.get("by_hand"):
        yield marches.by_hand(results["by_hand"]), marches.BY_HAND_NOTE
    if results.get("actuators"):
        yield marches.by_actuator(results["actuators"]), marches.ACTUATORS_NOTE
    if results.get("driving"):
        yield others.by_driving(results["driving"]), others.DRIVING_NOTE


def heading(results: dict[str, Any]) -> list[str]:
    """What the measurements were made on, and how."""
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
    """Whether everything but the times was the same in all repeats."""
    rows = [row for name in ("cases", "nodes", "points", "tree") for row in results[name]]
    equal = all(same(row["samples"]) for row in rows)
    counts = "are the same in all repeats" if equal else "DIFFER between repeats"
    return f"Counts and peaks {counts}. Measured in {results['settings']['total_seconds']:.0f} s."


def same(samples: Sequence[Sample]) -> bool:
    """Whether everything but the time is equal."""
    untimed = [{k: v for k, v in s.items() if k not in TIMES} for s in samples]
    return all(one == untimed[0] for one in untimed)
