"""Helmholtz pairs on one to three axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import kind
from magwire.scenario.kinds.actuator import CircuitTable, CoilsTable, Turns, unlimited
from magwire.scenario.quantity import Length, LengthOrZero, at_least_one
from magwire.scenario.table import preset

if TYPE_CHECKING:
    from magwire.actuate import Helmholtz, Pair


class PairTable(CircuitTable):
    """Two equal coils on one axis, in series; the circuit is that of both together."""

    axis: Literal["x", "y", "z"]
    radius: Length
    turns: Turns
    spacing: Length | None = None
    width: LengthOrZero = preset("0 mm")
    height: LengthOrZero = preset("0 mm")

    def build(self) -> Pair:
        """The pair as a model."""
        from magwire.actuate import Pair

        return Pair(
            axis=self.axis,
            radius=self.radius,
            turns=self.turns,
            spacing=self.spacing,
            max_current=self.most,
            circuit=self.circuit(),
            width=self.width,
            height=self.height,
        )


Pairs = Annotated[tuple[PairTable, ...], at_least_one("pair")]


@kind
class HelmholtzTable(CoilsTable):
    """Pairs whose coils are wound alike; its inputs are the currents Ix, Iy and Iz."""

    kind: Literal["helmholtz"]
    pairs: Pairs

    def create(self) -> Helmholtz:
        """The actuator as a model."""
        from magwire.actuate import Helmholtz

        return Helmholtz(
            pose=self.pose.build(),
            max_power=unlimited(self.max_power),
            pairs=tuple(pair.build() for pair in self.pairs),
        )
