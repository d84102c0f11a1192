"""Where in the ranges of a sweep the runs are."""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from magwire.errors import InputError
from magwire.units import DIMENSIONS, parse

Value = str | int | float | bool
_QUANTITY = re.compile(r"\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*(\S.*?)?\s*")


@dataclass(frozen=True)
class Choice:
    """A key that takes one of some values."""

    key: str
    values: tuple[Value, ...]

    @property
    def count(self) -> int:
        """Number of values on a grid."""
        return len(self.values)

    def on_grid(self) -> tuple[Value, ...]:
        """The values on a grid."""
        return self.values

    def at(self, part: float) -> Value:
        """The value at a part of the way from the first to the last, from 0 up to 1."""
        return self.values[min(int(part * len(self.values)), len(self.values) - 1)]


@dataclass(frozen=True)
class Span:
    """A key whose values are between two numbers of one unit ("" for plain numbers)."""

    key: str
    low: float
    high: float
    unit: str
    whole: bool
    count: int

    def on_grid(self) -> tuple[Value, ...]:
        """Evenly spaced values, both ends among them."""
        return tuple(self.at(float(part)) for part in np.linspace(0.0, 1.0, self.count))

    def at(self, part: float) -> Value:
        """The value at a part of the way."""
        number = self.low + part * (self.high - self.low)
        if self.whole:
            return round(number)
        number = float(f"{number:.12g}")  # 0.3 and not 0.30000000000000004
        return f"{number!r} {self.unit}" if self.unit else number


Range = Choice | Span


def split(value: object) -> tuple[float, str] | None:
    """Number and unit of a quantity as written in a file; None if it is none."""
    if isinstance(value, bool):
        return None
    if isinstance(value, (int, float)):
        return float(value), ""
    match = _QUANTITY.fullmatch(value) if isinstance(value, str) else None
    return (float(match[1]), match[2] or "") if match else None


def samples(
    ranges: tuple[Range, ...], method: str, count: int, seed: int
) -> list[tuple[Value, ...]]:
    """The values of all keys in each run.

    Parameters
    ----------
    ranges
        One for each key.
    method
        "grid": all combinations, the last key changing fastest; "random": independent and uniform;
        "sobol": a scrambled Sobol sequence, which fills the ranges evenly.
    count, seed
        Number of samples, and what starts the random numbers; of no use to a grid.
    """
    if method == "grid":
        return list(itertools.product(*(r.on_grid() for r in ranges)))
    if method == "random":
        parts = np.random.default_rng(seed).random((count, len(ranges)))
    else:
        from scipy.stats import qmc

        parts = qmc.Sobol(len(ranges), rng=np.random.default_rng(seed)).random(count)
    return [tuple(r.at(float(p)) for r, p in zip(ranges, row, strict=True)) for row in parts]


def column(values: list[Value]) -> tuple[Any, str]:
    """Values of a key for a table: numbers in SI units and their unit, or texts and ""."""
    found = [split(value) for value in values]
    units = {pair[1] for pair in found if pair is not None}
    if None in found or ("" in units and len(units) > 1):
        return np.array([str(value) for value in values], dtype=object), ""
    if units == {""}:
        return np.array([pair[0] for pair in found if pair]), "1"
    for kind in DIMENSIONS:
        try:
            numbers = np.array([parse(value, kind) for value in values])
        except InputError:
            continue
        return numbers, next(u for u, factor in DIMENSIONS[kind].units.items() if factor == 1.0)
    return np.array([str(value) for value in values], dtype=object), ""
