"""What can be set on an actuator, and how far and how fast."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from magwire.errors import InputError, array, nonnegative, positive

Vector3 = tuple[float, float, float]
NEARLY = 0.98
"""Part of supply / resistance to plan with: a current is there after 4 L/R, at all of it never."""


@dataclass(frozen=True)
class Input:
    """One thing that can be set: a current, a component of a field, a coordinate of a magnet.

    Parameters
    ----------
    name, unit
        What it is called, and its SI unit: "A", "T", "T/m", "m" or "" for parts of a direction.
    low, high
        Limits [unit].
    slew
        Largest rate of change [unit/s].
    resistance, inductance, supply
        For a coil: R [ohm], L [H] and the voltage of its supply [V], which bounds the rate of
        change: |L du/dt + R u| <= V (P-27).

    Raises
    ------
    InputError
        If the limits are in the wrong order, or a value cannot be.
    """

    name: str
    unit: str
    low: float = -math.inf
    high: float = math.inf
    slew: float = math.inf
    resistance: float = 0.0
    inductance: float = 0.0
    supply: float = math.inf

    def __post_init__(self) -> None:
        if math.isnan(self.low) or math.isnan(self.high) or self.low > self.high:
            raise InputError(
                f"Limits of input {self.name} must be low, then high; "
                f"received {self.low:g} and {self.high:g} {self.unit}.".replace(" .", ".")
            )
        if not self.slew > 0.0:
            raise InputError(f"Input slew of {self.name} must be positive; received {self.slew:g}.")
        nonnegative(self.name, "resistance", self.resistance, "ohm")
        nonnegative(self.name, "inductance", self.inductance, "H")
        if not self.supply > 0.0:
            raise InputError(
                f"Input supply of {self.name} must be positive; received {self.supply:g} V."
            )

    @property
    def held(self) -> tuple[float, float]:
        """Lowest and highest value that it can be brought to and held at [unit].

        The limits, or nearly what the supply's voltage drives through the resistance.
        """
        driven = NEARLY * self.supply / self.resistance if self.resistance > 0.0 else math.inf
        return max(self.low, -driven), min(self.high, driven)

    def at_limit(self, edge: float) -> str:
        """In words, that it is at an edge of what is held, and what makes it one."""
        shown = abs(edge) if self.low == -self.high else edge
        if edge in (self.low, self.high):
            return f"input {self.name} is at its limit of {shown:g} {self.unit}"
        return (
            f"input {self.name} is at {shown:.3g} {self.unit}, as much as its supply of "
            f"{self.supply:g} V holds against {self.resistance:g} ohm"
        )

    def rates(self, u: float) -> tuple[float, float]:
        """Lowest and highest rate of change at ``u`` [unit/s]."""
        low, high = -self.slew, self.slew
        if self.inductance > 0.0 and math.isfinite(self.supply):
            low = max(low, (-self.supply - self.resistance * u) / self.inductance)
            high = min(high, (self.supply - self.resistance * u) / self.inductance)
        return low, high


@dataclass(frozen=True)
class Box:
    """A workspace: where an actuator is calibrated, in its own frame.

    Parameters
    ----------
    low, high
        Opposite corners, shape (3,) [m]; it need not be centred.
    """

    low: Vector3
    high: Vector3

    def __post_init__(self) -> None:
        low = array("Box", "low", self.low, (3,), "m")
        high = array("Box", "high", self.high, (3,), "m")
        if not np.all(low < high):
            raise InputError(
                "Corners of Box must be low, then high, along each axis; "
                f"received {low.tolist()} and {high.tolist()} m."
            )
        object.__setattr__(self, "low", tuple(low.tolist()))
        object.__setattr__(self, "high", tuple(high.tolist()))

    def outside(self, points: np.ndarray) -> np.ndarray:
        """How far points, shape (n, 3) [m], are outside, shape (n,) [m]; 0 inside."""
        over = np.maximum(np.array(self.low) - points, points - np.array(self.high))
        away: np.ndarray = np.linalg.norm(np.maximum(over, 0.0), axis=1)
        return away


@dataclass(frozen=True)
class Circuit:
    """The electrical side of a coil: R [ohm], L [H] and the voltage of its supply [V]."""

    resistance: float = 0.0
    inductance: float = 0.0
    supply: float = math.inf


UNLIMITED = Circuit()


def current(name: str, most: float, circuit: Circuit) -> Input:
    """The current of a coil, at most ``most`` [A] either way."""
    if not math.isinf(most):
        positive(name, "max_current", most, "A")
    return Input(
        name,
        "A",
        -most,
        most,
        resistance=circuit.resistance,
        inductance=circuit.inductance,
        supply=circuit.supply,
    )


def direction(owner: str, name: str, value: object) -> np.ndarray:
    """A unit vector; refuses a direction of length zero."""
    vector = array(owner, name, value, (3,))  # type: ignore[arg-type]
    size = float(np.linalg.norm(vector))
    if size == 0.0:
        raise InputError(f"Input {name} of {owner} must have a length; received [0, 0, 0].")
    return vector / size
