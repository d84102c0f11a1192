"""The models of an episode, and what an environment knows about the way through them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from magwire.batch import start_of
from magwire.engine.plant import Snapshot
from magwire.env.task import Task
from magwire.errors import InputError
from magwire.scenario import load
from magwire.scenario.job import Job
from magwire.simulation import Simulation

Array = NDArray[np.float64]

ROWS = 512
"""Of the table of a path; columns: centre (3), radius, tangent (3) and two normals (3, 3)."""
_QUANTITY = re.compile(r"\s*([-+0-9.eE]+)\s*(.*)")


@dataclass(frozen=True, eq=False)
class Anatomy:
    """A wire and a lumen, and the way to the target.

    Attributes
    ----------
    job
        The scenario as models.
    goal
        How far along the path the tip is to come [m].
    path
        Table of the path, shape (ROWS, 13) [m].
    spacing
        Arc length from one row to the next [m].
    starts
        Wires to start from, one for each of the task's feeds.
    """

    job: Job
    goal: float
    path: Array
    spacing: float
    starts: tuple[Snapshot, ...]

    @property
    def simulation(self) -> Simulation:
        """The models together."""
        return self.job.simulation

    @cached_property
    def outline(self) -> Array:
        """Centres and radii of all branches, shape (n, 4) [m]."""
        parts = []
        for branch in self.simulation.system.lumen.branches:
            arcs = np.linspace(0.0, branch.length, max(8, int(branch.length / 5e-4)))
            parts.append(branch.curve.at(arcs))
        return np.concatenate(parts)


def draw(task: Task, chance: np.random.Generator) -> tuple[str, ...]:
    """Overrides of the scenario for one episode."""
    return tuple(f"{key}={_value(task, key, chance)}" for key in sorted(task.randomise))


def _value(task: Task, key: str, chance: np.random.Generator) -> str:
    low, high = task.randomise[key]
    if isinstance(low, int) and isinstance(high, int):
        if key.endswith("seed"):
            low, high = _half(task, key, (low, high))
        return str(int(chance.integers(low, high, endpoint=True)))
    (a, unit), (b, other) = _parts(key, low), _parts(key, high)
    if unit != other:
        raise InputError(
            f"Input randomise of Task must give the ends of {key} in the same unit; received "
            f"{low!r} and {high!r}."
        )
    drawn = chance.uniform(a, b)
    return f'"{drawn:.9g} {unit}"' if unit else f"{drawn:.9g}"


def _half(task: Task, key: str, whole: tuple[int, int]) -> tuple[int, int]:
    """The seeds of a split: the lower half of the range is for training."""
    low, high = whole
    middle = low + (high - low) // 2
    if high <= low:
        raise InputError(
            f"Input randomise of Task must give {key} at least two seeds, one to train and one to "
            f"test; received {low} to {high}."
        )
    return (low, middle) if task.split == "train" else (middle + 1, high)


def _parts(key: str, value: object) -> tuple[float, str]:
    """Number and unit of a quantity."""
    found = _QUANTITY.fullmatch(str(value))
    try:
        return float(found[1] if found else ""), found[2].strip() if found else ""
    except ValueError:
        raise InputError(
            f"Input randomise of Task must give {key} as numbers or quantities; received {value!r}."
        ) from None


def build(task: Task, drawn: tuple[str, ...] = ()) -> Anatomy:
    """The models of a task.

    Raises
    ------
    ScenarioError
        If the scenario has faults.
    ConvergenceError
        If there is no equilibrium at a start.
    """
    job = load(task.scenario, (*task.overrides, *drawn)).build()
    system = job.simulation.system
    if not system.lumen.branches:
        raise InputError("Input scenario of Task must have a lumen; received open space.")
    path = system.path
    far = task.goal * min(job.feed.largest, path.length)
    starts = tuple(start_of(job.simulation, feed) for feed in task.starts)
    return Anatomy(job, far, path_table(job), path.length / (ROWS - 1), starts)


def path_table(job: Job) -> Array:
    """Centre, radius, tangent and two normals along the path, shape (ROWS, 13) [m].

    The normals do not turn about the tangent on the way (parallel transport).
    """
    system = job.simulation.system
    curve = system.path.branches[0].curve
    arcs = np.linspace(0.0, curve.length, ROWS)
    centre, tangent = curve.at(arcs), curve.at(arcs, 1)[:, :3]
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    normal = np.empty((ROWS, 3))
    last = system.guide.director
    for k in range(ROWS):
        last = last - tangent[k] * (tangent[k] @ last)
        last = last / np.linalg.norm(last)
        normal[k] = last
    return np.hstack([centre, tangent, normal, np.cross(tangent, normal)])
