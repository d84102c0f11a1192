"""Inputs that make a flux density at a place, within their limits, at the least cost (P-28)."""

from __future__ import annotations

from collections.abc import Sequence

import daqp
import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.actuate import Actuator, Input, Magnet, extremes
from magwire.actuate.curve import Curve, curves_of
from magwire.errors import array

Array = NDArray[np.float64]

ROUNDS = 200  # of linearisation, where the field is not linear in the inputs
CLOSE = 1e-9  # of the wanted field, by which the made one may be off, and of inputs at rest
REACH = 0.02  # longest step of a magnet's coordinate [m], and of its direction, in one round
LEAST = 1e-3  # field that others are measured against [T]: less of it turns no tip by much
PARTS = (1.0, 0.3, 0.1, 0.03, 0.01)  # of the missing field that a round tries to make
PART = 0.99  # of the power, from which on it is at its limit
SHARES = (1.0, 0.5, 0.25, 0.1, 0.03, 0.0)  # of a change that makes currents cheaper
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
    prices = np.where(currents, prices_of(actuator.inputs), 1.0)
    unit = max(float(np.linalg.norm(wanted)), LEAST)
    if isinstance(actuator, Magnet) and np.any(wanted):
        far = np.linalg.norm(wanted - actuator.at(where, u)[0][0]) > 0.5 * unit
        u = actuator.aimed(u, where[0], wanted) if far else u
    u, curves = np.clip(u, low, high), curves_of(actuator)
    moved = len(actuator.arrays().posed) > 0
    linear = not moved and not any(curve.kind for curve in curves)
    made = actuator.at(where, u)[0][0]
    there = False
    for _ in range(ROUNDS):
        by_input = actuator.response(where, u)[0][0].T
        near = np.where(currents, FREE, REACH)
        steep = steepness(curves, u)
        low_by, high_by = (_straight(curves, u, edge) for edge in (low, high))
        change = None
        for part in PARTS if moved else PARTS[:1]:
            change = cheapest(
                prices * steep,
                np.where(currents, u, 0.0) / steep,
                (by_input / unit, part * (wanted - made) / unit),
                (np.maximum(low_by, -near), np.minimum(high_by, near)),
            )
            if change is not None:
                break
        if change is None:
            return None
        before, spent = u, float(prices @ np.where(currents, u, 0.0) ** 2)
        for share in SHARES:
            u = np.clip(_along(curves, before, share * change), low, high)
            if moved or not there or prices @ u**2 <= spent:
                break
        made = actuator.at(where, u)[0][0]
        there = float(np.linalg.norm(wanted - made)) <= CLOSE * unit
        size = max(1.0, float(np.linalg.norm(u)))
        if there and (linear or float(np.linalg.norm(u - before)) <= CLOSE * size):
            return None if actuator.violations(u) else u
    return None


def steepness(curves: Sequence[Curve], u: Array) -> Array:
    """How much more the price of each input bends than where its field is linear in it (P-26)."""
    return np.array([curve.steepening(value) for curve, value in zip(curves, u, strict=True)])


def _straight(curves: Sequence[Curve], u: Array, edge: Array) -> Array:
    """Changes from u that to first order lead to strengths at an edge, shape (m,)."""
    return np.array(
        [
            (curve.strength(end) - curve.strength(value)) / curve.slope(value)
            if curve.kind
            else end - value
            for curve, value, end in zip(curves, u, edge, strict=True)
        ]
    )


def _along(curves: Sequence[Curve], u: Array, change: Array) -> Array:
    """Inputs whose strengths are those that a change leads to to first order."""
    return np.array(
        [
            curve.input(curve.strength(value) + curve.slope(value) * by)
            if curve.kind
            else value + by
            for curve, value, by in zip(curves, u, change, strict=True)
        ]
    )


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
    over, said = lacking(actuator.inputs, needed), actuator.violations(needed)
    if np.any(actuator.arrays().curve):  # no current alone tells, where cores are saturated
        return f"{asked}: {_most(actuator, where[0], wanted)}"
    if over is not None:
        limit, takes = over
        return f"{asked}: {limit}; it takes {takes}."
    return f"{asked}: {said[0]}" if said else f"{asked}, and no inputs within the limits do."


def _most(actuator: Actuator, place: Array, wanted: Array) -> str:
    """How much there is in the direction of a flux density, as the end of a sentence."""
    found = extremes(actuator, place, wanted[None])
    (most,), (u,) = found.flux_density, found.inputs
    bound = [
        f"{one.name} at {value:.3g} {one.unit}"
        for one, value in zip(actuator.inputs, u, strict=True)
        if np.isclose(value, one.held).any()
    ]
    if actuator.power(u) >= PART * actuator.max_power:
        bound.append(f"the power at {actuator.max_power:g} W")
    return f"in its direction there are at most {1e3 * most:.4g} mT, with {', '.join(bound)}."
