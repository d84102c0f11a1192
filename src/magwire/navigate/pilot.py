"""Going from one planned field to the next (P-22).

At every planned feed the field b solves

    min |b|^2 / 2   subject to   |offset(b)| <= room   and   eigenvalue(b) >= margin

by sequential quadratic programming: both constraints are linearised with the sensitivities of the
equilibrium, and the next programme starts from the equilibrium in the new field.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.plant import Snapshot
from magwire.navigate import tuned
from magwire.navigate.model import Model, View
from magwire.navigate.navigator import NavigationError
from magwire.navigate.programme import Programme

Array = NDArray[np.float64]

BOUND = 2  # tries of a feed before which the field is at its limit: stiffness takes more of it
AT_LIMIT = 0.98  # of the largest field, from which on it is there
ROUND_OFF = 1e-4  # a rise of the merit by less does not matter


@dataclass(frozen=True)
class Knot:
    """A planned field: the weakest that it may come out as, and what the wire does in that.

    Attributes
    ----------
    feed
        Length of wire inside the lumen [m].
    snapshot
        Takes the model there.
    view
        The equilibrium; None before the wire is released.
    """

    feed: float
    snapshot: Snapshot
    view: View | None

    @property
    def flux(self) -> Array:
        """Weakest flux density, shape (3,) [T]."""
        return self.snapshot.inputs


class Pilot:
    """Plans field after field.

    Parameters
    ----------
    model
        The wire; it is moved about.
    programme
        What the fields must keep to.
    firm
        Eigenvalue, in stability margins, from which on a wire that was lost is made only a little
        stiffer; that of ``tuned.PILOT`` if left out.
    brisk
        Whether it does not search on where that led nowhere in tight vessels; see
        ``StableNavigator``.
    """

    def __init__(
        self, model: Model, programme: Programme, firm: float | None = None, *, brisk: bool = False
    ) -> None:
        self.brisk = brisk
        self.firm = tuned.PILOT.firm if firm is None else firm
        self.model = model
        self.programme = programme
        self._length = model.reach
        self.forget()

    def forget(self) -> None:
        """Start afresh: what was learned of the wire before is of no use elsewhere."""
        self._margin, self._trust = self.programme.demands.stability_margin, tuned.PILOT.trust

    def advance(self, last: Knot, feed: float, halves: int | None = None) -> list[Knot]:
        """Feed the model on from a knot, and find the field there.

        A wire that is lost on the way is made stiffer before. Where the wall already makes it stiff
        and that does not help, the field is too slow, and the way is halved.

        Returns
        -------
        list
            The last knot, with the field that it takes to get on from there; knots on a way that
            was halved; and the one at the feed.

        Raises
        ------
        NavigationError
            If no field does what is asked for.
        """
        halves = tuned.PILOT.halves if halves is None else halves
        try:
            return self._step(last, feed)
        except NavigationError:
            if halves == 0 or last.view is None or not self._is_firm(last.view.eigenvalue):
                raise
        first = self.advance(last, 0.5 * (last.feed + feed), halves - 1)
        return [*first[:-1], *self.advance(first[-1], feed, halves - 1)]

    def _step(self, last: Knot, feed: float) -> list[Knot]:
        """Feed the model on at once, after making it as stiff as it takes."""
        model, moved = self.model, abs(feed - last.feed)
        model.return_to(last.snapshot)
        for tried in range(1, tuned.PILOT.tries + 1):
            try:
                view = self._reach(feed, last, moved)
            except NavigationError as failure:
                lost = failure
            else:
                demanded = self.programme.demands.stability_margin
                self._margin = max(demanded, tuned.PILOT.relaxing * self._margin)
                return [last, Knot(feed, model.remember(), view)]
            if last.view is None or (tried >= BOUND and self._at_limit(last)):
                break
            self._margin = self._stiffer(last.view.eigenvalue)
            model.return_to(last.snapshot)
            view = self._improve(last.view, last.flux, moved)
            if self.brisk and not np.any(view.flux != last.flux):  # nor will a larger margin
                break
            last = Knot(last.feed, model.remember(), view)
        self.forget()
        raise lost

    def _stiffer(self, eigenvalue: float) -> float:
        """The margin with which to try again after the wire was lost with this eigenvalue."""
        faster = tuned.PILOT.stiffer if self._is_firm(eigenvalue) else 2.0
        return max(faster * self._margin, tuned.PILOT.stiffer * eigenvalue)

    def _at_limit(self, knot: Knot) -> bool:
        """Whether a planned field is as large as it may be."""
        return norm(knot.flux) >= AT_LIMIT * self.programme.demands.largest_weakest

    def _is_firm(self, eigenvalue: float) -> bool:
        """Whether the wall makes the wire stiff."""
        return eigenvalue > self.firm * self.programme.demands.stability_margin

    def _reach(self, feed: float, last: Knot, moved: float) -> View | None:
        """Feed the model on and find the field there; the view there, if there is anything."""
        model, seen = self.model, last.view
        where = f"At {feed * 1e3:.4g} mm of feed"
        if not model.feed_to(feed):
            raise NavigationError(
                f"{where} the navigator's model of the wire found no equilibrium; try a smaller "
                "plan_every."
            )
        if not model.released:
            return None
        view = model.look()
        if view is None:
            raise NavigationError(
                f"{where} the wire becomes unstable before the field can follow; try a smaller "
                "plan_every or a larger stability_margin."
            )
        slip = tuned.PILOT.slip * view.radius
        if seen is None or view.distance <= max(
            self.programme.wider_room(view) + slip, seen.distance + slip
        ):
            view = self._improve(view, last.flux, moved)
        self._judge(view, where)
        if self.programme.demands.gain_tolerance > 0.0:
            self._withstand(where)
        return view

    def _withstand(self, where: str) -> None:
        """Raise if the wire slips, or its tip comes to the wall, where coils are off.

        Where the wall holds the wire nothing in the equilibrium of the planned field tells of it.
        """
        model, programme = self.model, self.programme
        before, part = model.remember(), programme.demands.gain_tolerance
        flux = before.inputs / programme.demands.weakening
        for gain in programme.gains(flux):
            view = model.look() if model.settle(gain @ flux) else None
            model.return_to(before)
            if view is None or view.distance > programme.touches(view):
                raise NavigationError(
                    f"{where} no field was found in which the tip stays off the wall with each "
                    f"coil off by {100.0 * part:.3g} percent; try a smaller gain_tolerance."
                )

    def _improve(self, view: View, before: Array, moved: float) -> View:
        """Change the field until no programme makes it better, within its limit."""
        return self._limited(self._settled(view, before, moved))

    def _limited(self, view: View) -> View:
        """The equilibrium in the field, or in as much of it as its limit allows.

        Programmes keep to the limit to first order only, and may miss it where there is no other
        way; what is planned never does.
        """
        demands = self.programme.demands
        flux, largest = norm(view.flux), demands.largest_weakest
        if flux <= largest:
            return view
        where = f"At {self.model.feed * 1e3:.4g} mm of feed"
        there = self.model.look() if self.model.settle(view.flux * (largest / flux)) else None
        if there is None:
            raise demands.exceeded(where, flux / demands.weakening)
        return there

    def _settled(self, view: View, before: Array, moved: float) -> View:
        """Change the field until no programme makes it better."""
        stiffness = tuned.PILOT.inertia * self._length / moved
        wedged = view.eigenvalue > tuned.PILOT.wedged * self.programme.demands.stability_margin
        touchy = not wedged and self.model.near_wall
        if touchy or self.brisk:
            self._trust = max(self._trust, tuned.PILOT.fresh)
        for _ in range(tuned.PILOT.programmes):
            change = self._change(view, before, stiffness, moved)
            view, part = self._try(change, view, before, stiffness)
            if part == 0.0 and touchy:
                past = self._past(change, view, before, moved)
                if past is not None:
                    view = past
                    continue
            wider, used = 2.0 if part == 1.0 else 1.5 * part, self._trust
            self._trust = min(tuned.PILOT.trust, max(tuned.PILOT.least_trust, wider * used))
            if part == 0.0 and self._trust == used:  # the next programme would be this one again
                break
            enough = 1.0 if touchy else 0.5**tuned.PILOT.halvings
            size, unit = norm(change), self.programme.unit
            cut = self.brisk and np.abs(change).max() >= (1.0 - ROUND_OFF) * used * unit
            if part >= enough and not cut and size < tuned.PILOT.settled * unit:
                break
        return view

    def _past(self, change: Array, view: View, before: Array, moved: float) -> View | None:
        """Go to the changed field though it is worse, and on from there; None if all is worse.

        Where the wire comes to the wall, what the programmes see of stronger fields has a jump, and
        nothing on the way may be better though what is beyond is.
        """
        model, programme = self.model, self.programme
        stiffness, start = tuned.PILOT.inertia * self._length / moved, self.model.remember()
        least = programme.merit(view, before, stiffness, self._margin)
        there = model.look() if model.settle(start.inputs + change) else None
        for _ in range(tuned.PILOT.beyond):
            if there is None:
                break
            change = self._change(there, before, stiffness, moved)
            there, part = self._try(change, there, before, stiffness)
            if programme.merit(there, before, stiffness, self._margin) < least - ROUND_OFF:
                return there
            if part == 0.0:
                break
        model.return_to(start)
        return None

    def _change(self, view: View, before: Array, stiffness: float, moved: float) -> Array:
        """The change of the field of the next programme."""
        demands, unit = self.programme.demands, self.programme.unit
        largest = demands.max_field_rate * moved * demands.weakening
        bounds = self._trust * unit * np.array([[-1.0] * 3, [1.0] * 3])
        if np.isfinite(largest):
            bounds[0] = np.maximum(bounds[0], before - largest - view.flux)
            highest = np.minimum(bounds[1], before + largest - view.flux)
            bounds[1] = np.maximum(bounds[0], highest)
        change = self.programme.change(view, before, stiffness, self._margin, bounds)
        if change is None:
            raise NavigationError(
                f"At {self.model.feed * 1e3:.4g} mm of feed the quadratic programme for the "
                "field has no solution."
            )
        return change

    def _try(
        self, change: Array, view: View, before: Array, stiffness: float
    ) -> tuple[View, float]:
        """Go to the changed field, or the part of the way that makes things better."""
        model, programme = self.model, self.programme
        merit = programme.merit(view, before, stiffness, self._margin)
        start, part = model.remember(), 1.0
        for _ in range(tuned.PILOT.halvings):
            if model.settle(start.inputs + part * change):
                there = model.look()
                if there is not None:
                    new = programme.merit(there, before, stiffness, self._margin)
                    if new <= merit + ROUND_OFF:
                        return there, part
                model.return_to(start)
            part *= 0.5
        return view, 0.0

    def _judge(self, view: View, where: str) -> None:
        """Raise if the field found does not do what is asked for."""
        programme = self.programme
        demands = programme.demands
        weak = demands.weakening
        flux, room = norm(view.flux) / weak, programme.room(view)
        planned = norm(view.offset + (1.0 / weak - 1.0) * (view.offset_by_flux @ view.flux))
        missed = tuned.PILOT.missed * view.radius
        touches, wider = programme.touches(view), programme.wider_room(view)
        within = f"{where} no stable field was found that keeps the tip within"
        if planned > min(room + missed, touches):
            raise NavigationError(
                f"{within} {min(room, touches) * 1e3:.3g} mm of the centreline; with "
                f"{flux * 1e3:.3g} mT it is "
                f"{planned * 1e3:.3g} mm away."
            )
        if view.distance > min(wider + missed, touches):
            raise NavigationError(
                f"{within} {wider * 1e3:.3g} mm of the centreline should it be weaker; with "
                f"{norm(view.flux) * 1e3:.3g} mT it is {view.distance * 1e3:.3g} mm away."
            )
        uneven = programme.uneven(view) if demands.gain_tolerance > 0.0 else 0.0
        if uneven > min(wider + missed, touches):
            raise NavigationError(
                f"{within} {wider * 1e3:.3g} mm of the centreline with each coil "
                f"{demands.gain_tolerance:.3g} off; with {flux * 1e3:.3g} mT it is up to "
                f"{uneven * 1e3:.3g} mm away."
            )
        if view.eigenvalue < (1.0 - tuned.PILOT.missed) * demands.stability_margin:
            raise NavigationError(
                f"{where} the equilibrium's stability is {view.eigenvalue:.3g} rad^2/s^2 at best; "
                f"the margin asked for is {demands.stability_margin:.3g} rad^2/s^2."
            )


def norm(vector: Array) -> float:
    """Length of a vector."""
    return math.sqrt(vector @ vector)
