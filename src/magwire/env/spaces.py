"""Spaces of the environments, and what goes in and out of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from magwire.env.episodes import BOUND, Seen, observed
from magwire.env.picture import SMALL
from magwire.env.task import Task


def action_space(inputs: int) -> spaces.Box:
    """Feed speed, twist rate and inputs, each in units of its limit."""
    return spaces.Box(-1.0, 1.0, (2 + inputs,), np.float32)


def observation_space(task: Task, inputs: int) -> spaces.Space[Any]:
    """Numbers, or numbers and an image."""
    numbers = spaces.Box(-BOUND, BOUND, (observed(inputs),), np.float32)
    if not task.image:
        return numbers
    image = spaces.Box(0, 255, (SMALL, SMALL, 1), np.uint8)
    return spaces.Dict({"vector": numbers, "image": image})


def observation(task: Task, seen: Seen, row: int | None = None) -> Any:
    """What is observed as the space has it: of all wires, or of one."""
    values: dict[str, NDArray[Any]] = {
        name: array if row is None else array[row] for name, array in seen.items()
    }
    return values if task.image else values["vector"]
