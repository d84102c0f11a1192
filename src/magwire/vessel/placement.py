"""How the numbers of a file become places: its unit, a scale and a rigid motion."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from magwire.errors import InputError, array, one_of
from magwire.units import DIMENSIONS
from magwire.vessel.files import Drawing
from magwire.vessel.files.drawing import Array

OWNER = "Lumen.read"


@dataclass(frozen=True)
class Placement:
    """How the numbers of a file become places: scaled, then turned, then moved.

    Parameters
    ----------
    factor
        Metres for one of the file's units, times the scale that was asked for.
    rotation
        Rotation vector, shape (3,) [rad].
    translation
        Shape (3,) [m].
    """

    factor: float
    rotation: ArrayLike = (0.0, 0.0, 0.0)
    translation: ArrayLike = (0.0, 0.0, 0.0)

    def points(self, points: Array) -> Array:
        """Points where they are to be, shape (n, 3) [m]."""
        turn = Rotation.from_rotvec(array(OWNER, "rotation", self.rotation, (3,), "rad"))
        shift = array(OWNER, "translation", self.translation, (3,), "m")
        return np.asarray(turn.apply(self.factor * points) + shift)


def guessed_unit(drawing: Drawing) -> str:
    """The unit in which the numbers of a file would be those of a vessel: "mm", "cm", "m" or "um".

    The size of the whole settles it: people have vessels of some 10 mm to 1 m.
    """
    points = [line.points for line in drawing.lines]
    if drawing.surface is not None:
        points.append(drawing.surface.points)
    every = np.concatenate(points)
    size = float(np.linalg.norm(np.ptp(every, axis=0)))
    radii = [line.radius[np.isfinite(line.radius)] for line in drawing.lines]
    values = np.concatenate(radii) if radii else np.zeros(0)
    sizes = [(size, 0.2, 1.0)]
    if values.size and np.median(values) > 0.0:
        sizes.append((float(np.median(values)), 0.0025, 1.0))
    units = ("um", "mm", "cm", "m")
    factors = DIMENSIONS["length"].units
    off = [
        sum(w * abs(math.log(max(s, 1e-300) * factors[u] / usual)) for s, usual, w in sizes)
        for u in units
    ]
    return units[int(np.argmin(off))]


def unit_factor(path: str | Path, units: str | None, drawing: Drawing) -> float:
    """Metres in the file's unit."""
    known = DIMENSIONS["length"].units
    if units is not None:
        return float(known[one_of(OWNER, "units", units, known)])
    if drawing.unit is None or drawing.unit not in known:
        raise InputError(
            f"Input units of {OWNER} must be given for '{path}', which does not state them; its "
            f"numbers look like '{guessed_unit(drawing)}'."
        )
    return float(known[drawing.unit])
