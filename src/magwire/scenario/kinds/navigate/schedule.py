"""A field that is known beforehand."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import Field

from magwire.errors import MagwireError
from magwire.scenario.kind import Faults, Inlined, kind
from magwire.scenario.kinds.navigate import NavigatorTable, in_inputs
from magwire.scenario.measured import Measured, Numbers
from magwire.scenario.quantity import Quantity, Row, Rows
from magwire.units import show

if TYPE_CHECKING:
    from magwire.navigate import Navigator, Schedule
    from magwire.simulation import Simulation

Knots = Annotated[
    Numbers,
    Rows(Row((Quantity("length", "nonnegative"), *[Quantity("flux_density")] * 3)), least=1),
]
FILE = re.compile(r"^(?:Schedule file|Result file|File|Folder) ")


@kind
class ScheduledSteering(NavigatorTable):
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

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the numbers of its file in it."""
        if "file" not in table and "table" in table:
            return Inlined(table, [])
        rest = {key: value for key, value in table.items() if key not in ("file", "table")}
        if "file" not in table:
            fault = (
                "Input navigate.file is missing; expected a schedule as CSV file or a result file."
            )
        elif "table" in table:
            fault = "Input navigate.table cannot stand next to navigate.file; remove one of them."
        elif not isinstance(table["file"], str):
            fault = f"Input navigate.file must be the name of a file; received {table['file']!r}."
        else:
            from magwire.scenario.schedules import read_schedule

            try:
                schedule = read_schedule(folder / table["file"])
            except MagwireError as error:
                fault = FILE.sub("Input navigate.file ", str(error), count=1)
            else:
                return Inlined({**rest, "table": _measured(schedule)}, [])
        return Inlined(rest, [fault], unread=(("navigate", "table"),))

    def clashes(self) -> Faults:
        """The feeds grow."""
        for before, after in itertools.pairwise(row[0] for row in self.table):
            if after <= before:
                yield (
                    "Input navigate.table must have feeds that increase; received "
                    f"{show(after, 'length')} after {show(before, 'length')}."
                )
                return

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator, which has no memory."""
        from magwire.navigate import Prescribed, Schedule

        rows = self.table.values
        schedule = Schedule(rows[:, 0], rows[:, 1:])
        return in_inputs(simulation.system, lambda system: Prescribed(schedule))


def _measured(schedule: Schedule) -> Measured:
    """A schedule as the scenario's table has it."""
    from magwire.scenario.schedules import rows_of

    rows = np.column_stack([schedule.feed, schedule.flux_density])
    return Measured(rows, lambda: list(rows_of(schedule)))
