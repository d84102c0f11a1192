"""Many wires at once: stepped and watched in one call of compiled code, in several threads."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Literal, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.command import Command
from magwire.engine.plant import Plant, Snapshot
from magwire.engine.status import Status
from magwire.errors import InputError, array, one_of, positive, whole
from magwire.kernels.crew import SEEN, Orders, carry_out, count_steps, lay_out
from magwire.kernels.glance import GLANCE
from magwire.simulation import Simulation

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Motion = Literal["dynamic", "quasi-static"]

SLACK = 1e-9  # of a duration over the time step, for rounding


class Sight(NamedTuple):
    """What is seen of n wires: an ``Observation`` with a row for each of them, and some more.

    Attributes
    ----------
    time
        Simulated, shape (n,) [s].
    feed, twist
        Length of wire past the entrance [m]; angle of the guide [rad]; shape (n,).
    tip, tip_direction
        Position [m] and unit tangent of the tip, shape (n, 3).
    tip_force, wall_force, patch_force
        The wall's: on the tip node, summed over the wire, and the largest sum over a stretch of
        5 mm, or of two edges if they are longer; shape (n,) [N].
    clearance
        Smallest clearance of the nodes past the guide, shape (n,) [m]; infinity if there are none.
    inputs
        Those of the actuator, shape (n, m).
    tip_arc
        How far the tip has come on the way to the lumen's target, shape (n,) [m]; NaN where it is
        off that way, such as in another branch.
    branch
        Number of the lumen's branch that the tip is in, shape (n,); -1 where it is in none.
    """

    time: Array
    feed: Array
    twist: Array
    tip: Array
    tip_direction: Array
    tip_force: Array
    wall_force: Array
    patch_force: Array
    clearance: Array
    inputs: Array
    tip_arc: Array
    branch: Indices


class Batch:
    """Independent wires that are stepped together.

    Each wire gives bit for bit what it would give alone in a ``Session``, in whatever order and in
    however many threads. Wires of the same simulation share its lumen.

    Parameters
    ----------
    wires
        A simulation for each wire, which may be the same one many times, or a plant, which is the
        batch's from then on.
    feed
        Length of wire past the entrance at the start [m]: an equilibrium there. It is for
        simulations; plants start as they are.
    time_step
        Longest time step [s]; longer intervals are cut into equal ones.
    motion
        ``"dynamic"``, or ``"quasi-static"``: every step is an equilibrium.
    threads
        That work at once; one for each processor if left out.

    Raises
    ------
    InputError
        If there is no wire, or a value is out of its range.
    ConvergenceError
        If there is no equilibrium at ``feed``.
    """

    def __init__(
        self,
        wires: Sequence[Simulation | Plant],
        *,
        feed: float = 0.0,
        time_step: float = 0.01,
        motion: Motion = "dynamic",
        threads: int | None = None,
    ) -> None:
        if not wires:
            raise InputError("Input wires of Batch must hold at least one wire; received none.")
        self.time_step = positive("Batch", "time_step", time_step, "s")
        self._inertia = one_of("Batch", "motion", motion, ("dynamic", "quasi-static")) == "dynamic"
        count = _processors() if threads is None else whole("Batch", "threads", threads, minimum=1)
        self.threads = min(count, len(wires))
        self._pool = ThreadPoolExecutor(self.threads, thread_name_prefix="magwire-batch")
        starts: dict[int, Snapshot] = {}
        self._plants: list[Plant] = []
        self._starts: list[Snapshot] = []
        for wire in wires:
            plant = wire if isinstance(wire, Plant) else Plant(wire.system)
            if isinstance(wire, Plant):
                self._starts.append(plant.snapshot())
            else:
                if id(wire) not in starts:
                    starts[id(wire)] = start_of(wire, feed)
                plant.restore(starts[id(wire)])
                self._starts.append(starts[id(wire)])
            self._plants.append(plant)
        self._hands = [self._plants[0].hand() for _ in range(self.threads)]
        self._time = np.array([plant.time for plant in self._plants])
        self._lay_out(len(self._plants[0].inputs))
        for i, plant in enumerate(self._plants):
            self._enter(i, plant)
        self.look()

    def _lay_out(self, inputs: int) -> None:
        """Make the arrays that travel to the kernels, with a row for each wire."""
        n = len(self._plants)
        self._length, self._force = np.ones(n), np.ones(n)
        self._orders = Orders(
            places=np.zeros(n, dtype=np.int64),
            counts=np.zeros(n, dtype=np.int64),
            feed=np.zeros((n, 1)),
            twist=np.zeros((n, 1)),
            inputs=np.zeros((n, 1, inputs)),
            time_step=np.full(n, self.time_step),
            damping=np.zeros(n),
            patch=np.zeros(n),
            turn=np.zeros((n, 2)),
            done=np.zeros(n, dtype=np.int64),
            status=np.zeros(n, dtype=np.int64),
            seen=np.zeros((n, SEEN)),
            guide=np.zeros((n, 2)),
            held=np.zeros((n, inputs)),
            next=np.zeros(1, dtype=np.int64),
        )
        self._given = (
            *(np.zeros(n), np.zeros(n), np.zeros((n, inputs)), np.zeros(n)),
            np.zeros(n, dtype=bool),
        )

    def _enter(self, i: int, plant: Plant) -> None:
        """Note where a wire is in memory, and what belongs to it alone."""
        system, orders, body = plant.system, self._orders, plant.body
        first = self._plants[0].body
        if body.kind != first.kind or len(plant.inputs) != orders.held.shape[1]:
            raise InputError("Wires of Batch must have the same inputs; received different ones.")
        if not plant.source.affine:  # such a field is sampled anew in Python at every step
            raise InputError(
                f"Wires of Batch must be in a field that is affine in space; received wire {i} in "
                f"a {type(plant.source).__name__}, which takes a Session."
            )
        orders.places[i] = body.address
        orders.damping[i] = system.damping
        orders.patch[i] = system.patch / system.wire.length
        orders.turn[i] = system.mesh.rest_turn[-1]
        self._length[i], self._force[i] = system.scales.length, system.scales.force

    def __len__(self) -> int:
        return len(self._plants)

    def plant(self, i: int) -> Plant:
        """A wire as the engine has it; call ``look`` after changing its state."""
        self._plants[i].time = float(self._time[i])
        return self._plants[i]

    def advance(self, commands: Sequence[Command]) -> Indices:
        """Carry out a command for each wire, whose durations may differ.

        Returns
        -------
        Indices
            How each wire ended, shape (n,): values of ``Status``, zero if all its steps converged.
            A wire whose step did not is as it was before that step.

        Raises
        ------
        InputError
            If there is not a command for each wire, or its inputs do not fit.
        """
        if len(commands) != len(self):
            raise InputError(
                f"Input commands of Batch must hold one for each of the {len(self)} wires; "
                f"received {len(commands)}."
            )
        wanted = self._orders.held.copy()
        for i, command in enumerate(commands):
            if command.inputs is not None:
                wanted[i] = array("Command", "inputs", command.inputs, (wanted.shape[1],))
        return self.step(
            np.array([command.feed_speed for command in commands]),
            np.array([command.twist_rate for command in commands]),
            wanted,
            np.array([command.duration for command in commands]),
        )

    def step(
        self,
        feed_speed: ArrayLike = 0.0,
        twist_rate: ArrayLike = 0.0,
        inputs: ArrayLike | None = None,
        duration: ArrayLike | None = None,
        *,
        only: ArrayLike = True,
    ) -> Indices:
        """Move guides and inputs for an interval of time; as ``advance``, with arrays.

        The guides stop where the wires' lengths end, either way.

        Parameters
        ----------
        feed_speed, twist_rate
            Those of the guides [m/s, rad/s], one value or shape (n,).
        inputs
            The actuators' at the interval's end, reached linearly, shape (m,) or (n, m); they
            stay as they are if left out.
        duration
            That of the interval [s], one value or shape (n,); one time step if left out.
        only
            Which wires move, booleans of shape (n,); the others stay as they are.

        Raises
        ------
        InputError
            If a value is not finite, or a duration is not positive.
        """
        speed, rate, wanted, time, moving = self._given
        speed[:], rate[:], moving[:] = feed_speed, twist_rate, only
        wanted[:] = self._orders.held if inputs is None else inputs
        time[:] = self.time_step if duration is None else duration
        counts = self._orders.counts
        most = count_steps(speed, rate, wanted, time, moving, self.time_step, SLACK, counts)
        if most == 0:
            raise InputError("Inputs of Batch.step must be finite; received some that are not.")
        if most < 0:
            raise InputError(
                f"Input duration of Batch.step must be positive; received {time.min():.6g} s."
            )
        self._make_room(most)
        orders = self._orders
        lay_out(speed, rate, wanted, time, self.time_step, SLACK, self._length, orders)
        self._carry_out()
        self._time += orders.done * orders.time_step
        return orders.status.copy()

    def _make_room(self, steps: int) -> None:
        """Arrays of orders with a column for each step."""
        orders = self._orders
        n, inputs = orders.held.shape
        if orders.feed.shape[1] != steps:
            self._orders = orders._replace(
                feed=np.zeros((n, steps)),
                twist=np.zeros((n, steps)),
                inputs=np.zeros((n, steps, inputs)),
            )

    def _carry_out(self) -> None:
        orders = self._orders
        orders.next[0] = 0
        count = min(self.threads, int(np.count_nonzero(orders.counts >= 0)))
        mine, *others = self._hands[: max(count, 1)]
        busy = [self._pool.submit(carry_out, hand, orders, self._inertia) for hand in others]
        try:
            carry_out(mine, orders, self._inertia)
        finally:
            for thread in busy:
                thread.exception()  # waits for it
        for thread in busy:
            thread.result()

    def look(self, wires: Sequence[int] | None = None) -> None:
        """See wires anew, after a change of their plants from outside; all if left out."""
        chosen = range(len(self)) if wires is None else wires
        self._orders.counts[:] = -1
        self._orders.counts[list(chosen)] = 0
        self._carry_out()

    def observe(self) -> Sight:
        """What can be seen of all wires now; no compiled code is called for it."""
        orders, seen, length = self._orders, self._orders.seen, self._length
        gap = seen[:, GLANCE + 1]
        inside = (gap > 0.0) & (gap < np.inf)  # of the way, as a tube: elsewhere any ball may be it
        force = self._force
        return Sight(
            time=self._time.copy(),
            feed=orders.guide[:, 0] * length,
            twist=orders.guide[:, 1].copy(),
            tip=seen[:, :3] * length[:, None],
            tip_direction=seen[:, 3:6].copy(),
            tip_force=seen[:, 6] * force,
            wall_force=seen[:, 7] * force,
            patch_force=seen[:, 8] * force,
            clearance=seen[:, 9] * length,
            inputs=orders.held.copy(),
            tip_arc=np.where(inside, seen[:, GLANCE] * length, np.nan),
            branch=seen[:, GLANCE + 2].astype(np.int64),
        )

    def message(self, i: int) -> str:
        """What to try about a wire whose last step failed; empty if it converged."""
        status = Status(int(self._orders.status[i]))
        if status is Status.CONVERGED:
            return ""
        return f"A step of wire {i} did not converge: {status.remedy}."

    def snapshot(self, i: int) -> Snapshot:
        """What it takes for a wire to come back here."""
        return self.plant(i).snapshot()

    def restore(self, snapshots: Mapping[int, Snapshot]) -> None:
        """Have wires come back to snapshots, of their own or of others of the same simulation."""
        for i, snapshot in snapshots.items():
            self._plants[i].restore(snapshot)
            self._time[i] = snapshot.time
        self.look(list(snapshots))

    def reset(self, wires: Sequence[int] | None = None) -> None:
        """Have wires come back to where they started; all of them if left out."""
        chosen = range(len(self)) if wires is None else wires
        self.restore({i: self._starts[i] for i in chosen})

    def put(self, i: int, plant: Plant) -> None:
        """Have another wire in the place of one, which starts where it is."""
        self._enter(i, plant)
        self._plants[i], self._starts[i] = plant, plant.snapshot()
        self._time[i] = plant.time
        self.look([i])

    @property
    def bytes_per_wire(self) -> int:
        """Memory that the first wire takes beside what wires of a simulation share [B]."""
        plant = self._plants[0]
        model = plant.model
        wall = model.wall
        own = (model.field, wall.known, wall.jet, wall.between, plant.state, plant.work)
        return sum(part.nbytes for part in _arrays(own))

    def close(self) -> None:
        """End the threads; the batch cannot be stepped any more."""
        self._pool.shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def raw_sight(batch: Batch) -> tuple[Array, Array, Array, Array]:
    """What was seen of a batch's wires and where their guides are, and units, for kernels.

    Not to be changed; see ``kernels.crew.Orders``: scaled, shape (n, SEEN) and (n, 2), and units of
    length [m] and force [N], shape (n,).
    """
    orders = batch._orders
    return orders.seen, orders.guide, batch._length, batch._force


def start_of(simulation: Simulation, feed: float) -> Snapshot:
    """A wire at rest at a feed [m].

    Raises
    ------
    ConvergenceError
        If there is no equilibrium there.
    """
    plant = Plant(simulation.system)
    if feed != 0.0:
        plant.start_at(simulation.equilibrium(feed).point.state)
    return plant.snapshot()


def _arrays(value: object) -> Iterator[Array]:
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple):
        for part in value:
            yield from _arrays(part)


def _processors() -> int:
    """How many this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
