"""Inputs that make a flux density at a place, within their limits, at the least cost (P-28)."""

from __future__ import annotations

from collections.abc import Sequence

import daqp
import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator, Input, Magnet
from magwire.errors import array

Array = NDArray[np.float64]

ROUNDS = 200  # of linearisation, where the field is not linear in the inputs
CLOSE = 1e-9  # of the wanted field, by which the made one may be off, and of inputs at rest
REACH = 0.02  # longest step of a magnet's coordinate [m], and of its direction, in one round
LEAST = 1e-3  # field that others are measured against [T]: less of it turns no tip by much
PARTS = (1.0, 0.3, 0.1, 0.03, 0.01)  # of the missing field that a round tries to make
FREE = 1e30  # a bound that binds nothing, for the solver


def prices_of(inputs: Sequence[Input]) -> Array:
    """What the square of each input costs: its resistance, or one where none is known."""
    known = [one.resistance for one in inputs]
    if not all(resistance > 0.0 for resistance in known):
        return np.ones(len(known))
    return np.array(known)


def held(inputs: Sequence[Input]) -> tuple[Array, Array]:
    """Lowest and highest values to plan with, shape (m,) each."""
    low, high = np.array([one.held for one in inputs]).T
    return low, high


def lacking(inputs: Sequence[Input], needed: Array) -> tuple[str, str] | None:
    """In words, which limit is exceeded most by inputs that are needed, and what it takes."""
    low, high = held(inputs)
    edges = np.where(needed < 0.0, low, high)
    over = np.abs(needed) / np.maximum(np.abs(edges), CLOSE)
    worst = int(np.argmax(over))
    if over[worst] <= 1.0:
        return None
    one, edge, takes = inputs[worst], float(edges[worst]), float(needed[worst])
    digits = 3  # enough of them to tell the two apart
    while f"{takes:.{digits}g}" == f"{edge:.{digits}g}" and digits < 17:
        digits += 1
    shown = abs(takes) if one.low == -one.high else takes
    return one.at_limit(edge), f"{shown:.{digits}g} {one.unit}"


def allocate(
    actuator: Actuator, place: ArrayLike, flux: ArrayLike, start: ArrayLike | None = None
) -> Array | None:
    """Inputs that make a flux density at a place, within their limits, at the least cost.

    The cost of a current is its power, or its square where no resistance is known; that of a
    magnet's coordinate is how far it is moved.

    Parameters
    ----------
    actuator
        What makes the field.
    place
        Shape (3,) [m].
    flux
        Shape (3,) [T].
    start
        Inputs to start from, shape (m,); the idle ones if left out.

    Returns
    -------
    array or None
        Shape (m,); None if there are none.
    """
    where = array("allocate", "place", place, (3,), "m")[None]
    wanted = array("allocate", "flux", flux, (3,), "T")
    u = np.array(actuator.idle if start is None else start, dtype=np.float64)
    low, high = held(actuator.inputs)
    currents = np.array([one.unit == "A" for one in actuator.inputs])
    prices = prices_of(actuator.inputs)
    unit = max(float(np.linalg.norm(wanted)), LEAST)
    if isinstance(actuator, Magnet) and np.any(wanted):
        far = np.linalg.norm(wanted - actuator.at(where, u)[0][0]) > 0.5 * unit
        u = actuator.aimed(u, where[0], wanted) if far else u
    u, linear = np.clip(u, low, high), is_linear(actuator)
    made = actuator.at(where, u)[0][0]
    for _ in range(ROUNDS):
        by_input = actuator.response(where, u)[0][0].T
        near = np.where(currents, FREE, REACH)
        change = None
        for part in PARTS[:1] if linear else PARTS:
            change = cheapest(
                np.where(currents, prices, 1.0),
                np.where(currents, u, 0.0),
                (by_input / unit, part * (wanted - made) / unit),
                (np.maximum(low - u, -near), np.minimum(high - u, near)),
            )
            if change is not None:
                break
        if change is None:
            return None
        u = np.clip(u + change, low, high)
        made = actuator.at(where, u)[0][0]
        there = float(np.linalg.norm(wanted - made)) <= CLOSE * unit
        size = max(1.0, float(np.linalg.norm(u)))
        if there and (linear or float(np.linalg.norm(change)) <= CLOSE * size):
            return None if actuator.violations(u) else u
    return None


def is_linear(actuator: Actuator) -> bool:
    """Whether the field is linear in the inputs."""
    table = actuator.arrays()
    return not np.any(table.curve) and len(table.posed) == 0


def cheapest(
    prices: Array, now: Array, made: tuple[Array, Array], bounds: tuple[Array, Array]
) -> Array | None:
    """Least sum of prices times (now + change)^2 with rows . change = missing, within bounds."""
    rows, missing = made
    count = len(prices)
    scale = prices / prices.max()
    low, high = (np.clip(bound, -FREE, FREE) for bound in bounds)
    kinds = np.zeros(count + len(rows), dtype=np.int32)
    kinds[count:] = 5  # equations
    solution, _, flag, _ = daqp.solve(
        np.diag(scale),
        scale * now,
        np.ascontiguousarray(rows),
        np.concatenate((high, missing)),
        np.concatenate((low, missing)),
        kinds,
    )
    return np.asarray(solution) if flag > 0 else None


def binding(actuator: Actuator, place: ArrayLike, flux: ArrayLike, start: ArrayLike) -> str:
    """Which limit is in the way of a flux density at a place, as the end of a sentence."""
    where = array("binding", "place", place, (3,), "m")[None]
    wanted = array("binding", "flux", flux, (3,), "T")
    u = np.array(start, dtype=np.float64)
    asked = f"the magnet needs {1e3 * np.linalg.norm(wanted):.3g} mT"
    by_input = actuator.response(where, u)[0][0].T
    made = actuator.at(where, u)[0][0]
    change, *_ = np.linalg.lstsq(by_input, wanted - made, rcond=None)
    if np.linalg.norm(by_input @ change - (wanted - made)) > 1e-6 * np.linalg.norm(wanted):
        return f"{asked} in a direction that the actuator does not make there."
    needed = u + change
    over = lacking(actuator.inputs, needed)
    if over is None:
        said = actuator.violations(needed)
        return f"{asked}: {said[0]}" if said else f"{asked}, and no inputs within the limits do."
    limit, takes = over
    return f"{asked}: {limit}; it takes {takes}."
