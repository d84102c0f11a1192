"""Strength of a coil over its current: straight, or that of an iron core (P-26)."""

from __future__ import annotations

import math
from typing import NamedTuple

from magwire.actuate.actuator import Actuator
from magwire.kernels.sources.drive import saturated
from magwire.kernels.sources.table import ATAN, ERF, RATIONAL, TANH

EDGE = 1.0 - 1e-12
"""Largest part of a core's full strength that has an input: conditioning guard."""


class Curve(NamedTuple):
    """Strength s of one input u, and back; it rises and never gets steeper.

    Attributes
    ----------
    kind
        One of those in the table of sources.
    a, b
        Its two parameters.
    """

    kind: int
    a: float
    b: float

    def strength(self, u: float) -> float:
        """s(u)."""
        if math.isinf(u):
            return u if self.kind == 0 else math.copysign(self.most, u)
        return float(saturated(self.kind, self.a, self.b, u)[0])

    def slope(self, u: float) -> float:
        """ds/du."""
        return float(saturated(self.kind, self.a, self.b, u)[1])

    @property
    def most(self) -> float:
        """Limit of a curve that saturates."""
        return self.a * 0.5 * math.pi if self.kind == ATAN else self.a

    def input(self, s: float) -> float:
        """The input whose strength is ``s``."""
        if self.kind == 0:
            return s
        part = min(max(s, -EDGE * self.most), EDGE * self.most) / self.a
        if self.kind == ERF:
            from scipy.special import erfinv

            return float(erfinv(part)) / self.b
        if self.kind == ATAN:
            return math.tan(part) / self.b
        if self.kind == TANH:
            return math.atanh(part) / self.b
        assert self.kind == RATIONAL
        return self.b * part / (1.0 - abs(part))

    def steepening(self, u: float) -> float:
        """Second derivative of u^2/2 by s, times (ds/du)^2: 1 - u s''(u)/s'(u); 1 if s = u."""
        size = abs(u)
        if self.kind == ERF:
            return 1.0 + 2.0 * (self.b * size) ** 2
        if self.kind == ATAN:
            return 1.0 + 2.0 * (self.b * size) ** 2 / (1.0 + (self.b * size) ** 2)
        if self.kind == TANH:
            return 1.0 + 2.0 * self.b * size * math.tanh(self.b * size)
        return 1.0 + 2.0 * size / (size + self.b) if self.kind == RATIONAL else 1.0


def curves_of(actuator: Actuator) -> tuple[Curve, ...]:
    """Those of an actuator's inputs."""
    table = actuator.arrays()
    return tuple(
        Curve(int(kind), float(a), float(b))
        for kind, (a, b) in zip(table.curve, table.saturation, strict=True)
    )
