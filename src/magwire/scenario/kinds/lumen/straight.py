"""A straight tube."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen import RoundLumen
from magwire.scenario.quantity import Length

if TYPE_CHECKING:
    from magwire.lumen import Lumen


@kind
class StraightLumen(RoundLumen):
    """A straight tube along the x axis."""

    shape: Literal["straight"]
    length: Length

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return math.inf

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        return Lumen.straight(self.length, self.radius)
