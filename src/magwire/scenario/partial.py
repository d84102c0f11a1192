"""What can be made of a scenario with faults, so that the checks across tables find theirs, too."""

from __future__ import annotations

from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, TypeAdapter
from pydantic.fields import FieldInfo

from magwire.scenario.faults import Key
from magwire.scenario.kind import FAMILIES
from magwire.scenario.kinds.wire.sections import SectionTable
from magwire.scenario.model import Scenario

Model = TypeVar("Model", bound=BaseModel)


def partial_scenario(raw: dict[str, Any], faulty: set[Key]) -> Scenario:
    """The scenario without what is faulty.

    Parameters
    ----------
    raw
        The scenario as read.
    faulty
        Keys that have a fault.

    Returns
    -------
    Scenario
        Not validated as a whole; asking for a key that is faulty raises FaultyKeyError.
    """
    tables: dict[str, Any] = {}
    for name, field in Scenario.model_fields.items():
        if (name,) in faulty:
            continue
        given = raw.get(name, field.default)
        if given is None:
            tables[name] = None
        elif name in FAMILIES:
            kind = FAMILIES[name].of(given)
            if kind is not None:
                tables[name] = _table(kind, given, (name,), faulty)
        elif isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel):
            tables[name] = _table(field.annotation, given, (name,), faulty)
    return _bare(Scenario, tables)


def _table(model: type[BaseModel], raw: dict[str, Any], at: Key, faulty: set[Key]) -> BaseModel:
    values: dict[str, Any] = {}
    for name, field in model.model_fields.items():
        key = (*at, name)
        if name == "sections":
            entries = raw.get(name)
            if isinstance(entries, list) and entries and all(isinstance(e, dict) for e in entries):
                values[name] = tuple(
                    _table(SectionTable, entry, (*key, i), faulty)
                    for i, entry in enumerate(entries)
                )
        elif not any(fault[: len(key)] == key for fault in faulty):
            values[name] = _value(field, raw.get(name, field.default))
    return _bare(model, values)


def _value(field: FieldInfo, raw: Any) -> Any:
    kind: Any = field.annotation
    for note in field.metadata:
        kind = Annotated[kind, note]
    return TypeAdapter(kind).validate_python(raw)


def _bare(model: type[Model], values: dict[str, Any]) -> Model:
    """A model that holds these values and nothing else, not even defaults."""
    made = model.model_construct()
    object.__setattr__(made, "__dict__", values)
    return made
