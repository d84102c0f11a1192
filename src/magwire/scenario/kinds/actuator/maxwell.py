"""Maxwell pairs on one to three axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import CoilsTable, unlimited
from magwire.scenario.kinds.actuator.helmholtz import Pairs

if TYPE_CHECKING:
    from magwire.actuate import Maxwell


@kind
class MaxwellTable(CoilsTable):
    """Pairs whose coils are opposed; its inputs are the currents Mx, My and Mz."""

    kind: Literal["maxwell"]
    pairs: Pairs

    def create(self) -> Maxwell:
        """The actuator as a model."""
        from magwire.actuate import Maxwell

        return Maxwell(
            pose=self.pose.build(),
            max_power=unlimited(self.max_power),
            pairs=tuple(pair.build() for pair in self.pairs),
        )
