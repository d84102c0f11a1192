"""A wire of one make, with a magnetised tip."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from magwire.scenario.kind import Faults, kind
from magwire.scenario.kinds.wire import WireTable
from magwire.scenario.kinds.wire.make import MakeTable
from magwire.scenario.quantity import SLACK, LengthOrZero, Nodes
from magwire.scenario.table import preset
from magwire.units import show

if TYPE_CHECKING:
    from magwire.wire import Wire


@kind
class UniformWire(MakeTable, WireTable):
    """A wire of one make with, if wanted, its distal end magnetised."""

    magnet_key = "magnetization"
    nodes: Nodes
    magnetized_tip: LengthOrZero = preset("0 mm")

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        return self.length

    @property
    def width_key(self) -> str:
        """The key that says how wide the wire is, radius or diameter."""
        return "diameter" if self.radius is None else "radius"

    def clashes(self) -> Faults:
        """What it is made of is said once, and nothing is left out."""
        return self.contradictions("wire")

    def faults(self) -> Faults:
        """Its wall has some thickness; the tip is part of the wire, and the mesh resolves it."""
        if not any(self.clashes()):
            yield from self.thin_walls("wire")
        if self.magnetized:
            yield from self._tip()

    def _tip(self) -> Faults:
        tip, received = self.magnetized_tip, show(self.magnetized_tip, "length")
        if tip == 0.0:
            yield (
                f"Input wire.magnetized_tip must be positive for a wire with wire.{self.magnet}; "
                f"received {received}."
            )
        elif tip > self.length * (1.0 + SLACK):
            yield (
                "Input wire.magnetized_tip must be at most wire.length, "
                f"{show(self.length, 'length')}; received {received}."
            )
        else:
            least = math.ceil(self.length / tip * (1.0 - SLACK)) + 1
            if self.nodes < least:
                yield (
                    f"Input wire.nodes must be at least {least} for a magnetised tip of {received} "
                    f"to span one edge; received {self.nodes}."
                )

    def create(self) -> Wire:
        """The wire as a model."""
        from magwire.wire import Wire

        return Wire.of(self.make(), self.length, self.nodes, magnetized_tip=self.magnetized_tip)
