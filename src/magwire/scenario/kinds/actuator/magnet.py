"""A permanent magnet on an arm."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import ActuatorTable, Heading, unlimited
from magwire.scenario.measured import Numbers
from magwire.scenario.quantity import Length, LengthOrZero, Place, Quantity, Row, Rows, Speed
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.actuate import Magnet

Corners = Annotated[Numbers, Rows(Row((Quantity("length"),) * 3), least=2, most=2)]


@kind
class MagnetTable(ActuatorTable):
    """A sphere, or a cylinder if it has a length, magnetised along its axis.

    Its inputs are the position of its centre, x, y and z, and its direction, dx, dy and dz.
    ``parked`` is its position, and ``aimed`` its direction, before anybody moves it.
    """

    kind: Literal["magnet"]
    radius: Length
    length: Length | None = None
    remanence: Annotated[float, Quantity("flux_density", "positive")]
    parked: Place
    aimed: Heading
    reach: Corners | None = None
    keep_out: LengthOrZero = preset("0 mm")
    speed: Speed | None = None
    turning: Annotated[float, Quantity("angular_speed", "positive")] | None = None

    def create(self) -> Magnet:
        """The actuator as a model."""
        from magwire.actuate import Box, Magnet

        return Magnet(
            pose=self.pose.build(),
            radius=self.radius,
            length=self.length,
            remanence=self.remanence,
            reach=None if self.reach is None else Box(self.reach[0], self.reach[1]),  # type: ignore[arg-type]
            keep_out=self.keep_out,
            parked=(*self.parked, *self.aimed),
            speed=unlimited(self.speed),
            turning=unlimited(self.turning),
        )
