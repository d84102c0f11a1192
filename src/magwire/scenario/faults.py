"""What is wrong with a scenario, one plain sentence each."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from magwire.errors import received
from magwire.scenario.kind import FAMILIES
from magwire.scenario.model import Scenario
from magwire.scenario.quantity import FAULT

Key = tuple[str | int, ...]


def key_of(error: ErrorDetails) -> Key:
    """Where the fault is, as keys of the file: the make of a table is no key of its own."""
    loc = error["loc"]
    if len(loc) > 1 and loc[0] in FAMILIES:
        return (loc[0], *loc[2:])
    return loc


def sentence(error: ErrorDetails) -> str:
    """The fault in words."""
    key, kind, given = key_of(error), error["type"], error["input"]
    context = error.get("ctx", {})
    name = spell(key)
    if kind == FAULT:
        return f"Input {name} {context['text']}."
    if kind == "missing":
        return f"Input {name} is missing; expected {_expected(error['loc'])}."
    if kind == "extra_forbidden":
        return _unknown(error["loc"], key)
    if kind in ("model_type", "model_attributes_type", "dict_type") or (
        kind.startswith("union_tag") and not isinstance(given, dict)
    ):
        return f"Input {name} must be a table; received {received(given)}."
    if kind.startswith("union_tag"):
        return _choice(name, given)
    if kind == "literal_error":
        return f"Input {name} must be {context['expected']}; received {received(given)}."
    if kind.startswith("bool"):
        return f"Input {name} must be true or false; received {received(given)}."
    if kind == "string_type":
        return f"Input {name} must be text; received {received(given)}."
    if kind in ("tuple_type", "list_type"):
        return f"Input {name} must be a list of tables; received {received(given)}."
    return f"Input {name}: {error['msg']}; received {received(given)}."


def spell(key: Iterable[str | int]) -> str:
    """The key as people write it, ``wire.sections[0].radius``."""
    text = ""
    for part in key:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else str(part)
    return text


def suggestion(word: str, known: Sequence[str], note: str = "expected one of") -> str:
    """What may have been meant: the closest words, or all that are known."""
    close = difflib.get_close_matches(word, known, n=3, cutoff=0.6)
    if close:
        words = [f"'{name}'" for name in close]
        first = ", ".join(words[:-1]) + " or " if len(words) > 1 else ""
        return f"did you mean {first}{words[-1]}?"
    return f"{note} " + ", ".join(f"'{name}'" for name in known) + "."


def _choice(name: str, given: dict[str, Any]) -> str:
    """A lumen without a known shape, or a field without a known kind."""
    selector, makes = FAMILIES[name].selector, FAMILIES[name].kinds
    words = ", ".join(f"'{make}'" for make in makes)
    if selector not in given:
        return f"Input {name}.{selector} is missing; expected one of {words}."
    value = given[selector]
    if not isinstance(value, str):
        return f"Input {name}.{selector} must be one of {words}; received {received(value)}."
    close = difflib.get_close_matches(value, makes, n=1)
    hint = f", did you mean '{close[0]}'?" if close else "."
    return f"Input {name}.{selector} must be one of {words}; received {value!r}{hint}"


def _unknown(loc: Key, key: Key) -> str:
    model = _model_at(loc[:-1])
    word, table = str(key[-1]), spell(key[:-1])
    clash = _clash(loc, key)
    if clash:
        return clash
    where = f"[{table}]" if table else "the scenario"
    if len(key) == 2 and table in FAMILIES and FAMILIES[table].selector:
        where += f" with {FAMILIES[table].selector} '{loc[1]}'"
    known = list(model.model_fields) if model else []
    return f"Input {spell(key)} is not a key of {where}; {suggestion(word, known)}"


def _clash(loc: Key, key: Key) -> str:
    """The message for a key that another key rules out, "" if it is simply unknown."""
    family = FAMILIES.get(str(key[0])) if len(key) == 2 else None
    if family is None or family.selector:
        return ""
    ruled_by = family.kinds[str(loc[1])].ruled_by
    others = (table.model_fields for table in family.kinds.values())
    if ruled_by and any(key[1] in keys for keys in others):
        return (
            f"Input {spell(key)} cannot stand next to {family.name}.{ruled_by[0]}; remove one of "
            "them."
        )
    return ""


def _expected(loc: Key) -> str:
    """What a missing key should have been."""
    model = _model_at(loc[:-1])
    field = model.model_fields.get(str(loc[-1])) if model else None
    for note in field.metadata if field else ():
        if hasattr(note, "expected"):
            return str(note.expected)
    return "a table" if len(loc) == 1 else "a value"


def _model_at(loc: Key) -> type[BaseModel] | None:
    """The model of the table at a place of pydantic's."""
    if not loc:
        return Scenario
    if loc[0] in FAMILIES:
        kind = FAMILIES[str(loc[0])].kinds.get(str(loc[1])) if len(loc) > 1 else None
        return _inside(kind, loc[2:])
    return _inside(Scenario, loc)


def _inside(model: type[BaseModel] | None, keys: Key) -> type[BaseModel] | None:
    """The model of a table inside of another, itself or in a list."""
    for key in keys:
        if isinstance(key, str):
            field = model.model_fields.get(key) if model else None
            model = _table_in(field.annotation) if field else None
    return model


def _table_in(annotation: Any) -> type[BaseModel] | None:
    """The table that a key holds, or holds a list of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    found = (_table_in(part) for part in get_args(annotation))
    return next((table for table in found if table is not None), None)
