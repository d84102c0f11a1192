"""Feeding at one speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from magwire.scenario.kind import kind
from magwire.scenario.kinds.feed import FeedTable
from magwire.scenario.quantity import Angle, Length, Speed
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.engine.feed import Feed


@kind
class ConstantFeed(FeedTable):
    """Feeding at one speed."""

    length_key = "distance"
    speed: Speed
    distance: Length
    twist: Angle = preset("0 deg")

    @property
    def farthest(self) -> float:
        """Largest fed length [m]."""
        return self.distance

    @property
    def duration(self) -> float:
        """How long feeding takes [s]."""
        return self.distance / self.speed

    def create(self) -> Feed:
        """The feed as a model."""
        from magwire.engine.feed import Feed

        return Feed(speed=self.speed, distance=self.distance, twist=self.twist)
