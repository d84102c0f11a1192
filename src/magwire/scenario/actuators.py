"""An actuator from a file that holds its table: a whole scenario, or the table alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import ValidationError

from magwire.errors import ScenarioError
from magwire.files import TextFaultError, parse_toml
from magwire.scenario.faults import key_of, sentence
from magwire.scenario.kind import FAMILIES, AnyKind, on_new_kind
from magwire.scenario.kinds import ActuatorTable
from magwire.scenario.overrides import apply
from magwire.scenario.reader import text_of
from magwire.scenario.table import Table

if TYPE_CHECKING:
    from magwire.actuate import Actuator


class _Alone(Table):
    actuator: Annotated[ActuatorTable, AnyKind("actuator")]


on_new_kind(lambda: _Alone.model_rebuild(force=True))


def load_actuator(name_or_path: str | Path, overrides: Sequence[str] = ()) -> Actuator:
    """The actuator of a scenario, or of a file that holds nothing but its table.

    Parameters
    ----------
    name_or_path
        Name of a scenario of the library, or a TOML file with a table ``[actuator]``; what else it
        holds is not looked at.
    overrides
        Keys to set, ``key=value`` each, such as ``actuator.max_power=1 kW``.

    Raises
    ------
    ScenarioError
        With all faults of the table, one sentence each.
    """
    text, folder = text_of(name_or_path)
    try:
        raw = parse_toml(text)
    except TextFaultError as error:
        raise ScenarioError(f"Scenario '{name_or_path}' is not valid TOML: {error}.") from None
    faults = apply(raw, overrides)
    table: Any = raw.get("actuator")
    if table is None:
        raise ScenarioError(
            [*faults, f"Scenario '{name_or_path}' must have a table [actuator]; received none."]
        )
    unread: tuple[tuple[str, ...], ...] = ()
    kind = FAMILIES["actuator"].of(table) if isinstance(table, dict) else None
    if kind is not None:
        table, more, unread, *_ = kind.inline(table, folder)
        faults += more
    try:
        described = _Alone.model_validate({"actuator": table}).actuator
    except ValidationError as errors:
        found = [e for e in errors.errors(include_url=False) if key_of(e) not in unread]
        raise ScenarioError([*faults, *map(sentence, found)]) from None
    faults += [] if faults else [*described.clashes(), *described.faults()]
    if faults:
        raise ScenarioError(faults)
    return described.build()
