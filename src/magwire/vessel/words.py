"""Places and lengths as messages show them: in millimetres, as files of vessels mostly are."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

MM = 1e3


def long(metres: float) -> str:
    """A length [m] in millimetres, or in metres from one on."""
    return f"{metres:.3g} m" if metres >= 1.0 else f"{MM * metres:.3g} mm"


def between(low: float, high: float) -> str:
    """A range of lengths [m]; the unit is said once if it is the same."""
    a, b = long(low), long(high)
    return f"{a.split()[0] if a.split()[1] == b.split()[1] else a} to {b}"


def place(point: ArrayLike) -> str:
    """A point, shape (3,) [m], in millimetres."""
    x, y, z = np.round(MM * np.asarray(point, dtype=np.float64), 9) + 0.0  # no -0
    return f"({x:.4g}, {y:.4g}, {z:.4g}) mm"
