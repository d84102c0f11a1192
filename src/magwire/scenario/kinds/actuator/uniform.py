"""An ideal uniform field."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import ActuatorTable, unlimited
from magwire.scenario.quantity import Quantity

if TYPE_CHECKING:
    from magwire.actuate import Uniform

Component = Annotated[float, Quantity("flux_density", "positive")]
FluxRate = Annotated[float, Quantity("flux_rate", "positive")]


@kind
class UniformTable(ActuatorTable):
    """A field that is the same everywhere; its inputs are its components Bx, By and Bz."""

    kind: Literal["uniform"]
    max_component: Component | None = None
    slew: FluxRate | None = None

    def create(self) -> Uniform:
        """The actuator as a model."""
        from magwire.actuate import Uniform

        return Uniform(
            pose=self.pose.build(),
            max_component=unlimited(self.max_component),
            slew=unlimited(self.slew),
        )
