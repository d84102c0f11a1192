"""The quadratic programme for the change of the field at one feed (P-22).

It is posed at the equilibrium in the *weakest* field that there may be: a field that is too weak
is what loses the wire, and where the wall holds the wire this happens all at once, so that nothing
in the equilibrium of the planned field tells of it. The planned field and the strongest one are
seen from there to first order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import daqp
import numpy as np
from numpy.typing import NDArray

from magwire.kernels.conditions import fill_conditions
from magwire.navigate import tuned
from magwire.navigate.demands import Demands
from magwire.navigate.model import View

Array = NDArray[np.float64]

SIDES = 16  # of the polygon around the circle in which the tip may be
ANGLES = 2.0 * np.pi * np.arange(SIDES) / SIDES
NORMALS: Array = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
FREE = 1e30  # no bound
AXES: Array = np.eye(3)[:, :, None] * np.eye(3)[:, None, :]  # shares of coils along the axes


class Constraints(NamedTuple):
    """Linearised constraints, rows . (change, misses) <= upper.

    rows [m, 6], for the change of the field and for how far offset, eigenvalue and field miss what
    is asked for; upper [m]; missed: the sum of these misses at no change.
    """

    rows: Array
    upper: Array
    missed: float


@dataclass(frozen=True, eq=False)
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
    activation_gap
        Within it the wall presses on the tip [m].
    shares
        Each coil's part in a flux density: a matrix for each, shape (m, 3, 3), with the sum one.
    tolerance
        Miss of a constraint that counts as none, in the lumen's radius or the eigenvalue.
    """

    demands: Demands
    unit: float
    keep_off: float
    activation_gap: float
    shares: Array = field(default_factory=lambda: AXES)
    tolerance: float = 0.0

    def room(self, view: View) -> float:
        """How far from the centreline the tip may be [m]."""
        return (view.radius - self.keep_off) * (1.0 - self.demands.tip_clearance)

    def wider_room(self, view: View) -> float:
        """How far from the centreline the tip may be in a field that is off [m]."""
        most = min(tuned.PROGRAMME.most_room * (view.radius - self.keep_off), self.touches(view))
        return max(self.room(view), min(tuned.PROGRAMME.off_room * self.room(view), most))

    def touches(self, view: View) -> float:
        """How far from the centreline the tip is when the wall begins to press on it [m]."""
        return view.radius - self.keep_off - self.activation_gap

    @property
    def cases(self) -> int:
        """How many fields the conditions are about."""
        return 3 if self.demands.gain_tolerance == 0.0 else 4

    @property
    def starts(self) -> tuple[int, int, int]:
        """First rows about the offset, the eigenvalue, and the field itself."""
        return 0, self.cases * SIDES, self.cases * (SIDES + 1)

    def uneven(self, view: View) -> float:
        """How far from the centreline the tip may be where coils are off, each by itself [m]."""
        sides, _ = self.off(NORMALS @ view.offset_by_flux, view.flux)
        planned = view.offset + (1.0 / self.demands.weakening - 1.0) * (
            view.offset_by_flux @ view.flux
        )
        return float((NORMALS @ planned + sides).max())

    def gains(self, flux: Array) -> Iterator[Array]:
        """What flux densities are multiplied by where each coil is off, in all signs, (3, 3).

        Of more than three coils, those signs that take this flux density farthest to the corners
        of a cube.
        """
        for corner in product((-1.0, 1.0), repeat=min(3, len(self.shares))):
            signs = np.array(corner)
            if len(self.shares) > len(corner):
                signs = np.where(self.shares @ flux @ signs < 0.0, -1.0, 1.0)
            yield np.eye(3) + self.demands.gain_tolerance * np.einsum(
                "k,kij->ij", signs, self.shares
            )

    def off(self, rows: Array, flux: Array) -> tuple[Array, Array]:
        """The most that rows . flux density gain by errors of the coils, and its derivative.

        For each row the signs of the errors are the worst ones. Shapes (n,) and (n, 3).
        """
        part = self.demands.gain_tolerance / self.demands.weakening
        by_coil = np.einsum("ni,kij->nkj", part * rows, self.shares)
        worst = np.where(by_coil @ flux < 0.0, -1.0, 1.0)
        by_field: Array = np.einsum("nk,nkj->nj", worst, by_coil)
        return by_field @ flux, by_field

    def merit(self, view: View, before: Array, stiffness: float, margin: float) -> float:
        """What the programme minimises, at the field as it is."""
        missed = constraints(self, view, margin).missed
        b, change = view.flux / self.unit, (view.flux - before) / self.unit
        price = 0.5 * float(b @ b + stiffness * change @ change)
        return price + tuned.PROGRAMME.penalty * missed

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
        rows, upper, _ = constraints(self, view, margin)
        b, was = view.flux / self.unit, before / self.unit
        return solve(
            np.diag([1.0 + stiffness] * 3 + [1.0] * 3),
            np.concatenate([b + stiffness * (b - was), [tuned.PROGRAMME.penalty] * 3]),
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


@lru_cache(maxsize=4)
def constraints(programme: Programme, view: View, margin: float) -> Constraints:
    """The linearised constraints."""
    unit, size, weak = programme.unit, view.radius, programme.demands.weakening
    by_field = view.offset_by_flux * (unit / size)
    weight = max(view.eigenvalue, margin)
    by_eigen = view.eigenvalue_by_flux * (unit / weight)
    room, wider = programme.room(view) / size, programme.wider_room(view) / size
    fields = np.array([1.0, 1.0 / weak, (2.0 - weak) / weak])  # over the weakest
    rooms = np.array([wider, room, wider])
    uneven = programme.cases > len(fields)
    if uneven:  # the planned field once more
        fields, rooms = np.append(fields, fields[1]), np.append(rooms, wider)
    _, eigen, itself = programme.starts
    rows, upper = blank(programme.starts).copy(), np.empty(itself + 1)
    seen = view.flux / unit, view.offset / size, by_field, by_eigen
    largest = min(programme.demands.largest_weakest / unit, FREE)
    limits = view.eigenvalue / weight, margin / weight, largest
    missed = fill_conditions(NORMALS, fields, rooms, seen, limits, rows, upper)
    if uneven:
        for last, own in ((eigen, NORMALS @ by_field), (itself, -by_eigen[None])):
            most, by_change = programme.off(own, seen[0])
            rows[last - len(own) : last, :3] += by_change
            upper[last - len(own) : last] -= most
        missed = tuple(np.minimum.reduceat(upper, programme.starts).tolist())
    counted = sum(max(0.0, -value - programme.tolerance) for value in missed)
    return Constraints(rows, upper, counted)


@lru_cache(maxsize=4)
def blank(starts: tuple[int, int, int]) -> Array:
    """Rows with the columns of what misses, and nothing in those of the field."""
    _, eigen, itself = starts
    misses = -np.repeat(np.eye(3), (eigen, itself - eigen, 1), axis=0)
    return np.hstack([np.zeros((len(misses), 3)), misses])


def solve(
    weight: Array,
    slope: Array,
    rows: Array,
    limits: tuple[Array, Array],
    bounds: Array,
    unit: float,
) -> Array | None:
    """Solve a programme whose first three unknowns are the change of the field, in units.

    The others are slacks, which are not negative. Returns the change [T], or None. The solver
    scales the rows in place: it gets a copy.
    """
    slacks = len(slope) - 3
    low = np.concatenate([bounds[0], np.zeros(slacks), limits[0]])
    high = np.concatenate([bounds[1], np.full(slacks, 1e3), limits[1]])
    kinds = np.zeros(len(low), dtype=np.int32)
    solution, _, flag, _ = daqp.solve(weight, slope, rows.copy(), high, low, kinds)
    return solution[:3] * unit if flag >= 1 else None
