"""The command ``magwire plot``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.folders import FIGURES, passive_beside, writing_to
from magwire.cli.options import Flag
from magwire.cli.words import CommandError, say


def plot(result: Path, /, *, out: Path | None = None, force: Flag = False) -> None:
    """Draw a result as figure.png and figure.svg.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    out
        Folder for the figures; next to the result, where they replace the ones of the run, if left
        out.
    force
        Overwrite figures in another folder.
    """
    from magwire import plot as pictures
    from magwire.results import Result

    data = Result.load(result)
    beside = result if result.is_dir() else result.parent
    passive = passive_beside(result)
    folder = out or beside
    if folder.exists() and not folder.is_dir():
        raise CommandError(f"Output folder '{folder}' is a file.")
    there = [name for name in FIGURES if (folder / name).exists()]
    if there and not force and folder.resolve() != beside.resolve():
        raise CommandError(
            f"Folder '{folder}' holds {' and '.join(there)} already; use --force to overwrite."
        )
    with writing_to(folder):
        for path in pictures.save(data.dataset, folder, passive=passive):
            say(str(path))
