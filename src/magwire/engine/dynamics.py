"""Marching through time: the plant that a navigator steers (P-14, P-15)."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magwire.engine.feed import Feed
from magwire.engine.reaction import reaction
from magwire.engine.record import Record, Totals
from magwire.engine.sampling import SAMPLINGS, mismatch, sample
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.engine.tip import tip_direction
from magwire.errors import InputError, positive
from magwire.field import FieldSource
from magwire.kernels.arrays import Field, Mouth
from magwire.kernels.guide import find_mouth, place_held
from magwire.kernels.march import RETRIES, Plan, Tally, march
from magwire.kernels.newton import CONVERGED, copy_state
from magwire.kernels.observe import observe

Array = NDArray[np.float64]


class March:
    """A wire on its way into the lumen, one time step after the other.

    Parameters
    ----------
    system
        Wire, lumen and wall.
    source
        The outside field.
    feed
        Course of the guide.
    time_step
        dt [s].
    inertia
        Without it the steps are equilibria: the quasi-static march.

    Attributes
    ----------
    step, steps
        Time steps done, and to do in all.
    status, message
        How the last step ended; what happened and what to try if it failed.
    """

    def __init__(
        self,
        system: System,
        source: FieldSource,
        feed: Feed,
        *,
        time_step: float,
        inertia: bool = True,
    ) -> None:
        self.system = system
        self.source = source
        self.time_step = positive("Simulation", "time_step", time_step, "s")
        if feed.largest > system.wire.length * (1.0 + 1e-9):
            raise InputError(
                f"Input distance of Feed must be at most the wire's length "
                f"{system.wire.length:.6g} m; received {feed.largest:.6g} m."
            )
        self.steps = max(1, int(np.ceil(feed.duration / time_step - 1e-9)))
        ends = np.minimum(np.arange(self.steps + 1) * time_step, feed.duration)
        fed = np.minimum(feed.at(ends), system.wire.length)
        self._plan = Plan(
            feed=fed / system.wire.length,
            twist=feed.twist_at(ends),
            time_step=time_step,
            damping=system.damping,
            inertia=inertia,
            flux=np.zeros((self.steps + 1, 3)),
            steer=np.zeros(3),
        )
        self.step = 0
        self.status = Status.CONVERGED
        self.message = ""
        self._state = system.new_state()
        self._velocity = np.zeros_like(self._state.q)
        self._work = system.new_work()
        self._wall = system.new_wall()
        self._limits = system.step_limits()
        self._tally = Tally(np.zeros(4), np.array([0.0, 0.0, -1.0]))
        self._field = self._start()
        self._seen = np.zeros(4)
        self._clearance = float("inf")
        self._began = time.perf_counter()
        self._some(0)  # no steps: compiled code is made or read before the clock starts
        self.record()
        self._began = time.perf_counter()

    def _start(self) -> Field:
        """Put the wire on the guide at the first feed and sample the field there."""
        rod, guide = self.system.rod, self.system.guide
        tip = self.system.wire.nodes
        place_held(rod, guide, self._state, 0, tip, self._plan.feed[0], self._plan.twist[0])
        self._held = tip
        return self._sample()

    def _sample(self) -> Field:
        """The outside field where the wire is, with what steering adds to it."""
        field = sample(self.system, self.source, self._state)
        field.flux_density[:] += self._plan.steer
        return field

    @property
    def feed(self) -> float:
        """Length of wire past the entrance [m]."""
        return self._fed(self.step)

    def tip(self) -> tuple[Array, Array]:
        """Position [m] and unit direction of the tip, shape (3,)."""
        position: Array = self._state.q[-1, :3] * self.system.wire.length
        return position, tip_direction(self.system, self._state, self._held)

    def feeds(self, last: int) -> Array:
        """Feed at the ends of the steps from now on up to ``last``, shape (last - step,) [m]."""
        return self._plan.feed[self.step + 1 : last + 1] * self.system.wire.length

    def steer(self, flux_density: Array) -> None:
        """Set the uniform field that steering adds at the end of each of the next steps.

        Parameters
        ----------
        flux_density
            Shape (k, 3) [T]; after these steps the last value stays.
        """
        first = self.step + 1
        self._plan.flux[first : first + len(flux_density)] = flux_density
        self._plan.flux[first + len(flux_density) :] = flux_density[-1]

    def go_back(self, feed: float, multiple: int) -> None:
        """Put a detour into the course: back to a feed [m] and on to the present one again.

        Both ways take the same number of steps, a ``multiple`` of this many, none longer than the
        longest of the course.
        """
        plan, here = self._plan, self.step
        now, back = plan.feed[here], feed / self.system.wire.length
        pace = np.abs(np.diff(plan.feed)).max()
        count = multiple * max(1, int(np.ceil((now - back) / (pace * multiple) - 1e-9)))
        way = np.linspace(now, back, count + 1)
        detour = np.concatenate([way[1:], way[-2::-1]])
        still = np.full(2 * count, plan.twist[here])
        self._plan = plan._replace(
            feed=np.insert(plan.feed, here + 1, detour),
            twist=np.insert(plan.twist, here + 1, still),
            flux=np.insert(plan.flux, here + 1, np.tile(plan.flux[here], (2 * count, 1)), axis=0),
        )
        self.steps += 2 * count

    def advance(self, steps: int) -> bool:
        """Do at most this many more time steps; whether all of them converged."""
        last = min(self.step + steps, self.steps)
        while self.step < last:
            done, status = self._some(last) if self.source.affine else self._one()
            self.step += done
            if status != CONVERGED:
                self.status = Status(status)
                self.message = (
                    f"The step to {self._fed(self.step + 1) * 1e3:.4g} mm of feed did not "
                    f"converge, even when cut into {2**RETRIES} parts: {self.status.remedy}."
                )
                return False
        return True

    def _some(self, last: int) -> tuple[int, int]:
        """Steps up to ``last`` without leaving compiled code."""
        done, self._held, status = march(
            self._model(),
            self.system.guide,
            self._state,
            self._velocity,
            self._work,
            self._limits,
            self._plan,
            self.step,
            last,
            self._held,
            self._tally,
        )
        return done, status

    def _one(self) -> tuple[int, int]:
        """One step in a field that is sampled until the wire stays where it was sampled."""
        before, velocity = self.system.new_state(), self._velocity.copy()
        held = self._held
        copy_state(self._state, before, held)
        tally = Tally(self._tally.counts.copy(), self._tally.forces.copy())
        for _ in range(SAMPLINGS):
            done, status = self._some(self.step + 1)
            if status != CONVERGED:
                return done, status
            field = self._sample()
            if mismatch(self.system, self._field, field, self._held) <= self._limits.tolerance:
                return done, status
            self._field = field
            copy_state(before, self._state, held)
            self._velocity[:] = velocity
            self._held = held
            self._tally.counts[0] = tally.counts[0]
            self._tally.forces[:] = tally.forces
        return 0, int(Status.TOO_MANY_ITERATIONS)

    def _model(self) -> tuple[object, ...]:
        return (self.system.rod, self._field, self._wall, self.system.walls)

    def _fed(self, step: int) -> float:
        """Feed at the end of a step [m]."""
        return float(self._plan.feed[min(step, self.steps)]) * self.system.wire.length

    @property
    def totals(self) -> Totals:
        """Sums over all steps so far."""
        counts, forces = self._tally
        scales = self.system.scales
        steps = int(counts[0])
        return Totals(
            max_tip_force=float(forces[0]) * scales.force,
            mean_tip_force=float(forces[1]) / max(steps, 1) * scales.force,
            first_contact_feed=float(forces[2]) * scales.length if forces[2] >= 0 else float("nan"),
            smallest_clearance=self._clearance,
            steps=steps,
            newton_iterations=int(counts[1]),
            factorisations=int(counts[2]),
            retries=int(counts[3]),
            wall_time=time.perf_counter() - self._began,
        )

    def record(self) -> Record:
        """The state as it is now."""
        system, state = self.system, self._state
        scales = system.scales
        feed = float(self._plan.feed[self.step])
        twist = float(self._plan.twist[self.step])
        mouth = Mouth(*find_mouth(system.rod, system.guide, feed))
        place_held(system.rod, system.guide, state, 0, mouth.held, feed, twist)
        nodes = len(state.q)
        forces, clearance = np.zeros((nodes, 3)), np.zeros(nodes)
        middle, along, stable = observe(
            self._model(), state, mouth, self._work, forces, clearance
        )
        push, torque = reaction(system, mouth, self._work.gradient)
        clearance[: mouth.held + 1] = np.nan
        if mouth.held < nodes - 1:
            self._clearance = min(self._clearance, along * scales.length)
        counts = self._tally.counts
        new_steps = counts[0] - self._seen[0]
        iterations = (counts[1] - self._seen[1]) / new_steps if new_steps else 0.0
        self._seen = counts.copy()
        tip = state.q[-1:, :3] * scales.length
        return Record(
            time=self.step * self.time_step,
            feed=feed * scales.length,
            position=state.q[1:, :3] * scales.length,
            flux_density=self.source.at(tip)[0][0] + self._plan.steer,
            contact_force=forces[1:] * scales.force,
            clearance=clearance[1:] * scales.length,
            clearance_midpoint=middle * scales.length if np.isfinite(middle) else float("nan"),
            clearance_along=along * scales.length if np.isfinite(along) else float("nan"),
            tip_force=float(np.linalg.norm(forces[-1])) * scales.force,
            tip_offset=float(system.path.offset(tip)[0]),
            push_force=push,
            guide_torque=torque,
            newton_iterations=float(iterations),
            stable=bool(stable),
            totals=self.totals,
        )

    def end(self) -> None:
        """Make this the last step of the course."""
        self.steps = self.step

    def records(self, every: int) -> Iterator[Record]:
        """March to the end, with a record at the start and after every so many steps."""
        yield self.record()
        while self.step < self.steps:
            converged = self.advance(every)
            yield self.record()
            if not converged:
                return
