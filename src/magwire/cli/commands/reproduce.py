"""The command ``magwire reproduce``."""

from __future__ import annotations

from pathlib import Path

from magwire.cli.folders import occupied, writing_to
from magwire.cli.options import Flag, Names
from magwire.cli.words import complain, say, say_if_compiling


def reproduce(*, only: Names = None, out: Path | None = None, force: Flag = False) -> int:
    """Run the paper's cases: figures, and what it says next to what magwire finds.

    Parameters
    ----------
    only
        Parts of the page: setup, passive, half-circle, sinusoid, helix, branches, authors, speed.
    out
        Folder for reproduce.html, reproduce.md and images; reproduce in the working folder if left
        out.
    force
        Overwrite what a former run left in the folder.
    """
    from magwire.evidence.reproduce import report
    from magwire.report.progress import pieces

    names = report.chosen(only)
    folder = out or Path("reproduce")
    say_if_compiling()
    total = len(report.asks(names)) + len(names)
    with occupied(folder, force=force), writing_to(folder), pieces(total) as begin:
        chapters = report.reproduce(folder, names, watch=begin)
    for chapter in chapters:
        for text in chapter.broken:
            complain(text)
    say(str(folder / report.PAGE))
    return 1 if any(chapter.broken for chapter in chapters) else 0
