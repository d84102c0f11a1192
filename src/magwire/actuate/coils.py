"""Coils of wire: any set of loops, and pairs on one to three axes (P-25)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from magwire.actuate.actuator import Actuator
from magwire.actuate.inputs import UNLIMITED, Circuit, Input, Vector3, current, direction
from magwire.actuate.tables import Desk
from magwire.errors import InputError, array, finite, nonnegative, positive

MU_0 = 1.25663706127e-6
"""Magnetic constant [T m/A], CODATA 2022."""
GAUSS_POINTS = 4
"""Loops across each side of a winding. The field of a square one is off by 2e-4 at half its side
from it, 4e-6 at its side, 6e-8 at twice that (against 16 loops across)."""


@dataclass(frozen=True)
class Coil:
    """A round coil.

    Parameters
    ----------
    input
        Name of its current; coils of the same name are in series.
    centre, axis
        Shape (3,) [m], shape (3,); the current turns about the axis.
    radius
        Mean radius [m].
    turns
        Number of turns; negative turns are wound the other way.
    width, height
        Of the winding's cross-section along the axis and along the radius [m]; a thin loop if zero.

    Raises
    ------
    InputError
        If a value cannot be.
    """

    input: str
    centre: Vector3
    axis: Vector3
    radius: float
    turns: float = 1.0
    width: float = 0.0
    height: float = 0.0

    def __post_init__(self) -> None:
        name = f"coil {self.input}"
        centre = array(name, "centre", self.centre, (3,), "m")
        axis = direction(name, "axis", self.axis)
        positive(name, "radius", self.radius, "m")
        if finite(name, "turns", self.turns) == 0.0:
            raise InputError(f"Input turns of {name} must not be zero; received 0.")
        nonnegative(name, "width", self.width, "m")
        if nonnegative(name, "height", self.height, "m") >= 2.0 * self.radius:
            raise InputError(
                f"Input height of {name} must be less than its diameter {2.0 * self.radius:g} m; "
                f"received {self.height:g} m."
            )
        object.__setattr__(self, "centre", tuple(centre.tolist()))
        object.__setattr__(self, "axis", tuple(axis.tolist()))

    def lay(self, desk: Desk, k: int) -> None:
        """Lay the coil as loops at Gauss points of its cross-section."""
        axis = np.array(self.axis)
        for along, w in _points(self.width):
            for across, v in _points(self.height):
                place = (np.array(self.centre) + along * axis, axis)
                gain = MU_0 * self.turns * w * v / (2.0 * math.pi)
                desk.loop(k, place, self.radius + across, gain)


def _points(size: float) -> Sequence[tuple[float, float]]:
    if size == 0.0:
        return [(0.0, 1.0)]
    x, w = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    return [(0.5 * size * float(a), 0.5 * float(b)) for a, b in zip(x, w, strict=True)]


@dataclass(frozen=True, kw_only=True)
class Loops(Actuator):
    """Any set of coils.

    Parameters
    ----------
    coils
        The coils; those of one input are in series.
    currents
        What each input's current may be and what its circuit is; without one there is no limit.
    """

    coils: tuple[Coil, ...]
    currents: tuple[Input, ...] = ()

    def __post_init__(self) -> None:
        if not self.coils:
            raise InputError("Input coils of Loops must have at least one coil; received none.")
        known = {coil.input for coil in self.coils}
        for given in self.currents:
            if given.name not in known:
                raise InputError(
                    f"Currents of Loops must be those of its coils, {', '.join(sorted(known))}; "
                    f"received {given.name}."
                )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Currents [A], in the order of the coils."""
        given = {i.name: i for i in self.currents}
        names = dict.fromkeys(coil.input for coil in self.coils)
        return tuple(given.get(name) or Input(name, "A") for name in names)

    def lay(self, desk: Desk) -> None:
        """Lay every coil."""
        order = {i.name: k for k, i in enumerate(self.inputs)}
        for coil in self.coils:
            coil.lay(desk, order[coil.input])


@dataclass(frozen=True)
class Pair:
    """Two equal coils on one axis, in series.

    Parameters
    ----------
    axis
        "x", "y" or "z".
    radius
        Mean radius [m].
    turns
        Of each coil.
    spacing
        Distance of the coils [m]; that of the ideal pair if left out: the radius for a Helmholtz
        pair, the radius times sqrt 3 for a Maxwell pair.
    max_current
        [A].
    circuit
        Resistance and inductance of both together, and the supply.
    width, height
        Of each winding's cross-section [m].
    """

    axis: str
    radius: float
    turns: float
    spacing: float | None = None
    max_current: float = math.inf
    circuit: Circuit = UNLIMITED
    width: float = 0.0
    height: float = 0.0

    def __post_init__(self) -> None:
        if self.axis not in ("x", "y", "z"):
            raise InputError(f"Input axis of Pair must be 'x', 'y' or 'z'; received {self.axis!r}.")
        positive("Pair", "radius", self.radius, "m")
        positive("Pair", "turns", self.turns)
        if self.spacing is not None:
            positive("Pair", "spacing", self.spacing, "m")

    def coils(self, name: str, ideal: float, second: float) -> tuple[Coil, Coil]:
        """The coils; the ``second`` one, at the negative end, has so many times the turns."""
        unit = np.eye(3)["xyz".index(self.axis)]
        half = 0.5 * (ideal * self.radius if self.spacing is None else self.spacing)
        axis: Vector3 = tuple(unit.tolist())
        made = []
        for side, turns in ((1.0, self.turns), (-1.0, second * self.turns)):
            centre: Vector3 = tuple((side * half * unit).tolist())
            made.append(Coil(name, centre, axis, self.radius, turns, self.width, self.height))
        return made[0], made[1]


@dataclass(frozen=True, kw_only=True)
class _Pairs(Actuator):
    """Pairs on one to three axes; one input each, its current [A]."""

    pairs: tuple[Pair, ...]

    def __post_init__(self) -> None:
        axes = [pair.axis for pair in self.pairs]
        if not axes or len(set(axes)) < len(axes):
            raise InputError(
                f"Input pairs of {type(self).__name__} must be one to three pairs, each on another "
                f"axis; received {', '.join(axes) or 'none'}."
            )

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The current of each pair [A]."""
        return tuple(
            current(f"{self._letter}{pair.axis}", pair.max_current, pair.circuit)
            for pair in self.pairs
        )

    _letter = "I"

    def _lay(self, desk: Desk, ideal: float, second: float) -> None:
        for k, pair in enumerate(self.pairs):
            for coil in pair.coils(pair.axis, ideal, second):
                coil.lay(desk, k)


@dataclass(frozen=True, kw_only=True)
class Helmholtz(_Pairs):
    """Helmholtz pairs: the coils of each are wound alike, for a uniform field at the centre."""

    def lay(self, desk: Desk) -> None:
        """Lay both coils of each pair."""
        self._lay(desk, 1.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class Maxwell(_Pairs):
    """Maxwell pairs: the coils of each are opposed, for a uniform gradient at the centre."""

    _letter = "M"

    def lay(self, desk: Desk) -> None:
        """Lay both coils of each pair."""
        self._lay(desk, math.sqrt(3.0), -1.0)
