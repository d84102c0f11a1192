"""An ideal uniform field with a uniform gradient."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import ActuatorTable, unlimited
from magwire.scenario.kinds.actuator.uniform import Component, FluxRate
from magwire.scenario.quantity import Quantity

if TYPE_CHECKING:
    from magwire.actuate import UniformGradient

Slope = Annotated[float, Quantity("flux_gradient", "positive")]
SlopeRate = Annotated[float, Quantity("flux_gradient_rate", "positive")]


@kind
class UniformGradientTable(ActuatorTable):
    """A field that is linear about its origin; its inputs are Bx to Bz and Gxx to Gyz."""

    kind: Literal["uniform-gradient"]
    max_component: Component | None = None
    slew: FluxRate | None = None
    max_gradient: Slope | None = None
    gradient_slew: SlopeRate | None = None

    def create(self) -> UniformGradient:
        """The actuator as a model."""
        from magwire.actuate import UniformGradient

        return UniformGradient(
            pose=self.pose.build(),
            max_component=unlimited(self.max_component),
            slew=unlimited(self.slew),
            max_gradient=unlimited(self.max_gradient),
            gradient_slew=unlimited(self.gradient_slew),
        )
