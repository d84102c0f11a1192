"""How the numbers of a file become places: its unit, a scale and a rigid motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from magwire.errors import InputError, array, one_of
from magwire.units import DIMENSIONS
from magwire.vessel.files import Drawing, Line, Surface
from magwire.vessel.files.drawing import Array
from magwire.vessel.words import between, long

LENGTHS = (8e-3, 1.5)
RADII = (0.15e-3, 20e-3)
"""Lengths and radii of people's vessels [m]."""
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


class Size(NamedTuple):
    """How large the vessel of a file would be.

    Attributes
    ----------
    unit
        If its numbers were in this unit.
    length
        Length of its longest line, or from corner to corner of its box if that is longer [m].
    radii
        Smallest and largest radius [m]; not a number if the file has none.
    """

    unit: str
    length: float
    radii: tuple[float, float]

    @property
    def words(self) -> str:
        """A vessel of this size, in words."""
        low, high = self.radii
        wide = "" if np.isnan(low) else f" with radius {between(low, high)}"
        return f"a vessel {long(self.length)} long{wide}"

    @property
    def plausible(self) -> bool:
        """Whether people have vessels of this size."""
        usual = math.sqrt(max(self.radii[0], 1e-300) * self.radii[1])
        fits = np.isnan(usual) or RADII[0] <= usual <= RADII[1]
        return bool(fits and LENGTHS[0] <= self.length <= LENGTHS[1])


def sizes(drawing: Drawing) -> list[Size]:
    """How large the vessel of a file would be in each unit that is plausible, likeliest first.

    Lengths of people's vessels are taken as 8 mm to 1.5 m, their radii as 0.15 to 20 mm; of these,
    what is nearest to a length of 0.2 m and a radius of 2.5 mm is the likeliest. Where none fits,
    the likeliest is named.
    """
    length, radii = _extent(drawing.lines, drawing.surface)
    known = DIMENSIONS["length"].units
    found = []
    for unit in ("um", "mm", "cm", "m"):
        stated = known.get(drawing.radius_unit or "", known[unit])
        found.append(Size(unit, known[unit] * length, (stated * radii[0], stated * radii[1])))
    found.sort(key=lambda size: (size.unit != drawing.radius_unit, _unusual(size)))
    return [size for size in found if size.plausible] or found[:1]


def unlike(lines: Sequence[Line], surface: Surface | None) -> tuple[str, ...]:
    """A note on a vessel, in metres, of a size that people's are not: a unit may be wrong."""
    size = Size("m", *_extent(lines, surface))
    if size.plausible:
        return ()
    return (
        f"It is {size.words}. People's are {between(*LENGTHS)} long with radius "
        f"{between(*RADII)}: is its unit the right one?",
    )


def _extent(lines: Sequence[Line], surface: Surface | None) -> tuple[float, tuple[float, float]]:
    """The length, and the smallest and largest radius but for a twentieth; NaN without radii."""
    places = [line.points for line in lines]
    lengths = [float(np.linalg.norm(np.diff(p, axis=0), axis=1).sum()) for p in places]
    if surface is not None:
        places.append(surface.points)
    lengths.append(float(np.linalg.norm(np.ptp(np.concatenate(places), axis=0))))
    values = np.concatenate([np.zeros(0), *(line.radius for line in lines)])
    values = values[np.isfinite(values) & (values > 0.0)]
    low, high = np.percentile(values, [5.0, 95.0]) if values.size else (np.nan, np.nan)
    return max(lengths), (float(low), float(high))


def _unusual(size: Size) -> float:
    """How far a size is from the usual one."""
    far = abs(math.log(max(size.length, 1e-300) / 0.2))
    usual = math.sqrt(max(size.radii[0], 1e-300) * size.radii[1])
    return far if np.isnan(usual) else far + abs(math.log(usual / 2.5e-3))


def unit_factor(path: str | Path, units: str | None, drawing: Drawing) -> float:
    """Metres in the file's unit."""
    known = DIMENSIONS["length"].units
    if units is not None:
        return float(known[one_of(OWNER, "units", units, known)])
    if drawing.unit is None or drawing.unit not in known:
        raise missing_unit(path, drawing)
    return float(known[drawing.unit])


def missing_unit(path: str | Path, drawing: Drawing) -> InputError:
    """The error for a file without a unit, with the vessel that each plausible one would make."""
    made = ", or ".join(f"'{size.unit}', {size.words}" for size in sizes(drawing))
    return InputError(
        f"Input units of {OWNER} must be given for '{path}', which does not state them; its "
        f"numbers look like {made}."
    )
