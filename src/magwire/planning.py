"""To which outlets a wire gets, what it takes to get there, and what keeps it from the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.system import System
from magwire.errors import InputError, instance
from magwire.kernels.wall.barrier import barrier
from magwire.lumen import Lumen
from magwire.lumen.branch import Bend
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.navigator import (
    Course,
    NavigationError,
    Navigator,
    Observation,
    Prescribed,
)
from magwire.navigate.schedule import Schedule, last_tries
from magwire.navigate.tip import TipNavigator
from magwire.operate.steering import Persistent
from magwire.simulation import Simulation
from magwire.status import RunStatus
from magwire.wire import Wire

if TYPE_CHECKING:
    from magwire.results import Result

Array = NDArray[np.float64]

LARGE = 0.9999  # feed in a time step, over an edge: one that feeds more is cut in half
LONGEST = 2.0  # the same, over the feed between two planned fields, at most
SPEED = 0.01  # wire lengths in a second; there is no inertia
WIDE = 10.0  # lumen's radius over the wire's, in which a wire has nothing to lean on
MOUTH = 0.5  # of that lumen's radius: from there down it counts as narrow
AT_LIMIT = 0.98  # of the largest field, from which on it is what keeps a wire back


@dataclass(frozen=True)
class Trial:
    """How the way to an outlet went where something was off; see ``mw.robustness``.

    Attributes
    ----------
    change
        What was off, such as "E +5 %".
    reached
        Whether the tip got there.
    came
        How far along the path it came [m].
    peak_field
        Largest flux density [T].
    tip_force
        Largest force of the wall on the tip [N].
    clearance
        Smallest clearance [m]; NaN if the wire did not set out.
    reason
        Why it did not get there, or "".
    """

    change: str
    reached: bool
    came: float
    peak_field: float
    tip_force: float
    clearance: float
    reason: str


@dataclass(frozen=True)
class Prospect:
    """What to expect on the path to an outlet.

    Attributes
    ----------
    outlet
        Its name.
    reached
        Whether the tip gets there, up to one radius before the end.
    length, fed, came
        Length of the path; insertion length of the wire; and how far along the path the tip came
        [m]. A wire that cuts the bends is shorter than the path.
    narrowest, narrowest_at
        Smallest radius on the path and the arc parameter where it is [m].
    bend
        Tightest bend on the path.
    peak_field
        Largest flux density [T].
    tip_force, wall_force
        Largest force of the wall on the tip, and on the whole wire, summed over its nodes [N].
    patch_force, force_patch
        Largest force of the wall on a patch of the wire [N], and the length of the patch [m].
    push_force, guide_torque
        Largest push [N] and size of the torque [N m] at the guide.
    clearance
        Smallest clearance, also midway between the nodes [m]; NaN if it did not set out.
    reason
        Why it does not get there; of an outlet that is reached, what was tried again, or "".
    feed, arc, flux_density, force
        The same along the path: feed [m], how far the tip came [m], flux density [T] and force on
        the whole wire [N], shapes (n,).
    field_components
        The flux density along x, y and z, shape (n, 3) [T].
    trials
        How it went where something was off; none if that was not tried (``mw.robustness``).
    """

    outlet: str
    reached: bool
    length: float
    fed: float
    came: float
    narrowest: float
    narrowest_at: float
    bend: Bend
    peak_field: float
    tip_force: float
    wall_force: float
    patch_force: float
    force_patch: float
    push_force: float
    guide_torque: float
    clearance: float
    reason: str
    feed: Array = field(repr=False)
    arc: Array = field(repr=False)
    flux_density: Array = field(repr=False)
    force: Array = field(repr=False)
    field_components: Array = field(repr=False)
    trials: tuple[Trial, ...] = ()

    @property
    def schedule(self) -> Schedule:
        """The field as a function of the feed, to be replayed with ``mw.Prescribed``."""
        return Schedule.along(list(zip(self.feed.tolist(), self.field_components, strict=True)))


def plan(
    lumen: Lumen,
    wire: Wire,
    *,
    demands: Demands | None = None,
    contact: Barrier | None = None,
    watch: Callable[[str], None] | None = None,
    outlets: Sequence[str] = (),
) -> list[Prospect]:
    """Steer a wire to every outlet of a lumen, by equilibria (P-16, P-22), and replay each course.

    Programmes need a wall that gives way (``firm_wall``). What is reported is what a wire with
    inertia does in their field, open loop, at the wall that fits it, as in every run.

    Parameters
    ----------
    lumen
        The lumen; one without named outlets has one, "outlet".
    wire
        The wire. If it is too short for the path to an outlet, its proximal section is made longer.
    demands
        What the field must keep to, such as its largest value.
    contact
        The wall's barrier, of plans and replays; if left out, one that gives way for the plans, and
        the one that fits for the replays.
    watch
        Called with the name of each outlet before it is tried.
    outlets
        Names of the outlets to try; all of them if left out.

    Returns
    -------
    list of Prospect
        One for each outlet.

    Raises
    ------
    InputError
        If the wire has no magnetisation, or there is no lumen.
    """
    instance("plan", "lumen", lumen, Lumen)
    instance("plan", "wire", wire, Wire)
    instance("plan", "demands", demands, Demands, or_none=True)
    instance("plan", "contact", contact, Barrier, or_none=True)
    if not lumen.branches:
        raise InputError("Input lumen of plan must have at least one branch; received open space.")
    if not wire.moment_per_length > 0.0:
        raise InputError("Input wire of plan must be magnetised; received none.")
    found = []
    for name in outlets or lumen.outlets or ("outlet",):
        if watch is not None:
            watch(name)
        there = lumen.towards(name) if lumen.outlets else lumen
        found.append(
            _prospect(name, there, wire, Demands() if demands is None else demands, contact)
        )
    return found


def fitted(wire: Wire, length: float) -> Wire:
    """The wire, or if it is too short, the wire with a longer proximal section, on the same edges.

    Parameters
    ----------
    wire
        The wire.
    length
        What it has to have at least [m].
    """
    if wire.length >= length:
        return wire
    first = wire.sections[0]
    count = int(np.ceil(length / wire.edge_length - 1e-9))
    grown = replace(first, length=first.length + count * wire.edge_length - wire.length)
    return Wire((grown, *wire.sections[1:]), count + 1)


def firm_wall(wire: Wire, bend: float, gap: float) -> Barrier:
    """A barrier that bends the wire around a bend while it keeps it off by a part of its gap.

    Middles between the nodes cut the inside of a bend: a wall that lets the nodes come much closer
    than its activation gap would be cut by them. To bend a wire of stiffness EI to a radius rho all
    along takes forces of EI/rho^3 per length; a wire that cuts bends presses more at few places,
    so the wall is a thousandth as stiff as the wire's material at least.

    Parameters
    ----------
    wire
        The wire.
    bend
        Radius of the bend [m].
    gap
        Activation gap of the barrier [m].
    """
    line_force = wire.bending_stiffness / bend**3
    slope = -barrier(tuned.OUTLET.left * gap, gap)[1]  # of its energy, over K
    return Barrier(max(tuned.OUTLET.hard * wire.body.bending_modulus, line_force / slope), gap)


def _prospect(
    name: str, lumen: Lumen, wire: Wire, demands: Demands, contact: Barrier | None
) -> Prospect:
    """What to expect on the path to the lumen's target."""
    way = lumen.path().branches[0]
    knots = way.curve.knots()
    radii = way.curve.at(knots)[:, 3]
    thin = int(np.argmin(radii))
    none = np.zeros(0)
    nothing = Prospect(
        outlet=name,
        reached=False,
        length=way.length,
        fed=0.0,
        came=0.0,
        narrowest=float(radii[thin]),
        narrowest_at=float(knots[thin]),
        bend=way.bend_radius(),
        peak_field=0.0,
        tip_force=0.0,
        wall_force=0.0,
        patch_force=0.0,
        force_patch=float("nan"),
        push_force=0.0,
        guide_torque=0.0,
        clearance=float("nan"),
        reason="",
        feed=none,
        arc=none,
        flux_density=none,
        force=none,
        field_components=np.zeros((0, 3)),
    )
    if nothing.narrowest <= (contact or Barrier()).keep_off(wire.radius):
        return replace(
            nothing,
            reason=f"The wire is {2e3 * wire.radius:.4g} mm wide, the lumen "
            f"{2e3 * nothing.narrowest:.4g} mm at {1e3 * nothing.narrowest_at:.4g} mm.",
        )
    course = course_to(lumen, wire, contact)
    found = _travel(nothing, course, demands)
    return _nearer(found, nothing, course, demands) if _has_spike(found) else found


def _has_spike(found: Prospect) -> bool:
    """Whether the field of a course is far larger in one place than elsewhere."""
    sizes = found.flux_density[found.flux_density > 0.0]
    return found.reached and len(sizes) > 0 and sizes.max() > tuned.OUTLET.spike * np.median(sizes)


def _nearer(found: Prospect, nothing: Prospect, course: _Course, demands: Demands) -> Prospect:
    """The course, or one with the tip nearer to the centreline if that takes less field.

    Fields are planned one feed after the other. A wire that comes to a bend with its tip at the
    rim of its room may need far more field there than one that comes along the middle.
    """
    for part in tuned.OUTLET.nearer:
        clearance = demands.tip_clearance + part * (1.0 - demands.tip_clearance)
        other = _travel(nothing, course, replace(demands, tip_clearance=clearance))
        if other.reached and other.peak_field < found.peak_field:
            said = (
                f"Planned with tip_clearance {clearance:.3g}; with {demands.tip_clearance:.3g} it "
                f"takes {1e3 * found.peak_field:.3g} mT."
            )
            return replace(other, reason=" ".join(filter(None, (said, other.reason))))
    return found


def course_to(lumen: Lumen, wire: Wire, contact: Barrier | None = None) -> _Course:
    """How a wire that fits goes to the lumen's target; see ``plan``."""
    way = lumen.path().branches[0]
    radii = way.curve.at(way.curve.knots())[:, 3]
    room = float(radii.min()) - (contact or Barrier()).keep_off(wire.radius)
    long = fitted(wire, tuned.OUTLET.slack * way.length)
    every = min(
        tuned.OUTLET.finest * long.length, tuned.OUTLET.pace * float(np.quantile(radii, 0.25))
    )
    gap = min(tuned.OUTLET.gap, tuned.OUTLET.part * room)
    yielding = firm_wall(wire, way.bend_radius().radius, gap)
    return _Course(
        planned=Simulation(long, lumen, contact=contact or yielding),
        replayed=_briskly(Simulation(long, lumen, contact=contact or Barrier())),
        feed=Feed(SPEED * long.length, tuned.OUTLET.slack * way.length),
        every=every,
        step=min(LARGE * long.edge_length, LONGEST * every),
        goal=way.length - float(radii[-1]),
    )


def _briskly(simulation: Simulation) -> Simulation:
    """The simulation, with steps that are halved where they take an edge into the wall."""
    simulation.system = replace(simulation.system, halves=True)
    return simulation


@dataclass(frozen=True)
class _Course:
    """How a wire goes to an outlet: planned on one wall, replayed on another.

    every: feed between two planned fields; step: in a time step of the replay [m].
    """

    planned: Simulation
    replayed: Simulation
    feed: Feed
    every: float
    step: float
    goal: float

    def run(self, distance: float, navigator: Navigator) -> Result:
        """Feed the wire on with inertia until its tip is at the goal, or by a distance [m]."""
        return self.replayed.run(
            Feed(self.feed.fastest, distance),
            navigator,
            time_step=self.step / self.feed.fastest,
            record_every=self.step,
            update_every=self.step,
            until=self.goal,
        )


@dataclass(frozen=True)
class _Unasked:
    """A navigator that is not asked where the tip should be: it would solve for it each time."""

    navigator: Navigator

    @property
    def notes(self) -> Sequence[str]:
        """What was tried again."""
        return getattr(self.navigator, "notes", ())

    def plan(self, observation: Observation, until: float) -> Course:
        """See ``Navigator.plan``."""
        return self.navigator.plan(observation, until)

    def go_back(self, seen: Observation, failure: NavigationError) -> float:
        """See ``Persistent.go_back``."""
        if isinstance(self.navigator, Persistent):
            return self.navigator.go_back(seen, failure)
        raise failure


def _travel(nothing: Prospect, course: _Course, demands: Demands) -> Prospect:
    """Plan ahead of a wire that moves with inertia: what it takes is what that wire says.

    The plan does not hang on what the wire does, unless its tip goes astray: what is seen is the
    course replayed open loop. Where the wire was taken back to try again, the last tries are
    replayed from the entrance.
    """
    goal = course.goal
    steering = TipNavigator(
        demands, update_every=course.step, plan_every=course.every, attempts=tuned.OUTLET.attempts
    )
    navigator = _Unasked(steering.start(course.planned.system))
    planned = course.run(course.feed.largest, navigator)
    if len(planned.feed) == 0 or not planned.feed.max() > 0.0:
        return replace(nothing, reason=planned.message)
    tried, result = last_tries(planned.feed), planned
    if len(tried) < len(planned.feed):
        schedule = Schedule(planned.feed[tried], planned.field[tried])
        result = course.run(float(schedule.feed[-1]), Prescribed(schedule))
    arc = course.replayed.system.path.locate(result.position[:, -1])[0]
    flux = np.linalg.norm(result.field, axis=1)
    found = replace(
        nothing,
        reached=bool(arc[-1] >= goal),
        fed=float(result.feed.max()),
        came=float(arc.max()),
        peak_field=float(flux.max()),
        tip_force=result.max_tip_force,
        wall_force=result.max_wall_force,
        patch_force=result.max_patch_force,
        force_patch=result.force_patch,
        push_force=result.max_push_force,
        guide_torque=result.max_guide_torque,
        clearance=result.smallest_clearance,
        reason=planned.message,
        feed=result.feed,
        arc=arc,
        flux_density=flux,
        force=result.wall_force,
        field_components=np.array(result.field),
    )
    if found.reached:
        return found
    left = f"{1e3 * (goal - found.came):.4g} mm are left"
    if planned.status != RunStatus.COMPLETE:
        reason = planned.message
    elif course.replayed.tip_arc(planned.position[-1]) < goal:
        reason = f"All of the wire is inserted, and {left}. {planned.message}"
    else:
        reason = f"A course of the field was planned, but replayed with inertia {left}."
    bound = found.peak_field >= AT_LIMIT * demands.max_field  # then more field would do
    advice = "" if bound else remedy(course.replayed.system, found.came)
    replayed = "" if result is planned else result.message
    return replace(found, reason=" ".join(filter(None, (reason.strip(), replayed, advice))))


def remedy(system: System, came: float) -> str:
    """What to do about a wire that stopped in a wide vessel before a narrow one; "" elsewhere.

    Parameters
    ----------
    system
        Wire and lumen.
    came
        How far along the path the tip came [m].
    """
    way = system.path.branches[0]
    knots = way.curve.knots()
    radii = way.curve.at(knots)[:, 3]
    here = float(np.interp(came, knots, radii))
    ahead = np.flatnonzero((knots > came) & (radii < MOUTH * here))
    if here < WIDE * system.wire.radius or len(ahead) == 0:
        return ""
    mouth = float(knots[ahead[0]])
    x, y, z = 1e3 * way.curve.at(knots[ahead[:1]])[0, :3]
    return (
        f"There the lumen is {2e3 * here:.3g} mm wide, {1e3 * (mouth - came):.3g} mm before it "
        "narrows to half of that, and the wire has nothing to lean on: enter where it narrows, "
        f'with the entrance "{x:.1f} mm, {y:.1f} mm, {z:.1f} mm", or use a stiffer wire.'
    )
