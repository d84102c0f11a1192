"""The command ``magwire list``."""

from __future__ import annotations

from magwire.cli.words import say


def list_scenarios() -> None:
    """List the scenarios that come with magwire."""
    from magwire.scenario import load, names

    width = max(map(len, names()))
    for name in names():
        say(f"{name:{width}}  {load(name).description}")
