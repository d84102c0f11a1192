"""What field the hardware can make at a point, under its limits (P-27, P-28)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate.actuator import Actuator
from magwire.actuate.curve import Curve, curves_of
from magwire.actuate.inputs import Input
from magwire.errors import InputError, array

Array = NDArray[np.float64]
DIRECTIONS = 200
CUTS = 60
ENOUGH = 1e-3
"""The power may be over its limit by this share: the field is then over by half of it at most."""
GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
UNBOUNDED = 3
"""What scipy's linprog says where nothing limits the field."""


@dataclass(frozen=True)
class Extremes:
    """The largest flux density along directions, with no component across them.

    Parameters
    ----------
    directions
        Unit vectors, shape (n, 3).
    flux_density
        The largest in each, shape (n,) [T]; infinite where nothing limits it, 0 where a held
        background leaves none.
    inputs
        What makes it, shape (n, K); NaN where there is none.
    """

    directions: Array
    flux_density: Array
    inputs: Array

    @property
    def worst(self) -> float:
        """In the direction in which the hardware does least [T]."""
        return float(self.flux_density.min())

    @property
    def median(self) -> float:
        """Over all directions [T]."""
        return float(np.median(self.flux_density))

    @property
    def best(self) -> float:
        """In the direction in which the hardware does most [T]."""
        return float(self.flux_density.max())


def extremes(actuator: Actuator, point: ArrayLike, directions: ArrayLike | None = None) -> Extremes:
    """The largest flux density that an actuator can make at a point.

    Parameters
    ----------
    actuator
        Coils; magnets that move have no such set.
    point
        Shape (3,) [m].
    directions
        Shape (n, 3), of any length but zero; spread evenly over the sphere if left out.

    Raises
    ------
    InputError
        If an input is the pose of a magnet, or the point is outside of a map.

    Notes
    -----
    The field is linear in the strengths s_k(u_k), which are the unknowns; each curve rises, so that
    limits of u are limits of s. Power is convex in s: cuts by its tangents bound it.
    """
    where = array("extremes", "point", point, (3,), "m")
    aims = spread(DIRECTIONS) if directions is None else _units(directions)
    if any(i.unit in ("m", "") for i in actuator.inputs):
        raise InputError("The set of fields is that of coils; received a magnet that moves.")
    programme = _Programme.of(actuator, where)
    best = [programme.most(aim) for aim in aims]
    flux = np.array([value for value, _ in best]) + 0.0  # no minus zero
    return Extremes(aims, flux, np.array([u for _, u in best]))


def spread(count: int) -> Array:
    """Unit vectors spread evenly over the sphere by the golden angle, shape (count, 3)."""
    i = np.arange(count)
    z = 1.0 - (2.0 * i + 1.0) / count
    r = np.sqrt(1.0 - z * z)
    return np.stack([r * np.cos(GOLDEN * i), r * np.sin(GOLDEN * i), z], axis=1)


def _units(directions: ArrayLike) -> Array:
    aims = array("extremes", "directions", directions, (None, 3))
    size = np.linalg.norm(aims, axis=1, keepdims=True)
    if not np.all(size > 0.0):
        raise InputError("Input directions of extremes must have a length; received [0, 0, 0].")
    units: Array = aims / size
    return units


class _Programme(NamedTuple):
    """The linear programme of one point: field = constant + columns s."""

    limits: tuple[tuple[float, float], ...]
    curves: tuple[Curve, ...]
    resistance: Array
    max_power: float
    constant: Array
    columns: Array

    @classmethod
    def of(cls, actuator: Actuator, point: Array) -> _Programme:
        curves = curves_of(actuator)
        still = np.zeros(len(curves))
        constant, _ = actuator.at(point[None], still)
        if np.any(np.isnan(constant)):
            raise InputError(f"Point {point.tolist()} m is outside of the actuator's map.")
        response, _ = actuator.response(point[None], still)
        slopes = np.array([curve.slope(0.0) for curve in curves])
        return cls(
            tuple(_range(i, actuator.max_power) for i in actuator.inputs),
            curves,
            np.array([i.resistance for i in actuator.inputs]),
            actuator.max_power,
            constant[0],
            response[0].T / slopes,
        )

    def most(self, aim: Array) -> tuple[float, Array]:
        """The largest flux density along ``aim`` and the inputs that make it."""
        from scipy.optimize import linprog  # slow to import, and steering does without

        count = len(self.curves)
        cost = np.append(np.zeros(count), -1.0)
        ends = zip(self.curves, self.limits, strict=True)
        bounds = [(c.strength(low), c.strength(high)) for c, (low, high) in ends]
        cuts, levels = np.zeros((0, count + 1)), np.zeros(0)
        for _ in range(CUTS):
            found = linprog(
                cost,
                A_ub=cuts,
                b_ub=levels,
                A_eq=np.hstack([self.columns, -aim[:, None]]),
                b_eq=-self.constant,
                bounds=[*bounds, (None, None)],
            )
            if found.status == UNBOUNDED:
                return math.inf, np.full(count, math.nan)
            if found.status != 0:
                return 0.0, np.full(count, math.nan)
            s = found.x[:count]
            u = self._inputs(s)
            if self._power(s) <= self.max_power * (1.0 + ENOUGH):
                break
            tangent, level = self._cut(s)
            cuts = np.vstack([cuts, np.append(tangent, 0.0)])
            levels = np.append(levels, level)
        return float(found.x[-1]), u

    def _cut(self, s: Array) -> tuple[Array, float]:
        """The tangent of the allowed power on the way from zero to ``s``: tangent s <= level."""
        from scipy.optimize import brentq

        share = float(brentq(lambda a: self._power(a * s) - self.max_power, 0.0, 1.0, xtol=1e-9))
        edge = share * s
        u = self._inputs(edge)
        slopes = np.array([c.slope(v) for c, v in zip(self.curves, u, strict=True)])
        tangent = 2.0 * self.resistance * u / slopes
        return tangent, float(tangent @ edge)

    def _inputs(self, s: Array) -> Array:
        return np.array([c.input(v) for c, v in zip(self.curves, s, strict=True)])

    def _power(self, s: Array) -> float:
        u = self._inputs(s)
        return float(self.resistance @ (u * u))


def _range(i: Input, max_power: float) -> tuple[float, float]:
    """What an input can be held at, and what the power leaves to it alone."""
    alone = math.sqrt(max_power / i.resistance) if i.resistance > 0.0 else math.inf
    low, high = i.held
    return max(low, -alone), min(high, alone)
