"""Folders that commands write to, and what a run leaves there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from magwire.cli.words import CommandError
from magwire.files import claimed, is_left_over

if TYPE_CHECKING:
    import xarray as xr

RESULT, SCENARIO, FIGURES = "result.nc", "scenario.toml", ("figure.png", "figure.svg")
PASSIVE, SCHEDULE = "result-none.nc", "schedule.csv"


def check_free(folder: Path, *, force: bool) -> None:
    """Refuse a folder that holds something, unless it may be overwritten."""
    if folder.exists() and not folder.is_dir():
        raise CommandError(f"Output folder '{folder}' is a file; expected a folder or a new name.")
    if not force and folder.is_dir() and not all(map(is_left_over, folder.iterdir())):
        raise CommandError(
            f"Output folder '{folder}' exists already; use --force to overwrite it, "
            "or --out for another."
        )


@contextmanager
def occupied(folder: Path, *, force: bool) -> Iterator[None]:
    """Make a folder that this process alone writes its output to, free of what dead ones left."""
    check_free(folder, force=force)
    with ExitStack() as stack:
        with writing_to(folder):
            stack.enter_context(claimed(folder, "Output folder"))
        check_free(folder, force=force)  # another one may just have ended
        yield


@contextmanager
def writing_to(folder: Path) -> Iterator[None]:
    """Make a folder and say it plainly if it cannot be written to."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise CommandError(f"Output folder '{folder}' cannot be written: {reason}.") from error


def passive_beside(result: Path) -> xr.Dataset | None:
    """The run without steering that was made with a result, if there is one."""
    from magwire.results import Result

    beside = result if result.is_dir() else result.parent
    compared = (result.is_dir() or result.name == RESULT) and (beside / PASSIVE).exists()
    return Result.load(beside / PASSIVE).dataset if compared else None
