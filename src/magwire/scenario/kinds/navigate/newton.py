"""The tip on the centreline by Newton's method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.navigate import ModelSteering, in_inputs
from magwire.scenario.quantity import Length

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation


@kind
class NewtonSteering(ModelSteering):
    """The tip on the centreline, by Newton's method on the virtual tube's force."""

    method: Literal["newton"]
    plan_every: Length | None = None

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory."""
        from magwire.navigate.newton import NewtonNavigator

        return in_inputs(
            simulation.system,
            lambda system: NewtonNavigator(
                system, plan_every=self.plan_every, friction=self.friction
            ),
        )
