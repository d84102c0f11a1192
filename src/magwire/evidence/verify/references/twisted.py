"""Twisted wires: where they buckle, the localised helix, writhe, and areas on the sphere.

Lengths are in parts of the wire's, forces in EI/L^2, moments in EI/L. Wires are round, so that
both bending stiffnesses are EI.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]

SCAN = 2000


def ring_turn(twisting: float) -> float:
    """Total twist [rad] at which a closed ring leaves its plane: 2 pi sqrt(3) EI/GJ."""
    return float(2.0 * np.pi * np.sqrt(3.0) / twisting)


def clamped_moment(tension: float) -> float:
    """Moment M L/EI at which a wire clamped at both ends buckles under a tension T L^2/EI.

    One end may slide along the axis. w'''' - i M w''' - T w'' = 0 for w = y + i z has the
    solutions 1, s, exp(i q s) with q^2 - M q + T = 0. Between clamps at -1/2 and 1/2 they can be
    combined where q_1 q_2 sin(q_2/2 - q_1/2) = 2 (q_2 - q_1) sin(q_1/2) sin(q_2/2).
    """
    if tension == 0.0:  # tan z = z with z = M/2
        return float(2.0 * brentq(lambda z: np.sin(z) - z * np.cos(z), 4.0, 4.7, xtol=1e-14))

    def condition(moment: float) -> float:
        apart = np.sqrt(moment**2 - 4.0 * tension)
        first, second = 0.5 * (moment - apart), 0.5 * (moment + apart)
        turned = np.sin(0.5 * apart) / apart
        return float(turned - 2.0 * np.sin(0.5 * first) * np.sin(0.5 * second) / tension)

    lowest = 2.0 * np.sqrt(max(tension, 0.0))
    grid = np.linspace(lowest + 1e-6, lowest + 10.0, SCAN)
    values = [condition(moment) for moment in grid]
    change = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))[0]
    return float(brentq(condition, grid[change], grid[change + 1], xtol=1e-13))


class Localised(NamedTuple):
    """A localised helix in a long wire under tension.

    Its places, the axis being x, at evenly spaced stations; the largest angle between tangent and
    axis [rad]; by how much it is shorter [L]; the angle by which it turns one end [rad].
    """

    place: Array
    tilt: float
    shortening: float
    turn: float


def localised(moment: float, tension: float, points: int = 201) -> Localised:
    """Coyne's localised solution, centred in a wire from 0 to 1, for M < 2 sqrt(T).

    With 1 - cos(theta) = 2 (1 - m^2/4) sech^2(a (s - 1/2)), m = M/sqrt(T) and
    a = sqrt(T (1 - m^2/4)), and the azimuth's rate M/(1 + cos(theta)).
    """
    m = moment / np.sqrt(tension)
    depth = 1.0 - 0.25 * m**2
    rate = np.sqrt(tension * depth)
    fine = 40
    s = np.linspace(0.0, 1.0, fine * (points - 1) + 1)
    middle = 0.5 * (s[1:] + s[:-1])
    cosine = 1.0 - 2.0 * depth / np.cosh(rate * (middle - 0.5)) ** 2
    # The integral of M/(1 + cos(theta)) in closed form.
    azimuth = 0.5 * moment * (middle - 0.5)
    azimuth += np.arctan(2.0 * rate / moment * np.tanh(rate * (middle - 0.5)))
    sine = np.sqrt(1.0 - cosine**2)
    tangent = np.column_stack([cosine, sine * np.cos(azimuth), sine * np.sin(azimuth)])
    steps = np.vstack([np.zeros(3), np.cumsum(tangent, axis=0) * (s[1] - s[0])])
    return Localised(
        place=steps[::fine],
        tilt=float(np.arccos(1.0 - 2.0 * depth)),
        shortening=float(4.0 * depth / rate),
        turn=float(4.0 * np.arccos(0.5 * m)),
    )


def localised_moment(turn: float, tension: float, twisting: float) -> float:
    """Moment M of a localised helix if the ends are turned: turn = M/GJ + 4 arccos(m/2)."""
    limit = 2.0 * np.sqrt(tension)

    def excess(moment: float) -> float:
        return float(moment / twisting + 4.0 * np.arccos(moment / limit) - turn)

    return float(brentq(excess, 0.5 * limit, limit * (1.0 - 1e-12), xtol=1e-13))


def writhe(curve: Array, speed: Array) -> float:
    """Gauss's double integral for a closed curve at evenly spaced parameters from 0 to 2 pi.

    Parameters
    ----------
    curve, speed
        Places and their derivatives, shape (n, 3).
    """
    n = len(curve)
    total = 0.0
    for i in range(n):
        away = curve[i] - np.delete(curve, i, axis=0)
        across = np.cross(speed[i], np.delete(speed, i, axis=0))
        total += float(np.sum(np.sum(across * away, axis=1) / np.linalg.norm(away, axis=1) ** 3))
    return total * (2.0 * np.pi / n) ** 2 / (4.0 * np.pi)


def cone_area(angle: float, steps: int) -> float:
    """Area on the unit sphere of the regular polygon whose corners are at an angle to its axis.

    By Girard: sum of the inner angles less (n - 2) pi. A vector carried around along the sides
    turns by this angle.
    """
    half = np.arctan2(1.0, np.cos(angle) * np.tan(np.pi / steps))
    return float(2.0 * steps * half - (steps - 2) * np.pi)
