"""Progress bars, and lines where there is no terminal."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.progress import Progress, ProgressColumn

    from magwire.engine.record import Record

WIDTH = 28
"""Of a bar, in characters."""
EVERY = 10.0
"""Time between lines where there is no terminal [s]."""


def bar(*columns: ProgressColumn) -> Progress:
    """A progress bar on standard error; at its end it is gone.

    Where that is no terminal it is printed as a line every ten seconds, so that a log of long work
    shows how far it is and quick work prints nothing.
    """
    from rich.console import Console
    from rich.progress import Progress

    class Lines(Progress):
        said = time.monotonic()

        def update(self, *args: Any, **fields: Any) -> None:
            super().update(*args, **fields)
            if time.monotonic() - self.said >= EVERY:
                self.said = time.monotonic()
                self.console.print(*self.get_renderables())

    console = Console(stderr=True)
    if console.is_terminal:
        return Progress(*columns, console=console, transient=True)
    return Lines(*columns, console=Console(stderr=True, width=120), disable=True)


@contextmanager
def pieces(total: int) -> Iterator[Callable[[str], None]]:
    """A progress bar for work that comes in pieces.

    Parameters
    ----------
    total
        Number of pieces.

    Yields
    ------
    callable
        To be called with the name of each piece before it starts.
    """
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn

    columns = (
        BarColumn(bar_width=WIDTH),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}"),
    )
    with bar(*columns) as shown:
        task = shown.add_task("", total=total, completed=-1)

        def begin(name: str) -> None:
            shown.update(task, advance=1, description=name)

        yield begin


class _Listener(logging.Handler):
    """Shows what the work itself says of how far it is."""

    def __init__(self, show: Callable[[str], None]) -> None:
        super().__init__()
        self._show = show

    def emit(self, record: logging.LogRecord) -> None:
        self._show(record.getMessage())


@contextmanager
def listening(show: Callable[[str], None]) -> Iterator[None]:
    """What navigators say while they plan is shown."""
    said, listener = logging.getLogger("magwire.navigate"), _Listener(show)
    level = said.level
    said.addHandler(listener)
    said.setLevel(logging.INFO)
    try:
        yield
    finally:
        said.removeHandler(listener)
        said.setLevel(level)


@contextmanager
def running(duration: float) -> Iterator[Callable[[Record], None]]:
    """A progress bar for a run: feed, tip force and real-time factor; before it, how far plans are.

    Parameters
    ----------
    duration
        Simulated time at the end of the run [s].

    Yields
    ------
    callable
        To be called with every record.
    """
    from rich.progress import BarColumn, TaskProgressColumn, TextColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=WIDTH),
        TaskProgressColumn(),
        TextColumn("feed {task.fields[feed]:5.1f} mm"),
        TextColumn("tip force {task.fields[force]:6.3f} mN"),
        TextColumn("{task.fields[factor]:.1f} x real time"),
    )
    start = time.perf_counter()
    with bar(*columns) as shown:
        task = shown.add_task("running", total=duration, feed=0.0, force=0.0, factor=0.0)

        def watch(record: Record) -> None:
            shown.update(
                task,
                description="running",
                completed=record.time,
                feed=1e3 * record.feed,
                force=1e3 * record.tip_force,
                factor=record.time / max(time.perf_counter() - start, 1e-9),
            )

        with listening(lambda said: shown.update(task, description=said)):
            yield watch
