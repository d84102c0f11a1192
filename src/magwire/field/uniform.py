"""The uniform field: the inside of a Helmholtz coil."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from magwire.errors import array
from magwire.field.source import Array


@dataclass(frozen=True)
class UniformField:
    """A field that is the same everywhere.

    Parameters
    ----------
    flux_density
        Shape (3,) [T].
    """

    flux_density: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        values = array("UniformField", "flux_density", self.flux_density, (3,), "T")
        object.__setattr__(self, "flux_density", tuple(values.tolist()))

    @property
    def affine(self) -> bool:
        """Always: it is constant in space."""
        return True

    def at(self, points: Array) -> tuple[Array, Array]:
        """Flux density, shape (n, 3) [T], and zero gradient, shape (n, 3, 3) [T/m]."""
        n = len(points)
        return np.full((n, 3), self.flux_density), np.zeros((n, 3, 3))
