"""A device of the library in a scenario: its sections take its place."""

from __future__ import annotations

from typing import Any

from magwire.devices import load
from magwire.errors import InputError
from magwire.units import parse

ALLOWED = ("device", "length", "nodes")


def inline(wire: dict[str, Any]) -> tuple[dict[str, Any] | None, list[str]]:
    """The table of a wire with the sections of its device.

    Parameters
    ----------
    wire
        The table as read, with a key ``device`` and no ``sections``.

    Returns
    -------
    dict or None
        The table with sections and number of nodes; it keeps the name of the device. None if it
        cannot be made.
    list
        A sentence for each fault.
    """
    faults = [
        f"Input wire.{key} cannot stand next to wire.device, whose sections say what it is; "
        "remove one of them."
        for key in wire
        if key not in ALLOWED
    ]
    try:
        device = load(wire["device"])
        length = parse(wire["length"], "length", "wire.length") if "length" in wire else None
        made = {
            "device": device.name,
            "nodes": wire.get("nodes", device.nodes(length)),
            "sections": device.tables(length),
        }
    except InputError as error:
        return None, [*faults, str(error)]
    return (None if faults else made), faults


def schema(table: dict[str, Any]) -> None:
    """Change the JSON schema of a table of sections: a device may stand in their place."""
    table.pop("required", None)
    table["anyOf"] = [{"required": ["nodes", "sections"]}, {"required": ["device"]}]
    table["properties"]["length"] = {
        "type": "string",
        "description": "of a device: its length, which its proximal section makes up",
        "examples": ["150 mm"],
    }
