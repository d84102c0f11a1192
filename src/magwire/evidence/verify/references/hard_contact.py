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
        Force of the walls on them, shape (links, 2) [EI/L^2].
    energy
        Energy of bending [EI/L].
    misfit
        Norm of the torques on the links that the walls' forces leave over [EI/L].
    """

    joints: Array
    wall_force: Array
    energy: float
    misfit: float


@dataclass(frozen=True)
class _Channel:
    """Energy and gaps of a chain by the angles of its links."""

    step: float
    bend: float
    width: float
    entry: float
    springs: Array
    magnet: Array

    def joints(self, angles: Array) -> Array:
        """Ends of the links, shape (links, 2)."""
        links = self.step * np.column_stack((np.cos(angles), np.sin(angles)))
        ends: Array = np.cumsum(links, axis=0)
        ends[:, 0] -= self.entry
        return ends

    def outwards(self, angles: Array) -> tuple[Array, Array]:
        """Distance of the joints from the centre of the bend, and unit vectors away from it.

        In the straight channel the centre is as far from its axis, and goes along.
        """
        away = self.joints(angles) - np.array([0.0, self.bend])
        away[:, 0] = np.maximum(away[:, 0], 0.0)
        distance: Array = np.sqrt((away**2).sum(axis=1))
        return distance, away / distance[:, None]

    def energy(self, angles: Array) -> tuple[float, Array]:
        """Energy and its derivatives: torques on the links."""
        turn = np.diff(angles, prepend=0.0)
        moment = self.springs * turn
        x, y = self.magnet.T
        value = 0.5 * float(moment @ turn) - float(x @ np.cos(angles) + y @ np.sin(angles))
        torque = moment - np.append(moment[1:], 0.0) + x * np.sin(angles) - y * np.cos(angles)
        return value, torque

    def gaps(self, angles: Array) -> Array:
        """To the outer and to the inner wall, shape (2 links,)."""
        distance, _ = self.outwards(angles)
        outer, inner = self.bend + self.width, self.bend - self.width
        return np.concatenate((outer - distance, distance - inner))

    def slopes(self, angles: Array) -> Array:
        """Of the gaps by the angles, shape (2 links, links)."""
        _, outwards = self.outwards(angles)
        turned = self.step * np.column_stack((-np.sin(angles), np.cos(angles)))
        by_angle = np.tril(outwards @ turned.T)
        return np.concatenate((-by_angle, by_angle))


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
    springs[0] *= 2.0  # half a cell
    magnet = np.zeros((links, 2)) if field is None else field
    channel = _Channel(step, bend, width, entry, springs, magnet)
    found = minimize(
        channel.energy,
        np.maximum(step * (np.arange(links) + 0.5) - entry, 0.0) / bend,
        jac=True,
        method="SLSQP",
        constraints={"type": "ineq", "fun": channel.gaps, "jac": channel.slopes},
        options={"maxiter": 2000, "ftol": 1e-14},
    )
    angles = np.asarray(found.x)
    wall_force, misfit = _wall_forces(channel, angles)
    return Pressed(channel.joints(angles), wall_force, float(found.fun), misfit)


def _wall_forces(channel: _Channel, angles: Array) -> tuple[Array, float]:
    """The multipliers as forces, shape (links, 2), and what they leave over."""
    _, torque = channel.energy(angles)
    touching = np.flatnonzero(channel.gaps(angles) < TOUCHING)
    wall_force = np.zeros((len(angles), 2))
    if len(touching) == 0:
        return wall_force, float(np.linalg.norm(torque))
    sizes, misfit = nnls(channel.slopes(angles)[touching].T, torque)
    _, outwards = channel.outwards(angles)
    for i, size in zip(touching, sizes, strict=True):
        inner, joint = divmod(int(i), len(angles))
        wall_force[joint] += (1.0 if inner else -1.0) * size * outwards[joint]
    return wall_force, float(misfit)
