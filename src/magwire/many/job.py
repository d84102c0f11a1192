"""What goes to a worker, and what comes back."""

from __future__ import annotations

from typing import Any, NamedTuple


class Job(NamedTuple):
    """A run to do: its number, its scenario as TOML, its result file if there is to be one."""

    number: int
    scenario: str
    file: str | None


class Answer(NamedTuple):
    """A run that has ended: its number, and what ``task.run`` returned."""

    number: int
    done: dict[str, Any]
