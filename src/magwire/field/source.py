"""What a source of the magnetic field must offer."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@runtime_checkable
class FieldSource(Protocol):
    """A magnetic field in space: flux density and its gradient at points.

    To add a source, write a class with these two members; nothing else in magwire needs to know.

    Attributes
    ----------
    affine
        Whether the field is linear in space, so that one sample a run is exact. Other fields are
        sampled again, at the wire's new place, until the state does not change any more.
    """

    @property
    def affine(self) -> bool:
        """Whether the field is linear in space."""
        ...

    def at(self, points: Array) -> tuple[Array, Array]:
        """Flux density and its gradient at points.

        Parameters
        ----------
        points
            Shape (n, 3) [m].

        Returns
        -------
        tuple
            Flux density, shape (n, 3) [T], and its gradient G[n, i, j] = dB_i/dx_j, shape
            (n, 3, 3) [T/m].
        """
        ...
