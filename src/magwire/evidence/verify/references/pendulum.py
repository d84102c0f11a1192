"""Planar elastica by elliptic integrals: a wire clamped at one end, bent by a force or a field.

Lengths are in parts of the wire's, forces in EI/L^2. With theta the angle of the tangent to the
clamp's direction, a dead force p at an angle phi on the tip and a uniform magnetisation along
the tangent in a uniform field b at an angle phi obey the same equation,
theta'' = -p sin(phi - theta), which is that of the pendulum. docs/theory/verification.md derives
what is used here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipeinc, ellipj, ellipkm1, elliprf

Array = NDArray[np.float64]

SCAN = 4000


class Bent(NamedTuple):
    """A bent wire: angle [rad] and place of its tip, angle of the joint where the magnet begins."""

    angle: float
    x: float
    y: float
    joint: float = 0.0


def under_force(load: float, direction: float) -> Bent:
    """Tip under a dead force p at an angle 0 < phi <= pi to the clamp; its first branch.

    Also a wire magnetised all along its tangent, in a field b = p at that angle. At phi = pi this
    is the buckled branch; a load that does not buckle the wire is refused.
    """
    return magnetised_tip(load, direction, 1.0)


def magnetised_tip(load: float, direction: float, part: float) -> Bent:
    """A wire of which the distal part is magnetised along its tangent, in a uniform field.

    The rest carries a constant moment and is an arc of a circle. Of several equilibria the one is
    taken that has come nearest to the field's direction.

    Raises
    ------
    ValueError
        If there is none, as in an antiparallel field that does not buckle the wire.
    """
    root = np.sqrt(load)

    def joint(left: Array) -> tuple[Array, Array]:
        """Angle still missing at the joint and curvature there, if ``left`` misses at the tip."""
        k, m, m1 = np.cos(0.5 * left), np.cos(0.5 * left) ** 2, np.sin(0.5 * left) ** 2
        u = ellipkm1(m1) - root * part
        sn, cn, _, _ = ellipj(abs(u), m)
        sn = np.copysign(sn, u)
        return 2.0 * np.arccos(np.clip(k * sn, -1.0, 1.0)), 2.0 * root * k * cn

    def excess(logarithm: Array) -> Array:
        missing, curvature = joint(np.exp(logarithm))
        return missing + (1.0 - part) * curvature - direction

    grid = np.linspace(np.log(1e-7), np.log(direction * (1.0 - 1e-9)), SCAN)
    values = excess(grid)
    changes = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))
    if len(changes) == 0:
        raise ValueError(f"No bent wire at a load of {load} at {direction} rad.")
    left = float(np.exp(brentq(excess, *grid[changes[0] : changes[0] + 2], xtol=1e-14)))
    missing, curvature = (float(value) for value in joint(np.asarray(left)))
    theta = direction - missing
    if part < 1.0:
        x, y = np.sin(theta) / curvature, (1.0 - np.cos(theta)) / curvature
    else:
        x, y, theta = 0.0, 0.0, 0.0
    along, across = _span(load, missing, left)
    c, s = np.cos(direction), np.sin(direction)
    x, y = x + along * c + across * s, y + along * s - across * c
    return Bent(direction - left, float(x), float(y), float(theta))


def _span(load: float, missing: float, left: float) -> tuple[float, float]:
    """From joint to tip: the way along the field, and across it on the clamp's side."""
    k, m1 = np.cos(0.5 * left), np.sin(0.5 * left) ** 2
    m = k * k
    sine = np.cos(0.5 * missing) / k
    cosine = np.sqrt(max(0.0, 1.0 - sine * sine))
    u = sine * elliprf(cosine**2, cosine**2 + m1 * sine**2, 1.0)
    first = ellipkm1(m1) - u
    second = ellipeinc(0.5 * np.pi, m) - ellipeinc(np.arcsin(min(sine, 1.0)), m)
    root = np.sqrt(load)
    return float(first - 2.0 * second) / root, float(2.0 * k * cosine / root)


def shape(load: float, bent: Bent, direction: float, part: float = 1.0, points: int = 101) -> Array:
    """Points of the bent wire from clamp to tip, shape (2, points), for drawing."""
    root, left = np.sqrt(load), direction - bent.angle
    k = np.cos(0.5 * left)
    u = ellipkm1(np.sin(0.5 * left) ** 2) - root * np.linspace(part, 0.0, points)
    sn = np.copysign(ellipj(np.abs(u), k * k)[0], u)
    theta = direction - 2.0 * np.arccos(np.clip(k * sn, -1.0, 1.0))
    s = 1.0 - np.linspace(part, 0.0, points)
    if part < 1.0:
        body = np.linspace(0.0, 1.0 - part, points, endpoint=False)
        s, theta = np.append(body, s), np.append(body / (1.0 - part) * bent.joint, theta)
    steps = np.diff(s) * np.array(
        [np.cos(0.5 * (theta[1:] + theta[:-1])), np.sin(0.5 * (theta[1:] + theta[:-1]))]
    )
    return np.hstack([np.zeros((2, 1)), np.cumsum(steps, axis=1)])


def dipole(strength: float, direction: float, rigid: float) -> Bent:
    """A wire that ends in a rigid magnet, of length ``rigid``, in a uniform field.

    ``strength`` is m B L/EI for the magnet's whole moment m. The wire before it is an arc.
    """
    length = 1.0 - rigid
    angle = float(brentq(lambda t: t - length * strength * np.sin(direction - t), 0.0, direction))
    x, y = length * np.sin(angle) / angle, length * (1.0 - np.cos(angle)) / angle
    x, y = x + rigid * np.cos(angle), y + rigid * np.sin(angle)
    return Bent(angle, float(x), float(y), angle)


def critical_antiparallel(part: float) -> float:
    """Field b at which the straight wire buckles, if its distal part is magnetised."""
    if part == 1.0:
        return float(0.25 * np.pi**2)

    def condition(root: float) -> float:
        return float(root * (1.0 - part) * np.sin(root * part) - np.cos(root * part))

    return float(brentq(condition, 1e-6, 0.5 * np.pi / part, xtol=1e-14) ** 2)
