"""The navigate tables of a scenario, one for each way to steer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field

from magwire.scenario.quantity import Length, Quantity, Row, Rows, Share, Whole
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation

Knots = Annotated[
    tuple[tuple[float, float, float, float], ...],
    Rows(Row((Quantity("length", "nonnegative"), *[Quantity("flux_density")] * 3)), least=1),
]
FieldLimit = Annotated[float, Quantity("flux_density", "positive")]
FieldRate = Annotated[float, Quantity("flux_gradient", "positive")]
Stability = Annotated[float, Quantity("rate_squared", "positive")]
Part = Annotated[float, Share(0.0, 1.0)]
Tolerance = Annotated[float, Share(0.0, 0.5)]
Momentum = Annotated[float, Share(1e-9, 10.0)]


class SteeringTable(Table):
    """What all ways to steer have in common."""

    @property
    def interval(self) -> float:
        """Feed between two observations [m]."""
        return 5e-4

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory; None if nobody steers."""
        raise NotImplementedError


class NoSteering(SteeringTable):
    """Nobody steers: the wire is pushed in the field as it is."""

    method: Literal["none"]

    def build(self, simulation: Simulation) -> Navigator | None:
        """Nobody."""
        return None


class ModelSteering(SteeringTable):
    """Steering by a navigator that has a model of the wire."""

    method: Literal["stable", "newton", "paper"]
    update_every: Length = preset("0.5 mm")

    @property
    def interval(self) -> float:
        """Feed between two observations [m]."""
        return self.update_every


class StableSteering(ModelSteering):
    """The least field that keeps the tip clear of the wall, stably."""

    method: Literal["stable"]
    plan_every: Length | None = None
    tip_clearance: Part = 0.4
    stability_margin: Stability = preset("1 1/s^2")
    field_tolerance: Tolerance = 0.05
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
            **{name: limit for name, limit in limits.items() if limit is not None},
        )
        plain = StableNavigator(simulation.system, demands=demands, plan_every=self.plan_every)
        return persistent(plain, self.attempts)


class NewtonSteering(ModelSteering):
    """The tip on the centreline, by Newton's method on the virtual tube's force."""

    method: Literal["newton"]
    plan_every: Length | None = None

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory."""
        from magwire.navigate.newton import NewtonNavigator

        return NewtonNavigator(simulation.system, plan_every=self.plan_every)


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
        return PaperNavigator(simulation.system, optimiser=optimiser)


class ScheduledSteering(SteeringTable):
    """A field that is known beforehand as a function of the feed.

    ``file`` stands for ``table`` in the file that a user writes; it is replaced by the numbers it
    stands for before the table is checked.
    """

    method: Literal["schedule"]
    table: Knots
    file: str | None = Field(
        default=None,
        description="schedule as a CSV file, or result file, in place of table; relative to the "
        "scenario's folder",
    )

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator, which has no memory."""
        from magwire.navigate import Prescribed, Schedule

        rows = np.array(self.table)
        return Prescribed(Schedule(rows[:, 0], rows[:, 1:]))
