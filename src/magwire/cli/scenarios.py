"""The commands ``magwire list`` and ``magwire schema``."""

from __future__ import annotations

import json

from magwire.cli.words import say


def list_scenarios() -> None:
    """List the scenarios that come with magwire."""
    from magwire.scenario import load, names

    width = max(map(len, names()))
    for name in names():
        say(f"{name:{width}}  {load(name).description}")


def schema() -> None:
    """Print the JSON schema of scenario files."""
    from magwire.scenario import json_schema

    say(json.dumps(json_schema(), indent=2))
