"""The public interface as text; ``python tests/public.py`` renews ``tests/data/public_api.txt``."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import magwire

SNAPSHOT = Path(__file__).parent / "data" / "public_api.txt"
MODULES = (magwire, __import__("magwire.actuate", fromlist=["actuate"]))


def snapshot() -> str:
    """Every public name with its signature; of a class its public members, too, a line each."""
    return "".join(f"{line}\n" for module in MODULES for line in _module(module))


def _module(module: Any) -> Iterator[str]:
    for name in sorted(module.__all__):
        value = getattr(module, name)
        yield from _lines(f"{module.__name__}.{name}", value)


def _lines(name: str, value: Any) -> Iterator[str]:
    if inspect.isclass(value):
        yield f"class {name}{_signature(value)}"
        for member, owner in sorted(_members(value).items()):
            yield from _member(f"{name}.{member}", owner.__dict__[member])
    elif callable(value):
        yield f"{name}{_signature(value)}"
    else:
        yield name


def _members(kind: type) -> dict[str, type]:
    """Public members by name, and the class of magwire's that has each."""
    ours = [base for base in kind.__mro__ if base.__module__.startswith("magwire")]
    given = {*getattr(kind, "__dataclass_fields__", ()), *getattr(kind, "_fields", ())}
    return {
        name: base
        for base in reversed(ours)
        for name in vars(base)
        if not name.startswith(("_", "model_")) and name not in given  # pydantic's, listed
    }


def _member(name: str, value: Any) -> Iterator[str]:
    function = getattr(value, "__func__", value)
    if inspect.isfunction(function):
        yield f"{name}{_signature(function)}"
    else:
        yield name


def _signature(value: Any) -> str:
    try:
        found = inspect.signature(value)
    except ValueError:  # of an exception, which has none of its own
        return ""
    if list(found.parameters) == ["args", "kwargs"]:  # of a protocol
        return ""
    back = found.return_annotation
    gives = "" if back is found.empty or inspect.isclass(value) else f" -> {_annotation(back)}"
    return f"({', '.join(_parameters(found.parameters.values()))}){gives}"


def _parameters(parameters: Any) -> Iterator[str]:
    """Parameters with annotations as they are written, the same in every version of Python."""
    starred = False
    for one in parameters:
        if one.name in ("self", "cls"):
            continue
        if one.kind is one.KEYWORD_ONLY and not starred:
            starred = True
            yield "*"
        starred |= one.kind is one.VAR_POSITIONAL
        stars = {one.VAR_POSITIONAL: "*", one.VAR_KEYWORD: "**"}.get(one.kind, "")
        note = "" if one.annotation is one.empty else f": {_annotation(one.annotation)}"
        default = "" if one.default is one.empty else f" = {_default(one.default)}"
        yield f"{stars}{one.name}{note}{default}"


def _annotation(value: Any) -> str:
    if isinstance(value, str):
        return value
    return getattr(value, "__forward_arg__", None) or getattr(value, "__name__", str(value))


def _default(value: Any) -> str:
    plain = value is None or isinstance(value, (bool, int, float, str, tuple))
    return repr(value) if plain else "..."


if __name__ == "__main__":
    SNAPSHOT.write_text(snapshot(), encoding="utf-8")
