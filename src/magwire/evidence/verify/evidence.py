"""What a group of cases gives: lines with a verdict, curves to look at, cases left out."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Verdict = Literal["pass", "fail", "skipped"]
Series = tuple[NDArray[np.float64], NDArray[np.float64], Literal["line", "points"]]

NODES = 100
"""Nodes of the wire, unless a line's case says otherwise."""
ORDER_TOLERANCE = 0.2


@dataclass(frozen=True)
class Line:
    """One quantity of one case, next to a reference.

    Parameters
    ----------
    group, case, quantity, unit
        What is compared; the unit is empty for pure numbers.
    reference, source
        The value it should have, and where that comes from.
    value
        magwire's.
    tolerance
        Largest difference that passes, in the unit or, if ``relative``, as part of the reference.
    order, expected_order
        Order of convergence that was observed, and the one that theory has.

    Raises
    ------
    ValueError
        If the line could not be judged: no tolerance, a relative one with a reference of zero, or
        one order without the other.
    """

    group: str
    case: str
    quantity: str
    unit: str
    reference: float
    source: str
    value: float
    tolerance: float
    relative: bool = False
    order: float | None = None
    expected_order: float | None = None

    def __post_init__(self) -> None:
        if not self.tolerance >= 0.0:
            raise ValueError(f"{self.name} needs a tolerance; received {self.tolerance}.")
        if self.relative and self.reference == 0.0:
            raise ValueError(f"{self.name} has a relative tolerance and a reference of zero.")
        if (self.order is None) != (self.expected_order is None):
            raise ValueError(f"{self.name} has one of order and expected order without the other.")

    @property
    def name(self) -> str:
        """What is compared, in words."""
        return f"{self.case}: {self.quantity}"

    @property
    def error(self) -> float:
        """Difference to the reference, in its unit or as part of it."""
        difference = abs(self.value - self.reference)
        return difference / abs(self.reference) if self.relative else difference

    @property
    def passed(self) -> bool:
        """Whether the error is within the tolerance, and the order near the expected one."""
        if self.order is not None and self.expected_order is not None:
            off = abs(self.order - self.expected_order)
            if not off <= ORDER_TOLERANCE:
                return False
        return math.isfinite(self.error) and self.error <= self.tolerance

    @property
    def verdict(self) -> Verdict:
        """As the report prints it."""
        return "pass" if self.passed else "fail"


@dataclass(frozen=True)
class Curve:
    """Something to look at: series of points by name.

    Parameters
    ----------
    title, x_label, y_label
        What it shows.
    series
        For each name x, y and how to draw them: references as lines, magwire as points.
    equal
        Whether a unit is as long on both axes, as shapes need it.
    """

    title: str
    x_label: str
    y_label: str
    series: Mapping[str, Series]
    equal: bool = False


@dataclass(frozen=True)
class Skipped:
    """A case that could not be run here, such as one that needs a package that is not there."""

    group: str
    case: str
    reason: str
    verdict: Verdict = "skipped"


@dataclass(frozen=True)
class Raised:
    """A group that ended with an error, or that gave nothing to judge."""

    group: str
    reason: str
    case: str = "the group as a whole"
    verdict: Verdict = "fail"
