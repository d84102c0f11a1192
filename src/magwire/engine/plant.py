"""A wire in a lumen that is driven and watched, one time step after the other (P-14, P-15)."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from magwire.engine.command import Drive
from magwire.engine.departure import departs
from magwire.engine.observation import Observation
from magwire.engine.point import Point
from magwire.engine.record import Record, Totals, row_type, sheet_of
from magwire.engine.rubbing import Rubbing
from magwire.engine.sampling import SAMPLINGS, mismatch, sample, unsampled_stiffness
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.field import FieldSource
from magwire.kernels._handle import resolved
from magwire.kernels.arrays import Field, Mouth, State, Tube
from magwire.kernels.body import (
    INPUTS,
    Body,
    Parts,
    Queue,
    Sight,
    advance,
    look,
    place_wall,
    rest,
    survey,
)
from magwire.kernels.guide import find_mouth, place_held
from magwire.kernels.history import copy_state
from magwire.kernels.march import RETRIES, Tally
from magwire.kernels.newton import CONVERGED, Limits
from magwire.kernels.sheet import (
    CLEARANCE_ALONG,
    NEWTON_ITERATIONS,
    SMALLEST_CLEARANCE,
    STABLE,
    TIME,
    TIP_DEPARTURE,
    TIP_OFFSET,
    WALL_TIME,
)
from magwire.kernels.sources.steer import steer

Array = NDArray[np.float64]

QUEUE = 256
"""Steps that compiled code does in one call, at most."""

DEEP = 0.8  # part of how deep a wall may be pressed in, from which on that may stop a step


@dataclass(frozen=True, eq=False)
class Snapshot:
    """All that a plant needs to go on from where it was.

    Attributes
    ----------
    feed, time
        Length of wire past the entrance [m], and the plant's time [s], at that moment.
    """

    feed: float
    time: float
    state: State
    tally: Tally

    @property
    def inputs(self) -> Array:
        """Of the actuator at that moment, shape (m,)."""
        return self.state.inputs

    def with_inputs(self, inputs: Array) -> Snapshot:
        """The same wire with other inputs: it is not at rest with them."""
        return replace(self, state=self.state._replace(inputs=inputs.copy()))


class Plant:
    """A wire, a lumen, a field, and a guide that moves.

    Parameters
    ----------
    system
        Wire, lumen and wall.
    source
        The outside field, next to what the actuator makes; the system's own if left out.
    feed, twist
        Feed and twist of the guide at the start [m, rad].
    tube
        A virtual tube around the centreline (P-19); none if left out.

    Attributes
    ----------
    time
        Simulated [s].
    status, message
        How the last step ended; what happened and what to try if it failed.
    wanted
        Inputs of the actuator at the end of the next single step, to be filled in, shape (m,).
    model, field, state, work
        Rod, field, state and workspace of the wire, as the kernels hold them.
    """

    def __init__(
        self,
        system: System,
        source: FieldSource | None = None,
        *,
        feed: float = 0.0,
        twist: float = 0.0,
        tube: Tube | None = None,
    ) -> None:
        self.system = system
        self.source = system.background if source is None else source
        self.time = 0.0
        self.status = Status.CONVERGED
        self.message = ""
        self.state = system.new_state()
        self.state.guide[:] = feed / system.wire.length, twist
        self.work = system.new_work()
        self._wall = system.new_wall()
        self._tally = Tally(np.zeros(4), np.array([0.0, 0.0, -1.0]))
        place_held(system.rod, system.guide, self.state, 0, system.wire.nodes, *self.state.guide)
        self.field = sample(system, self.source, self.state)
        moving = system.new_moving()
        if moving and self._wall.friction:
            rubbing = self._wall.friction[0]
            rubbing = rubbing._replace(path=rubbing.path._replace(moving=moving))
            self._wall = self._wall._replace(friction=(rubbing,))
        lumen = system.walls._replace(moving=moving)
        terms = system.new_terms(self.field, wall=self._wall, tube=tube)
        self.model = terms._replace(lumen=lumen)
        limits, path = system.step_limits(), system.path_arrays._replace(moving=moving)
        self._tolerance = limits.tolerance
        self._kind = row_type(system.wire.nodes, len(self.inputs), system.absent)
        self._row = np.zeros(self._kind.itemsize // 8)
        self._row[SMALLEST_CLEARANCE], self._row[TIP_DEPARTURE] = math.inf, math.nan
        self._sheet = sheet_of(self._row, self._kind)
        inputs = len(self.state.inputs)
        self._queue = Queue(np.zeros(QUEUE), np.zeros(QUEUE), np.zeros((QUEUE, inputs)))
        self.wanted = self._queue.inputs[0]
        known = self.model, path, system.guide, self.state, self.work, limits, self._tally
        self._units = system.scales.length, system.scales.force
        self._seen = np.zeros(INPUTS + inputs)
        patch, turn = system.patch / system.wire.length, tuple(system.mesh.rest_turn[-1].tolist())
        sight = Sight(self._seen, *self._units, patch, turn)
        self._parts = Parts(*known, self._queue, self._sheet, sight)
        self._body = Body(self._parts)
        self._counted = np.zeros(4)
        self._advance = resolved(advance, self._body, 0, 1.0, 1.0, True)
        self._advance(self._body, 0, 1.0, 1.0, True)  # the sources are as the inputs are
        self._began = time.perf_counter()

    @cached_property
    def _look(self) -> Callable[..., None]:
        return resolved(look, self._body)

    @cached_property
    def _survey(self) -> Callable[..., None]:
        return resolved(survey, self._body, *self._units)

    @property
    def body(self) -> Body:
        """The wire as compiled code refers to it."""
        return self._body

    def hand(self) -> Body:
        """The wire with another workspace, for one of several threads; see ``kernels.crew``."""
        return Body(self._parts._replace(work=self.system.new_work()))

    @property
    def guided(self) -> tuple[float, float]:
        """``feed`` and ``twist``."""
        feed, twist = self.state.guide.tolist()
        return feed * self._units[0], twist

    @property
    def feed(self) -> float:
        """Length of wire past the entrance [m]."""
        return self.guided[0]

    @property
    def twist(self) -> float:
        """Angle by which the guide has turned the wire about its axis [rad]."""
        return self.guided[1]

    @property
    def inputs(self) -> Array:
        """Of the actuator, as they are, shape (m,)."""
        return self.state.inputs.copy()

    @inputs.setter
    def inputs(self, inputs: Array) -> None:
        self.state.inputs[:] = inputs
        self._steer()

    def _steer(self) -> None:
        steer(self.field.sources, self.state.inputs, self.field.strength)

    @property
    def released(self) -> bool:
        """Whether any of the wire is free."""
        return bool(self.state.held[0] < self.system.wire.nodes)

    def advance(self, drive: Drive) -> int:
        """Do the steps of a drive; how many of them converged before one did not.

        A step that fails leaves the wire as it was before it; ``status`` and ``message`` tell why.
        """
        feed = drive.feed / self.system.wire.length
        twist, inputs, dt = drive.twist, drive.inputs, drive.time_step
        if self.source.affine:
            done, status = self.march(feed, twist, inputs, dt, inertia=drive.inertia)
        else:
            done, status = 0, CONVERGED
            while done < len(feed) and status == CONVERGED:
                one = slice(done, done + 1)
                now, status = self._one(feed[one], twist[one], inputs[one], dt, drive.inertia)
                done += now
        self.time += done * dt
        self._ended(status, drive.feed[done] if done < len(feed) else 0.0)
        return done

    def step(self, feed: float, twist: float, dt: float, *, inertia: bool) -> bool:
        """A single step to the inputs ``wanted``, as ``advance`` does it, in less time.

        Returns whether it converged.

        Parameters
        ----------
        feed, twist
            Where the guide is at its end [m, rad].
        dt
            Its length [s].
        inertia
            Without it the step is an equilibrium.
        """
        if not self.source.affine:
            inputs = self.wanted[None].copy()
            drive = Drive(np.array([feed]), np.array([twist]), inputs, dt, inertia)
            return self.advance(drive) == 1
        queue = self._queue
        queue.feed[0], queue.twist[0] = feed / self._units[0], twist
        done, status = self._advance(self._body, 1, dt, self.system.damping, inertia)
        self.time += done * dt
        if status != CONVERGED or self.message:
            self._ended(status, feed)
        return bool(done)

    def _ended(self, status: int, feed: float) -> None:
        """Keep how the steps to a feed [m] ended."""
        self.status, self.message = Status(status), ""
        if status != CONVERGED:
            self.message = (
                f"The step to {feed * 1e3:.4g} mm of feed did not "
                f"converge, even when cut into {2**RETRIES} parts: {self._remedy()}."
            )

    def _remedy(self) -> str:
        """What to try after a step that failed."""
        most = self._wall.bed.deepest * self.system.wire.length
        if most > 0.0:
            deep = float(self.survey().wall_indentation.max())
            if deep > DEEP * most:
                return (
                    f"the wall is pressed in by {1e3 * deep:.3g} mm, and by at most "
                    f"{1e3 * most:.3g} mm it may be, half of the path's smallest radius; use a "
                    "stiffer foundation"
                )
        return self.status.remedy

    def march(
        self, feed: Array, twist: Array, inputs: Array, dt: float, *, inertia: bool
    ) -> tuple[int, int]:
        """Steps in the field as it is sampled; how many, and how the last one ended.

        The feed is in wire lengths; otherwise see ``Drive``.
        """
        queue, whole, done, status = self._queue, len(feed), 0, CONVERGED
        while True:
            count = min(QUEUE, whole - done)
            some = slice(done, done + count)
            queue.feed[:count], queue.twist[:count] = feed[some], twist[some]
            queue.inputs[:count] = inputs[some]
            now, status = self._advance(self._body, count, dt, self.system.damping, inertia)
            done += now
            if done == whole or status != CONVERGED:
                return done, status

    def _one(
        self, feed: Array, twist: Array, inputs: Array, dt: float, inertia: bool
    ) -> tuple[int, int]:
        """One step in a field that is sampled until the wire stays where it was sampled."""
        before = self.snapshot()
        for _ in range(SAMPLINGS):
            done, status = self.march(feed, twist, inputs, dt, inertia=inertia)
            if status != CONVERGED:
                return done, status
            now = sample(self.system, self.source, self.state)
            if mismatch(self.system, self.field, now, int(self.state.held[0])) <= self._tolerance:
                return done, status
            self._take_over(now)
            iterations = self._tally.counts[1:].copy()
            self.restore(before)
            self._tally.counts[1:] = iterations
        return 0, int(Status.TOO_MANY_ITERATIONS)

    def sample_again(self) -> None:
        """Sample the outside field where the wire is now."""
        self._take_over(sample(self.system, self.source, self.state))

    def samples(self) -> Field:
        """The field as it is sampled now."""
        now = self.field
        return Field(
            now.flux_density.copy(),
            now.gradient.copy(),
            now.origin.copy(),
            now.uniform.copy(),
            now.sources,
            now.strength.copy(),
        )

    def _take_over(self, now: Field) -> None:
        field = self.field
        for kept, value in zip(field[:4], now[:4], strict=True):
            kept[:] = value

    def observe(self) -> Observation:
        """What can be seen of the wire now, without a record of all its nodes."""
        self._look(self._body)
        seen = self._seen.copy()
        force, forces, patch, clear, feed, twist = seen[6:INPUTS].tolist()
        tip, direction, inputs = seen[:3], seen[3:6], seen[INPUTS:]
        return Observation(
            self.time, feed, twist, tip, direction, force, forces, patch, clear, inputs
        )

    @property
    def stable(self) -> bool:
        """Whether the wire stays where it is: see ``Record.stable`` (P-16, P-33)."""
        return self._stays(self.survey())

    def _stays(self, seen: Record) -> bool:
        """Whether it is stable; under friction, where its tangent leaves that open, after a search.

        The search knows no wall that moves; there the wire counts as one that leaves.
        """
        if seen.stable or not self._wall.friction or self.system.wall_motion:
            return seen.stable
        return not departs(self.rubbing)

    @property
    def rubbing(self) -> Rubbing:
        """The wire at rest where it is, with its contacts (P-33)."""
        system, source = self.system.smooth, self.source
        point = Point(system, self.samples(), self.snapshot().state, self.mouth)
        if not source.affine:
            point = replace(point, unsampled=unsampled_stiffness(system, source, point.state))
        return Rubbing(point, self._wall.friction)

    def use(self, source: FieldSource) -> None:
        """Be in another outside field from now on."""
        self.source = source
        self.sample_again()

    def start_at(self, state: State) -> None:
        """Take up a configuration, at rest."""
        copy_state(state, self.state)
        self.state.velocity[:] = 0.0
        place_wall(self._body)
        if not self.source.affine:
            self.sample_again()
        self._steer()

    def snapshot(self) -> Snapshot:
        """What it takes to come back here."""
        state = self.system.new_state()
        copy_state(self.state, state)
        tally = Tally(*(kept.copy() for kept in self._tally))
        return Snapshot(self.feed, self.time, state, tally)

    def restore(self, snapshot: Snapshot) -> None:
        """Come back to a snapshot of this plant, or of another one of the same system."""
        copy_state(snapshot.state, self.state)
        for value, kept in zip(self._tally, snapshot.tally, strict=True):
            value[:] = kept
        self.time = snapshot.time
        self.status, self.message = Status.CONVERGED, ""
        place_wall(self._body)
        self._steer()

    @property
    def mouth(self) -> Mouth:
        """Where the guide ends."""
        return Mouth(*find_mouth(self.system.rod, self.system.guide, self.state.guide[0]))

    def settle(self, limits: Limits) -> tuple[Status, int, float]:
        """Bring the wire to rest as guide and inputs are; how it ended, iterations, residual."""
        status, taken, _, residual, _ = rest(self._body, limits)
        return Status(status), int(taken), float(residual)

    def survey(self) -> Record:
        """What there is to see of the wire now; nothing is counted or noted by it."""
        system, sheet = self.system, self._sheet
        self._survey(self._body, *self._units)
        numbers, tip, flux = sheet.numbers, sheet.position[-1:], sheet.flux_density
        flux += self.source.at(tip)[0][0]
        if math.isnan(numbers[TIP_OFFSET]):
            numbers[TIP_OFFSET] = float(system.path.offset(tip)[0])
        numbers[TIME] = self.time
        numbers[WALL_TIME] = time.perf_counter() - self._began
        return Record(self._row.copy(), self._kind)

    @property
    def totals(self) -> Totals:
        """Sums over all steps so far."""
        return self.survey().totals

    def record(self, departure: float = math.nan) -> Record:
        """The state as it is now, to be kept.

        Parameters
        ----------
        departure
            Distance of the tip from where the navigator's model has it [m].
        """
        seen = self.survey()
        here, least = seen.row[CLEARANCE_ALONG], self._row[SMALLEST_CLEARANCE]
        self._row[SMALLEST_CLEARANCE] = seen.row[SMALLEST_CLEARANCE] = (
            here if here < least else least
        )
        counts, before = self._tally.counts, self._counted
        steps = counts[0] - before[0]
        seen.row[NEWTON_ITERATIONS] = (counts[1] - before[1]) / steps if steps > 0 else 0.0
        seen.row[TIP_DEPARTURE] = departure
        seen.row[STABLE] = self._stays(seen)
        self._counted = counts.copy()
        return seen
