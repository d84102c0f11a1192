"""Three coils at one point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import (
    CoilsTable,
    Current,
    Inductance,
    Resistance,
    Voltage,
    unlimited,
)
from magwire.scenario.quantity import Place, Quantity, Row
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.actuate import Omnimagnet

Moments = Annotated[tuple[float, float, float], Row((Quantity("magnetic_moment", "positive"),) * 3)]


@kind
class OmnimagnetTable(CoilsTable):
    """Three coils at one point, seen from afar; its inputs are the currents Ix, Iy and Iz.

    ``moments`` are those for one ampere; limits and circuit are those of each coil.
    """

    kind: Literal["omnimagnet"]
    moments: Moments
    position: Place = preset(["0 mm", "0 mm", "0 mm"])
    max_current: Current | None = None
    resistance: Resistance = preset("0 ohm")
    inductance: Inductance = preset("0 H")
    supply: Voltage | None = None

    def create(self) -> Omnimagnet:
        """The actuator as a model."""
        from magwire.actuate import Circuit, Omnimagnet

        circuit = Circuit(self.resistance, self.inductance, unlimited(self.supply))
        return Omnimagnet(
            pose=self.pose.build(),
            max_power=unlimited(self.max_power),
            moments=self.moments,
            position=self.position,
            max_current=unlimited(self.max_current),
            circuits=(circuit, circuit, circuit),
        )
