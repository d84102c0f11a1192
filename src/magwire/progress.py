"""A progress bar for work that comes in pieces."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def pieces(total: int) -> Iterator[Callable[[str], None]]:
    """A progress bar on standard error, if that is a terminal.

    Parameters
    ----------
    total
        Number of pieces.

    Yields
    ------
    callable
        To be called with the name of each piece before it starts.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    bar = Progress(
        BarColumn(bar_width=28),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}"),
        console=console,
        disable=not console.is_terminal,
        transient=True,
    )
    with bar:
        task = bar.add_task("", total=total, completed=-1)

        def begin(name: str) -> None:
            bar.update(task, advance=1, description=name)

        yield begin
