"""Steering by an actuator's inputs: first the field, then the inputs that do the same (P-28).

The navigator of a uniform field plans as if there were one. At every knot of its schedule inputs
are sought that make its field where the magnet is, at the least cost: power, or the way of a
magnet. A gradient pulls, though: so the wire's equilibrium in the actuator's own field is followed,
and the inputs are corrected until the tip is where the plan has it, with the planned component of
the field along it, which is what keeps it from buckling.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from magwire.actuate import Magnet
from magwire.actuate.curve import curves_of
from magwire.engine.command import Drive
from magwire.engine.plant import Plant, Snapshot
from magwire.engine.point import Point
from magwire.engine.sensitivity import derivative
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.errors import InputError, one_of
from magwire.navigate.arm import Arm
from magwire.navigate.direct import Direct
from magwire.navigate.inputs import InputSchedule
from magwire.navigate.least_cost import (
    FREE,
    LEAST,
    REACH,
    allocate,
    binding,
    cheapest,
    held,
    lacking,
    prices_of,
    steepness,
)
from magwire.navigate.model import across
from magwire.navigate.navigator import NavigationError, Navigator, Observation, Steering
from magwire.navigate.schedule import Schedule
from magwire.navigate.shares import shares_of

Array = NDArray[np.float64]
Objective = Literal["power", "field"]

POINTS = 201  # of the path, from which a magnet keeps away
CORRECTIONS = 6  # of the inputs at a knot
CLOSE = 1e-9  # two feeds are the same [m]
SLACK = 1.0 + 1e-6  # room for rounding in rates
ON_PLAN = 0.01  # tip off the plan, over the radius, and field along it, over the planned one
ASIDE = 0.2  # the same, beyond which a knot counts as not reached
ASTRAY = (
    "no inputs within the limits bring the tip to where it is planned, in the actuator's own "
    "field: its gradient pulls, or the wire is about to buckle"
)
ADVICE = "ask for a larger stability_margin or tip_clearance, or use larger coils."


@dataclass(frozen=True)
class Allocated:
    """Steer by the inputs of the simulation's actuator: first the field, then the inputs.

    Parameters
    ----------
    steering
        Who plans the field, such as a ``TipNavigator``.
    objective
        ``"field"``: the planned field is made where the magnet is, at the least power.
        ``"power"``: from there the inputs go on to the least power with which tip and stability are
        what the planner's demands ask for, if it has any: a torque or a pull may cost less than the
        field. Of a magnet on an arm it is always the way that is least.
    """

    steering: Steering
    objective: Objective = "power"

    def __post_init__(self) -> None:
        one_of("Allocated", "objective", self.objective, get_args(Objective))

    @property
    def update_every(self) -> float:
        """Feed between two observations [m]."""
        return self.steering.update_every

    def start(self, system: System) -> AllocatingNavigator:
        """The navigator of one run of a system.

        Raises
        ------
        InputError
            If the system has no actuator, or cannot be steered by a field.
        """
        if system.actuator is None:
            raise InputError(
                "Input actuator of Simulation must be given to steer by its inputs; received None."
            )
        inner = self.steering.start(replace(system, actuator=None))
        return AllocatingNavigator(inner, system, objective=self.objective)


class AllocatingNavigator:
    """A navigator of a uniform field, and the inputs that make its field at the magnet.

    Parameters
    ----------
    navigator
        Who plans the field.
    system
        Wire, lumen and actuator.
    objective
        See ``Allocated``.
    """

    def __init__(
        self, navigator: Navigator, system: System, *, objective: Objective = "power"
    ) -> None:
        assert system.actuator is not None
        self._currents = np.array([one.unit not in ("m", "") for one in system.actuator.inputs])
        self._saves = objective == "power" and bool(self._currents.all())
        self.navigator, self._system, self._actuator = navigator, system, system.actuator
        begin, end = system.wire.magnet
        self._behind = system.wire.length - 0.5 * (begin + end)  # of the tip, the magnet's middle
        inputs = system.actuator.inputs
        self._low, self._high = held(inputs)
        self._prices = prices_of(inputs)
        self._curves = curves_of(system.actuator)
        self._last = system.idle_inputs
        self._feed = float("inf")
        self._needed: Array | None = None  # inputs without limits, where the limits bind
        self._plant = Plant(system.smooth)
        self._unit = system.path.narrowest
        planner = getattr(navigator, "navigator", navigator)  # of one that tries again
        demands = getattr(planner, "demands", None)
        self._direct = None if demands is None else Direct(self._plant, demands, self._prices)
        every = float(getattr(planner, "plan_every", np.inf))
        self._arm: Arm | None = None
        if self._direct is not None and isinstance(self._actuator, Magnet):
            self._arm = Arm(self._direct, self._actuator, every)
        expect = getattr(planner, "expect", None)
        if expect is not None and bool(self._currents.all()):
            curve = system.path.branches[0].curve
            middle = curve.at(np.array([0.5 * curve.length]))[0, :3]
            expect(shares_of(system.actuator, middle))

    def plan(self, observation: Observation, until: float) -> InputSchedule:
        """The inputs from the observed feed to the feed ``until`` [m].

        Raises
        ------
        NavigationError
            If no field does what is asked for, or no inputs within the limits make it.
        """
        if self._arm is not None:
            return self._moved(self._arm, observation, until)
        course = self.navigator.plan(observation, until)
        assert isinstance(course, Schedule)
        low, high = sorted((observation.feed, until))
        inner = course.feed[(course.feed > low + CLOSE) & (course.feed < high - CLOSE)]
        knots = np.unique(np.concatenate(([low], inner, [high])))
        if until < observation.feed:
            knots = knots[::-1]
        rows: list[Array] = []
        start = self._last
        for feed, flux in zip(knots, course.at(knots), strict=True):
            if rows or abs(feed - self._feed) > CLOSE:  # where the last plan ends, this one begins
                start = self._allocate(float(feed), flux, start)
            rows.append(start)
        self._in_time(knots, np.array(rows), observation.speed)
        self._last, self._feed = rows[-1], float(knots[-1])
        order = np.argsort(knots)
        return InputSchedule(knots[order], np.array(rows)[order], self._system.input_names)

    def _allocate(self, feed: float, flux: Array, start: Array) -> Array:
        curve = self._system.path.branches[0].curve
        place = curve.at(np.array([feed - self._behind]))[0, :3]
        found = allocate(self._actuator, place, flux, start)
        at = f"At {1e3 * feed:.4g} mm of feed"
        if found is None:
            raise NavigationError(f"{at} {binding(self._actuator, place, flux, start)}")
        known = getattr(self.navigator, "expected_tip", None)
        tip = None if known is None else known(feed)
        before, self._needed = self._plant.snapshot(), None
        if tip is not None:
            there = self._follow(feed, found)
            done = there and (not np.any(flux) or self._correct(tip, flux))
            if not done and not self._swung(feed, found, tip, flux):
                why = self._lacking() or self._astray(found, flux, place)
                return self._aside(feed, before, f"{at} {why}")
            found = self._plant.inputs
            if self._saves and self._direct is not None and np.any(flux):
                found = self._saved(self._direct, found)
        over = self._actuator.violations(found)
        if over:
            raise NavigationError(f"{at} a limit binds. {over[0]}")
        if isinstance(self._actuator, Magnet):
            self._keep_out(self._actuator, found, feed)
        return found

    def _swung(self, feed: float, inputs: Array, tip: Array, flux: Array) -> bool:
        """Take the wire to be as it is planned to be: it may have to swing to get there."""
        expected = getattr(self.navigator, "expected", None)
        planned = None if expected is None else expected(feed)
        if planned is None:
            return False
        needed = self._needed
        self._plant.restore(planned.with_inputs(inputs))
        settled = self._plant.settle(self._system.step_limits())[0] is Status.CONVERGED
        done = settled and self._correct(tip, flux)
        self._needed = None if done else needed
        return done

    def _lacking(self) -> str:
        """Which limit is in the way of the tip, as the end of a sentence; "" if none is known."""
        over = None if self._needed is None else lacking(self._actuator.inputs, self._needed)
        if over is None:
            return ""
        limit, takes = over
        return f"{limit}; to bring the tip to where it is planned takes {takes}."

    def _astray(self, inputs: Array, flux: Array, place: Array) -> str:
        """Why no inputs do though none is at its limit, as the end of a sentence."""
        used = np.abs(inputs) / np.maximum(np.abs(self._low), np.abs(self._high))
        most = int(np.argmax(used))
        one = self._actuator.inputs[most]
        _, gradient = self._actuator.at(place[None], inputs)
        pull = float(np.linalg.norm(gradient[0], 2))
        return (
            f"{ASTRAY}. No input is at its limit: for the planned {1e3 * np.linalg.norm(flux):.3g} "
            f"mT {one.name} has {abs(inputs[most]):.3g} of {abs(inputs[most]) / used[most]:.3g} "
            f"{one.unit}, with a gradient of {pull:.2g} T/m; {ADVICE}"
        )

    def _saved(self, direct: Direct, found: Array) -> Array:
        """Inputs of less power that do what is asked for; those found if there are none."""
        plant, weak = self._plant, direct.weak
        start = plant.snapshot()
        plant.inputs = weak * found
        settled = plant.settle(self._system.step_limits())[0] is Status.CONVERGED
        if settled and direct.improve(plant.inputs, np.full(len(found), FREE)):
            less = plant.inputs / weak
            if self._prices @ less**2 < self._prices @ found**2:
                return less
        plant.restore(start)
        return found

    def _aside(self, feed: float, before: Snapshot, why: str) -> Array:
        """Inputs that are found from those at the feed before, where the plan's field fails."""
        plant, direct = self._plant, self._direct
        if not self._saves or direct is None:
            raise NavigationError(why)
        plant.restore(before)
        plant.inputs = direct.weak * plant.inputs
        settled = plant.settle(self._system.step_limits())[0] is Status.CONVERGED
        free = np.full(len(plant.inputs), FREE)
        if not settled or not direct.feed_to(feed) or not direct.improve(plant.inputs, free):
            raise NavigationError(why)
        found: Array = plant.inputs / direct.weak
        return found

    def _moved(self, arm: Arm, observation: Observation, until: float) -> InputSchedule:
        """The poses of a magnet up to a feed."""
        goal = until if observation.goal is None else observation.goal
        places = arm.plan(observation.feed, until, goal, observation.speed)
        feeds = np.array([place.feed for place in places])
        poses = np.array([place.pose for place in places])
        return InputSchedule(feeds, poses, self._system.input_names)

    def _tip(self) -> Array | None:
        """The model's tip in the inputs that were found, not in the weakest that they may be."""
        plant = self._plant
        start = plant.snapshot()
        plant.inputs = self._last
        settled = plant.settle(self._system.step_limits())[0] is Status.CONVERGED
        tip = plant.observe().tip
        plant.restore(start)
        return tip if settled else None

    def _follow(self, feed: float, inputs: Array) -> bool:
        """Bring the model to a feed and inputs by equilibria; whether they were found."""
        plant = self._plant
        edge = float(self._system.mesh.edge_length.min())
        steps = max(1, int(np.ceil(abs(feed - plant.feed) / (0.5 * edge) - 1e-9)))
        share = np.linspace(0.0, 1.0, steps + 1)[1:, None]
        course = plant.feed + share[:, 0] * (feed - plant.feed)
        way = plant.inputs + share * (inputs - plant.inputs)
        done = plant.advance(Drive(course, np.zeros(steps), way, 1.0, inertia=False))
        return done == steps

    def _correct(self, tip: Array, flux: Array) -> bool:
        """Bring the model's tip to where it is planned; whether inputs within the limits do."""
        for _ in range(CORRECTIONS):
            rows, off = self._to_first_order(tip, flux)
            if np.abs(off).max() < ON_PLAN or not self._plant.released:
                return True
            if not self._change(rows, off):
                return False
        return float(np.abs(off).max()) < ASIDE

    def _to_first_order(self, tip: Array, flux: Array) -> tuple[Array, Array]:
        """How the tip and the field along it change with the inputs, and how far they are off.

        Shapes (3, m) and (3,); the tip across itself over the radius, the field over
        the planned one.
        """
        plant, actuator = self._plant, self._actuator
        seen, u = plant.observe(), plant.inputs
        point = Point(self._system, plant.samples(), plant.snapshot().state, plant.mouth)
        moves = derivative(point, "tip", "inputs")
        unit = max(float(np.linalg.norm(flux)), LEAST)
        aside = across(seen.tip_direction)
        where = (seen.tip - self._behind * seen.tip_direction)[None]
        made, by_input = actuator.at(where, u)[0][0], actuator.response(where, u)[0][0].T
        along = seen.tip_direction
        rows = np.vstack([aside @ moves / self._unit, along @ by_input / unit])
        off = np.append(aside @ (tip - seen.tip) / self._unit, along @ (flux - made) / unit)
        return rows, off

    def _change(self, rows: Array, off: Array) -> bool:
        """Change the inputs at the least cost so that nothing is off; whether the wire follows."""
        plant, u = self._plant, self._plant.inputs
        near = np.where(self._currents, FREE, REACH)
        steep = steepness(self._curves, u)
        cost = self._prices * steep, np.where(self._currents, u, 0.0) / steep
        change = cheapest(
            *cost,
            (rows, off),
            (np.maximum(self._low - u, -near), np.minimum(self._high - u, near)),
        )
        if change is None:
            free = np.full(len(u), FREE)
            wanted = cheapest(*cost, (rows, off), (-free, free))
            self._needed = None if wanted is None else u + wanted
            return False
        plant.inputs = np.clip(u + change, self._low, self._high)
        return plant.settle(self._system.step_limits())[0] is Status.CONVERGED

    def _in_time(self, feeds: Array, rows: Array, speed: float | None) -> None:
        """Refuse inputs that would have to change faster than they can."""
        if not speed or len(feeds) < 2:
            return
        for k, (a, b) in enumerate(itertools.pairwise(rows)):
            time = abs(float(feeds[k + 1] - feeds[k]) / speed)
            for one, now, then in zip(self._actuator.inputs, a, b, strict=True):
                rate = float(then - now) / time
                low, high = one.rates(float(then))
                if not low * SLACK <= rate <= high * SLACK:
                    raise NavigationError(
                        f"At {1e3 * feeds[k + 1]:.4g} mm of feed input {one.name} would have to "
                        f"change by {rate:.3g} {one.unit}/s, and can by "
                        f"{high if rate > 0.0 else low:.3g} {one.unit}/s: feed more slowly, or "
                        "observe more often."
                    )

    def _keep_out(self, magnet: Magnet, pose: Array, feed: float) -> None:
        """Refuse a magnet that is too near to the vessel."""
        curve = self._system.path.branches[0].curve
        points = curve.at(np.linspace(0.0, curve.length, POINTS))
        near = float((magnet.distance(pose, points[:, :3]) - points[:, 3]).min())
        if near < magnet.keep_out:
            raise NavigationError(
                f"At {1e3 * feed:.4g} mm of feed the magnet would be {1e3 * near:.3g} mm from the "
                f"vessel; it must keep {1e3 * magnet.keep_out:g} mm away."
            )

    def go_back(self, seen: Observation, failure: NavigationError) -> float:
        """The feed to go back to [m], if the navigator of the field tries again.

        Raises
        ------
        NavigationError
            If it does not, or gives up.
        """
        again = getattr(self.navigator, "go_back", None)
        if again is None:
            raise failure
        feed: float = again(seen, failure)
        return feed

    @property
    def notes(self) -> tuple[str, ...]:
        """What was tried more than once, a sentence each."""
        return tuple(getattr(self.navigator, "notes", ()))

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None if that is not known."""
        if self._arm is not None:
            return self._arm.expected_tip(feed)
        if abs(feed - self._plant.feed) < CLOSE and self._direct is not None:
            return self._tip()
        known = getattr(self.navigator, "expected_tip", None)
        tip: Array | None = None if known is None else known(feed)
        return tip
