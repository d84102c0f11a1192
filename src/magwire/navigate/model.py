"""The navigator's own model of the wire: equilibria one after the other (P-16, P-21)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.errors import InputError
from magwire.kernels.arrays import Field, Motion, Mouth, State
from magwire.kernels.wall.gap import gap_value
from magwire.kernels.guide import find_mouth, place_held
from magwire.kernels.linearise import Linear, linearise, respond, tube_force
from magwire.kernels.march import Plan, Tally, march
from magwire.kernels.newton import newton
from magwire.lumen import Lumen
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]

SAME = 1e-9  # feeds that differ by less are the same [m]
MAGNETS = 20.0  # see Model.reach
NEAR = 2.0  # to the wall, in activation gaps
GLANCE = 10  # steps between two looks at the tip while the wire moves


@dataclass(frozen=True, eq=False)
class View:
    """A stable equilibrium to first order in the uniform flux density.

    Attributes
    ----------
    flux
        The flux density, shape (3,) [T].
    axes
        Two unit vectors across the centreline where the tip is, shape (2, 3).
    offset
        From the centreline to the tip, in these axes, shape (2,) [m].
    offset_by_flux
        Shape (2, 3) [m/T].
    radius
        Of the lumen where the tip is [m].
    eigenvalue
        Smallest eigenvalue of the tangent stiffness against the lumped mass [rad^2/s^2].
    eigenvalue_by_flux
        Shape (3,) [rad^2/s^2 per T].
    """

    flux: Array
    axes: Array
    offset: Array
    offset_by_flux: Array
    radius: float
    eigenvalue: float
    eigenvalue_by_flux: Array

    @property
    def distance(self) -> float:
        """From the centreline to the tip [m]."""
        return float(np.linalg.norm(self.offset))


@dataclass(frozen=True)
class Memory:
    """What a model needs to go back to where it was."""

    state: State
    held: int
    feed: float
    flux: Array


class Model:
    """A wire at equilibrium in a uniform field, fed and steered quasi-statically.

    Parameters
    ----------
    system
        Wire, lumen and wall as the navigator believes them to be.
    path
        Tube around the centreline that the tip is to follow.
    tube_radius
        Radius of the virtual tube, which holds the tip on the centreline [m] (P-19); there is none
        if left out.

    Attributes
    ----------
    feed
        Length of wire inside the lumen [m].
    flux
        Uniform flux density, shape (3,) [T].
    reach
        Length in which plans are measured [m]: that of twenty magnets, or of the wire if it is
        shorter. What the wire is longer plays no part at the tip.
    solves
        Equilibria solved so far.

    Raises
    ------
    InputError
        If the wire has no magnetisation, so that no field moves it.
    """

    def __init__(self, system: System, path: Lumen, tube_radius: float | None = None) -> None:
        if not system.scales.flux_density > 0.0:
            raise InputError("Input wire of a navigator must be magnetised; received none.")
        self.system = system
        self.path = path
        magnets = sum(s.length for s in system.wire.sections if any(s.magnetization))
        self.reach = min(system.wire.length, MAGNETS * magnets)
        self.feed = 0.0
        self.flux: Array = np.zeros(3)
        self.solves = 0
        self._state, self._work = system.new_state(), system.new_work()
        tube = None if tube_radius is None else system.new_tube(path, tube_radius)
        self._wall, self._limits = system.new_wall(tube), system.step_limits()
        self._velocity = np.zeros_like(self._state.q)
        self._held = system.wire.nodes
        self._tube = path.arrays(system.wire.length)
        edges, rows = len(self._state.length), len(self._work.step)
        self._field = Field(np.zeros((edges, 3)), np.zeros((edges, 9)), np.zeros((edges, 3)), True)
        self._linear = Linear(np.zeros((3, rows)), np.ones(rows), np.zeros(3), np.zeros((edges, 3)))
        place_held(system.rod, system.guide, self._state, 0, self._held, 0.0, 0.0)

    @property
    def released(self) -> bool:
        """Whether any of the wire is free."""
        return self._held < self.system.wire.nodes

    @property
    def near_wall(self) -> bool:
        """Whether the wall presses on the wire anywhere, or is about to."""
        system = self.system
        points = self._state.q[self._held + 1 :, :3] * system.wire.length
        if len(points) == 0:
            return False
        reach = system.keep_off + NEAR * system.firmness.activation_gap
        return float(system.lumen.gap(points).min()) < reach

    def feed_to(self, feed: float) -> bool:
        """Feed the wire on (or back) in the field as it is; whether an equilibrium was found."""
        length = self.system.wire.length
        edge = float(self.system.mesh.edge_length.min())
        steps = max(1, int(np.ceil(abs(feed - self.feed) / (0.5 * edge) - 1e-9)))
        course = np.linspace(self.feed, feed, steps + 1) / length
        plan = Plan(course, np.zeros(steps + 1), 1.0, 0.0, False)
        return self._march(plan, 0, steps)

    def _march(self, plan: Plan, first: int, last: int) -> bool:
        """Do some steps of a plan; whether all of them converged."""
        done, self._held, status = march(
            self._model(),
            self.system.guide,
            self._state,
            self._velocity,
            self._work,
            self._limits,
            plan,
            first,
            last,
            self._held,
            Tally(np.zeros(4), np.zeros(3)),
        )
        self.solves += last - first
        self.feed = float(plan.feed[first + done]) * self.system.wire.length
        if len(plan.flux) > 0:
            self.flux = plan.flux[first + done]
        return bool(status == Status.CONVERGED)

    def play(self, schedule: Schedule, speed: float, time_step: float) -> Iterator[float]:
        """Feed the wire on along a schedule with inertia, as the plant would.

        Starts at rest where the model is and ends in motion: settle next.

        Yields
        ------
        float
            Now and then the tip's distance from the centreline over the lumen's radius; infinity
            where a step did not converge.
        """
        length, first, last = self.system.wire.length, self.feed, float(schedule.feed[-1])
        steps = max(1, int(np.ceil(abs(last - first) / (speed * time_step) - 1e-9)))
        feeds = np.linspace(first, last, steps + 1)
        plan = Plan(
            feeds / length,
            np.zeros(steps + 1),
            time_step,
            self.system.damping,
            True,
            schedule.at(feeds),
            self.flux.copy(),
        )
        self._velocity[:] = 0.0
        for step in range(0, steps, GLANCE):
            good = self._march(plan, step, min(step + GLANCE, steps))
            _, offset, radius = self.tip()
            yield float(np.linalg.norm(offset)) / radius if good else float("inf")

    def plan(self, until: float, every: float, find_field: Callable[[float], None]) -> Schedule:
        """The schedule up to a feed [m], with a field found at least ``every`` [m].

        ``find_field`` feeds the model to a feed and changes its field.
        """
        course = [(self.feed, self.flux)]
        steps = max(1, int(np.ceil(abs(until - self.feed) / every - 1e-9)))
        for feed in np.linspace(self.feed, until, steps + 1)[1:]:
            find_field(float(feed))
            course.append((float(feed), self.flux))
        return Schedule.along(course)

    def settle(self, flux: Array) -> bool:
        """Find the equilibrium in another field; if there is none, stay as before."""
        before = self.remember()
        self.flux = np.asarray(flux, dtype=np.float64)
        still = Motion(0.0, self._work.target)
        mouth = self._mouth()
        status = newton(self._model(), self._state, mouth, still, self._work, self._limits)[0]
        self.solves += 1
        if status != Status.CONVERGED:
            self.return_to(before)
            return False
        return True

    def look(self) -> View | None:
        """The equilibrium to first order; None if it is unstable."""
        mouth = self._mouth()
        value = linearise(self._model(), self._state, mouth, self._work, self._linear)
        if not value > 0.0:
            return None
        axes, offset, radius = self.tip()
        return View(
            flux=self.flux,
            axes=axes,
            offset=offset,
            offset_by_flux=axes @ self._tip_moves() * self.system.wire.length,
            radius=radius,
            eigenvalue=float(value),
            eigenvalue_by_flux=self._linear.slope.copy(),
        )

    def tip(self) -> tuple[Array, Array, float]:
        """Where the tip is in the path.

        Returns
        -------
        tuple
            Two axes across the path, shape (2, 3); the tip's offset in them, shape (2,) [m]; the
            lumen's radius there [m].
        """
        tip = self._state.q[-1, :3] * self.system.wire.length
        curve = self.path.branches[0].curve
        where = np.array([self.tip_arc()])
        centre, along = curve.at(where)[0], curve.at(where, 1)[0, :3]
        axes = across(along)
        return axes, axes @ (tip - centre[:3]), float(centre[3])

    def tip_arc(self) -> float:
        """How far along the path the tip is [m]."""
        length = self.system.wire.length
        tip = self._state.q[-1, :3]
        _, arc, branch, _ = gap_value(self._tube, *tip)
        if branch < 0:  # far off the path, as in another branch
            return float(self.path.locate(tip[None] * length)[0][0])
        return float(arc) * length

    def expected_tip(self, feed: float) -> Array | None:
        """Position of the tip, shape (3,) [m], if the model is at this feed [m]; otherwise None."""
        tip: Array = self._state.q[-1, :3] * self.system.wire.length
        return tip if abs(self.feed - feed) < SAME else None

    def tube_force(self) -> Array:
        """Force of the virtual tube on the tip, shape (3,) [N] (P-19)."""
        return self._tube_force()[0]

    def hold(self) -> tuple[Array, Array]:
        """Force of the virtual tube on the tip [N], and its derivative by the flux density [N/T].

        Shapes (3,) and (3, 3) (P-19, P-21). At an unstable equilibrium the derivative is zero.
        """
        force, slope = self._tube_force()
        stable = respond(self._model(), self._state, self._mouth(), self._work, self._linear)
        moves = self._tip_moves() if stable else np.zeros((3, 3))
        return force, slope @ moves

    def _tube_force(self) -> tuple[Array, Array]:
        """Force of the virtual tube, and its derivative by the tip's scaled position [N]."""
        force, slope = np.zeros(3), np.zeros((3, 3))
        tube_force(self._model(), self._state, force, slope)
        unit = self.system.scales.force
        return force * unit, slope * unit

    def _tip_moves(self) -> Array:
        """Change of the scaled tip position by the flux density [1/T], from the linearisation."""
        last = 4 * (len(self._state.q) - self._held)
        moves: Array = self._linear.moves[:, last : last + 3].T
        return moves

    def remember(self) -> Memory:
        """What it takes to come back here."""
        state = self.system.new_state()
        for kept, value in zip(state, self._state, strict=True):
            kept[:] = value
        return Memory(state, self._held, self.feed, self.flux)

    def return_to(self, memory: Memory) -> None:
        """Come back to what was remembered."""
        for value, kept in zip(self._state, memory.state, strict=True):
            value[:] = kept
        self._held, self.feed, self.flux = memory.held, memory.feed, memory.flux

    def _mouth(self) -> Mouth:
        part = self.feed / self.system.wire.length
        return Mouth(*find_mouth(self.system.rod, self.system.guide, part))

    def _model(self) -> tuple[object, ...]:
        self._field.flux_density[:] = self.flux
        return (self.system.rod, self._field, self._wall, self.system.walls)


def across(direction: Array) -> Array:
    """Two unit vectors across a direction, shape (2, 3)."""
    x, y, z = direction / np.linalg.norm(direction)
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        first = np.array([0.0, z, -y])
    elif abs(y) <= abs(z):
        first = np.array([-z, 0.0, x])
    else:
        first = np.array([y, -x, 0.0])
    u, v, w = first / np.linalg.norm(first)
    return np.array([[u, v, w], [y * w - z * v, z * u - x * w, x * v - y * u]])
