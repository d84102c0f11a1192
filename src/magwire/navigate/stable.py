"""Steering with the least field that keeps the tip off the wall, stably (P-22, P-23).

The plan runs ahead of the wire. Where it ends, or its field grows too fast, it is taken back, and a
course is looked for that leans the wire on the wall.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from magwire.engine.plant import Snapshot
from magwire.engine.system import System
from magwire.errors import InputError, instance, positive
from magwire.lumen import Lumen
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.model import InModel, Model
from magwire.navigate.navigator import NavigationError, Observation
from magwire.navigate.pilot import Knot, Pilot, norm
from magwire.navigate.programme import AXES, Programme
from magwire.navigate.schedule import Schedule
from magwire.navigate.swing import Swings

Array = NDArray[np.float64]

CLOSE = 1e-9  # two feeds are the same [m]


class StableNavigator:
    """Plans the least field that keeps the tip clear and the wire stable.

    Parameters
    ----------
    system
        Wire, lumen and wall as the navigator believes them to be.
    path
        The tube that the tip is to follow; the path to the lumen's target if left out.
    demands
        What the schedule must keep to.
    plan_every
        Feed between two planned fields [m]; half a percent of the wire if left out.
    friction
        ``"model"``: the plan is made with the system's friction; ``"none"``: without.
    brisk
        Whether the search for a field is that for tight vessels: with a tolerance for constraints,
        and with fewer tries that lead nowhere there. A swing may hang on them.

    Raises
    ------
    InputError
        If the wire has no magnetisation, or the path is no single tube.
    """

    def __init__(
        self,
        system: System,
        *,
        path: Lumen | None = None,
        demands: Demands | None = None,
        plan_every: float | None = None,
        friction: InModel = "none",
        brisk: bool = False,
    ) -> None:
        instance("StableNavigator", "system", system, System)
        instance("StableNavigator", "path", path, Lumen, or_none=True)
        instance("StableNavigator", "demands", demands, Demands, or_none=True)
        path = system.path if path is None else path
        if len(path.branches) != 1:
            raise InputError(
                "Input path of StableNavigator must have one branch; "
                f"received {len(path.branches)}."
            )
        length = 5e-3 * system.wire.length if plan_every is None else plan_every
        self.plan_every = positive("StableNavigator", "plan_every", length, "m")
        self.model = Model(system, path, friction=friction)
        self._length = self.model.reach
        self._shares, self._brisk = AXES, brisk
        self._keep_to(Demands() if demands is None else demands)
        self._begin(Knot(0.0, self.model.remember(), None), back=False)

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        back = until < observation.feed
        if observation.speed is not None and observation.speed != 0.0:
            self._swings.speed = abs(observation.speed)
        self._take_up(observation.feed, back)
        end = until
        if not back and observation.goal is not None:
            end = min(self._full_steps(until + tuned.COURSE.ahead * self._length), observation.goal)
        self._extend(end)
        short = until - self._knots[-1].feed
        if self._failure is not None and (short < -CLOSE if back else short > CLOSE):
            raise self._failure
        weak = self.demands.weakening
        whole = back or observation.goal is not None
        near = self._knots if whole else self._up_to(end)
        return Schedule.along([(knot.feed, knot.flux / weak) for knot in near])

    def _up_to(self, end: float) -> list[Knot]:
        """The planned fields up to the first one at or past a feed [m]."""
        count = next((k for k, knot in enumerate(self._knots) if knot.feed >= end), -1)
        return self._knots[: count + 1] if count >= 0 else self._knots

    def _full_steps(self, feed: float) -> float:
        """The first feed at or past another that is full steps of the plan away."""
        last = self._knots[-1].feed
        return last + self.plan_every * float(np.ceil((feed - last) / self.plan_every - 1e-6))

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None between planned fields."""
        if self.expected(feed) is None:
            return None
        return self.model.expected_tip(feed)

    def expected(self, feed: float) -> Snapshot | None:
        """How the wire should be at a feed [m]; None between planned fields."""
        knot = next((knot for knot in self._knots if abs(knot.feed - feed) < CLOSE), None)
        if knot is None:
            return None
        self.model.return_to(knot.snapshot)
        self.model.settle(knot.flux / self.demands.weakening)
        return self.model.remember()

    def expect(self, shares: Array) -> None:
        """Plan for coils, each of which makes its share of a field, shape (m, 3, 3)."""
        self._shares = shares
        self._keep_to(self.demands)

    @property
    def knot(self) -> Knot:
        """The planned field next behind the wire, from which the plan can be resumed."""
        return self._knots[0]

    @property
    def knots(self) -> list[Knot]:
        """All planned fields from there on."""
        return list(self._knots)

    @property
    def unit(self) -> float:
        """Flux density of order one [T]."""
        return self._pilot.programme.unit

    def go_on(self, end: float) -> bool:
        """Plan on to a feed [m], as far as it goes; whether there is a field all the way."""
        self._extend(end)
        return self._failure is None

    def take(self, knots: list[Knot]) -> None:
        """Take over fields that were planned, from the first one of them on."""
        self._begin(knots[-1], back=False)
        self._knots = list(knots)

    def resume(self, knot: Knot, demands: Demands) -> None:
        """Plan anew from a knot that was planned before, and keep to other demands from there."""
        self._keep_to(demands)
        self._begin(knot, back=False)

    def _keep_to(self, demands: Demands) -> None:
        """Plan fields that meet these demands from now on."""
        self.demands, system = demands, self.model.system
        longer = system.wire.length / self.model.reach
        programme = Programme(
            demands,
            tuned.COURSE.reference * system.scales.flux_density * longer**2,
            system.keep_off,
            system.firmness.activation_gap,
            self._shares,
            tuned.PROGRAMME.tolerance if self._brisk else 0.0,
        )
        free = replace(demands, max_field=float("inf"), gain_tolerance=0.0)
        unlimited = replace(programme, demands=free)
        self._pilot = Pilot(self.model, programme, brisk=self._brisk)
        self._scout = Pilot(self.model, unlimited, firm=float("inf"), brisk=self._brisk)
        self._swings = Swings(self.model, programme)

    def _begin(self, knot: Knot, back: bool) -> None:
        """Plan anew from a knot on."""
        self.model.return_to(knot.snapshot)
        self._knots, self._back = [knot], back
        self._failure: NavigationError | None = None
        self._pilot.forget()
        self._searched = 0.0

    def _take_up(self, feed: float, back: bool) -> None:
        """Drop what lies behind the wire; if the plan does not lead on from here, begin anew."""
        knots = self._knots
        low, high = sorted((knots[0].feed, knots[-1].feed))
        if back == self._back and low - CLOSE <= feed <= high + CLOSE:
            passed = 1
            while passed < len(knots) and (
                knots[passed].feed >= feed if back else knots[passed].feed <= feed + CLOSE
            ):
                passed += 1
            self._knots = knots[passed - 1 :]
            return
        nearest = min(knots, key=lambda knot: abs(knot.feed - feed))
        self._begin(nearest, back=feed < nearest.feed)
        self._extend(feed)
        if self._failure is not None:
            raise self._failure
        self._begin(self._knots[-1], back)

    def _extend(self, end: float) -> None:
        """Plan on to a feed, as far as it goes; past the path's end the field stays as it is."""
        while self._failure is None:
            last = self._knots[-1]
            left = end - last.feed
            if abs(left) < CLOSE or (left < 0.0) != self._back:
                return
            if left > 0.0 and self._is_past_end(last):
                return
            feed = last.feed + float(np.copysign(min(self.plan_every, abs(left)), left))
            try:
                self._knots[-1:] = self._pilot.advance(last, feed)
            except NavigationError as failure:
                if not self._swing():
                    self._failure = self._reason(failure, last, feed)
            else:
                if self._grows():
                    self._swing()

    def _is_past_end(self, knot: Knot) -> bool:
        """Whether the tip has left the path, where there is no wall to keep it from."""
        self.model.return_to(knot.snapshot)
        return self.model.tip_arc() > self.model.path.branches[0].length

    def _reason(self, failure: NavigationError, last: Knot, feed: float) -> NavigationError:
        """Why there is no field: the limit, if there would be one without."""
        if not np.isfinite(self.demands.max_field):
            return failure
        self._scout.forget()
        try:
            *_, knot = self._scout.advance(last, feed)
        except NavigationError:
            return failure
        needed = norm(knot.flux) / self.demands.weakening
        if needed <= self.demands.max_field:
            return failure
        return self.demands.exceeded(f"At {feed * 1e3:.4g} mm of feed", needed)

    def _grows(self) -> bool:
        """Whether the field that holds the wire grows so fast that the wall had better do it."""
        last = self._knots[-1]
        if self._back or self._swings.is_held(last.view):
            return False
        near = [
            k for k in self._knots if k.feed >= last.feed - tuned.COURSE.span * self._length - CLOSE
        ]
        large = norm(last.flux) > self._pilot.programme.unit
        return large and norm(last.flux) > tuned.COURSE.growth * max(
            norm(near[0].flux), self._searched
        )

    def _swing(self) -> bool:
        """Take the plan back to where the wire can swing onto the wall; whether it can."""
        knots = self._knots
        if self._back or self._swings.is_held(knots[-1].view):
            return False
        self._searched = norm(knots[-1].flux)
        course = self._swings.find(knots, self._held(knots), self._searched, self._stays)
        if course is None:
            return False
        self._knots = course
        self._pilot.forget()
        return True

    def _stays(self, knot: Knot) -> bool:
        """Whether the wall still holds the wire in the next planned field."""
        self._pilot.forget()
        try:
            *_, after = self._pilot.advance(knot, knot.feed + self.plan_every)
        except NavigationError:
            return False
        return self._swings.is_held(after.view)

    def _held(self, knots: list[Knot]) -> list[Knot]:
        """The course of the wire when the wall holds it, by rising feed; empty if it does not.

        It is found by going on, in whatever field that takes, until the wall holds the wire, and
        then back from there.
        """
        last = self._next_held(knots[-1], self.plan_every)
        if last is None:  # where the wall comes near a wire may be lost in a long step
            last = self._next_held(knots[-1], 0.5 * self.plan_every)
        if last is None:
            return []
        scout, back = self._scout, tuned.COURSE.stride * self.plan_every
        scout.forget()
        found: list[Knot] = []
        try:
            while self._swings.is_held(last.view) and last.feed > knots[0].feed:
                found.insert(0, last)
                found[0], *_, last = scout.advance(last, last.feed - back)
        except NavigationError:
            pass
        return found

    def _next_held(self, last: Knot, step: float) -> Knot | None:
        """The first knot from one on, in steps of feed [m], at which the wall holds the wire."""
        farthest = self.model.system.wire.length - step
        end = min(last.feed + tuned.COURSE.scout * self._length, farthest)
        self._scout.forget()
        try:
            while not self._swings.is_held(last.view):
                if last.feed > end:
                    return None
                *_, last = self._scout.advance(last, last.feed + step)
        except NavigationError:
            return None
        return last
