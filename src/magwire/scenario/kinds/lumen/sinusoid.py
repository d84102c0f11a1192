"""A cosine in a plane."""

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
class SinusoidLumen(RoundLumen):
    """A cosine in the xy plane that starts along the x axis; ``length`` is its extent in x."""

    shape: Literal["sinusoid"]
    amplitude: Length
    period: Length
    length: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return 1.0 / (self.amplitude * (2.0 * math.pi / self.period) ** 2)

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        return Lumen.sinusoid(
            self.amplitude, self.period, self.length, self.radius, points=self.points
        )
