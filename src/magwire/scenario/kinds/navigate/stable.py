"""The least field that keeps the tip clear."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.navigate import FieldLimit, ModelSteering, Objective, in_inputs
from magwire.scenario.quantity import Length, Quantity, Share, Whole
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.engine.system import System
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation

FieldRate = Annotated[float, Quantity("flux_gradient", "positive")]
Stability = Annotated[float, Quantity("rate_squared", "positive")]
Part = Annotated[float, Share(0.0, 1.0)]
Tolerance = Annotated[float, Share(0.0, 0.5)]


@kind
class StableSteering(ModelSteering):
    """The least field that keeps the tip clear of the wall, stably."""

    method: Literal["stable"]
    objective: Objective | None = None
    plan_every: Length | None = None
    tip_clearance: Part = 0.4
    stability_margin: Stability = preset("1 1/s^2")
    field_tolerance: Tolerance = 0.05
    gain_tolerance: Tolerance = 0.0
    max_field: FieldLimit | None = None
    max_field_rate: FieldRate | None = None
    attempts: Annotated[int, Whole(1, 4)] = 4

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory."""
        from magwire.navigate.demands import Demands
        from magwire.navigate.persistent import persistent
        from magwire.navigate.stable import StableNavigator

        limits = {"max_field": self.max_field, "max_field_rate": self.max_field_rate}
        demands = Demands(
            tip_clearance=self.tip_clearance,
            stability_margin=self.stability_margin,
            field_tolerance=self.field_tolerance,
            gain_tolerance=self.gain_tolerance,
            **{name: limit for name, limit in limits.items() if limit is not None},
        )

        def planner(system: System) -> Navigator:
            plain = StableNavigator(
                system, demands=demands, plan_every=self.plan_every, friction=self.friction
            )
            return persistent(plain, self.attempts)

        return in_inputs(simulation.system, planner, self.objective)
