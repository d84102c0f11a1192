"""The command ``magwire animate``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.folders import passive_beside, writing_to
from magwire.cli.options import Flag
from magwire.cli.words import CommandError, say


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
        That of the picture, in pixels.
    seconds
        How long it takes.
    force
        Overwrite the file.
    """
    from magwire.plot import animation
    from magwire.report.progress import pieces
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
