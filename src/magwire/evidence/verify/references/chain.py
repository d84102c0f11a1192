"""A planar chain of rigid links: a swinging magnetic beam in other unknowns than nodes.

Lengths in L, forces in EI/L^2, times in L^2 sqrt(rho A/EI). Links of length h = 1/n with their
angles as unknowns, springs 1/h between them and 2/h at the clamp, uniform mass; the beam is
inextensible by construction. Errors are of second order in h. Integrated by scipy.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root

Array = NDArray[np.float64]


def _mass(links: int) -> Array:
    """M_ij of the kinetic energy 1/2 sum M_ij cos(a_i - a_j) a_i. a_j. of uniform links."""
    h = 1.0 / links
    i = np.arange(links)
    after = links - 1 - np.maximum.outer(i, i)  # whole links beyond both
    matrix = h**3 * (after + 0.5)
    matrix[i, i] = h**3 * (after[i, i] + 1.0 / 3.0)
    return np.asarray(matrix)


def _torque(angles: Array, field: Array) -> Array:
    """Of springs and field on every link."""
    links = len(angles)
    springs = np.full(links, float(links))
    springs[0] *= 2.0
    moments = springs * np.diff(angles, prepend=0.0)
    magnetic = (field[1] * np.cos(angles) - field[0] * np.sin(angles)) / links
    torque: Array = np.append(moments[1:], 0.0) - moments + magnetic
    return torque


def swing(
    start_field: Array, field: Array, damping: float, time: float, links: int
) -> tuple[Array, Array]:
    """Let a beam that is at rest in one field go in another.

    Fields as b = M B L^2/EI, shape (2,); damping mu against the velocities of all mass points.

    Returns
    -------
    begin, end
        Tip at the start and at the end, shape (2,).
    """
    mass, links_range = _mass(links), np.arange(links)
    rest = root(_torque, 0.1 * (links_range + 1) / links, args=(start_field,), tol=1e-12)
    if not rest.success:
        raise RuntimeError(f"The chain found no equilibrium: {rest.message}")

    def slope(_: float, state: Array) -> Array:
        angles, rates = state[:links], state[links:]
        between = angles[:, None] - angles[None, :]
        matrix = mass * np.cos(between)
        push = _torque(angles, field) - (mass * np.sin(between)) @ rates**2
        return np.concatenate((rates, np.linalg.solve(matrix, push) - damping * rates))

    begin = np.concatenate((rest.x, np.zeros(links)))
    course = solve_ivp(slope, (0.0, time), begin, "LSODA", rtol=1e-8, atol=1e-10)
    ends = [
        np.array([np.cos(a).sum(), np.sin(a).sum()]) / links for a in course.y[:links, [0, -1]].T
    ]
    return ends[0], ends[1]
