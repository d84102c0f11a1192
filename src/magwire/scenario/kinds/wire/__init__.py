"""Kinds of wire, and what they have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from magwire.scenario.kind import ModelTable

if TYPE_CHECKING:
    from magwire.wire import Wire


class WireTable(ModelTable):
    """A kind of wire."""

    family = "wire"
    magnet_key: ClassVar[str]
    """The key that says how the wire is magnetised."""

    @property
    def total_length(self) -> float:
        """Length of the wire [m]."""
        raise NotImplementedError

    @property
    def largest_radius(self) -> float:
        """Largest outer radius [m]."""
        raise NotImplementedError

    @property
    def width_key(self) -> str:
        """The key that says how wide the wire is, radius or diameter."""
        return "radius"

    @property
    def magnetized(self) -> bool:
        """Whether any of it is."""
        raise NotImplementedError

    def create(self) -> Wire:
        """The wire as a model."""
        raise NotImplementedError

    def build(self) -> Wire:
        """The wire as a model, created once."""
        model: Wire = super().build()
        return model
