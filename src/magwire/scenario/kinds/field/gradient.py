"""A flux density that grows linearly from a place."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import Faults, kind
from magwire.scenario.kinds.field import FieldTable
from magwire.scenario.measured import Numbers
from magwire.scenario.quantity import FluxDensity, Place, Quantity, Row, Rows
from magwire.scenario.table import preset
from magwire.units import show

if TYPE_CHECKING:
    from magwire.field import GradientField

FluxGradient = Annotated[
    Numbers,
    Rows(Row((Quantity("flux_gradient"),) * 3), least=3, most=3),
]


@kind
class GradientFieldTable(FieldTable):
    """A flux density that grows linearly from a place."""

    kind: Literal["gradient"]
    flux_density: FluxDensity = preset(["0 mT", "0 mT", "0 mT"])
    gradient: FluxGradient
    origin: Place = preset(["0 mm", "0 mm", "0 mm"])

    def clashes(self) -> Faults:
        """A linear field obeys Maxwell's equations in free space."""
        rows = self.gradient
        size = max(abs(entry) for row in rows for entry in row)
        trace = rows[0][0] + rows[1][1] + rows[2][2]
        if abs(trace) > 1e-6 * size:
            yield (
                "Input field.gradient must have a trace of zero (no sources of flux); "
                f"received {show(trace, 'flux_gradient')}."
            )
        skew = max(abs(rows[i][j] - rows[j][i]) for i in range(3) for j in range(i))
        if skew > 1e-6 * size:
            yield (
                "Input field.gradient must be symmetric (no currents in the lumen); "
                f"received a difference of {show(skew, 'flux_gradient')} across the diagonal."
            )

    def create(self) -> GradientField:
        """The field as a model."""
        from magwire.field import GradientField

        return GradientField(self.flux_density, self.gradient.values, self.origin)  # type: ignore[arg-type]
