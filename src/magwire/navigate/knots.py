"""Tables that are linear between knots, and stay before the first and after the last."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array

Array = NDArray[np.float64]


def rising(owner: str, name: str, values: ArrayLike, unit: str) -> Array:
    """Knots, checked, shape (k,).

    Raises
    ------
    InputError
        If there are none, or they do not rise.
    """
    knots = array(owner, name, values, (None,), unit)
    if len(knots) == 0 or np.any(np.diff(knots) <= 0.0):
        raise InputError(
            f"Input {name} of {owner} must hold at least one value and rise; received "
            f"{len(knots)} values, the smallest rise "
            f"{np.diff(knots).min(initial=np.inf):.6g} {unit}."
        )
    return knots


def between(knots: Array, table: Array, where: Array) -> Array:
    """Rows of a table, shape (k, m), at places between its knots, shape (n, m)."""
    return np.stack([np.interp(where, knots, column) for column in table.T], axis=1)


def spaced(knots: Array, step: float) -> Array:
    """Knots every ``step`` from the first on, and the last."""
    first, last = float(knots[0]), float(knots[-1])
    return np.append(np.arange(first, last - 1e-9 * step, step), last)
