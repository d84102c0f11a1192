"""Wires in vessels as environments of Gymnasium; ``pip install magwire[env]``.

To import this module is what makes the ids ``magwire/...-v0`` known.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from magwire.env.ids import TASKS, names, register
from magwire.env.sb3 import to_sb3
from magwire.env.task import Task
from magwire.env.vector_env import WireVectorEnv
from magwire.env.wire_env import WireEnv

__all__ = [
    "TASKS",
    "Task",
    "WireEnv",
    "WireVectorEnv",
    "from_scenario",
    "names",
    "register",
    "to_sb3",
]

register()


def from_scenario(scenario: str | Path, **task: Any) -> WireEnv:
    """An environment of a scenario.

    Parameters
    ----------
    scenario
        Name of a scenario of the library, or a TOML file.
    **task
        Further fields of ``Task``, and ``render_mode``.

    Raises
    ------
    ScenarioError
        If the scenario has faults.
    """
    return WireEnv(scenario=scenario, **task)
