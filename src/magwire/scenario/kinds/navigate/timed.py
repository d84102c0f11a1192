"""Inputs that are known beforehand as functions of time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import Field

from magwire.scenario.columns import TIME, NamedColumns
from magwire.scenario.kind import Inlined, kind
from magwire.scenario.kinds.navigate import NavigatorTable
from magwire.scenario.kinds.navigate.inputs import inlined
from magwire.scenario.measured import Columns

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.navigate.timed import TimedInputs
    from magwire.simulation import Simulation


@kind
class TimedSteering(NavigatorTable):
    """Inputs that are known beforehand as functions of time: to hold, to rotate, to ramp.

    They are those of the actuator, or the flux density Bx, By and Bz. ``file`` stands for
    ``table``.
    """

    method: Literal["timed"]
    table: Annotated[Columns, NamedColumns(TIME)]
    file: str | None = Field(
        default=None,
        description="inputs by time as a CSV file, in place of table; relative to the scenario's "
        "folder",
    )

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the numbers of its file in it."""
        from magwire.scenario.courses import read_columns

        return inlined(table, lambda name: read_columns(folder / name, TIME))

    def inputs(self) -> TimedInputs:
        """The inputs that the table names."""
        from magwire.navigate.timed import TimedInputs

        values = self.table.values
        return TimedInputs(values[:, 0], values[:, 1:], self.table.names)

    def scaled(self, factor: float) -> TimedSteering:
        """The same with all inputs multiplied by a factor."""
        scaled = self.inputs().scaled(factor)
        values = np.column_stack([scaled.time, scaled.inputs])
        return self.model_copy(update={"table": Columns(scaled.names, values)})

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator, which has no memory."""
        return self.inputs().start(simulation.system)
