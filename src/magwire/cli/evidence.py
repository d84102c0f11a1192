"""The commands ``magwire reproduce`` and ``magwire verify``."""

from __future__ import annotations

from contextlib import nullcontext
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
    from magwire.progress import pieces
    from magwire.reproduce import report

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


def verify(
    *,
    full: Flag = False,
    only: Names = None,
    out: Path | None = None,
    force: Flag = False,
) -> int:
    """Compare with closed forms and other methods: the evidence that the physics is right.

    Parameters
    ----------
    full
        Run all cases, which takes minutes, and not only the fast ones.
    only
        Groups to run: elastica, magnetic, twist, dynamics, contact, authors, consistency, engines.
    out
        Folder for the report as verify.html and verify.json; nothing is written if left out.
    force
        Overwrite what is there.
    """
    from magwire.verify import report

    claim = nullcontext() if out is None else occupied(out, force=force)  # better before the work
    with claim:
        say_if_compiling()
        result = report.show(only or tuple(report.GROUPS), full=full)
        if out is not None:
            with writing_to(out):
                for path in report.save(result, out):
                    say(str(path))
    return 0 if result.passed else 1
