"""To which outlets a wire gets, what it takes to get there, and what keeps it from the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from magwire.contact import Barrier
from magwire.errors import InputError, instance
from magwire.lumen import Lumen
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.foresight import foresee
from magwire.navigate.navigator import (
    Course,
    NavigationError,
    Navigator,
    Observation,
    Prescribed,
)
from magwire.navigate.persistent import persistent
from magwire.navigate.schedule import Schedule, last_tries
from magwire.navigate.stable import StableNavigator
from magwire.operate.steering import Persistent
from magwire.planning.prospect import Prospect
from magwire.planning.remedy import remedy
from magwire.planning.route import Route, route_to
from magwire.status import RunStatus
from magwire.wire import Wire

AT_LIMIT = 0.98  # of the largest field, from which on it is what keeps a wire back


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
    route = route_to(lumen, wire, contact)
    found = _travel(nothing, route, demands)
    if not found.reached and _is_lost(found, route, demands):
        return _nearer(found, nothing, route, demands)
    return found


def _is_lost(found: Prospect, route: Route, demands: Demands) -> bool:
    """Whether an outlet is not reached though there is field left, and a wall to lean on."""
    return not (_at_limit(found, demands) or remedy(route.replayed.system, found.came))


def _at_limit(found: Prospect, demands: Demands) -> bool:
    """Whether more field would do."""
    return found.peak_field >= AT_LIMIT * demands.max_field


def _nearer(found: Prospect, nothing: Prospect, route: Route, demands: Demands) -> Prospect:
    """The course that misses an outlet, or one nearer to the centreline that gets there.

    Fields are planned one feed after the other. A wire that comes to a bend with its tip at the
    rim of its room may find no field there in which one that comes along the middle gets on.
    """
    for part in tuned.OUTLET.nearer:
        clearance = demands.tip_clearance + part * (1.0 - demands.tip_clearance)
        other = _travel(nothing, route, replace(demands, tip_clearance=clearance))
        if other.reached:
            said = (
                f"Planned with tip_clearance {clearance:.3g}; with {demands.tip_clearance:.3g} "
                f"{_left(found, route)}."
            )
            return replace(other, reason=" ".join(filter(None, (said, other.reason))))
    return found


def _left(found: Prospect, route: Route) -> str:
    """How far the tip is from the goal, in words."""
    return f"{1e3 * (route.goal - found.came):.4g} mm are left"


class _Foreseen:
    """A navigator whose course is planned to its end before the wire sets out.

    It is not asked where the tip should be: it would solve for it each time. Nor does it plan on
    ahead of the wire, unless that was taken back.
    """

    def __init__(self, navigator: Navigator, notes: Sequence[str]) -> None:
        self._navigator, self._notes, self._as_foreseen = navigator, notes, True

    @property
    def notes(self) -> Sequence[str]:
        """What was planned otherwise, and what was tried again."""
        return [*self._notes, *getattr(self._navigator, "notes", ())]

    def plan(self, observation: Observation, until: float) -> Course:
        """See ``Navigator.plan``."""
        seen = replace(observation, goal=None) if self._as_foreseen else observation
        return self._navigator.plan(seen, until)

    def go_back(self, seen: Observation, failure: NavigationError) -> float:
        """See ``Persistent.go_back``."""
        self._as_foreseen = False
        if isinstance(self._navigator, Persistent):
            return self._navigator.go_back(seen, failure)
        raise failure


def _travel(nothing: Prospect, route: Route, demands: Demands, *, level: bool = True) -> Prospect:
    """Plan the whole course, and see what a wire that moves with inertia does along it.

    The plan does not hang on what the wire does, unless its tip goes astray: what is seen is the
    course replayed open loop. Where the wire was taken back to try again, the last tries are
    replayed from the entrance. ``level``: without spikes, if that gets there.
    """
    goal = route.goal
    stable = StableNavigator(
        route.planned.system, demands=demands, plan_every=route.every, brisk=True
    )
    notes = foresee(stable, route.feed, goal, level=level)
    navigator = _Foreseen(persistent(stable, tuned.OUTLET.attempts), notes)
    planned = route.run(route.feed.largest, navigator)
    if len(planned.feed) == 0 or not planned.feed.max() > 0.0:
        return replace(nothing, reason=planned.message)
    tried, result = last_tries(planned.feed), planned
    if len(tried) < len(planned.feed):
        schedule = Schedule(planned.feed[tried], planned.field[tried])
        result = route.run(float(schedule.feed[-1]), Prescribed(schedule))
    arc = route.replayed.system.path.locate(result.position[:, -1])[0]
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
    if notes:
        return _travel(nothing, route, demands, level=False)
    left = _left(found, route)
    if planned.status != RunStatus.COMPLETE:
        reason = planned.message
    elif route.replayed.tip_arc(planned.position[-1]) < goal:
        reason = f"All of the wire is inserted, and {left}. {planned.message}"
    else:
        reason = f"A course of the field was planned, but replayed with inertia {left}."
    advice = "" if _at_limit(found, demands) else remedy(route.replayed.system, found.came)
    replayed = "" if result is planned else result.message
    return replace(found, reason=" ".join(filter(None, (reason.strip(), replayed, advice))))
