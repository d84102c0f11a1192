"""A compressed beam that lies on the bottom of a tube, or winds along its wall.

At the bottom of a tube a beam of weight w per length that moves sideways by y climbs by
y^2/(2 r), where r is the distance of its axis from the tube's: the tube acts like an elastic
foundation of stiffness k = w/r. A compressive force F gives

    1/2 int EI y''^2 + N y'^2 + k y^2 ds,   N = -F,

whose least F without a minimum at y = 0 is, for a long beam, 2 (EI w/r)^(1/2) (Dawson and
Paslay), for a pinned one the least of EI (n pi/L)^2 + (w/r) (L/n pi)^2. Here it is solved by
Hermite elements for any course of N and k. A weightless beam winds up to a helix instead
(Lubinski and Woods).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize
from scipy.sparse import csc_array
from scipy.sparse.linalg import eigsh

Array = NDArray[np.float64]
Course = Callable[[Array], Array]


@dataclass(frozen=True)
class Ends:
    """What is held at the two ends: deflection and slope each."""

    begin: tuple[bool, bool] = (True, True)
    end: tuple[bool, bool] = (False, False)


def least_load(
    length: float,
    stiffness: float,
    foundation: Course,
    carried: Course,
    tension: Course,
    *,
    ends: Ends,
    push_at: dict[float, float] | None = None,
    elements: int = 400,
) -> float:
    """Least factor F at which a beam on a foundation buckles sideways.

    Parameters
    ----------
    length, stiffness
        Length and stiffness of the beam [m, N m^2].
    foundation
        k at places along the beam [N/m^2].
    carried, tension
        Axial force N = tension - F carried [N, without unit].
    ends
        How the beam is held.
    push_at
        Stiffness of springs of the size F times these, at places along the beam [1/m]; negative
        ones push away.
    elements
        Number of elements, of equal length, cubic.
    """
    h = length / elements
    fixed, load = np.zeros((2, 2 * elements + 2, 2 * elements + 2))
    for e in range(elements):
        rows = slice(2 * e, 2 * e + 4)
        for point, weight in zip(*np.polynomial.legendre.leggauss(4), strict=True):
            x = 0.5 * (1.0 + point)
            value, slope, bend = _hermite(x, h)
            s, area = np.array([h * (e + x)]), 0.5 * weight * h
            own = stiffness * np.outer(bend, bend) + foundation(s)[0] * np.outer(value, value)
            fixed[rows, rows] += area * (own + tension(s)[0] * np.outer(slope, slope))
            load[rows, rows] += area * carried(s)[0] * np.outer(slope, slope)
    for place, factor in (push_at or {}).items():
        e = min(int(place / h), elements - 1)
        value, _, _ = _hermite(place / h - e, h)
        load[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] -= factor * np.outer(value, value)
    held = np.concatenate((ends.begin, np.zeros(2 * elements - 2, dtype=bool), ends.end))
    return _smallest(fixed, load, np.flatnonzero(~held))


def _smallest(fixed: Array, load: Array, free: NDArray[np.intp]) -> float:
    """Least F of (fixed - F load) y = 0.

    ``load`` need not be definite, ``fixed`` is: the largest 1/F of load y = (1/F) fixed y.
    """
    a, b = (csc_array(matrix[np.ix_(free, free)]) for matrix in (fixed, load))
    value = eigsh(b, k=1, M=a, which="LA", return_eigenvectors=False)
    return 1.0 / float(value[0])


def _hermite(x: float, h: float) -> tuple[Array, Array, Array]:
    """Cubic shape functions, their slopes and curvatures at the part x of an element."""
    value = [1 - 3 * x**2 + 2 * x**3, h * (x - 2 * x**2 + x**3), 3 * x**2 - 2 * x**3]
    value.append(h * (x**3 - x**2))
    slope = np.array([-6 * x + 6 * x**2, h * (1 - 4 * x + 3 * x**2), 6 * x - 6 * x**2])
    slope = np.append(slope, h * (3 * x**2 - 2 * x)) / h
    bend = np.array([-6 + 12 * x, h * (6 * x - 4), 6 - 12 * x, h * (6 * x - 2)]) / h**2
    return np.array(value), slope, bend


def sinusoidal_load(stiffness: float, weight: float, offset: float) -> float:
    """Of a long beam, 2 (EI w/r)^(1/2) [N] (Dawson and Paslay 1984)."""
    return 2.0 * sqrt(stiffness * weight / offset)


def helix(stiffness: float, force: float, offset: float) -> tuple[float, float]:
    """The weightless helix under a dead load: turn per length [1/m] and wall force per length.

    Bending energy EI r^2 k^4/2 and the work of the load F (1 - (1 - r^2 k^2)^(1/2)) per length
    balance at k^2 = F/(2 EI (1 - r^2 k^2)^(1/2)); for small r k these are the classical
    k^2 = F/(2 EI) and F^2 r/(4 EI) (Lubinski and others 1962; Mitchell 1988).
    """

    def misfit(turn: float) -> float:
        rise = sqrt(1.0 - (offset * turn) ** 2)
        return 2.0 * stiffness * turn**2 * rise - force

    small = sqrt(force / (2.0 * stiffness))
    turn = float(brentq(misfit, 0.5 * small, 1.2 * small, xtol=1e-14 * small))
    # Virtual work of a change of r at a fixed turn per length.
    rise = sqrt(1.0 - (offset * turn) ** 2)
    return turn, force * offset * turn**2 / rise - stiffness * offset * turn**4


def helical_energy(load: float, waves: int = 6) -> float:
    """Mean energy of a heavy long helix over that of the straight beam at the bottom [w r].

    Load in (EI w/r)^(1/2), lengths along the beam in (EI r/w)^(1/4). Of all courses of the angle
    a(s) around the tube that wind up steadily, k s + sum c_n sin(n k s), the least mean of
    a''^2/2 + a'^4/2 - load a'^2/2 + 1 - cos(a). With a constant pitch, c_n = 0, that is
    1 - load^2/8, zero at 2 sqrt(2) (Chen, Lin and Cheatham 1990).
    """
    n = np.arange(1, waves + 1)[:, None]
    phase = np.linspace(0.0, 2.0 * np.pi, 128, endpoint=False)
    sine, cosine = np.sin(n * phase), np.cos(n * phase)

    def mean(unknowns: Array) -> float:
        turn, c = unknowns[0], unknowns[1:, None]
        angle = phase + (c * sine).sum(axis=0)
        first = turn * (1.0 + (c * n * cosine).sum(axis=0))
        second = -(turn**2) * (c * n**2 * sine).sum(axis=0)
        bending = 0.5 * (second**2 + first**4)
        return float(np.mean(bending - 0.5 * load * first**2 + 1.0 - np.cos(angle)))

    begin = np.concatenate(([sqrt(0.5 * load)], np.zeros(waves)))
    return float(minimize(mean, begin, method="BFGS", options={"gtol": 1e-9}).fun)


def helical_load() -> float:
    """Load [(EI w/r)^(1/2)] at which the heavy helix has the energy of the straight beam."""
    return float(brentq(helical_energy, 2.6, 2.9, xtol=1e-8))


def barrier_clearance(force: float, stiffness: float, gap: float) -> float:
    """Clearance [m] at which a barrier carries a force per length [N/m] (P-11)."""

    def misfit(part: float) -> float:
        away = part - 1.0
        slope = -2.0 * away * np.log(part) - away * away / part
        return float(-stiffness * gap * slope - force)

    return gap * float(brentq(misfit, 1e-9, 1.0 - 1e-9))
