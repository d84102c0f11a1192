"""The wall's barrier: how near a wire feels it, and how stiffly (P-11, P-12, P-39)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from magwire.errors import one_of, positive

Auto = Literal["auto"]
Radius = TypeVar("Radius", float, NDArray[np.float64])


@dataclass(frozen=True)
class Barrier:
    """A logarithmic barrier that keeps the wire off the wall (P-11).

    Its energy per unit length of wire is -K (d - dhat)^2 log(d / dhat) for clearances d < dhat.

    Parameters
    ----------
    stiffness
        K [Pa]; ``"auto"`` fits it to the wire's bending stiffness and the lumen's bends.
    activation_gap
        Clearance dhat below which the wall is felt [m]; ``"auto"`` makes it a small part of the
        free room in the lumen, so that what remains of it under load is no more than that part.
    wall
        What the wall keeps off (P-12): the wire's ``"surface"``, or, as in the paper, its
        ``"centreline"``.
    foundation
        Pressure over indentation of a wall that gives way, as Winkler's elastic foundation does
        [Pa/m]. A wire presses on the width of its diameter. The wall is rigid if None.
    """

    stiffness: float | Auto = "auto"
    activation_gap: float | Auto = "auto"
    wall: Literal["surface", "centreline"] = "surface"
    foundation: float | None = None

    def __post_init__(self) -> None:
        if self.stiffness != "auto":
            positive("Barrier", "stiffness", self.stiffness, "Pa")
        if self.activation_gap != "auto":
            positive("Barrier", "activation_gap", self.activation_gap, "m")
        one_of("Barrier", "wall", self.wall, ("surface", "centreline"))
        if self.foundation is not None:
            positive("Barrier", "foundation", self.foundation, "Pa/m")

    def keep_off(self, radius: Radius) -> Radius:
        """What the wall keeps from the axis of a wire of some radius, or of several [m] (P-12)."""
        return radius if self.wall == "surface" else 0.0 * radius
