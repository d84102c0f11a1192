"""Planar elastica as a boundary value problem: any stiffness, rest curvature, weight, tip force.

Lengths are in parts of the wire's, forces in EI/L^2 with the stiffness EI that the caller scales
with.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_bvp

Array = NDArray[np.float64]
Along = Callable[[Array], Array]

TOLERANCE = 1e-9
STEPS = 8


class Shape(NamedTuple):
    """Angle [rad] and place at evenly spaced stations from the clamp to the tip."""

    angle: Array
    x: Array
    y: Array


def constant(value: float) -> Along:
    """A quantity that is the same all along the wire."""
    return lambda s: np.full_like(s, value)


def elastica(
    *,
    stiffness: Along | None = None,
    rest_curvature: float = 0.0,
    force: ArrayLike = (0.0, 0.0),
    weight: ArrayLike = (0.0, 0.0),
    joints: tuple[float, ...] = (),
    points: int = 101,
) -> Shape:
    """Shape of a wire clamped at the origin along x, loads being raised from zero in steps.

    Parameters
    ----------
    stiffness
        EI along the wire, s from 0 to 1; 1 if left out.
    rest_curvature
        Curvature of the unloaded wire.
    force, weight
        Dead force on the tip, and for each unit of length, shape (2,).
    joints
        Where the stiffness jumps.
    points
        How many stations are given back.
    """
    bending = constant(1.0) if stiffness is None else stiffness
    push, pull = np.asarray(force, dtype=np.float64), np.asarray(weight, dtype=np.float64)
    bounds = np.array([0.0, *joints, 1.0])
    count = len(bounds) - 1
    lengths = np.diff(bounds)
    t = np.linspace(0.0, 1.0, 60)
    rows = np.vstack([np.vstack([b + d * t, 0 * t, b + d * t, 0 * t])
                      for b, d in zip(bounds[:-1], lengths, strict=True)])  # fmt: skip
    rows[0::4] *= rest_curvature

    def slope(part: float) -> Callable[[Array, Array], Array]:
        def by_t(t: Array, y: Array) -> Array:
            result = np.empty_like(y)
            for k in range(count):
                inside = bounds[k] + lengths[k] * np.clip(t, 1e-12, 1.0 - 1e-12)
                theta, moment = y[4 * k], y[4 * k + 1]
                nx = part * (push[0] + pull[0] * (1.0 - inside))
                ny = part * (push[1] + pull[1] * (1.0 - inside))
                result[4 * k] = lengths[k] * (rest_curvature + moment / bending(inside))
                result[4 * k + 1] = -lengths[k] * (np.cos(theta) * ny - np.sin(theta) * nx)
                result[4 * k + 2] = lengths[k] * np.cos(theta)
                result[4 * k + 3] = lengths[k] * np.sin(theta)
            return result

        return by_t

    def ends(start: Array, end: Array) -> Array:
        joined = start[4:] - end[:-4]
        return np.concatenate([start[[0, 2, 3]], joined, end[[4 * count - 3]]])

    for step in range(1, STEPS + 1):
        found = solve_bvp(slope(step / STEPS), ends, t, rows, tol=TOLERANCE, max_nodes=50000)
        if not found.success:
            raise RuntimeError(f"The planar elastica was not found: {found.message}")
        t, rows = found.x, found.y
    s = np.linspace(0.0, 1.0, points)
    which = np.clip(np.searchsorted(bounds, s, side="right") - 1, 0, count - 1)
    values = found.sol((s - bounds[which]) / lengths[which])
    pick = np.arange(points)
    return Shape(*(values[4 * which + row, pick] for row in (0, 2, 3)))


def arc(curvature: float, points: int = 101) -> Shape:
    """The unloaded wire of a rest curvature: an arc of a circle."""
    s = np.linspace(0.0, 1.0, points)
    angle = curvature * s
    return Shape(angle, np.sin(angle) / curvature, (1.0 - np.cos(angle)) / curvature)
