"""The ideal uniform field, alone or with a uniform gradient."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import Input
from magwire.actuate.tables import Desk

PAIRS = {"xx": (0, 0), "xy": (0, 1), "xz": (0, 2), "yy": (1, 1), "yz": (1, 2)}


@dataclass(frozen=True, kw_only=True)
class Uniform(Actuator):
    """A field that is the same everywhere; its inputs are its three components [T].

    Parameters
    ----------
    max_component
        Largest component [T].
    slew
        Largest rate of each component [T/s].
    """

    max_component: float = math.inf
    slew: float = math.inf

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Bx, By and Bz [T]."""
        most = self.max_component
        return tuple(Input(f"B{c}", "T", -most, most, self.slew) for c in "xyz")

    def lay(self, desk: Desk) -> None:
        """Three unit fields."""
        for k, unit in enumerate(np.eye(3)):
            desk.affine(k, unit)


@dataclass(frozen=True, kw_only=True)
class UniformGradient(Uniform):
    """A field B + G x about the actuator's origin; three inputs of B [T], five of G [T/m].

    G is symmetric and without trace, as in empty space: Gzz = -Gxx - Gyy.

    Parameters
    ----------
    max_gradient
        Largest of the five [T/m].
    gradient_slew
        Largest rate of each [T/m/s].
    """

    max_gradient: float = math.inf
    gradient_slew: float = math.inf

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Bx, By, Bz [T], Gxx, Gxy, Gxz, Gyy and Gyz [T/m]."""
        most = self.max_gradient
        slopes = (Input(f"G{p}", "T/m", -most, most, self.gradient_slew) for p in PAIRS)
        return (*super().inputs, *slopes)

    def lay(self, desk: Desk) -> None:
        """Three unit fields and five unit gradients."""
        super().lay(desk)
        for k, (i, j) in enumerate(PAIRS.values(), start=3):
            g = np.zeros((3, 3))
            g[i, j] = g[j, i] = 1.0
            g[2, 2] -= 1.0 if i == j else 0.0
            desk.affine(k, (0.0, 0.0, 0.0), g)
