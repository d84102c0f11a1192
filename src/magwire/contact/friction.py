"""Friction of the wall on the wire (P-29 to P-32)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError, array, nonnegative, numbers

Array = NDArray[np.float64]
Coefficient = float | tuple[float, ...]


@dataclass(frozen=True)
class Friction:
    """Coulomb friction with elastic stick, and viscous drag where the wire touches the wall.

    Parameters
    ----------
    static
        Coefficient of friction of a wire that sticks: one, or one for each section of the wire.
    kinetic
        Coefficient of a wire that slides; that of ``static`` if left out. Not larger than it.
    drag
        Viscous force per length and speed where the wall is touched, of a lubricated wall
        [N s/m^2].
    along
        Factor of the coefficients along the path to the lumen's target: pairs of arc parameter [m]
        and factor, linear in between and constant beyond; 1 everywhere if left out.

    Raises
    ------
    InputError
        If a value is negative or not finite, ``kinetic`` exceeds ``static``, arcs do not rise, or
        the wall has both friction and drag.
    """

    static: Coefficient = 0.0
    kinetic: Coefficient | None = None
    drag: float = 0.0
    along: Sequence[tuple[float, float]] = ()

    def __post_init__(self) -> None:
        nonnegative("Friction", "drag", self.drag, "N s/m^2")
        for name in ("static", "kinetic"):
            value = getattr(self, name)
            if name == "static" or value is not None:
                for one in numbers("Friction", name, value).ravel():
                    nonnegative("Friction", name, float(one))
        static, kinetic = np.atleast_1d(self.static), np.atleast_1d(self._moving)
        if static.shape != kinetic.shape and 1 not in (len(static), len(kinetic)):
            raise InputError(
                "Input kinetic of Friction must have as many values as static, "
                f"{len(static)}; received {len(kinetic)}."
            )
        if np.any(kinetic > static):
            raise InputError(
                f"Input kinetic of Friction must be at most static, {self.static}; "
                f"received {self.kinetic}."
            )
        if self.drag > 0.0 and np.any(static > 0.0):
            raise InputError(
                "Input drag of Friction must be 0 where static is given: a wall is lubricated or "
                f"it is not; received {self.drag:g} N s/m^2."
            )
        along = (
            self.along if np.size(numbers("Friction", "along", self.along)) else np.empty((0, 2))
        )
        table = array("Friction", "along", along, (None, 2))
        if np.any(np.diff(table[:, 0]) <= 0.0) or np.any(table[:, 1] < 0.0):
            raise InputError(
                "Input along of Friction must have rising arcs and factors that are not negative; "
                f"received {table.tolist()}."
            )
        object.__setattr__(self, "along", tuple(map(tuple, table.tolist())))

    @property
    def _moving(self) -> Coefficient:
        return self.static if self.kinetic is None else self.kinetic

    def of_sections(self, count: int) -> tuple[Array, Array]:
        """Static and kinetic coefficients of each of a wire's sections, shape (count,).

        Raises
        ------
        InputError
            If there are several, but not as many as sections.
        """
        found = []
        for name, value in (("static", self.static), ("kinetic", self._moving)):
            values = np.atleast_1d(np.asarray(value, dtype=np.float64))
            if len(values) not in (1, count):
                raise InputError(
                    f"Input {name} of Friction must have one value, or one for each of the wire's "
                    f"{count} sections; received {len(values)}."
                )
            found.append(np.broadcast_to(values, (count,)).copy())
        return found[0], found[1]
