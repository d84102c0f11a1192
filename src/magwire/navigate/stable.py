"""Steering with the least field that keeps the tip off the wall, stably (P-22, P-23).

At every planned feed the field b solves

    min |b|^2 / 2   subject to   |offset(b)| <= room   and   eigenvalue(b) >= margin

by sequential quadratic programming: both constraints are linearised with the sensitivities of the
equilibrium, the circle of the offset being a polygon, and the next programme starts from the
equilibrium in the new field. So that the schedule holds without help, the constraints are asked
for again in fields that are too weak and too strong by a tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

import daqp
import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.errors import InputError, positive, within
from magwire.lumen import Lumen
from magwire.navigate.model import Model, View
from magwire.navigate.navigator import NavigationError, Observation
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]

SIDES = 16  # of the polygon around the circle in which the tip may be
PROGRAMMES = 8  # per planned feed, at most
SETTLED = 5e-4  # they end when the field changes by less than this, in REFERENCE
TRUST = 0.3  # largest change of a component of the field in one programme, in REFERENCE
HALVINGS = 6
ROUND_OFF = 1e-4  # a rise of the merit by less does not matter
PENALTY = 300.0  # price of missing a constraint: it is paid only where there is no other way
MISSED = 0.1  # part of the lumen's radius, or of the margin, by which a constraint may be missed
REFERENCE = 100.0  # field of order one inside, in EI/(M L^2)
OFF_ROOM = 1.4  # room for the tip in a field that is off, over the room in the field itself


@dataclass(frozen=True)
class Demands:
    """What a field schedule must keep to.

    Parameters
    ----------
    tip_clearance
        Of the tip to the wall, as part of the clearance on the centreline, between 0 and 1.
    stability_margin
        Smallest eigenvalue of the tangent stiffness against the lumped mass [rad^2/s^2].
    field_tolerance
        Part by which the field may be off without harm.
    max_field
        Largest flux density [T].
    max_field_rate
        Largest change of the flux density per length fed [T/m].
    """

    tip_clearance: float = 0.5
    stability_margin: float = 1.0
    field_tolerance: float = 0.05
    max_field: float = float("inf")
    max_field_rate: float = float("inf")

    def __post_init__(self) -> None:
        within("Demands", "tip_clearance", self.tip_clearance, low=0.0, high=1.0)
        positive("Demands", "stability_margin", self.stability_margin, "rad^2/s^2")
        within("Demands", "field_tolerance", self.field_tolerance, low=0.0, high=0.5)
        for name, unit in (("max_field", "T"), ("max_field_rate", "T/m")):
            value = getattr(self, name)
            if not value > 0.0:
                raise InputError(
                    f"Input {name} of Demands must be positive; received {value} {unit}."
                )


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
    ) -> None:
        self.demands = Demands() if demands is None else demands
        path = system.path if path is None else path
        if len(path.branches) != 1:
            raise InputError(
                "Input path of StableNavigator must have one branch; "
                f"received {len(path.branches)}."
            )
        length = 5e-3 * system.wire.length if plan_every is None else plan_every
        self.plan_every = positive("StableNavigator", "plan_every", length, "m")
        self.model = Model(system, path)
        self._unit = REFERENCE * system.scales.flux_density
        self._keep_off = system.wire.radius if system.contact.wall == "surface" else 0.0
        angles = 2.0 * np.pi * np.arange(SIDES) / SIDES
        self._sides: Array = np.stack([np.cos(angles), np.sin(angles)], axis=1)

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        model = self.model
        if abs(model.feed - observation.feed) > 1e-9:
            self._go_to(observation.feed)
        return model.plan(until, self.plan_every, self._go_to)

    def _go_to(self, feed: float) -> None:
        """Feed the model on and find the field there."""
        model = self.model
        before, moved = model.flux, abs(feed - model.feed)
        if not model.feed_to(feed):
            raise NavigationError(
                f"At {feed * 1e3:.4g} mm of feed the navigator's model of the wire found no "
                "equilibrium; try a smaller plan_every."
            )
        if not model.released:
            return
        largest = self.demands.max_field_rate * moved
        view = self._view(feed)
        for _ in range(PROGRAMMES):
            change = self._programme(view, before, largest) * self._unit
            view, taken = self._try(change, view)
            if float(np.linalg.norm(taken)) < SETTLED * self._unit:
                break
        self._judge(view, feed)

    def _view(self, feed: float) -> View:
        view = self.model.look()
        if view is None:
            raise NavigationError(
                f"At {feed * 1e3:.4g} mm of feed the wire becomes unstable before the field can "
                "follow; try a smaller plan_every or a larger stability_margin."
            )
        return view

    def _room(self, view: View) -> float:
        """How far from the centreline the tip may be [m]."""
        clearance = view.radius - self._keep_off
        return clearance * (1.0 - self.demands.tip_clearance)

    def _constraints(self, view: View) -> tuple[Array, Array, Array]:
        """The linearised constraints, rows . change - missed <= upper.

        Returns
        -------
        tuple
            Rows, shape (m, 5), for the change of the field in units of its own and for how far
            offset and eigenvalue miss what is asked for; upper bounds, shape (m,); and which
            of the two misses a row belongs to, shape (m,).
        """
        unit, size, margin = self._unit, view.radius, self.demands.stability_margin
        b = self.model.flux / unit
        offset, by_field = view.offset / size, view.offset_by_flux * (unit / size)
        weight = max(view.eigenvalue, margin)
        value, by_eigen = view.eigenvalue / weight, view.eigenvalue_by_flux * (unit / weight)
        rows, upper = [], []
        tolerance = self.demands.field_tolerance
        offs = (0.0, -tolerance, tolerance) if tolerance > 0.0 else (0.0,)
        for off in offs:
            room = self._room(view) / size * (1.0 if off == 0.0 else OFF_ROOM)
            rows.append(self._sides @ by_field * (1.0 + off))
            upper.append(room - self._sides @ (offset + off * (by_field @ b)))
            rows.append(-by_eigen[None] * (1.0 + off))
            upper.append(np.array([value + off * (by_eigen @ b) - margin / weight]))
        kind = np.tile(np.array([0] * SIDES + [1]), len(offs))
        misses = -np.eye(2)[kind]
        return np.hstack([np.concatenate(rows), misses]), np.concatenate(upper), kind

    def _merit(self, view: View) -> float:
        """What a programme minimises, at the field as it is."""
        _, upper, kind = self._constraints(view)
        missed = sum(max(0.0, float(-upper[kind == k].min())) for k in (0, 1))
        b = self.model.flux / self._unit
        return 0.5 * float(b @ b) + PENALTY * missed

    def _programme(self, view: View, before: Array, largest: float) -> Array:
        """Change of the field by one quadratic programme, shape (3,), in units of its own."""
        b = self.model.flux / self._unit
        rows, upper, _ = self._constraints(view)
        low, high = np.full(3, -TRUST), np.full(3, TRUST)
        if np.isfinite(largest):
            low = np.maximum(low, (before - largest) / self._unit - b)
            high = np.maximum(low, np.minimum(high, (before + largest) / self._unit - b))
        solution, _, flag, _ = daqp.solve(
            np.eye(5),
            np.concatenate([b, [PENALTY, PENALTY]]),
            np.ascontiguousarray(rows),
            np.concatenate([high, [1e3, 1e3], upper]),
            np.concatenate([low, [0.0, 0.0], np.full(len(upper), -1e30)]),
            np.zeros(5 + len(upper), dtype=np.int32),
        )
        if flag < 1:
            raise NavigationError(
                f"At {self.model.feed * 1e3:.4g} mm of feed the quadratic programme for the field "
                f"has no solution (exit flag {flag})."
            )
        result: Array = solution[:3]
        return result

    def _try(self, change: Array, view: View) -> tuple[View, Array]:
        """Go to the changed field, or as much of the way as makes things better."""
        model = self.model
        start, merit = model.remember(), self._merit(view)
        for _ in range(HALVINGS):
            if model.settle(start.flux + change):
                there = model.look()
                if there is not None and self._merit(there) <= merit + ROUND_OFF:
                    return there, change
                model.return_to(start)
            change = 0.5 * change
        return view, np.zeros(3)

    def _judge(self, view: View, feed: float) -> None:
        """Raise if the field found does not do what is asked for."""
        demands, flux = self.demands, float(np.linalg.norm(self.model.flux))
        where = f"At {feed * 1e3:.4g} mm of feed"
        offset, room = float(np.linalg.norm(view.offset)), self._room(view)
        if offset > room + MISSED * view.radius:
            raise NavigationError(
                f"{where} no stable field was found that keeps the tip within {room * 1e3:.3g} mm "
                f"of the centreline; with {flux * 1e3:.3g} mT it is {offset * 1e3:.3g} mm away."
            )
        if view.eigenvalue < (1.0 - MISSED) * demands.stability_margin:
            raise NavigationError(
                f"{where} the equilibrium's stability is {view.eigenvalue:.3g} rad^2/s^2 at best; "
                f"the margin asked for is {demands.stability_margin:.3g} rad^2/s^2."
            )
        if flux > demands.max_field:
            raise NavigationError(
                f"{where} the tip needs {flux * 1e3:.3g} mT; the limit is "
                f"{demands.max_field * 1e3:.3g} mT."
            )
