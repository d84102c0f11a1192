"""What to know of a device, as lines of text."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from magwire.devices import Device, Number, Part

WIDTH = 100


def lines(device: Device) -> Iterator[str]:
    """Every number of a device, between what it may lie, and its source; a line each."""
    yield f"{device.name}: {device.description}"
    yield f"{1e3 * device.length:.6g} mm long with {device.nodes()} nodes, unless given otherwise."
    for part in device.parts:
        yield ""
        yield part.name
        yield from _part(part)
    yield ""
    yield "Sources"
    for key, text in device.sources.items():
        yield textwrap.fill(f"{key}: {text}.", WIDTH, initial_indent="  ", subsequent_indent="    ")


def _part(part: Part) -> Iterator[str]:
    rows = [(key, _value(number), number) for key, number in part.numbers.items()]
    first = max(len(key) for key, _, _ in rows)
    second = max(len(value) for _, value, _ in rows)
    third = max(len(_range(number)) for _, _, number in rows)
    for key, value, number in rows:
        origin = f"{number.source}: {number.note}" if number.note else number.source
        yield f"  {key:{first}}  {value:{second}}  {_range(number):{third}}  {origin}"


def _value(number: Number) -> str:
    return number.text if isinstance(number.text, str) else ", ".join(number.text)


def _range(number: Number) -> str:
    return f"({number.between[0]} to {number.between[1]})"
