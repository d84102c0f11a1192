"""The environments that come with magwire, by their names."""

from __future__ import annotations

from typing import Any

import gymnasium

STARTS = (0.0, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3)
"""Feeds that episodes of a known anatomy start from [m]."""
COMMON: dict[str, Any] = {"starts": STARTS, "input_error": 0.02, "noise": 1e-4}

TASKS: dict[str, dict[str, Any]] = {
    "HalfCircle": {"scenario": "half-circle", "input_limit": 40e-3},
    "Sinusoid": {"scenario": "sinusoid", "input_limit": 30e-3},
    "Helix": {"scenario": "helix", "input_limit": 70e-3},
    "Branch": {"scenario": "left-branch", "input_limit": 12e-3},
    "AorticArch": {
        "scenario": "aortic-arch",
        "overrides": ("wire.nodes=101",),
        "input_limit": 20e-3,
        "feed_speed": 20e-3,
    },
    "Coronary": {
        "scenario": "coronary",
        "overrides": ("wire.nodes=106", "lumen.target=diagonal 1", "feed.distance=70 mm"),
        "input_limit": 5e-3,
        "force_limit": 1e-4,
    },
    "RandomVessel": {
        "scenario": "tortuous",
        "overrides": (
            "wire.length=100 mm",
            "wire.nodes=101",
            "lumen.length=90 mm",
            "feed.distance=88 mm",
        ),
        "randomise": {
            "lumen.seed": (0, 2**32 - 1),
            "lumen.amplitude": ("2.5 mm", "4.5 mm"),
            "lumen.radius": ("2.6 mm", "3.2 mm"),
        },
        "starts": (0.0,),
        "input_limit": 8e-3,
        "force_limit": 4e-4,
    },
}
"""What each environment is, beside the defaults of ``Task``."""


def names() -> tuple[str, ...]:
    """Ids that ``gymnasium.make`` takes."""
    return tuple(f"magwire/{name}-v0" for name in TASKS)


def options_of(name: str, **more: Any) -> dict[str, Any]:
    """Fields of the ``Task`` of an environment; name: without ``magwire/`` and ``-v0``."""
    return {**COMMON, **TASKS[name], **more}


def register() -> None:
    """Make the ids known to Gymnasium; what is known already is left alone."""
    for name in TASKS:
        full = f"magwire/{name}-v0"
        if full not in gymnasium.registry:
            gymnasium.register(
                full,
                entry_point="magwire.env.wire_env:WireEnv",
                vector_entry_point="magwire.env.vector_env:WireVectorEnv",
                kwargs=options_of(name),
            )
