"""Single keys of a scenario set from outside, as in ``--set wire.radius="0.5 mm"``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from magwire.files import TextFaultError, parse_toml


def apply(raw: dict[str, Any], overrides: Sequence[str]) -> list[str]:
    """Set keys of a scenario as read.

    Parameters
    ----------
    raw
        The scenario, changed in place.
    overrides
        ``key=value`` each; the key with dots and, in lists, numbers from zero
        (``wire.sections.0.radius``); the value as in TOML, where a quantity needs no quotes.
        Another ``navigate.method`` than the scenario's starts that table anew, since the keys of
        one method are faults in another; so does a ``wire.device``.

    Returns
    -------
    list
        One sentence for each override that could not be set.
    """
    faults = []
    _restart(raw, overrides)
    for text in overrides:
        key, equals, value = text.partition("=")
        path = [part.strip() for part in key.split(".")]
        if not equals or not all(path):
            faults.append(f"Override {text!r} must read key=value, as in 'wire.radius=0.5 mm'.")
        elif not _put(raw, path, _value(value.strip())):
            faults.append(f"Override {text!r} sets a key inside something that is no table.")
    return faults


def _restart(raw: dict[str, Any], overrides: Sequence[str]) -> None:
    """Forget how a scenario is steered if an override says that it is steered in another way.

    Likewise its wire, if it is to be a device.
    """
    table = raw.get("navigate")
    for text in overrides:
        key, _, value = text.partition("=")
        path = [part.strip() for part in key.split(".")]
        method = path == ["navigate", "method"]
        if method and isinstance(table, dict) and table.get("method") != _value(value.strip()):
            raw["navigate"] = {}
        if path == ["wire", "device"]:
            raw["wire"] = {}


def _value(text: str) -> Any:
    try:
        return parse_toml(f"value = {text}")["value"]
    except TextFaultError:
        return text


def _put(raw: dict[str, Any], path: list[str], value: Any) -> bool:
    place: Any = raw
    for part in path[:-1]:
        if isinstance(place, dict):
            place = place.setdefault(part, {})
        elif _has(place, part):
            place = place[int(part)]
        else:
            return False
    last = path[-1]
    if isinstance(place, dict):
        place[last] = value
    elif _has(place, last):
        place[int(last)] = value
    else:
        return False
    return True


def _has(place: object, part: str) -> bool:
    return isinstance(place, list) and part.isdecimal() and int(part) < len(place)
