"""The commands ``magwire plot``, ``magwire animate`` and ``magwire view``."""

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


def animate(
    result: Path,
    /,
    *,
    out: Path | None = None,
    width: int = 960,
    seconds: float = 12.0,
    force: Flag = False,
) -> None:
    """Make a moving picture of a result: the wire in its lumen, the field and the tip force.

    Parameters
    ----------
    result
        Result file, or the folder that holds it.
    out
        File to write, .gif or .mp4 by its suffix; animation.gif next to the result if left out.
    width
        Of the picture, in pixels.
    seconds
        How long it takes.
    force
        Overwrite the file.
    """
    from magwire.plot import animation
    from magwire.progress import pieces
    from magwire.results import Result

    data = Result.load(result).dataset
    beside = result if result.is_dir() else result.parent
    passive = passive_beside(result)
    file = out or beside / "animation.gif"
    if file.exists() and not force:
        raise CommandError(f"File '{file}' exists already; use --force to overwrite it.")
    rate = 25 if file.suffix.lower() == ".mp4" else 12
    with writing_to(file.parent), pieces(round(seconds * rate)) as begin:
        animation.animate(
            data,
            file,
            passive=passive,
            width=width,
            seconds=seconds,
            rate=rate,
            watch=lambda *_: begin("frames"),
        )
    say(str(file))


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
