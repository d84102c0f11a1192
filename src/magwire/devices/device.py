"""A device: sections of wire, of which every number has a source and a range."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from magwire.errors import InputError, finite
from magwire.units import parse, write
from magwire.wire import Make, Wire

DIMENSIONS = {
    "length": "length",
    "diameter": "diameter",
    "inner_diameter": "diameter",
    "taper_to": "diameter",
    "youngs_modulus": "pressure",
    "shear_modulus": "pressure",
    "poisson_ratio": "dimensionless",
    "bending_stiffness": "bending_stiffness",
    "density": "density",
    "magnetization": "magnetization",
    "remanence": "flux_density",
    "rest_curvature": "curvature",
}
"""What the number of each key is; the keys mean what they mean in ``[[wire.sections]]``."""

Text = str | tuple[str, ...]


@dataclass(frozen=True)
class Number:
    """A number of a device, as it is written, and where it comes from.

    Attributes
    ----------
    text
        The value with its unit, or several of a vector.
    between
        Lowest and highest value that it may have, with units; of a vector its length.
    source
        A key of the device's sources.
    note
        How it follows from the source; empty if it stands there.
    """

    text: Text
    between: tuple[str, str]
    source: str
    note: str

    def value(self, key: str) -> float | tuple[float, ...]:
        """In SI; ``key`` is what the device calls it."""
        if isinstance(self.text, str):
            return self._si(self.text, key)
        return tuple(self._si(text, key) for text in self.text)

    def range(self, key: str) -> tuple[float, float]:
        """Lowest and highest value in SI."""
        low, high = (self._si(text, key) for text in self.between)
        return low, high

    def scenario(self, key: str) -> Any:
        """As a scenario has it: numbers without unit are numbers there."""
        if DIMENSIONS[key] == "dimensionless":
            return self.value(key)
        return self.text if isinstance(self.text, str) else list(self.text)

    @staticmethod
    def _si(text: str, key: str) -> float:
        plain = DIMENSIONS[key] == "dimensionless"
        return parse(float(text) if plain else text, DIMENSIONS[key], key)


@dataclass(frozen=True)
class Part:
    """A section of a device: its name, and its numbers by their keys."""

    name: str
    numbers: Mapping[str, Number]

    @property
    def length(self) -> float:
        """Along the wire [m]."""
        value = self.numbers["length"].value("length")
        assert isinstance(value, float)
        return value


@dataclass(frozen=True)
class Device:
    """A real device, to be had as a wire.

    Attributes
    ----------
    name
        As scenarios call it.
    description
        One sentence.
    parts
        From the proximal end to the tip; the first one is as long as is wanted.
    edge_length
        Distance between nodes that resolves it [m].
    sources
        What the numbers refer to, by their keys.
    """

    name: str
    description: str
    parts: tuple[Part, ...]
    edge_length: float
    sources: Mapping[str, str]

    @property
    def length(self) -> float:
        """Length if no other one is asked for [m]."""
        return math.fsum(part.length for part in self.parts)

    def wire(self, *, length: float | None = None, nodes: int | None = None) -> Wire:
        """The device as a wire.

        Parameters
        ----------
        length
            Length [m], which the proximal section makes up; the device's own if left out.
        nodes
            Number of nodes; so many that they resolve the device if left out.

        Raises
        ------
        InputError
            If the length leaves nothing for the proximal section, or a section is shorter than
            the distance between nodes.
        """
        lengths = self.lengths(length)
        count = self.nodes(length) if nodes is None else nodes
        sections = []
        for part, long in zip(self.parts, lengths, strict=True):
            given: dict[str, Any] = {
                key: number.value(key) for key, number in part.numbers.items() if key != "length"
            }
            sections.append(Make(**given).section(long))
        return Wire(tuple(sections), count)

    def lengths(self, length: float | None = None) -> tuple[float, ...]:
        """Lengths of the sections [m] of a device that is so long [m]; see ``wire``."""
        distal = tuple(part.length for part in self.parts[1:])
        if length is None:
            return (self.parts[0].length, *distal)
        first = finite("Device", "length", length, "m") - math.fsum(distal)
        if first < self.edge_length:
            least = math.fsum(distal) + self.edge_length
            raise InputError(
                f"Input length of Device '{self.name}' must be at least {least:.6g} m, to hold "
                f"its distal sections and an edge of its {self.parts[0].name}; received "
                f"{length:.6g} m."
            )
        return (first, *distal)

    def nodes(self, length: float | None = None) -> int:
        """How many nodes resolve a device that is so long [m]."""
        whole = self.length if length is None else length
        return max(math.ceil(whole / self.edge_length * (1.0 - 1e-9)) + 1, 5)

    def tables(self, length: float | None = None) -> list[dict[str, Any]]:
        """The sections as tables of a scenario, for a length [m] as in ``wire``."""
        tables = []
        for part, long in zip(self.parts, self.lengths(length), strict=True):
            given = {key: number.scenario(key) for key, number in part.numbers.items()}
            tables.append({**given, "length": write(long, "length")})
        return tables
