"""The whole scenario: what a TOML file describes, validated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import tomli_w
from pydantic import Field

from magwire.scenario.kind import FAMILIES, AnyKind, on_new_kind
from magwire.scenario.kinds import (
    ActuatorTable,
    FeedTable,
    FieldTable,
    LumenTable,
    NavigatorTable,
    WireTable,
)
from magwire.scenario.kinds.navigate.none import NoSteering
from magwire.scenario.table import Table
from magwire.scenario.tables import ContactTable, EnvironmentTable, OutputTable, SolverTable

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from magwire.engine.record import Record
    from magwire.results import Result
    from magwire.scenario.job import Job


class Scenario(Table):
    """A run, described completely.

    Every quantity is in SI; the file and ``to_toml`` have units. Get one with
    ``magwire.load_scenario``.
    """

    notes: ClassVar[tuple[str, ...]] = ()
    """What was done to the vessel's file that it was read from, and which values are unlikely; a
    sentence each."""

    title: str = ""
    description: str = ""
    wire: Annotated[WireTable, AnyKind("wire")]
    lumen: Annotated[LumenTable, AnyKind("lumen")]
    field: Annotated[FieldTable, AnyKind("field")] = Field(default={"kind": "uniform"})  # type: ignore[assignment]
    actuator: Annotated[ActuatorTable, AnyKind("actuator")] | None = None
    contact: ContactTable = Field(default={})  # type: ignore[assignment]
    feed: Annotated[FeedTable, AnyKind("feed")]
    navigate: Annotated[NavigatorTable, AnyKind("navigate")] = Field(default={"method": "none"})  # type: ignore[assignment]
    solver: SolverTable = Field(default={})  # type: ignore[assignment]
    environment: EnvironmentTable = Field(default={})  # type: ignore[assignment]
    output: OutputTable = Field(default={})  # type: ignore[assignment]

    def to_toml(self) -> str:
        """The scenario as TOML: complete, with every default written out, and re-runnable."""
        tables = _lists(self.model_dump(exclude_none=True))
        for name, family in FAMILIES.items():
            selector = family.selector
            if selector and name in tables:  # what a table is comes first in it
                tables[name] = {selector: tables[name][selector], **tables[name]}
        return tomli_w.dumps(tables)

    def with_notes(self, notes: tuple[str, ...]) -> Scenario:
        """The scenario with a record of what it was read from, which is no part of it."""
        object.__setattr__(self, "notes", notes)
        return self

    def unsteered(self) -> Scenario:
        """The same scenario with nobody steering."""
        return self.model_copy(update={"navigate": NoSteering(method="none")})

    def build(self) -> Job:
        """The simulation, the feed and the settings of the run.

        Raises
        ------
        ScenarioError
            If a model refuses what the scenario describes.
        """
        from magwire.scenario.job import Job

        return Job.of(self)

    def run(
        self, out: Path | None = None, *, watch: Callable[[Record], None] | None = None
    ) -> Result:
        """Build it and run it.

        Parameters
        ----------
        out
            NetCDF file to write as the run goes; none if left out.
        watch
            Called with every record.

        Raises
        ------
        ScenarioError
            If a model refuses what the scenario describes.
        """
        return self.build().run(out, watch=watch)


def _lists(value: Any) -> Any:
    """The same with lists in place of tuples, as TOML has them."""
    if isinstance(value, dict):
        return {key: _lists(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_lists(entry) for entry in value]
    return value


on_new_kind(lambda: Scenario.model_rebuild(force=True))
