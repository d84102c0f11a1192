"""The command ``magwire schema``."""

from __future__ import annotations

import json

from magwire.cli.words import say


def schema() -> None:
    """Print the JSON schema of scenario files."""
    from magwire.scenario import json_schema

    say(json.dumps(json_schema(), indent=2))
