"""The linear gradient field: a Maxwell coil on top of a Helmholtz coil."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from magwire.errors import InputError, array
from magwire.field.source import Array

Matrix3 = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class GradientField:
    """A field that varies linearly in space, B(x) = B_0 + G (x - origin).

    Parameters
    ----------
    flux_density
        B_0 at the origin, shape (3,) [T].
    gradient
        G[i, j] = dB_i/dx_j, shape (3, 3) [T/m]; symmetric and without trace, as curl and
        divergence of a magnetic field in empty space are zero.
    origin
        Shape (3,) [m].

    Raises
    ------
    InputError
        If the gradient has a trace or a skew part (no magnetic field in empty space has).

    Examples
    --------
    >>> import magwire as mw
    >>> field = mw.GradientField((0.01, 0, 0), [[0.2, 0, 0], [0, -0.1, 0], [0, 0, -0.1]])
    >>> flux, gradient = field.at([[0.05, 0, 0]])
    >>> flux.round(9).tolist()
    [[0.02, 0.0, 0.0]]
    """

    flux_density: tuple[float, float, float]
    gradient: Matrix3
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        flux = array("GradientField", "flux_density", self.flux_density, (3,), "T")
        origin = array("GradientField", "origin", self.origin, (3,), "m")
        matrix = array("GradientField", "gradient", self.gradient, (3, 3), "T/m")
        size = float(np.abs(matrix).max())
        if abs(np.trace(matrix)) > 1e-9 * size:
            raise InputError(
                "Input gradient of GradientField must have zero trace (div B = 0); "
                f"received trace {np.trace(matrix):.6g} T/m."
            )
        if float(np.abs(matrix - matrix.T).max()) > 1e-9 * size:
            raise InputError(
                "Input gradient of GradientField must be symmetric (curl B = 0); "
                f"received {matrix.tolist()} T/m."
            )
        object.__setattr__(self, "flux_density", tuple(flux.tolist()))
        object.__setattr__(self, "origin", tuple(origin.tolist()))
        object.__setattr__(self, "gradient", tuple(tuple(line) for line in matrix.tolist()))

    @property
    def affine(self) -> bool:
        """Always: it is linear in space."""
        return True

    def at(self, points: Array) -> tuple[Array, Array]:
        """Flux density, shape (n, 3) [T], and gradient, shape (n, 3, 3) [T/m]."""
        matrix = np.array(self.gradient)
        away = np.asarray(points) - np.array(self.origin)
        flux = np.array(self.flux_density) + away @ matrix.T
        return flux, np.tile(matrix, (len(points), 1, 1))
