"""A planar chain of rigid links in a bent channel with hard walls: least energy, no barrier.

Lengths in L, forces in EI/L^2. The channel turns to the left along a circle around (0, bend); its
walls keep the joints between bend - width and bend + width from the centre. The angles of the
links are the unknowns: the chain is inextensible by construction. Least bending energy under the
walls is a nonlinear programme; its multipliers are the forces of the walls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, nnls

Array = NDArray[np.float64]
TOUCHING = 1e-7
"""Gap below which a joint is taken to touch, in L."""


@dataclass(frozen=True)
class Pressed:
    """A chain pressed into a channel.

    Attributes
    ----------
    joints
        Ends of the links, shape (links, 2) [L].
    wall_force
        Of the walls on them, shape (links, 2) [EI/L^2].
    energy
        Of bending [EI/L].
    misfit
        Norm of the torques on the links that the walls' forces leave over [EI/L].
    """

    joints: Array
    wall_force: Array
    energy: float
    misfit: float


def press(
    links: int,
    step: float,
    bend: float,
    width: float,
    *,
    field: Array | None = None,
    entry: float = 0.0,
) -> Pressed:
    """Chain of links of length ``step``, clamped along x, in the channel.

    ``field``: torque per link and unit of sine of the angle to it, shape (links, 2). ``entry``:
    length of a straight channel before the bend; the clamp is at its begin, the bend at the origin.
    """
    springs = np.full(links, 1.0 / step)
    springs[0] *= 2.0
    magnet = np.zeros((links, 2)) if field is None else field
    centre = np.array([0.0, bend])

    def joints(angles: Array) -> Array:
        ends: Array = step * np.cumsum(np.column_stack((np.cos(angles), np.sin(angles))), axis=0)
        ends[:, 0] -= entry
        return ends

    def from_centre(angles: Array) -> Array:
        """Away from the centre of the bend; in the straight channel, from its own axis."""
        away: Array = joints(angles) - centre
        away[:, 0] = np.maximum(away[:, 0], 0.0)
        return away

    def energy(angles: Array) -> tuple[float, Array]:
        turn = np.diff(angles, prepend=0.0)
        moment = springs * turn
        value = 0.5 * float(moment @ turn)
        value -= float((magnet[:, 0] * np.cos(angles) + magnet[:, 1] * np.sin(angles)).sum())
        slope = moment - np.append(moment[1:], 0.0)
        slope += magnet[:, 0] * np.sin(angles) - magnet[:, 1] * np.cos(angles)
        return value, slope

    def gaps(angles: Array) -> Array:
        away = np.linalg.norm(from_centre(angles), axis=1)
        return np.concatenate((bend + width - away, away - (bend - width)))

    def slopes(angles: Array) -> Array:
        """Of the gaps by the angles, shape (2 links, links)."""
        away = from_centre(angles)
        outwards = away / np.linalg.norm(away, axis=1)[:, None]
        turned = step * np.column_stack((-np.sin(angles), np.cos(angles)))
        by_angle = np.tril(outwards @ turned.T)
        return np.concatenate((-by_angle, by_angle))

    start = np.maximum(step * (np.arange(links) + 0.5) - entry, 0.0) / bend
    found = minimize(
        energy,
        start,
        jac=True,
        method="SLSQP",
        constraints={"type": "ineq", "fun": gaps, "jac": slopes},
        options={"maxiter": 2000, "ftol": 1e-14},
    )
    angles = np.asarray(found.x)
    touching = np.flatnonzero(gaps(angles) < TOUCHING)
    torque = energy(angles)[1]
    if len(touching) > 0:
        forces, misfit = nnls(slopes(angles)[touching].T, torque)
    else:
        forces, misfit = np.zeros(0), np.linalg.norm(torque)
    away = from_centre(angles)
    outwards = away / np.linalg.norm(away, axis=1)[:, None]
    wall_force = np.zeros((links, 2))
    for i, force in zip(touching, forces, strict=True):
        wall_force[i % links] += (-1.0 if i < links else 1.0) * force * outwards[i % links]
    return Pressed(joints(angles), wall_force, float(found.fun), float(misfit))
