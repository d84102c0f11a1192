"""A magnet outside: a field source that is not linear in space, written as a user would."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
PER_METRE = 1e-7  # mu_0 / (4 pi)


class Dipole:
    """A point dipole, with a uniform field on top.

    Parameters
    ----------
    place, moment
        Shape (3,) [m] and (3,) [A m^2].
    uniform
        Shape (3,) [T].
    """

    affine = False

    def __init__(
        self, place: ArrayLike, moment: ArrayLike, uniform: ArrayLike = (0.0, 0.0, 0.0)
    ) -> None:
        self.place = np.asarray(place, dtype=np.float64)
        self.moment = np.asarray(moment, dtype=np.float64)
        self.uniform = np.asarray(uniform, dtype=np.float64)

    def at(self, points: Array) -> tuple[Array, Array]:
        """Flux density, shape (n, 3) [T], and gradient, shape (n, 3, 3) [T/m]."""
        r = np.asarray(points) - self.place
        d = np.linalg.norm(r, axis=1)[:, None]
        along = (r @ self.moment)[:, None]
        flux = PER_METRE * (3.0 * along * r / d**5 - self.moment / d**3)
        rm = r[:, :, None] * self.moment
        rr = r[:, :, None] * r[:, None, :]
        d, along = d[:, :, None], along[:, :, None]
        gradient = (rm + np.swapaxes(rm, 1, 2) + along * np.eye(3)) / d**5 - 5 * along * rr / d**7
        return flux + self.uniform, 3.0 * PER_METRE * gradient
