"""What a wire looks like, from the scenario of its result: radius and magnets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magwire.files import TextFaultError, parse_toml
from magwire.units import parse

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
UNKNOWN = 0.2
"""Radius of a wire that was set up in Python, over that of its lumen: results do not say it."""


def tables(data: xr.Dataset) -> dict[str, Any]:
    """The scenario of a result; empty for a run that was set up in Python."""
    try:
        return parse_toml(str(data.attrs.get("scenario", "")))
    except TextFaultError:
        return {}


def sections(data: xr.Dataset) -> list[dict[str, Any]]:
    """Tables of the wire's sections, the proximal one first; the wire's own if it has none."""
    wire = tables(data).get("wire", {})
    found = wire.get("sections") or [wire] if isinstance(wire, dict) else []
    return [section for section in found if isinstance(section, dict)]


def radius(data: xr.Dataset) -> float | None:
    """Outer radius of the wire at its tip [m]; None if the result does not say it."""
    for section in reversed(sections(data)):
        for name, factor in (("radius", 1.0), ("diameter", 0.5)):
            if name in section:
                return factor * parse(section[name], "length", name)
    return None


def on_axis(data: xr.Dataset) -> bool:
    """Whether the wall holds the wire's centreline and not its surface (P-12)."""
    contact = tables(data).get("contact", {})
    return isinstance(contact, dict) and contact.get("wall") == "centreline"


def entrance(data: xr.Dataset) -> Array:
    """Where the wire comes in, shape (3,) [m]."""
    return np.asarray(data["way"].values[0], dtype=np.float64)


def magnets(data: xr.Dataset) -> NDArray[np.bool_]:
    """Which nodes lie in a magnet, shape (nodes,): the distal one, and those of the scenario."""
    station = np.linspace(0.0, float(data.attrs["length_scale"]), data.sizes["node"])
    slack = 1e-6 * station[-1]

    def between(begin: float, end: float) -> NDArray[np.bool_]:
        return np.asarray((station >= begin - slack) & (station <= end + slack))

    found = between(float(data.attrs["magnet_begin"]), float(data.attrs["magnet_end"]))
    parts = sections(data)
    if len(parts) > 1 and all("length" in part for part in parts):
        end = 0.0
        for part in parts:
            begin, end = end, end + parse(part["length"], "length", "length")
            if _magnetised(part):
                found |= between(begin, end)
    return found


def _magnetised(part: dict[str, Any]) -> bool:
    for name in ("magnetization", "remanence"):
        given = part.get(name, [])
        values = given if isinstance(given, list) else [given]
        if any(float(str(value).split()[0]) != 0.0 for value in values):
            return True
    return False
