"""The navigator's own model of the wire: equilibria one after the other (P-16, P-21)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from magwire.engine.command import Drive
from magwire.engine.plant import Plant, Snapshot
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.errors import InputError, one_of
from magwire.kernels.body import linearised
from magwire.kernels.history import copy_state
from magwire.kernels.linearise import new_linear, respond
from magwire.kernels.tube import tube_force
from magwire.kernels.wall.gap import gap_value
from magwire.lumen import Lumen
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]
InModel = Literal["model", "none"]
"""Whether a navigator's model has the wall's friction."""

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
        Those of the lumen where the tip is [m].
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
        return math.sqrt(self.offset @ self.offset)


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
    friction
        Whether the model has the system's friction: ``"model"``, or ``"none"``. With it, the way
        that the wire has come is part of what is remembered.

    Attributes
    ----------
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

    def __init__(
        self,
        system: System,
        path: Lumen,
        tube_radius: float | None = None,
        friction: InModel = "none",
    ) -> None:
        if not system.scales.flux_density > 0.0:
            raise InputError("Input wire of a navigator must be magnetised; received none.")
        if system.actuator is not None:
            raise InputError(
                "Input actuator of a navigator's system must be left out: it steers by a uniform "
                f"field; received {system.actuator!r}."
            )
        if not system.background.affine:
            raise InputError(
                "Input field of a navigator's system must be uniform or linear in space; received "
                f"{system.background!r}."
            )
        self.system = system
        self.path = path
        magnets = sum(s.length for s in system.wire.sections if any(s.magnetization))
        self.reach = min(system.wire.length, MAGNETS * magnets)
        self.solves = 0
        tube = None if tube_radius is None else system.new_tube(path, tube_radius)
        one_of("navigator", "friction", friction, get_args(InModel))
        believed = system.still if friction == "model" else system.smooth
        self._plant = Plant(believed, tube=tube)
        self._rubs = believed.rubs
        self._kept = self._plant.system.new_state()
        self._came: Snapshot | None = None  # where the wire rested before its field was changed
        self._limits = system.step_limits()
        self._tube = path.arrays(system.wire.length)
        self._linear = new_linear(len(self._plant.work.step))

    @property
    def feed(self) -> float:
        """Length of wire inside the lumen [m]."""
        return self._plant.feed

    @property
    def flux(self) -> Array:
        """Uniform flux density of the inputs, shape (3,) [T]."""
        return self._plant.inputs

    @flux.setter
    def flux(self, flux: Array) -> None:
        self._plant.inputs = flux

    @property
    def released(self) -> bool:
        """Whether any of the wire is free."""
        return self._plant.released

    @property
    def near_wall(self) -> bool:
        """Whether the wall presses on the wire anywhere, or is about to."""
        system, state = self.system, self._plant.state
        points = state.q[state.held[0] + 1 :, :3] * system.wire.length
        if len(points) == 0:
            return False
        reach = system.keep_off + NEAR * system.firmness.activation_gap
        return float(system.lumen.gap(points).min()) < reach

    def feed_to(self, feed: float) -> bool:
        """Feed the wire on (or back) in the field as it is; whether an equilibrium was found."""
        edge = float(self.system.mesh.edge_length.min())
        steps = max(1, int(np.ceil(abs(feed - self.feed) / edge - 1e-9)))
        course = np.linspace(self.feed, feed, steps + 1)[1:]
        still = np.tile(self.flux, (steps, 1))
        self._came = None
        return self._drive(Drive(course, np.zeros(steps), still, 1.0, inertia=False))

    def _drive(self, drive: Drive) -> bool:
        """Do the steps of a drive; whether all of them converged."""
        self.solves += len(drive.feed)
        return self._plant.advance(drive) == len(drive.feed)

    def play(self, schedule: Schedule, speed: float, time_step: float) -> Iterator[float]:
        """Feed the wire on along a schedule with inertia, as the plant would.

        Starts at rest where the model is and ends in motion: settle next.

        Yields
        ------
        float
            Now and then the tip's distance from the centreline over the lumen's radius; infinity
            where a step did not converge.
        """
        first, last = self.feed, float(schedule.feed[-1])
        steps = max(1, int(np.ceil(abs(last - first) / (speed * time_step) - 1e-9)))
        feeds = np.linspace(first, last, steps + 1)[1:]
        inputs = schedule.at(feeds)
        self._plant.state.velocity[:] = 0.0
        self._came = None
        for step in range(0, steps, GLANCE):
            part = slice(step, step + GLANCE)
            twist = np.zeros(len(feeds[part]))
            good = self._drive(Drive(feeds[part], twist, inputs[part], time_step))
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
        if self._rubs:
            return self._settle_rubbing(np.asarray(flux, dtype=np.float64))
        plant, kept = self._plant, self._kept
        copy_state(plant.state, kept)
        self.flux = np.asarray(flux, dtype=np.float64)
        status = plant.settle(self._limits)[0]
        self.solves += 1
        if status != Status.CONVERGED:
            copy_state(kept, plant.state)
            self.flux = kept.inputs
            return False
        return True

    def _settle_rubbing(self, flux: Array) -> bool:
        """Change the field in one step from where the wire came to this feed, or was taken to.

        Of several fields that are tried there only the last one is what the wire goes through.
        """
        before, plant = self.remember(), self._plant
        if self._came is None:
            self._came = before
        plant.restore(self._came)
        drive = Drive(np.array([plant.feed]), np.zeros(1), flux[None], 1.0, inertia=False)
        if self._drive(drive):
            return True
        plant.restore(before)
        return False

    def _let_go(self) -> Plant:
        """The plant, with no friction in its tangent until the next step reads it off anew."""
        for friction in self._plant.model.wall.friction:
            friction.load[:, 3] = 0.0
        return self._plant

    def look(self) -> View | None:
        """The equilibrium to first order; None if it is unstable.

        Without friction in it: a plan that leaves it to friction to hold the wire would not do, and
        contacts that stick would hide how the wire answers where they give way.
        """
        plant = self._let_go()
        value = linearised(plant.body, self._linear)
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
        tip = self._plant.state.q[-1, :3] * self.system.wire.length
        centre, along = self.path.branches[0].curve.place(self.tip_arc())
        axes = across(along[:3])
        return axes, axes @ (tip - centre[:3]), float(centre[3])

    def tip_arc(self) -> float:
        """How far along the path the tip is [m]."""
        length = self.system.wire.length
        tip = self._plant.state.q[-1, :3]
        _, arc, branch, _ = gap_value(self._tube, *tip)
        if branch < 0:  # far off the path, as in another branch
            return float(self.path.locate(tip[None] * length)[0][0])
        return float(arc) * length

    def expected_tip(self, feed: float) -> Array | None:
        """Position of the tip, shape (3,) [m], if the model is at this feed [m]; otherwise None."""
        tip: Array = self._plant.state.q[-1, :3] * self.system.wire.length
        return tip if abs(self.feed - feed) < SAME else None

    def tube_force(self) -> Array:
        """Force of the virtual tube on the tip, shape (3,) [N] (P-19)."""
        return self._tube_force()[0]

    def hold(self) -> tuple[Array, Array]:
        """Force of the virtual tube on the tip [N], and its derivative by the flux density [N/T].

        Shapes (3,) and (3, 3) (P-19, P-21). At an unstable equilibrium the derivative is zero.
        """
        force, slope = self._tube_force()
        plant = self._let_go()
        stable = respond(plant.model, plant.state, plant.mouth, plant.work, self._linear)
        moves = self._tip_moves() if stable else np.zeros((3, 3))
        return force, slope @ moves

    def _tube_force(self) -> tuple[Array, Array]:
        """Force of the virtual tube, and its derivative by the tip's scaled position [N]."""
        force, slope = np.zeros(3), np.zeros((3, 3))
        model = self._plant.model
        tube_force(model.rod, model.tube, self._plant.state, force, slope)
        unit = self.system.scales.force
        return force * unit, slope * unit

    def _tip_moves(self) -> Array:
        """Change of the scaled tip position by the flux density [1/T], from the linearisation."""
        last = 4 * (len(self._plant.state.q) - int(self._plant.state.held[0]))
        moves: Array = self._linear.moves[:, last : last + 3].T
        return moves

    def remember(self) -> Snapshot:
        """What it takes to come back here."""
        return self._plant.snapshot()

    def return_to(self, snapshot: Snapshot) -> None:
        """Come back to what was remembered."""
        self._came = None
        self._plant.restore(snapshot)


def across(direction: Array) -> Array:
    """Two unit vectors across a direction, shape (2, 3)."""
    x, y, z = (direction / math.sqrt(direction @ direction)).tolist()
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        u, v, w = 0.0, z, -y
    elif abs(y) <= abs(z):
        u, v, w = -z, 0.0, x
    else:
        u, v, w = y, -x, 0.0
    size = math.sqrt(u * u + v * v + w * w)
    u, v, w = u / size, v / size, w / size
    return np.array([[u, v, w], [y * w - z * v, z * u - x * w, x * v - y * u]])
