"""Run the groups; the report as a table for the terminal and as JSON."""

from __future__ import annotations

import json
import math
import platform
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib import import_module
from typing import TYPE_CHECKING

import magwire
from magwire.errors import InputError
from magwire.evidence.verify.evidence import NODES, Curve, Line, Raised, Skipped, Verdict

if TYPE_CHECKING:
    from rich.console import RenderableType

GROUPS = {
    "elastica": "Elastica",
    "magnetic": "Magnetic torque and force",
    "twist": "Twist",
    "dynamics": "Dynamics",
    "contact": "Contact",
    "friction": "Friction",
    "authors": "The authors' curves",
    "consistency": "Consistency",
    "engines": "Another engine",
}
"""The groups, each a module of this package with a function ``evidence``, and their titles."""

FILE_WIDTH = 160
"""Width of the table where it does not go to a terminal."""

Entry = Line | Skipped | Raised


def _machine() -> str:
    from importlib.metadata import version

    libraries = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba"))
    return f"Python {platform.python_version()}, {libraries}, {platform.platform()}"


@dataclass(frozen=True)
class Group:
    """What a group gave.

    Attributes
    ----------
    name, title
        From ``GROUPS``.
    entries, curves
        In the order in which they came.
    seconds
        Time that it took [s].
    """

    name: str
    title: str
    entries: tuple[Entry, ...]
    curves: tuple[Curve, ...]
    seconds: float


@dataclass(frozen=True)
class Report:
    """All groups that were run, and where and when.

    Attributes
    ----------
    groups
        In the order in which they were run.
    full
        Whether all cases were run, or the fast set.
    version, machine, date
        Version of magwire; Python, libraries and platform; UTC, to the second.
    """

    groups: tuple[Group, ...]
    full: bool
    version: str = field(default_factory=lambda: magwire.__version__)
    machine: str = field(default_factory=_machine)
    date: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))

    @property
    def passed(self) -> bool:
        """Whether there is a line, and none that fails."""
        counts = self.counts
        return counts["fail"] == 0 and counts["pass"] > 0

    @property
    def counts(self) -> Counter[Verdict]:
        """How many lines passed, failed and were skipped."""
        return Counter(entry.verdict for group in self.groups for entry in group.entries)

    @property
    def verdict(self) -> str:
        """All in one sentence."""
        counts = self.counts
        seconds = sum(group.seconds for group in self.groups)
        nothing = "" if counts["pass"] or counts["fail"] else " Nothing could be compared."
        return (
            f"{counts['pass']} lines pass, {counts['fail']} fail, {counts['skipped']} skipped, "
            f"in {seconds:.0f} s.{nothing}"
        )


def gather(
    names: Sequence[str] = tuple(GROUPS),
    *,
    full: bool = False,
    watch: Callable[[str, Entry | None], None] | None = None,
    done: Callable[[Group], None] | None = None,
) -> Report:
    """Run groups of cases.

    Parameters
    ----------
    names
        Names of the groups, among ``GROUPS``.
    full
        Run all cases, in minutes; the fast set if left out.
    watch
        Called with the title of a group when it starts, and with every entry when it is there.
    done
        Called with every group when it has ended.

    Raises
    ------
    InputError
        If there is no such group.
    """
    unknown = [name for name in names if name not in GROUPS]
    if unknown:
        raise InputError(
            f"Input names of verify must be among {', '.join(GROUPS)}; "
            f"received {', '.join(unknown)}."
        )
    groups = []
    for name in dict.fromkeys(names):
        group = _run(name, full=full, watch=watch)
        groups.append(group)
        if done is not None:
            done(group)
    return Report(tuple(groups), full)


def _run(
    name: str, *, full: bool, watch: Callable[[str, Entry | None], None] | None = None
) -> Group:
    title = GROUPS[name]
    entries: list[Entry] = []
    curves: list[Curve] = []
    begin = time.perf_counter()
    if watch is not None:
        watch(title, None)
    for piece in _evidence(name, full=full):
        if isinstance(piece, Curve):
            curves.append(piece)
        else:
            entries.append(piece)
            if watch is not None:
                watch(title, piece)
    if not entries:
        entries.append(Raised(name, "The group gave no line."))
    return Group(name, title, tuple(entries), tuple(curves), time.perf_counter() - begin)


def _evidence(name: str, *, full: bool) -> Iterator[Entry | Curve]:
    """A group's evidence; an error ends it, as an entry that fails."""
    try:
        yield from import_module(f"magwire.evidence.verify.{name}").evidence(full)
    except Exception as error:  # whatever it is, the other groups go on
        reason = " ".join(str(error).split())
        yield Raised(name, f"The group ended with {type(error).__name__}: {reason}")


def table(group: Group) -> RenderableType:
    """A group as a table, with the sources of its references below."""
    from rich.console import Group as Stack
    from rich.table import Table
    from rich.text import Text

    sources = list(dict.fromkeys(e.source for e in group.entries if isinstance(e, Line)))
    result = Table(title=f"{group.title} ({group.seconds:.1f} s)", title_justify="left", box=None)
    result.add_column("case", ratio=1)
    for heading in ("reference", "magwire", "error", "tolerance", "order"):
        result.add_column(heading, justify="right", no_wrap=True)
    result.add_column("verdict", no_wrap=True)
    colours = {"pass": "green", "fail": "bold red", "skipped": "yellow"}
    notes = [Text(f"({i}) {source}", style="dim") for i, source in enumerate(sources, 1)]
    for entry in group.entries:
        colour = colours[entry.verdict]
        if isinstance(entry, Line):
            unit = f" [{entry.unit}]" if entry.unit else ""
            cells = numbers(entry)
            cells[0] += f" ({sources.index(entry.source) + 1})"
            result.add_row(Text(entry.name + unit), *cells, Text(entry.verdict, style=colour))
        else:
            notes.append(Text(f"{entry.verdict}: {entry.case}: {entry.reason}", style=colour))
    return Stack(result, *notes, "")


def numbers(line: Line) -> list[str]:
    """Reference, value, error, tolerance and order as the reports print them."""
    percent = line.relative
    return [
        f"{line.reference:.6g}",
        f"{line.value:.6g}",
        f"{100 * line.error:.2g} %" if percent else f"{line.error:.1e}",
        f"{100 * line.tolerance:.3g} %" if percent else f"{line.tolerance:.0e}",
        "" if line.order is None else f"{line.order:.2f} of {line.expected_order:g}",
    ]


def show(names: Sequence[str] = tuple(GROUPS), *, full: bool = False) -> Report:
    """Run groups and print each as soon as it is there; what runs is said on standard error."""
    from rich.console import Console

    screen = Console()
    if not screen.is_terminal:
        screen.width = max(screen.width, FILE_WIDTH)
    progress = Console(stderr=True)
    with progress.status("") as status:

        def watch(title: str, entry: Entry | None) -> None:
            status.update(title if entry is None else f"{title}: {entry.case}")

        report = gather(names, full=full, watch=watch, done=lambda g: screen.print(table(g)))
    screen.print(report.verdict, highlight=False)
    return report


def to_json(report: Report) -> str:
    """The report as JSON; numbers that are not finite are null."""

    def number(value: float | None) -> float | None:
        return value if value is not None and math.isfinite(value) else None

    def entry(item: Entry) -> dict[str, object]:
        if not isinstance(item, Line):
            return {"case": item.case, "reason": item.reason, "verdict": item.verdict}
        return {
            "case": item.case,
            "quantity": item.quantity,
            "unit": item.unit,
            "reference": number(item.reference),
            "source": item.source,
            "value": number(item.value),
            "error": number(item.error),
            "tolerance": number(item.tolerance),
            "relative": item.relative,
            "order": number(item.order),
            "expected_order": number(item.expected_order),
            "verdict": item.verdict,
        }

    content = {
        "magwire": report.version,
        "machine": report.machine,
        "date": report.date,
        "full": report.full,
        "nodes": NODES,
        "passed": report.passed,
        "counts": dict(report.counts),
        "groups": [
            {
                "name": group.name,
                "title": group.title,
                "seconds": round(group.seconds, 2),
                "entries": [entry(item) for item in group.entries],
            }
            for group in report.groups
        ],
    }
    return json.dumps(content, indent=1, allow_nan=False) + "\n"
