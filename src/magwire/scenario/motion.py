"""The tables of how the wall moves with the tissue around it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from magwire.scenario.quantity import Length, Place, Time
from magwire.scenario.table import Table

if TYPE_CHECKING:
    from magwire.contact import WallMotion


class WallMotionTable(Table):
    """A displacement of the tissue, to and fro; see ``WallMotion``."""

    amplitude: Place
    period: Time
    ramp: Length

    def build(self) -> WallMotion:
        """The motion as a model."""
        from magwire.contact import WallMotion

        return WallMotion(self.amplitude, self.period, self.ramp)
