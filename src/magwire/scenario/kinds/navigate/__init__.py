"""Kinds of navigator, and what they have in common."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import KindTable
from magwire.scenario.quantity import Length, Quantity
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from collections.abc import Callable

    from magwire.engine.system import System
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation

Objective = Literal["power", "field"]
FieldLimit = Annotated[float, Quantity("flux_density", "positive")]


class NavigatorTable(KindTable):
    """A kind of navigator: its key ``method`` says which."""

    family = "navigate"
    method: str

    @property
    def interval(self) -> float:
        """Feed between two observations [m]."""
        return 5e-4

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator of one run, as yet without a memory; None if nobody steers."""
        raise NotImplementedError


class ModelSteering(NavigatorTable):
    """A navigator that has a model of the wire; it takes a magnet and a field of its own."""

    update_every: Length = preset("0.5 mm")
    friction: Literal["model", "none"] = "none"

    @property
    def interval(self) -> float:
        """Feed between two observations [m]."""
        return self.update_every


def in_inputs(
    system: System, planner: Callable[[System], Navigator], objective: Objective | None = None
) -> Navigator:
    """A navigator of a uniform field, which plans in the inputs of the system's actuator if any.

    Parameters
    ----------
    system
        What is steered.
    planner
        Makes the navigator of a system without an actuator.
    objective
        What the inputs are to be least in; "power" if left out.
    """
    if system.actuator is None:
        return planner(system)
    from magwire.navigate.allocation import AllocatingNavigator

    inner = planner(replace(system, actuator=None))
    return AllocatingNavigator(inner, system, objective=objective or "power")
