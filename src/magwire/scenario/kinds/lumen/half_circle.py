"""Half a circle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.lumen import Points, RoundLumen
from magwire.scenario.quantity import Length
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.lumen import Lumen


@kind
class HalfCircleLumen(RoundLumen):
    """Half a circle in the xy plane."""

    shape: Literal["half-circle"]
    centreline_radius: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return self.centreline_radius

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        return Lumen.half_circle(self.centreline_radius, self.radius, points=self.points)
