"""Places and lengths as messages show them: in millimetres, as files of vessels mostly are."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

MM = 1e3


def long(metres: float) -> str:
    """A length [m] in millimetres."""
    return f"{MM * metres:.3g} mm"


def place(point: ArrayLike) -> str:
    """A point, shape (3,) [m], in millimetres."""
    x, y, z = np.round(MM * np.asarray(point, dtype=np.float64), 9) + 0.0  # no -0
    return f"({x:.4g}, {y:.4g}, {z:.4g}) mm"
