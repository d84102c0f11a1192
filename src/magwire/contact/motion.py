"""How the wall moves with the tissue around it (P-40)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array, positive

Array = NDArray[np.float64]

STEEPEST = 1.875  # slope of the rise from 0 to 1, at its middle
STRAIN = 0.5
"""Largest strain of the tissue. At one the tissue would fold; up to here every point of it comes
from one place, which is found by going there and back."""
PASSES = 60
"""Of going there and back: each halves the error at least."""


@dataclass(frozen=True, eq=False)
class WallMotion:
    """A displacement of the tissue around the lumen, to and fro: breathing, or pulsation.

    At a distance r from the entrance it is the amplitude, times a rise over the ramp, times
    sin^2(pi t/T): at rest at the start, in full after half a period, and back after a whole one
    (Lujan et al., Med. Phys. 26, 715, 1999, for breathing). The rise is 10 s^3 - 15 s^4 + 6 s^5 of
    s = r/ramp, and 1 beyond: the entrance, where the guide is, rests.

    Parameters
    ----------
    amplitude
        Largest displacement, shape (3,) [m].
    period
        T [s].
    ramp
        Distance from the entrance at which the displacement is full [m].

    Raises
    ------
    InputError
        If a value is not finite, or period or ramp not positive, or the ramp so short that the
        tissue would be strained by more than a half.
    """

    amplitude: ArrayLike
    period: float
    ramp: float

    def __post_init__(self) -> None:
        amplitude = array("WallMotion", "amplitude", self.amplitude, (3,), "m")
        object.__setattr__(self, "amplitude", amplitude)
        positive("WallMotion", "period", self.period, "s")
        positive("WallMotion", "ramp", self.ramp, "m")
        if self.strain > STRAIN:
            least = STEEPEST * float(np.linalg.norm(amplitude)) / STRAIN
            raise InputError(
                f"Input ramp of WallMotion must be at least {least:.6g} m for an amplitude of "
                f"{float(np.linalg.norm(amplitude)):.6g} m, which strains the tissue by "
                f"{STRAIN:g}; received {self.ramp:.6g} m."
            )

    def __repr__(self) -> str:
        x, y, z = (1e3 * np.asarray(self.amplitude)).tolist()
        return (
            f"<WallMotion: ({x:.4g}, {y:.4g}, {z:.4g}) mm every {self.period:.4g} s, "
            f"in full {1e3 * self.ramp:.4g} mm from the entrance>"
        )

    @property
    def strain(self) -> float:
        """Largest strain of the tissue."""
        return STEEPEST * float(np.linalg.norm(np.asarray(self.amplitude))) / self.ramp

    def at(self, points: ArrayLike, entrance: ArrayLike, time: float) -> Array:
        """Displacement of the tissue that is at some points at a time.

        Parameters
        ----------
        points, entrance
            Shapes (n, 3) and (3,) [m].
        time
            [s].

        Returns
        -------
        array
            Shape (n, 3) [m].
        """
        away = np.linalg.norm(np.asarray(points) - np.asarray(entrance), axis=1)
        s = np.minimum(away / self.ramp, 1.0)
        part = np.sin(np.pi * time / self.period) ** 2
        rise = part * s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        result: Array = np.outer(rise, np.asarray(self.amplitude))
        return result


def gone(
    motions: Sequence[WallMotion], points: ArrayLike, entrance: ArrayLike, time: float
) -> Array:
    """Where tissue has gone that is at some points when the wall is at rest.

    Parameters
    ----------
    motions
        Displacements, which add up; together they strain the tissue by at most ``STRAIN``.
    points, entrance
        Shapes (n, 3) and (3,) [m].
    time
        [s].

    Returns
    -------
    array
        Shape (n, 3) [m].
    """
    rest = there = np.asarray(points, dtype=np.float64)
    for _ in range(PASSES if motions else 0):  # a displacement is of where the tissue is
        there = rest + np.sum([one.at(there, entrance, time) for one in motions], axis=0)
    return there


def recorded(data: Any) -> tuple[WallMotion, ...]:
    """How the wall of a result's variables moves; at rest in those of versions that did not say."""
    if "wall_period" not in data:
        return ()
    columns = (data[name].values for name in ("wall_amplitude", "wall_period", "wall_ramp"))
    return tuple(WallMotion(a, float(t), float(r)) for a, t, r in zip(*columns, strict=True))
