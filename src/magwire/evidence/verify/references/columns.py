"""Loads at which straight wires buckle, in EI/L^2."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from scipy.special import jv


def euler(ends: str) -> float:
    """Euler's load P L^2/EI of a column whose two ends are clamped, pinned or free.

    An end that is pinned or clamped may slide along the axis, where the force acts.
    """
    if ends == "clamped-pinned":  # tan z = z
        return float(brentq(lambda z: np.sin(z) - z * np.cos(z), 4.0, 4.7, xtol=1e-14) ** 2)
    halves = {"clamped-free": 0.5, "pinned-pinned": 1.0, "clamped-clamped": 2.0}[ends]
    return float((halves * np.pi) ** 2)


def own_weight() -> float:
    """Weight q L^3/EI at which a clamped column buckles: Greenhill's 7.8373.

    theta'' + q (1 - s) theta = 0 with theta(0) = 0 and theta'(1) = 0 has the solution
    (1 - s)^(1/2) J_{-1/3}(2/3 q^(1/2) (1 - s)^(3/2)).
    """
    root = float(brentq(lambda z: jv(-1.0 / 3.0, z), 1.0, 2.5, xtol=1e-14))
    return float((1.5 * root) ** 2)
