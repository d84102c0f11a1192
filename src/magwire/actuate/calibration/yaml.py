"""The part of YAML that calibration files use, read strictly.

Mappings, sequences, flow sequences of plain values, numbers, texts, null and comments. Anchors,
tags, block texts and several documents are refused: none has a place in a table of numbers.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from magwire.errors import InputError
from magwire.files import read_text

Value = None | bool | float | int | str | list["Value"] | dict[str, "Value"]

KEY = re.compile(r"""^("[^"]*"|'[^']*'|[^\s"'\[\]{}#&*!|>%@`,-][^:#]*?)\s*:(?:\s+(.*))?$""")
DEEPEST = 16
LONGEST = 100_000
INTEGER = re.compile(r"^[-+]?\d{1,18}$")
NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")
SPECIAL = {
    ".nan": float("nan"),
    ".inf": float("inf"),
    "+.inf": float("inf"),
    "-.inf": -float("inf"),
    "nan": float("nan"),
}


class _Line(NamedTuple):
    number: int
    indent: int
    text: str


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
    lines: list[_Line] = []
    for number, raw in enumerate(text.split("\n"), start=1):
        bare = _without_comment(raw).rstrip()
        if not bare.strip() or bare.startswith("%"):
            continue
        if bare.strip() in ("---", "..."):
            if lines and bare.startswith("---"):
                raise _FaultError(f"line {number} begins a second document")
            continue
        indent = len(bare) - len(bare.lstrip(" "))
        if bare[indent] == "\t":
            raise _FaultError(f"line {number} is indented by a tabulator, not by blanks")
        lines.append(_Line(number, indent, bare[indent:]))
    if len(lines) > LONGEST:
        raise _FaultError(f"it has {len(lines)} lines, {LONGEST} at most are read")
    if not lines:
        return None
    value, rest = _block(lines, 0, lines[0].indent, 0)
    if rest < len(lines):
        raise _FaultError(f"line {lines[rest].number} is indented like no line above it")
    return value


def _without_comment(line: str) -> str:
    quote = ""
    for i, mark in enumerate(line):
        if quote:
            quote = "" if mark == quote else quote
        elif mark in "\"'":
            quote = mark
        elif mark == "#" and (i == 0 or line[i - 1] in " \t"):
            return line[:i]
    return line


def _block(lines: list[_Line], at: int, indent: int, depth: int) -> tuple[Value, int]:
    """What begins at line ``at`` with this indentation, and the line after it."""
    if depth > DEEPEST:
        raise _FaultError(f"line {lines[at].number} is nested more than {DEEPEST} deep")
    if _is_item(lines[at]):
        return _sequence(lines, at, indent, depth)
    if KEY.match(lines[at].text):
        return _mapping(lines, at, indent, depth)
    return _scalar(lines[at].text, lines[at].number), at + 1


def _is_item(line: _Line) -> bool:
    return line.text == "-" or line.text.startswith("- ")


def _sequence(lines: list[_Line], at: int, indent: int, depth: int) -> tuple[Value, int]:
    items: list[Value] = []
    while at < len(lines) and lines[at].indent == indent and _is_item(lines[at]):
        line = lines[at]
        rest = line.text[1:].lstrip()
        if rest:  # what follows the dash is a block of its own, indented as far as it stands
            inner = indent + len(line.text) - len(rest)
            lines[at] = _Line(line.number, inner, rest)
            value, at = _block(lines, at, inner, depth + 1)
        else:
            value, at = _nested(lines, at + 1, indent, depth, items_may_align=False)
        items.append(value)
    return items, at


def _mapping(lines: list[_Line], at: int, indent: int, depth: int) -> tuple[Value, int]:
    made: dict[str, Value] = {}
    while at < len(lines) and lines[at].indent == indent and not _is_item(lines[at]):
        line = lines[at]
        match = KEY.match(line.text)
        if match is None:
            raise _FaultError(f"line {line.number} is no key with a value")
        key = match[1].strip("\"'")
        if key in made:
            raise _FaultError(f"line {line.number} gives '{key}' a second time")
        if match[2]:
            made[key], at = _scalar(match[2], line.number), at + 1
        else:
            made[key], at = _nested(lines, at + 1, indent, depth, items_may_align=True)
    return made, at


def _nested(
    lines: list[_Line], at: int, indent: int, depth: int, *, items_may_align: bool
) -> tuple[Value, int]:
    """The block below a key or a dash; null if there is none."""
    if at < len(lines):
        deeper = lines[at].indent > indent
        aligned = items_may_align and lines[at].indent == indent and _is_item(lines[at])
        if deeper or aligned:
            return _block(lines, at, lines[at].indent, depth + 1)
    return None, at


def _scalar(text: str, number: int) -> Value:
    if text[0] == "[":
        if text[-1] != "]" or "[" in text[1:] or "{" in text:
            raise _FaultError(f"line {number} has a list that does not end on it or is nested")
        inner = text[1:-1].strip()
        return [_scalar(part.strip(), number) if part.strip() else None for part in _split(inner)]
    if text[0] in "&*!|>{%@`":
        raise _FaultError(f"line {number} uses '{text[0]}', which is not read")
    if text[0] in "\"'":
        if len(text) < 2 or text[-1] != text[0]:
            raise _FaultError(f"line {number} has a text that does not end on it")
        return text[1:-1]
    return _plain(text)


def _split(text: str) -> list[str]:
    return text.split(",") if text else []


def _plain(text: str) -> Value:
    if text in ("~", "null", "Null", "NULL"):
        return None
    if text in ("true", "false"):
        return text == "true"
    if INTEGER.match(text):
        return int(text)
    if NUMBER.match(text):
        return float(text)
    return SPECIAL.get(text.lower(), text)
