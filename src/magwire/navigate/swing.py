"""Ways to swing the wire onto the wall, where it can no longer swing (P-22).

Past a quarter turn a wire that only the guide touches is held against swinging by the field alone,
and the field for that grows without bound as the tip turns by 180 degrees. A wire whose body rests
on the wall needs much less. Between the two there is no path of stable equilibria in a moderate
field: the wire has to swing. What is looked for here are two fields, a little feed apart, from one
to the other of which it does so with its tip within bounds all the way. Only trials with
inertia can tell.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.navigate import tuned
from magwire.navigate.model import Model, View
from magwire.navigate.pilot import Knot, norm
from magwire.navigate.programme import Programme
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]

ROUND = 1e-9  # round-off of feeds [m]


class Way(NamedTuple):
    """A way to swing onto the wall.

    Attributes
    ----------
    leads
        The course that leads to its start.
    start
        The last equilibrium of the free wire.
    landing
        The wire that the wall holds, pressed onto it.
    reach
        Length in which plans are measured [m].
    nudge
        Field, over that at the start, that is added on the way in the direction in which the wire
        gives way most: it says to which side the wire swings, whichever coil is off.
    """

    leads: list[Knot]
    start: Knot
    landing: Knot
    reach: float
    nudge: float = 0.0

    @property
    def rest(self) -> Knot:
        """Its end: where the wire arrives, the field stays for a while."""
        return replace(self.landing, feed=self.landing.feed + tuned.SWING.length * self.reach)

    @property
    def course(self) -> list[Knot]:
        """All of it."""
        start, landing, rest = self.start, self.landing, self.rest
        if self.nudge == 0.0:
            return [*self.leads, start, landing, rest]
        assert start.view is not None
        *_, directions = np.linalg.svd(start.view.offset_by_flux)
        share = tuned.SWING.early
        flux = start.flux + share * (landing.flux - start.flux)
        flux += self.nudge * norm(start.flux) * directions[0]
        feed = start.feed + share * (landing.feed - start.feed)
        nudged = Knot(feed, start.snapshot.with_inputs(flux), None)
        return [*self.leads, start, nudged, landing, rest]

    @property
    def largest(self) -> float:
        """Largest flux density from the start on [T]."""
        return max(norm(knot.flux) for knot in self.course[len(self.leads) :])


class Swings:
    """Looks for swings.

    Parameters
    ----------
    model
        The wire; it is moved about.
    programme
        What the fields must keep to.

    Attributes
    ----------
    speed
        With which the wire is fed while it swings [m/s].
    """

    def __init__(self, model: Model, programme: Programme) -> None:
        self.model = model
        self.programme = programme
        self._length = model.reach
        self.speed = 0.01 * model.system.wire.length

    def find(
        self,
        free: Sequence[Knot],
        held: Sequence[Knot],
        highest: float,
        stays: Callable[[Knot], bool],
    ) -> list[Knot] | None:
        """The course with the least field that begins with the wire free and ends with it held.

        Parameters
        ----------
        free, held
            Courses of a wire that the wall does not hold, and of one that it does, by rising feed.
        highest
            Flux density [T] that the course must stay below.
        stays
            Whether a plan that goes on from a place where the wire is held keeps it held.
        """
        ways = [way for knot in held for way in self._onto(free, knot, highest)]
        ways.sort(key=lambda way: way.largest)
        known: dict[int, bool] = {}  # by landing
        for way in ways:
            landing = id(way.landing)
            if known.get(landing, True) and self._holds(way):
                if landing not in known:
                    known[landing] = stays(way.rest)
                if known[landing]:
                    return self._refined(way).course
        return None

    def _refined(self, way: Way) -> Way:
        """The way with its start moved to where less field will do."""
        for part in tuned.SWING.finer:
            spacing = part * tuned.SWING.spacing
            better: Way | None = way
            while better is not None:
                way = better
                better = next((w for w in self._near(way, spacing) if self._holds(w)), None)
        return way

    def _near(self, way: Way, spacing: float) -> Iterator[Way]:
        """Ways that start a little beside, in less field."""
        start = way.start
        assert start.view is not None
        size, axes = start.view.radius, start.view.axes
        for angle in np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False):
            aside = spacing * size * np.array([np.cos(angle), np.sin(angle)])
            place = self._send(start, (start.view.offset + aside) @ axes, norm(start.flux))
            if place is not None and norm(place.flux) < (1.0 - tuned.SWING.gain) * norm(start.flux):
                yield way._replace(start=place)

    def _onto(self, free: Sequence[Knot], landing: Knot, highest: float) -> list[Way]:
        """Ways to swing to where a held knot is, or beside it."""
        length = self._length
        landings: list[Knot] | None = None
        found = []
        for part in tuned.SWING.shorter if self._uneven else (1.0,):
            latest = landing.feed - part * tuned.SWING.length * length
            starts = [k for k in free if k.feed <= latest + ROUND]
            leads = [
                k for k in starts if k.feed <= starts[-1].feed - tuned.SWING.lead * length + ROUND
            ]
            if not leads or leads[-1].view is None:
                continue
            if landings is None:
                on = self._places(landing, tuned.SWING.coarse, highest, held=True)
                landings = [self._pressed(place) for place in on]
            if not landings:
                return []
            places = self._places(starts[-1], tuned.SWING.spacing, highest, held=False)
            for place, pressed in product(places, landings):
                way = Way(leads, place, pressed, length)
                nudged = [way._replace(nudge=n) for n in tuned.SWING.nudges]
                found += [w for w in (nudged if self._uneven else [way]) if w.largest <= highest]
        return found

    def _pressed(self, held: Knot) -> Knot:
        """A wire that the wall holds in more field than it takes."""
        pressed = tuned.SWING.press * held.flux
        if self._uneven:  # at rest in it, as the plan goes on from there
            self.model.return_to(held.snapshot)
            fields = np.linspace(held.flux, pressed, 1 + tuned.SWING.presses)[1:]
            if all(self.model.settle(flux) for flux in fields):
                return replace(held, snapshot=self.model.remember(), view=self.model.look())
        return replace(held, snapshot=held.snapshot.with_inputs(pressed))

    @property
    def _uneven(self) -> bool:
        """Whether coils may be off, each by itself."""
        return self.programme.demands.gain_tolerance > 0.0

    def is_held(self, view: View | None) -> bool:
        """Whether more than the field holds the wire: the wall, or the guide."""
        return (
            view is None
            or view.eigenvalue > tuned.SWING.support * self.programme.demands.stability_margin
        )

    def _holds(self, way: Way) -> bool:
        """Whether the wire goes along a course, and ends held, in all fields that may come."""
        weak = self.programme.demands.weakening
        plan = Schedule.along([(knot.feed, knot.flux / weak) for knot in way.course])
        if self._uneven:
            trials = [plan.turned(gain) for gain in self.programme.gains(way.landing.flux)]
            bound = tuned.SWING.uneven_bound
            return all(self._follows(way.leads[-1], trial, bound) for trial in (*trials, plan))
        end = way.course[-1].feed
        few = np.arange(0.0, (1.0 + tuned.SWING.sparse) * end, tuned.SWING.sparse * self._length)
        off = tuned.SWING.off * (1.0 - weak)
        trials = [
            plan.scaled(1.0 - off),
            Schedule(few, plan.at(few)),
            plan,
            plan.scaled(1.0 + off),
        ]
        return self._follows(way.start, trials[0], tuned.SWING.bound) and all(
            self._follows(way.leads[-1], trial, tuned.SWING.bound) for trial in trials
        )

    def _follows(self, start: Knot, plan: Schedule, bound: float) -> bool:
        """Whether the tip stays within bounds along a schedule, and the wire ends held."""
        model = self.model
        model.return_to(start.snapshot)
        if not model.settle(plan.at(start.feed)[0]):
            return False
        if any(part > bound for part in model.play(plan, self.speed, tuned.SWING.step)):
            return False
        view = model.look() if model.settle(plan.flux_density[-1]) else None
        return view is not None and self.is_held(view)

    def _places(self, knot: Knot, spacing: float, highest: float, *, held: bool) -> list[Knot]:
        """Equilibria with the tip all over its room, in the least stable fields, held or free.

        They are reached one from the other, beginning at a knot, in steps across the lumen.
        """
        view = knot.view
        if view is None:
            return []
        size, axes = view.radius, view.axes
        room = tuned.SWING.marginal * self.programme.room(view)
        first = np.round(view.offset / (spacing * size)).astype(int)
        seen, found = {tuple(first), *neighbours(tuple(first))}, []
        waiting = deque((cell, knot) for cell in sorted(seen))
        while waiting:
            cell, origin = waiting.popleft()
            place = self._send(origin, spacing * size * np.array(cell) @ axes, highest)
            if place is None or self.is_held(place.view) != held:
                continue
            found.append(place)
            for near in neighbours(cell):
                if near not in seen and spacing * size * norm(np.array(near)) <= room:
                    seen.add(near)
                    waiting.append((near, place))
        return found

    def _send(self, knot: Knot, target: Array, highest: float) -> Knot | None:
        """The equilibrium with the tip at an offset in space, shape (3,) [m], from a knot."""
        model, programme = self.model, self.programme
        margin, off = programme.demands.stability_margin, 0.0
        bounds = tuned.SWING.trust * programme.unit * np.array([[-1.0] * 3, [1.0] * 3])
        model.return_to(knot.snapshot)
        view = knot.view
        assert view is not None
        for _ in range(tuned.SWING.programmes):
            change = programme.aim(view, view.axes @ target, margin, bounds)
            if change is None:
                return None
            there = self._go(view, change)
            if there is None or norm(model.flux) > tuned.SWING.detour * highest:
                return None
            settled = norm(there.flux - view.flux) < tuned.SWING.settled * programme.unit
            view = there
            off = (
                programme.uneven(view) / (tuned.SWING.uneven * view.radius) if self._uneven else 0.0
            )
            if off > 1.0:  # the stiffer the wire, the less it minds which coil is off
                margin = max(margin, min(off, tuned.SWING.stiffer) * view.eigenvalue)
            elif settled:
                break
        missed = float(np.linalg.norm(view.axes @ target - view.offset))
        fits = missed <= tuned.SWING.close * view.radius and view.eigenvalue >= 0.9 * margin
        if not fits or off > 1.0:
            return None
        return Knot(knot.feed, model.remember(), view)

    def _go(self, view: View, change: Array) -> View | None:
        """Change the field, or as much of it as keeps the wire stable."""
        model = self.model
        start = model.remember()
        least = min(0.4 * self.programme.demands.stability_margin, 0.9 * view.eigenvalue)
        for _ in range(tuned.SWING.halvings):
            if model.settle(start.inputs + change):
                there = model.look()
                if there is not None and there.eigenvalue > least:
                    return there
                model.return_to(start)
            change = 0.5 * change
        return None


def neighbours(cell: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The four cells around a cell of a grid."""
    i, j = cell
    yield from ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1))
