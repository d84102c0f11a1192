"""Episodes of n wires side by side: actions in, observations, rewards and forces out.

All numbers are arrays with a row for each wire, and no row depends on another: one wire gives bit
for bit what it gives among others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.batch import Batch, raw_sight, start_of
from magwire.engine.plant import Plant
from magwire.env import anatomy
from magwire.env.anatomy import Anatomy
from magwire.env.picture import SMALL, View
from magwire.env.task import AHEAD, Task
from magwire.kernels.guide import place_held
from magwire.kernels.outlook import ROW, ask, report, settle

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Seen = dict[str, NDArray[Any]]

_AHEAD = np.array(AHEAD)
_TOLD = ("tip_force", "max_wall_force", "cost", "progress", "success", "branch")
BOUND = 10.0
"""No observed number is larger; those of a wire in its lumen are around one."""
WEIGHTS = (10.0, 1.0, 0.2, 0.05, 10.0)
"""Of the reward: progress, success, haste, force, and the largest force; see ``Episodes.act``."""


class Episodes:
    """Wires that act until they are there, or until time is up.

    Parameters
    ----------
    task
        What is to be done.
    count
        Number of wires.
    threads
        That work at once; one for each processor if left out.

    Attributes
    ----------
    reward, terminated, truncated
        Those of the last action, shape (n,).
    info
        Arrays with a row for each wire, as the environments' documentation has them.
    """

    def __init__(self, task: Task, count: int, *, threads: int | None = None) -> None:
        self.task = task
        self._known = None if task.randomise else anatomy.build(task)
        chance = np.random.default_rng(0)  # of anatomies that are never seen
        first = self._known or anatomy.build(task, anatomy.draw(task, chance))
        self.anatomies: list[Anatomy] = [first] * count
        self.batch = Batch(
            [first.simulation] * count, time_step=first.job.time_step, threads=threads
        )
        self._chance = [chance] * count
        self._rows = np.arange(count)
        self._paths = np.repeat(first.path[None], count, axis=0)
        self._spacing, self._goal = np.full(count, first.spacing), np.full(count, first.goal)
        self.inputs = self.batch.observe().inputs.shape[1]
        self._asked, self._gain = np.zeros((count, self.inputs)), np.ones((count, self.inputs))
        self._last = np.zeros((count, 2 + self.inputs))
        self._taken = np.zeros(count, dtype=np.int64)
        self._arc, self._frame = np.zeros(count), np.zeros((count, 3, 3))
        self._limit = task.input_limit if task.axes == "path" else -task.input_limit
        self._seen, self._row = np.zeros((count, 8)), np.zeros(ROW)
        self._off = np.zeros((count, 3))
        self._numbered = np.zeros((count, observed(self.inputs)))
        self._views: list[View | None] = [None] * count
        self.reward = np.zeros(count)
        self.terminated, self.truncated = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
        self.info: dict[str, NDArray[Any]] = {}
        self._history: list[Seen] = []
        seen = self._look(self._rows)
        self._history = [self._copy(seen) for _ in range(task.delay + 1)]
        self._shown = self._copy(seen)

    def begin(
        self, wires: Sequence[int], chances: Sequence[np.random.Generator], feed: float | None
    ) -> None:
        """Start new episodes of some wires, each with its own chance.

        Parameters
        ----------
        wires, chances
            Which wires, and where their chance comes from until their next episode.
        feed
            Length of wire past the entrance to start with [m]; one of the task's if left out.
        """
        task, back = self.task, {}
        for i, chance in zip(wires, chances, strict=True):
            self._chance[i] = chance
            if task.randomise:
                self._move_in(i, anatomy.build(task, anatomy.draw(task, chance)))
            now = self.anatomies[i]
            start = now.starts[int(chance.integers(len(now.starts)))]
            back[i] = start if feed is None else start_of(now.simulation, feed)
            self._gain[i] = 1.0 + task.input_error * chance.standard_normal(self.inputs)
        self.batch.restore(back)
        some = np.asarray(wires, dtype=np.int64)
        for kept in (self._asked, self._last, self._taken, self._arc, self.reward):
            kept[some] = 0
        self.terminated[some] = self.truncated[some] = False
        seen = self._look(some)
        for older in (*self._history, self._shown):
            for name, values in older.items():
                values[some] = seen[name][some]

    def _move_in(self, i: int, new: Anatomy) -> None:
        """Give a wire another anatomy."""
        self.batch.put(i, Plant(new.simulation.system))
        self.anatomies[i], self._views[i] = new, None
        self._paths[i], self._spacing[i], self._goal[i] = new.path, new.spacing, new.goal

    def act(self, actions: ArrayLike, only: Flags | None = None) -> None:
        """Carry out an action for each wire, or for some of them.

        The reward of an action is 10 times the share of the way to the goal that the tip has gained
        (lost, if negative; nothing past the goal), and 1 for reaching the goal; less 0.2 over the
        number of actions that an episode may have; less 0.05 times the wall's force on the tip and
        the cost, in units of the limit, of which no more than 10 count.
        """
        task, whole = self.task, self.task.action_time
        only = np.ones(len(self._rows), dtype=bool) if only is None else only
        action = np.minimum(np.maximum(np.asarray(actions, dtype=np.float64), -1.0), 1.0)
        most = task.input_rate * whole
        ask(action[:, 2:], self._frame, self._limit, most, only, self._asked)
        speed, rate = action[:, 0] * task.feed_speed, action[:, 1] * task.twist_rate
        applied = self._asked * self._gain
        ended = self.batch.step(speed, rate, applied, whole, only=only)
        self._last[only] = action[only]
        self._taken += only
        before, moved = self._arc.copy(), np.flatnonzero(only)
        self._remember(self._look(moved), only)
        force = (self.info["tip_force"] + self.info["cost"]) / task.force_limit
        over = (self.terminated, self.truncated)
        course = (only, ended, self._taken, task.actions, before, self._arc, self._goal, force)
        settle(*course, WEIGHTS, self.reward, over)
        self.info["unconverged"][moved] = ended[moved] != 0
        command = self.info["command"]
        command[moved, 0], command[moved, 1] = speed[moved], rate[moved]
        command[moved, 2:] = applied[moved]

    def share_of(self, inputs: Array) -> Array:
        """Which actions ask for some inputs, shape (n, m), beyond one where the limit is."""
        share = inputs / self.task.input_limit
        if self.task.axes == "world":
            return share
        return along(share[:, None], self._frame)[:, 0]

    def measured_factors(self) -> Array:
        """What the actuators make of one tesla that is asked for, shape (n, m); 1 if of none."""
        made, asked = self.batch.observe().inputs, self._asked
        return np.divide(made, asked, out=np.ones_like(asked), where=asked != 0.0)

    def _look(self, fresh: NDArray[np.int64]) -> Seen:
        """What is observed of all wires; those in ``fresh`` have changed.

        Renews what is told of them, in arrays of its own, and the paths' frames at their tips.
        """
        n, task = len(self._rows), self.task
        if task.noise > 0.0:
            self._off[:] = 0.0
            for i in fresh:
                self._off[i] = task.noise * self._chance[i].standard_normal(3)
        force, largest, cost, progress = (np.empty(n) for _ in range(4))
        success, branch = np.empty(n, dtype=bool), np.empty(n, dtype=np.int64)
        vector = np.empty(self._numbered.shape, dtype=np.float32)
        told = (force, largest, cost, progress, success, branch)
        way = (self._paths, self._spacing, self._goal, _AHEAD)
        mine = (self._seen, self._asked, self._last, self._limit)
        course = (raw_sight(self.batch), task.force_limit, self._off, self._arc)
        room = (self._row, self._frame, self._numbered)
        report(*course, told, way, mine, *room, BOUND, vector)
        self._tell(dict(zip(_TOLD, told, strict=True)), fresh)
        if not task.image:
            return {"vector": vector}
        return {"vector": vector, "image": self._images(fresh)}

    def _tell(self, told: dict[str, NDArray[Any]], fresh: NDArray[np.int64]) -> None:
        """Take over what is told of some wires; of the others it stays."""
        n = len(self._rows)
        told["unconverged"] = np.zeros(n, dtype=bool)
        told["command"] = np.zeros((n, 2 + self.inputs))
        for name, before in self.info.items() if len(fresh) < n else ():
            values = before.copy()
            values[fresh] = told[name][fresh]
            told[name] = values
        self.info = told

    def _remember(self, seen: Seen, moved: Flags) -> None:
        """Keep what is seen, and show what is due: late, and not after every action."""
        if moved.all() and self.task.delay == 0 and self.task.observe_every == 1:
            self._history, self._shown = [seen], seen
            return
        entry = self._copy(self._history[-1])
        for name, values in seen.items():
            entry[name][moved] = values[moved]
        self._history = [*self._history, entry][-(self.task.delay + 1) :]
        due = moved & (self._taken % self.task.observe_every == 0)
        for name, values in self._history[0].items():
            self._shown[name][due] = values[due]

    def _images(self, fresh: NDArray[np.int64]) -> NDArray[np.uint8]:
        """What a fluoroscope sees, shape (n, 84, 84, 1)."""
        images = np.zeros((len(self._rows), SMALL, SMALL, 1), dtype=np.uint8)
        if self._history:
            images[:] = self._history[-1]["image"]
        for i in fresh:
            images[i, :, :, 0] = self.view(int(i)).fluoroscopy(self.nodes(int(i)))
        return images

    def view(self, i: int) -> View:
        """How a wire and its lumen are looked at."""
        view = self._views[i]
        if view is None:
            view = View(self.anatomies[i].outline)
            for k, other in enumerate(self.anatomies):  # one for all in the same anatomy
                if other is self.anatomies[i]:
                    self._views[k] = view
        return view

    def nodes(self, i: int) -> Array:
        """Where a wire's nodes are, shape (nodes, 3) [m]."""
        plant = self.batch.plant(i)
        system, state = plant.system, plant.state
        place_held(system.rod, system.guide, state, 0, int(state.held[0]), *state.guide)
        return np.asarray(plant.state.q[1:, :3] * plant.system.wire.length)

    @staticmethod
    def _copy(seen: Mapping[str, NDArray[Any]]) -> Seen:
        return {name: values.copy() for name, values in seen.items()}

    @property
    def seen(self) -> Seen:
        """What is observed now; arrays that no later action changes."""
        return self._copy(self._shown)


def along(vectors: Array, frames: Array) -> Array:
    """Components of vectors, shape (n, k, 3), along the rows of frames, shape (n, 3, 3).

    They are summed in the same order for any number of rows.
    """
    parts = vectors[:, :, None] * frames[:, None]
    return np.asarray(parts[..., 0] + parts[..., 1] + parts[..., 2])


def observed(inputs: int) -> int:
    """Numbers of an observation."""
    return 9 + inputs + 2 + inputs + 4 * len(AHEAD)
