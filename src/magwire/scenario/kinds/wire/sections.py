"""A wire of several sections, or a device of the library, whose sections take its place."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import ConfigDict

from magwire.devices import load
from magwire.errors import InputError
from magwire.scenario.kind import Faults, Inlined, kind
from magwire.scenario.kinds.wire import WireTable
from magwire.scenario.kinds.wire.make import MakeTable
from magwire.scenario.quantity import SLACK, Nodes, at_least_one
from magwire.units import parse, show

if TYPE_CHECKING:
    from magwire.wire import Section, Wire

ALLOWED = ("device", "length", "nodes")
"""Keys of a wire that is a device."""


def _schema(table: dict[str, Any]) -> None:
    """Change the JSON schema of a table of sections: a device may stand in their place."""
    table.pop("required", None)
    table["anyOf"] = [{"required": ["nodes", "sections"]}, {"required": ["device"]}]
    table["properties"]["length"] = {
        "type": "string",
        "description": "of a device: its length, which its proximal section makes up",
        "examples": ["150 mm"],
    }


class SectionTable(MakeTable):
    """A stretch of wire of one make."""

    def build(self) -> Section:
        """The section as a model."""
        return self.make().section(self.length)


@kind
class SectionedWire(WireTable):
    """A wire of several sections, the proximal one first; ``device`` says where they are from."""

    model_config = ConfigDict(json_schema_extra=_schema)
    ruled_by = ("sections", "device")
    magnet_key = "sections"

    device: str = ""
    nodes: Nodes
    sections: Annotated[tuple[SectionTable, ...], at_least_one("section")]

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return sum(section.length for section in self.sections)

    @property
    def largest_radius(self) -> float:
        """Largest outer radius [m]."""
        return max(section.largest_radius for section in self.sections)

    @property
    def magnetized(self) -> bool:
        """Whether any section is."""
        return any(section.magnetized for section in self.sections)

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the sections of its device, whose name it keeps."""
        if "device" not in table or "sections" in table:
            return Inlined(table, [])
        faults = [
            f"Input wire.{key} cannot stand next to wire.device, whose sections say what it is; "
            "remove one of them."
            for key in table
            if key not in ALLOWED
        ]
        try:
            device = load(table["device"])
            length = parse(table["length"], "length", "wire.length") if "length" in table else None
            made = {
                "device": device.name,
                "nodes": table.get("nodes", device.nodes(length)),
                "sections": device.tables(length),
            }
        except InputError as error:
            return Inlined(None, [*faults, str(error)])
        return Inlined(None if faults else made, faults)

    def clashes(self) -> Faults:
        """What each section is made of is said once, and nothing is left out."""
        for i, section in enumerate(self.sections):
            yield from section.contradictions(f"wire.sections[{i}]")

    def faults(self) -> Faults:
        """Walls have some thickness, and the mesh resolves every magnetised section."""
        if not any(self.clashes()):
            for i, section in enumerate(self.sections):
                yield from section.thin_walls(f"wire.sections[{i}]")
        for i, section in enumerate(self.sections):
            least = math.ceil(self.total_length / section.length * (1.0 - SLACK)) + 1
            if section.magnetized and self.nodes < least:
                yield (
                    f"Input wire.nodes must be at least {least} for the magnetised "
                    f"wire.sections[{i}] of {show(section.length, 'length')} to span one edge; "
                    f"received {self.nodes}."
                )

    def create(self) -> Wire:
        """The wire as a model."""
        from magwire.wire import Wire

        return Wire(tuple(section.build() for section in self.sections), self.nodes)
