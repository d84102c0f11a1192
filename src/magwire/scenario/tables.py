"""The tables of a scenario that come in one kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field

from magwire.scenario.friction import FrictionTable
from magwire.scenario.motion import WallMotionTable
from magwire.scenario.quantity import (
    Acceleration,
    DensityOrZero,
    Force,
    Foundation,
    Length,
    Pressure,
    Rate,
    Time,
)
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.contact import Barrier, WallMotion


class ContactTable(Table):
    """How the wall acts on the wire."""

    stiffness: Pressure | Literal["auto"] = "auto"
    activation_gap: Length | Literal["auto"] = "auto"
    wall: Literal["surface", "centreline"] = "surface"
    foundation: Foundation | None = None
    friction: FrictionTable = Field(default={})  # type: ignore[assignment]
    breathing: WallMotionTable | None = None
    pulsation: WallMotionTable | None = None

    def build(self) -> Barrier:
        """The contact as a model."""
        from magwire.contact import Barrier

        return Barrier(
            stiffness=self.stiffness,
            activation_gap=self.activation_gap,
            wall=self.wall,
            foundation=self.foundation,
        )

    def motion(self) -> tuple[WallMotion, ...]:
        """How the wall moves, as models."""
        return tuple(one.build() for one in (self.breathing, self.pulsation) if one is not None)


class SolverTable(Table):
    """How the motion is computed."""

    motion: Literal["dynamic", "quasi-static"] = "dynamic"
    time_step: Time = preset("10 ms")
    damping: Rate = preset("0.01 1/s")
    release: Literal["sliding", "node"] = "sliding"


class EnvironmentTable(Table):
    """What surrounds the wire, and what pulls at it."""

    gravity: Acceleration = preset(["0 m/s^2", "0 m/s^2", "0 m/s^2"])
    fluid_density: DensityOrZero = preset("0 kg/m^3")
    tip_load: Force = preset(["0 mN", "0 mN", "0 mN"])


class OutputTable(Table):
    """What is recorded."""

    record_every: Length = preset("0.1 mm")
