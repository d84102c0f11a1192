"""Measured fields on a grid, each scaled by a current."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field

from magwire.scenario.kind import Inlined, kind
from magwire.scenario.kinds.actuator import CircuitTable, CoilsTable, unlimited, with_files
from magwire.scenario.kinds.actuator.loops import Name
from magwire.scenario.quantity import at_least_one

if TYPE_CHECKING:
    from magwire.actuate import Map


class MapTable(CircuitTable):
    """A measured field for one ampere: a file in CSV or NetCDF, or a VTK image."""

    input: Name
    file: str


@kind
class MeasuredTable(CoilsTable):
    """Measured fields on one grid; its inputs are their currents, by their names."""

    kind: Literal["map"]
    fields: Annotated[tuple[MapTable, ...], at_least_one("field")]
    checksum: str | None = Field(
        default=None, description="of the files, filled in where it is missing"
    )

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the whole places of its files."""
        given = table.get("fields")
        entries = given if isinstance(given, list) else []
        names = [
            (("fields", number, "file"), entry["file"])
            for number, entry in enumerate(entries)
            if isinstance(entry, dict) and isinstance(entry.get("file"), str)
        ]
        return with_files(table, names, folder)

    def create(self) -> Map:
        """The actuator as a model."""
        from magwire.actuate import Map
        from magwire.actuate.grids import read_grid
        from magwire.actuate.inputs import current

        return Map(
            pose=self.pose.build(),
            max_power=unlimited(self.max_power),
            fields=tuple(read_grid(entry.file) for entry in self.fields),
            controls=tuple(current(f.input, f.most, f.circuit()) for f in self.fields),
        )
