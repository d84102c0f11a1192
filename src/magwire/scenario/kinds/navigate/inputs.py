"""Inputs of the actuator that are known beforehand."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field

from magwire.errors import MagwireError
from magwire.scenario.columns import NamedColumns
from magwire.scenario.kind import Inlined, kind
from magwire.scenario.kinds.navigate import NavigatorTable
from magwire.scenario.kinds.navigate.schedule import FILE
from magwire.scenario.measured import Columns

if TYPE_CHECKING:
    from collections.abc import Callable

    from magwire.navigate import Navigator
    from magwire.navigate.inputs import InputSchedule
    from magwire.simulation import Simulation


@kind
class InputSteering(NavigatorTable):
    """Inputs of the actuator that are known beforehand as functions of the feed.

    ``file`` stands for ``table`` in the file that a user writes; it is replaced by the numbers it
    stands for before the table is checked.
    """

    method: Literal["inputs"]
    table: Annotated[Columns, NamedColumns()]
    file: str | None = Field(
        default=None,
        description="inputs as a CSV file, or result file, in place of table; relative to the "
        "scenario's folder",
    )

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the numbers of its file in it."""
        from magwire.scenario.courses import columns_of, read_inputs

        return inlined(table, lambda name: columns_of(read_inputs(folder / name)))

    def schedule(self) -> InputSchedule:
        """The inputs that the table names."""
        from magwire.navigate.inputs import InputSchedule

        values = self.table.values
        return InputSchedule(values[:, 0], values[:, 1:], self.table.names)

    def build(self, simulation: Simulation) -> Navigator | None:
        """The navigator, which has no memory."""
        from magwire.navigate import Prescribed

        actuator = simulation.system.actuator
        assert actuator is not None  # a rule between the tables
        return Prescribed(self.schedule().of(actuator))


def inlined(table: dict[str, Any], read: Callable[[str], Columns]) -> Inlined:
    """A table with the columns that are read of its file in it."""
    if "file" not in table:
        return Inlined(table, [])
    rest = {key: value for key, value in table.items() if key not in ("file", "table")}
    if "table" in table:
        fault = "Input navigate.table cannot stand next to navigate.file; remove one of them."
    elif not isinstance(table["file"], str):
        fault = f"Input navigate.file must be the name of a file; received {table['file']!r}."
    else:
        try:
            return Inlined({**rest, "table": read(table["file"])}, [])
        except MagwireError as error:
            fault = FILE.sub("Input navigate.file ", str(error), count=1)
    return Inlined(rest, [fault], unread=(("navigate", "table"),))
