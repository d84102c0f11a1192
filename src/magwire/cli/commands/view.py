"""The command ``magwire view``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.folders import writing_to
from magwire.cli.options import Flag
from magwire.cli.words import CommandError, say


def view(
    result: Path, other: Path | None = None, /, *, out: Path | None = None, force: Flag = False
) -> None:
    """Make a page that replays a result in a browser; one file, which needs no network.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    other
        A second one, to be shown beside it.
    out
        File to write; view.html next to the result if left out.
    force
        Overwrite the file.
    """
    from magwire.results import Result
    from magwire.view import page

    beside = result if result.is_dir() else result.parent
    file = out or beside / "view.html"
    if file.is_dir():
        raise CommandError(f"Page '{file}' is a folder; expected the name of a file.")
    if file.exists() and not force:
        raise CommandError(f"File '{file}' exists already; use --force to overwrite it.")
    paths = [result] if other is None else [result, other]
    loaded = [(path, Result.load(path).dataset) for path in paths]
    made = page(loaded)
    with writing_to(file.parent):
        made.save(file)
    say(f"{file}, {len(made.html.encode()) / 1e3:.0f} kB: open it in a browser")
