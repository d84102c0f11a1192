"""The library of devices: TOML files that come with magwire."""

from __future__ import annotations

import difflib
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from magwire.devices.device import DIMENSIONS, Device, Number, Part
from magwire.errors import InputError
from magwire.units import parse


def names() -> tuple[str, ...]:
    """Names of the devices that come with magwire."""
    entries = files("magwire.devices").joinpath("library").iterdir()
    return tuple(sorted(e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml")))


def load(name: str) -> Device:
    """A device of the library.

    Parameters
    ----------
    name
        One of ``names()``.

    Raises
    ------
    InputError
        If there is none of this name.
    """
    if name not in names():
        near = difflib.get_close_matches(str(name), names(), n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names())}."
        raise InputError(f"There is no device '{name}'; {hint}")
    return _read(name)


@cache
def _read(name: str) -> Device:
    text = files("magwire.devices").joinpath("library", f"{name}.toml").read_text("utf-8")
    return _device(name, tomllib.loads(text))


def _device(name: str, raw: dict[str, Any]) -> Device:
    return Device(
        name=name,
        description=raw["description"],
        parts=tuple(_part(table) for table in raw["sections"]),
        edge_length=parse(raw["edge_length"], "length", "edge_length"),
        sources=raw["sources"],
    )


def _part(raw: dict[str, Any]) -> Part:
    return Part(raw["name"], {key: _number(raw[key]) for key in DIMENSIONS if key in raw})


def _number(raw: dict[str, Any]) -> Number:
    value, (low, high) = raw["value"], raw["between"]
    text = value if isinstance(value, str) else tuple(value)
    return Number(text, (low, high), raw["source"], raw["note"])
