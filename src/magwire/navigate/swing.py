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
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from magwire.navigate import tuned
from magwire.navigate.model import Model, View
from magwire.navigate.pilot import Knot, norm
from magwire.navigate.programme import Programme
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]

ROUND = 1e-9  # round-off of feeds [m]


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

    def find(self, free: Sequence[Knot], held: Sequence[Knot], highest: float) -> list[Knot] | None:
        """The course with the least field that begins with the wire free and ends with it held.

        Parameters
        ----------
        free, held
            Courses of a wire that the wall does not hold, and of one that it does, by rising feed.
        highest
            Flux density [T] that the course must stay below.
        """
        ways = [way for knot in held for way in self._onto(free, knot, highest)]
        courses = sorted(ways, key=lambda way: way[0])
        found = next((course for _, course in courses if self._holds(course)), None)
        return None if found is None else self._refined(found)

    def _refined(self, course: list[Knot]) -> list[Knot]:
        """The course with its start moved to where less field will do."""
        for spacing in (0.5 * tuned.SWING.spacing, 0.25 * tuned.SWING.spacing):
            better: list[Knot] | None = course
            while better is not None:
                course = better
                better = next((c for c in self._near(course, spacing) if self._holds(c)), None)
        return course

    def _near(self, course: list[Knot], spacing: float) -> Iterator[list[Knot]]:
        """Courses that start a little beside, in less field."""
        start = course[-3]
        assert start.view is not None
        size, axes = start.view.radius, start.view.axes
        for angle in np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False):
            aside = spacing * size * np.array([np.cos(angle), np.sin(angle)])
            place = self._send(start, (start.view.offset + aside) @ axes, norm(start.flux))
            if place is not None and norm(place.flux) < (1.0 - tuned.SWING.gain) * norm(start.flux):
                yield [*course[:-3], place, *course[-2:]]

    def _onto(
        self, free: Sequence[Knot], landing: Knot, highest: float
    ) -> list[tuple[float, list[Knot]]]:
        """Largest field, and course, of ways to swing to where a held knot is, or beside it."""
        length = self._length
        starts = [k for k in free if k.feed <= landing.feed - tuned.SWING.length * length + ROUND]
        leads = [k for k in starts if k.feed <= starts[-1].feed - tuned.SWING.lead * length + ROUND]
        if not leads or leads[-1].view is None:
            return []
        places = [
            p
            for p in self._places(starts[-1], tuned.SWING.spacing, highest)
            if not self.is_held(p.view)
        ]
        landings = [
            p for p in self._places(landing, tuned.SWING.coarse, highest) if self.is_held(p.view)
        ]
        found = []
        for place, aim in product(places, landings):
            firm = replace(aim, snapshot=aim.snapshot.with_inputs(tuned.SWING.press * aim.flux))
            rest = replace(firm, feed=firm.feed + tuned.SWING.length * length)
            largest = max(norm(place.flux), norm(firm.flux))
            if largest <= highest:
                found.append((largest, [*leads, place, firm, rest]))
        return found

    def is_held(self, view: View | None) -> bool:
        """Whether more than the field holds the wire: the wall, or the guide."""
        return (
            view is None
            or view.eigenvalue > tuned.SWING.support * self.programme.demands.stability_margin
        )

    def _holds(self, course: Sequence[Knot]) -> bool:
        """Whether the wire goes along a course, and ends held, in all fields that may come."""
        weak = self.programme.demands.weakening
        plan = Schedule.along([(knot.feed, knot.flux / weak) for knot in course])
        few = np.arange(
            0.0, (1.0 + tuned.SWING.sparse) * course[-1].feed, tuned.SWING.sparse * self._length
        )
        sparse = Schedule(few, plan.at(few))
        off = tuned.SWING.off * (1.0 - weak)
        trials = (plan.scaled(1.0 - off), sparse, plan, plan.scaled(1.0 + off))
        return self._follows(course[-3], trials[0]) and all(
            self._follows(course[-4], trial) for trial in trials
        )

    def _follows(self, start: Knot, plan: Schedule) -> bool:
        """Whether the tip stays within bounds along a schedule, and the wire ends held."""
        model = self.model
        model.return_to(start.snapshot)
        if not model.settle(plan.at(start.feed)[0]):
            return False
        if any(part > tuned.SWING.bound for part in model.play(plan, self.speed, tuned.SWING.step)):
            return False
        view = model.look() if model.settle(plan.flux_density[-1]) else None
        return view is not None and self.is_held(view)

    def _places(self, knot: Knot, spacing: float, highest: float) -> list[Knot]:
        """Equilibria with the tip all over its room, in the least stable fields.

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
            if place is None:
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
        margin = programme.demands.stability_margin
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
            settled = norm(there.flux - view.flux) < 2e-3 * programme.unit
            view = there
            if settled:
                break
        missed = float(np.linalg.norm(view.axes @ target - view.offset))
        fits = missed <= tuned.SWING.close * view.radius and view.eigenvalue >= 0.9 * margin
        if not fits:
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
