"""The order of convergence by slope."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def order(sizes: ArrayLike, errors: ArrayLike) -> float:
    """Slope of log(error) over log(size)."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])
