"""Kinds of navigator, and what they have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import KindTable
from magwire.scenario.quantity import Length, Quantity
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation

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
