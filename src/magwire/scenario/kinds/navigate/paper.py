"""The tip on the centreline by the paper's optimiser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.navigate import FieldLimit, ModelSteering, in_inputs
from magwire.scenario.quantity import Share, Whole
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation

Momentum = Annotated[float, Share(1e-9, 10.0)]


@kind
class PaperSteering(ModelSteering):
    """The tip on the centreline, by the paper's optimiser."""

    method: Literal["paper"]
    difference: FieldLimit = preset("0.1 mT")
    beta1: Momentum = 0.9
    beta2: Momentum = 1e-4
    tolerance: Momentum = 0.05
    iterations: Annotated[int, Whole(1, 100_000)] = 200

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory."""
        from magwire.navigate.paper import Optimiser, PaperNavigator

        optimiser = Optimiser(
            difference=self.difference,
            beta1=self.beta1,
            beta2=self.beta2,
            tolerance=self.tolerance,
            iterations=self.iterations,
        )
        return in_inputs(
            simulation.system,
            lambda system: PaperNavigator(system, optimiser=optimiser, friction=self.friction),
        )
