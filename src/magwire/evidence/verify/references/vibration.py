"""Small vibrations of a clamped beam that is magnetised along its axis, in a field along it.

Lengths in L, times in L^2 sqrt(rho A/EI), b = M B L^2/EI. The deflection w obeys
w'''' - b w'' + w.. + mu w. = 0 with w = w' = 0 at the clamp and w'' = w''' - b w' = 0 at the tip:
the torque of the field on the magnet acts like a tension of fixed direction.
"""

from __future__ import annotations

from functools import lru_cache
from math import cos, cosh, sin, sinh, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


def _wave_numbers(omega: float, b: float) -> tuple[float, float]:
    """Of the hyperbolic and the trigonometric part."""
    middle = sqrt(0.25 * b * b + omega * omega)
    return sqrt(middle + 0.5 * b), sqrt(middle - 0.5 * b)


def _tip_conditions(omega: float, b: float) -> Array:
    """Bending moment and shear force at the tip of the two shapes that are clamped at zero.

    The shapes are cosh(p x) - cos(k x) and sinh(p x)/p - sin(k x)/k; shape (2, 2), over cosh(p).
    """
    p, k = _wave_numbers(omega, b)
    big, small = cosh(p), sinh(p)
    moment = [p * p * big + k * k * cos(k), p * small + k * sin(k)]
    shear = [p * k * (k * small - p * sin(k)), k * k * big + p * p * cos(k)]
    return np.array([moment, shear]) / big


@lru_cache
def frequencies(b: float, count: int) -> Array:
    """Lowest angular frequencies, shape (count,); b above -pi^2/4, where the beam buckles."""

    def value(omega: float) -> float:
        (m1, m2), (q1, q2) = _tip_conditions(omega, b).tolist()
        return float(m1 * q2 - m2 * q1)

    found: list[float] = []
    low, step = 1e-6, 0.2  # frequencies are much farther apart
    before = value(low)
    while len(found) < count:
        after = value(low + step)
        if before * after < 0.0:
            found.append(float(brentq(value, low, low + step, xtol=1e-12, rtol=1e-14)))
        low, before = low + step, after
    return np.array(found)


def _tip_of_mode(omega: float, b: float) -> float:
    """Deflection of the tip in a mode of unit mass, int w^2 dx = 1."""
    p, k = _wave_numbers(omega, b)
    moment = _tip_conditions(omega, b)[0]
    share = float(-moment[0] / moment[1])

    def shape(x: Array) -> Array:
        first: Array = np.cosh(p * x) - np.cos(k * x)
        return first + share * (np.sinh(p * x) / p - np.sin(k * x) / k)

    points, weights = np.polynomial.legendre.leggauss(100)
    mass = 0.5 * float(weights @ shape(0.5 * (1.0 + points)) ** 2)
    return float(shape(np.ones(1))[0]) / sqrt(mass)


def tip_after_release(time: ArrayLike, b: float, damping: float, modes: int = 6) -> Array:
    """Tip of a beam held by a unit field across it, after that field is switched off at time 0.

    A uniform field across acts like a force on the tip. Each mode of frequency w then swings
    freely: q.. + mu q. + w^2 q = 0 from rest.
    """
    t = np.asarray(time, dtype=np.float64)
    tip = np.zeros_like(t)
    for omega in frequencies(b, modes):
        fast = np.sqrt(complex(omega**2 - 0.25 * damping**2))
        swing = np.exp(-0.5 * damping * t) * (
            np.cos(fast * t) + 0.5 * damping * np.sin(fast * t) / fast
        )
        tip += (_tip_of_mode(float(omega), b) / omega) ** 2 * swing.real
    return tip


def implicit_euler(omega: float, damping: float, time_step: float) -> tuple[float, float]:
    """Frequency and rate of decay that implicit Euler steps make of q.. + mu q. + w^2 q = 0.

    (1 + mu dt + w^2 dt^2) z^2 - (2 + mu dt) z + 1 = 0 for the factor z of a step.
    """
    drag = damping * time_step
    roots = np.roots([1.0 + drag + (omega * time_step) ** 2, -2.0 - drag, 1.0])
    rate = np.log(roots[np.argmax(roots.imag)].astype(complex)) / time_step
    return float(rate.imag), float(-rate.real)
