"""The outside field of a scenario's text, whatever stands in its other tables."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, ValidationError

from magwire.errors import ScenarioError
from magwire.field import FieldSource
from magwire.files import TextFaultError, parse_toml
from magwire.scenario.faults import sentence
from magwire.scenario.kind import AnyKind, on_new_kind
from magwire.scenario.kinds import FieldTable
from magwire.scenario.table import Table


class _Alone(Table):
    field: Annotated[FieldTable, AnyKind("field")] = Field(default={"kind": "uniform"})  # type: ignore[assignment]


on_new_kind(lambda: _Alone.model_rebuild(force=True))


def field_of(text: str) -> FieldSource:
    """The outside field of the scenario that a result holds.

    Raises
    ------
    ScenarioError
        With all faults of its table, one sentence each.
    """
    try:
        raw = parse_toml(text)
    except TextFaultError as error:
        raise ScenarioError(f"Scenario 'of the result' is not valid TOML: {error}.") from None
    try:
        table = _Alone.model_validate({key: raw[key] for key in ("field",) if key in raw}).field
    except ValidationError as errors:
        raise ScenarioError([sentence(e) for e in errors.errors(include_url=False)]) from None
    faults = [*table.clashes(), *table.faults()]
    if faults:
        raise ScenarioError(faults)
    return table.build()
