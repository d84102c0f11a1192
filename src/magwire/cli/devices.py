"""The command ``magwire devices``."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from magwire.cli.words import say

if TYPE_CHECKING:
    from magwire.devices import Device, Number, Part

WIDTH = 100


def devices(name: str = "", /) -> None:
    """List the devices that can be a scenario's wire, or show where the numbers of one are from.

    Parameters
    ----------
    name
        Show this one: every number, between what it may lie, and its source.
    """
    from magwire.devices import load, names

    if name:
        _show(load(name))
        return
    width = max(map(len, names()))
    for each in names():
        say(f"{each:{width}}  {load(each).description}")


def _show(device: Device) -> None:
    say(f"{device.name}: {device.description}")
    say(f"{1e3 * device.length:.6g} mm long with {device.nodes()} nodes, unless given otherwise.")
    for part in device.parts:
        say()
        say(part.name)
        _show_part(part)
    say()
    say("Sources")
    for key, text in device.sources.items():
        say(textwrap.fill(f"{key}: {text}.", WIDTH, initial_indent="  ", subsequent_indent="    "))


def _show_part(part: Part) -> None:
    rows = [(key, _value(number), number) for key, number in part.numbers.items()]
    first = max(len(key) for key, _, _ in rows)
    second = max(len(value) for _, value, _ in rows)
    third = max(len(_range(number)) for _, _, number in rows)
    for key, value, number in rows:
        origin = f"{number.source}: {number.note}" if number.note else number.source
        say(f"  {key:{first}}  {value:{second}}  {_range(number):{third}}  {origin}")


def _value(number: Number) -> str:
    return number.text if isinstance(number.text, str) else ", ".join(number.text)


def _range(number: Number) -> str:
    return f"({number.between[0]} to {number.between[1]})"
