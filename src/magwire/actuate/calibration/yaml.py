"""Calibration files in YAML, read strictly.

Plain values are what YAML 1.2 says: 1e-05 is a number, which PyYAML by itself takes for a text.
Anchors, tags and several documents are refused: none has a place in a table of numbers.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from magwire.errors import InputError
from magwire.files import read_text

if TYPE_CHECKING:
    from collections.abc import Iterator

Value = None | bool | float | int | str | list["Value"] | dict[str, "Value"]

DEEPEST = 16
LONGEST = 1_000_000
INTEGER = re.compile(r"^[-+]?\d{1,18}$")
NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")
SPECIAL = {
    ".nan": float("nan"),
    ".inf": float("inf"),
    "+.inf": float("inf"),
    "-.inf": -float("inf"),
    "nan": float("nan"),
}


class _FaultError(Exception):
    """What is wrong, without the file's name."""


def read(path: Path, kind: str) -> dict[str, Value]:
    """The mapping in a file.

    Parameters
    ----------
    path
        The file.
    kind
        What messages call it, such as "Calibration file".

    Raises
    ------
    InputError
        If it cannot be read, or is not of this part of YAML.
    """
    try:
        found = parse(read_text(path))
    except FileNotFoundError:
        raise InputError(f"{kind} '{path}' does not exist.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{kind} '{path}' cannot be read: {error}.") from None
    except _FaultError as fault:
        raise InputError(f"{kind} '{path}' cannot be read: {fault}.") from None
    if not isinstance(found, dict):
        raise InputError(f"{kind} '{path}' must be a mapping of keys; received no key.")
    return found


def parse(text: str) -> Value:
    """What a text says."""
    import yaml

    if len(text) > LONGEST:
        raise _FaultError(f"it has {len(text)} characters, {LONGEST} at most are read")
    events = yaml.parse(text, Loader=yaml.SafeLoader)
    try:
        found: Value = None
        begun = False
        for event in events:
            if isinstance(event, yaml.DocumentStartEvent):
                if begun:
                    raise _at(event, "begins a second document")
                begun = True
                found = _value(next(events), events, 0)
    except yaml.MarkedYAMLError as error:
        mark, problem = error.problem_mark or error.context_mark, error.problem or error.context
        line = "" if mark is None else f"line {mark.line + 1}: "
        raise _FaultError(f"{line}{problem}") from None
    except yaml.YAMLError:
        raise _FaultError("it has characters that no text has") from None
    return found


def _value(event: Any, events: Iterator[Any], depth: int) -> Value:
    """What begins with an event."""
    import yaml

    if depth > DEEPEST:
        raise _at(event, f"is nested more than {DEEPEST} deep")
    if isinstance(event, yaml.AliasEvent) or event.anchor is not None:
        raise _at(event, "uses an anchor, which is not read")
    if event.tag is not None:
        raise _at(event, f"uses the tag {event.tag}, which is not read")
    if isinstance(event, yaml.ScalarEvent):
        return _plain(event.value) if event.style is None else str(event.value)
    if isinstance(event, yaml.SequenceStartEvent):
        items = _until(yaml.SequenceEndEvent, events)
        return [_value(item, events, depth + 1) for item in items]
    made: dict[str, Value] = {}
    for key in _until(yaml.MappingEndEvent, events):
        if not isinstance(key, yaml.ScalarEvent):
            raise _at(key, "has a key that is no name")
        if key.value in made:
            raise _at(key, f"gives '{key.value}' a second time")
        made[key.value] = _value(next(events), events, depth + 1)
    return made


def _until(end: type, events: Iterator[Any]) -> Iterator[Any]:
    """Events up to one that ends what they are in."""
    for event in events:
        if isinstance(event, end):
            return
        yield event


def _at(event: Any, what: str) -> _FaultError:
    return _FaultError(f"line {event.start_mark.line + 1} {what}")


def _plain(text: str) -> Value:
    if text in ("", "~", "null", "Null", "NULL"):
        return None
    if text in ("true", "false"):
        return text == "true"
    if INTEGER.match(text):
        return int(text)
    if NUMBER.match(text):
        return float(text)
    return SPECIAL.get(text.lower(), text)
