"""The quadratic programme for the change of the field at one feed (P-22).

It is posed at the equilibrium in the *weakest* field that there may be: a field that is too weak
is what loses the wire, and where the wall holds the wire this happens all at once, so that nothing
in the equilibrium of the planned field tells of it. The planned field and the strongest one are
seen from there to first order.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import daqp
import numpy as np
from numpy.typing import NDArray

from magwire.navigate.demands import Demands
from magwire.navigate.model import View

Array = NDArray[np.float64]

SIDES = 16  # of the polygon around the circle in which the tip may be
PENALTY = 300.0  # price of missing a constraint: it is paid only where there is no other way
OFF_ROOM = 1.3  # room for the tip in a field that is off, over the room in the field itself
FREE = 1e30  # no bound


def polygon() -> Array:
    """Unit normals of the polygon's sides, shape (SIDES, 2)."""
    angles = 2.0 * np.pi * np.arange(SIDES) / SIDES
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


@dataclass(frozen=True)
class Programme:
    """Least field, and least change of it, that meets the demands to first order.

    All fields inside are over ``unit``.

    Attributes
    ----------
    demands
        What the field must keep to.
    unit
        Flux density of order one [T].
    keep_off
        What the wall keeps from the wire's axis [m].
    """

    demands: Demands
    unit: float
    keep_off: float
    sides: Array = field(default_factory=polygon)

    def room(self, view: View) -> float:
        """How far from the centreline the tip may be [m]."""
        return (view.radius - self.keep_off) * (1.0 - self.demands.tip_clearance)

    def constraints(self, view: View, margin: float) -> tuple[Array, Array, Array]:
        """The linearised constraints, rows . change - missed <= upper.

        Returns
        -------
        tuple
            Rows, shape (m, 6), for the change of the field and for how far offset, eigenvalue and
            field miss what is asked for; upper bounds, shape (m,); and which of the three misses a
            row belongs to, shape (m,).
        """
        size, weak = view.radius, self.demands.weakening
        b = view.flux / self.unit
        offset, by_field = view.offset / size, view.offset_by_flux * (self.unit / size)
        weight = max(view.eigenvalue, margin)
        value, by_eigen = view.eigenvalue / weight, view.eigenvalue_by_flux * (self.unit / weight)
        rows, upper = [], []
        fields = (weak, 1.0, 2.0 - weak) if weak < 1.0 else (1.0,)
        for part in fields:
            more = part / weak - 1.0
            room = self.room(view) / size * (1.0 if part == 1.0 else OFF_ROOM)
            rows.append(self.sides @ by_field * (1.0 + more))
            upper.append(room - self.sides @ (offset + more * (by_field @ b)))
            rows.append(-by_eigen[None] * (1.0 + more))
            upper.append(np.array([value + more * (by_eigen @ b) - margin / weight]))
        largest, flux = self.demands.max_field * weak / self.unit, float(np.linalg.norm(b))
        rows.append(b[None] / max(flux, 1e-9))
        upper.append(np.array([min(largest, FREE) - flux]))
        kind = np.array(([0] * SIDES + [1]) * len(fields) + [2])
        return np.hstack([np.concatenate(rows), -np.eye(3)[kind]]), np.concatenate(upper), kind

    def merit(self, view: View, before: Array, stiffness: float, margin: float) -> float:
        """What the programme minimises, at the field as it is."""
        _, upper, kind = self.constraints(view, margin)
        missed = sum(max(0.0, -float(upper[kind == k].min())) for k in range(3))
        b, change = view.flux / self.unit, (view.flux - before) / self.unit
        return 0.5 * float(b @ b) + 0.5 * stiffness * float(change @ change) + PENALTY * missed

    def change(
        self, view: View, before: Array, stiffness: float, margin: float, bounds: Array
    ) -> Array | None:
        """The best change of the field [T], shape (3,); None if the solver finds none.

        Parameters
        ----------
        view
            The equilibrium in the weakest field.
        before
            Field at the feed before [T], shape (3,).
        stiffness
            Price of a change from there, over the price of the field itself.
        margin
            Smallest eigenvalue asked for [rad^2/s^2].
        bounds
            Smallest and largest change of each component [T], shape (2, 3).
        """
        rows, upper, _ = self.constraints(view, margin)
        b, was = view.flux / self.unit, before / self.unit
        weight = np.diag([1.0 + stiffness] * 3 + [1.0] * 3)
        return solve(
            weight,
            np.concatenate([b + stiffness * (b - was), [PENALTY] * 3]),
            rows,
            (np.full(len(upper), -FREE), upper),
            bounds / self.unit,
            self.unit,
        )

    def aim(self, view: View, target: Array, margin: float, bounds: Array) -> Array | None:
        """The change of the field [T] that brings the tip to an offset, shape (3,) or None.

        ``target`` is the offset in the view's axes, shape (2,) [m]; of all fields that do so the
        least one with the margin is taken.
        """
        size = view.radius
        by_field = view.offset_by_flux * (self.unit / size)
        weight = max(view.eigenvalue, margin)
        by_eigen = view.eigenvalue_by_flux * (self.unit / weight)
        way = (target - view.offset) / size
        rows = np.zeros((3, 8))
        rows[:2, :3], rows[:2, 3:5], rows[:2, 5:7] = by_field, np.eye(2), -np.eye(2)
        rows[2, :3], rows[2, 7] = -by_eigen, -1.0
        upper = np.append(way, (view.eigenvalue - margin) / weight)
        return solve(
            np.diag([1.0] * 3 + [1e-6] * 5),
            np.concatenate([view.flux / self.unit, [100.0] * 4, [1000.0]]),
            rows,
            (np.append(way, -FREE), upper),
            bounds / self.unit,
            self.unit,
        )


def solve(
    weight: Array,
    slope: Array,
    rows: Array,
    limits: tuple[Array, Array],
    bounds: Array,
    unit: float,
) -> Array | None:
    """Solve a programme whose first three unknowns are the change of the field, in units.

    The others are slacks, which are not negative. Returns the change [T], or None.
    """
    slacks = len(slope) - 3
    low = np.concatenate([bounds[0], np.zeros(slacks), limits[0]])
    high = np.concatenate([bounds[1], np.full(slacks, 1e3), limits[1]])
    kinds = np.zeros(len(low), dtype=np.int32)
    solution, _, flag, _ = daqp.solve(weight, slope, np.ascontiguousarray(rows), high, low, kinds)
    return solution[:3] * unit if flag >= 1 else None
