"""Kirchhoff's rod in space as a boundary value problem, with a magnetisation of three components.

Lengths are in parts of the wire's, forces in EI/L^2, moments in EI/L, moments per unit length and
flux densities so that their product is in EI/L^2. The rod does not stretch. Its directors are
carried as a unit quaternion.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_bvp

Array = NDArray[np.float64]
Field = Callable[[Array], tuple[Array, Array]]

TOLERANCE = 1e-8
STEPS = 10
PLACE, TURN, FORCE, MOMENT = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)


class Rod(NamedTuple):
    """Places and directors (columns d1, d2, d3) at evenly spaced stations, clamp first."""

    place: Array
    directors: Array


def directors_of(q: Array) -> Array:
    """Rotation matrices of quaternions (w, x, y, z), shape (4, n), as shape (3, 3, n)."""
    w, x, y, z = q / np.linalg.norm(q, axis=0)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def clamped(
    frame: Array,
    moment: ArrayLike,
    field: Field,
    *,
    twisting: float,
    rest: ArrayLike = (0.0, 0.0, 0.0),
    weight: ArrayLike = (0.0, 0.0, 0.0),
    points: int = 101,
) -> Rod:
    """A wire clamped at the origin with these directors and free at its tip, in a field.

    The loads are raised from zero in steps.

    Parameters
    ----------
    frame
        d1, d2, d3 at the clamp as columns.
    moment
        Magnetic moment per unit length in the directors, shape (3,).
    field
        Flux density, shape (n, 3), and its gradient dB_i/dx_j, shape (n, 3, 3), at places of
        shape (n, 3).
    twisting
        GJ/EI.
    rest
        Darboux vector of the unloaded wire in the directors, shape (3,).
    weight
        Dead force for each unit of length, shape (3,).
    points
        How many stations are given back.

    Raises
    ------
    RuntimeError
        If the boundary value problem is not solved.
    """
    m, pull = np.asarray(moment, dtype=np.float64), np.asarray(weight, dtype=np.float64)
    compliance = np.array([1.0, 1.0, 1.0 / twisting])[:, None]
    natural = np.asarray(rest, dtype=np.float64)[:, None]
    start = _quaternion(frame)
    s = np.linspace(0.0, 1.0, 50)
    rows = np.zeros((13, s.size))
    rows[PLACE] = frame[:, 2:] * s
    rows[TURN] = start[:, None]

    def slope(part: float) -> Callable[[Array, Array], Array]:
        def by_s(s: Array, y: Array) -> Array:
            d = directors_of(y[TURN])
            b, gradient = field(y[PLACE].T)
            space = np.einsum("ijn,j->in", d, m)
            u = part * natural + compliance * np.einsum("jin,jn->in", d, y[MOMENT])
            q = y[TURN]
            # The last term brings the quaternion back to length 1.
            turn = 0.5 * _product(q, u) + (1.0 - np.sum(q * q, axis=0)) * q
            drawn = part * (np.einsum("nij,in->jn", gradient, space) + pull[:, None])
            turned = np.cross(d[:, 2], y[FORCE], axis=0) + part * np.cross(space, b.T, axis=0)
            return np.vstack([d[:, 2], turn, -drawn, -turned])

        return by_s

    def ends(first: Array, last: Array) -> Array:
        return np.concatenate([first[PLACE], first[TURN] - start, last[FORCE], last[MOMENT]])

    for step in range(1, STEPS + 1):
        found = solve_bvp(slope(step / STEPS), ends, s, rows, tol=TOLERANCE, max_nodes=20000)
        if not found.success:
            raise RuntimeError(f"Kirchhoff's rod was not found: {found.message}")
        s, rows = found.x, found.y
    values = found.sol(np.linspace(0.0, 1.0, points))
    return Rod(values[PLACE].T, np.moveaxis(directors_of(values[TURN]), -1, 0))


def _product(q: Array, u: Array) -> Array:
    """Quaternions times vectors, which are quaternions without a real part; shape (4, n)."""
    w, v = q[0], q[1:]
    return np.vstack([-np.sum(v * u, axis=0), w * u + np.cross(v, u, axis=0)])


def _quaternion(frame: Array) -> Array:
    """Unit quaternion of a rotation matrix: an eigenvector, good for any angle."""
    r = frame
    k = np.array(
        [
            [r[0, 0] + r[1, 1] + r[2, 2], 0.0, 0.0, 0.0],
            [r[2, 1] - r[1, 2], r[0, 0] - r[1, 1] - r[2, 2], 0.0, 0.0],
            [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], 0.0],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1]],
        ]
    )
    result: Array = np.linalg.eigh(k)[1][:, -1]
    return result
