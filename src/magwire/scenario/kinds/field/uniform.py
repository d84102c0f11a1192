"""The same flux density everywhere."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.field import FieldTable
from magwire.scenario.quantity import FluxDensity
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.field import UniformField


@kind
class UniformFieldTable(FieldTable):
    """The same flux density everywhere."""

    kind: Literal["uniform"]
    flux_density: FluxDensity = preset(["0 mT", "0 mT", "0 mT"])

    def create(self) -> UniformField:
        """The field as a model."""
        from magwire.field import UniformField

        return UniformField(self.flux_density)
