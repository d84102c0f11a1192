"""The wall's barrier: how near a wire feels it, and how stiffly (P-11, P-12)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from magwire.errors import one_of, positive


@dataclass(frozen=True)
class Barrier:
    """A logarithmic barrier that keeps the wire off the wall (P-11).

    Its energy per unit length of wire is -K (d - dhat)^2 log(d / dhat) for clearances d < dhat.

    Parameters
    ----------
    stiffness
        K [Pa].
    activation_gap
        Clearance dhat below which the wall is felt [m].
    wall
        What the wall keeps off (P-12): the wire's ``"surface"``, or, as in the paper, its
        ``"centreline"``.
    """

    stiffness: float = 1e3
    activation_gap: float = 0.1e-3
    wall: Literal["surface", "centreline"] = "surface"

    def __post_init__(self) -> None:
        positive("Barrier", "stiffness", self.stiffness, "Pa")
        positive("Barrier", "activation_gap", self.activation_gap, "m")
        one_of("Barrier", "wall", self.wall, ("surface", "centreline"))
