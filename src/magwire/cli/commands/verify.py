"""The command ``magwire verify``."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path

from magwire.cli.folders import occupied, writing_to
from magwire.cli.options import Flag, Names
from magwire.cli.words import say, say_if_compiling


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
        Groups to run: elastica, magnetic, twist, dynamics, contact, friction, authors,
        consistency, engines.
    out
        Folder for the report as verify.html and verify.json; nothing is written if left out.
    force
        Overwrite what is there.
    """
    from magwire.evidence.verify import page, report

    claim = nullcontext() if out is None else occupied(out, force=force)  # better before the work
    with claim:
        say_if_compiling()
        result = report.show(only or tuple(report.GROUPS), full=full)
        if out is not None:
            with writing_to(out):
                for path in page.save(result, out):
                    say(str(path))
    return 0 if result.passed else 1
