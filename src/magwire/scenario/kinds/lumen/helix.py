"""A helix."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen import Points, RoundLumen
from magwire.scenario.quantity import Length
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.lumen import Lumen


@kind
class HelixLumen(RoundLumen):
    """A helix; ``length`` is its arc length."""

    shape: Literal["helix"]
    helix_radius: Length
    pitch: Length
    length: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        rise = self.pitch / (2.0 * math.pi)
        return (self.helix_radius**2 + rise**2) / self.helix_radius

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        return Lumen.helix(
            self.helix_radius, self.pitch, self.length, self.radius, points=self.points
        )
