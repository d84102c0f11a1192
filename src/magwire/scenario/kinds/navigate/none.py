"""Nobody steers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.navigate import NavigatorTable

if TYPE_CHECKING:
    from magwire.navigate import Navigator
    from magwire.simulation import Simulation


@kind
class NoSteering(NavigatorTable):
    """Nobody steers: the wire is pushed in the field as it is."""

    method: Literal["none"]

    def build(self, simulation: Simulation) -> Navigator | None:
        """Nobody."""
        return None
