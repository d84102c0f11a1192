"""Calibrated electromagnets, from their files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field

from magwire.errors import InputError
from magwire.scenario.kind import Inlined, kind
from magwire.scenario.kinds.actuator import CoilsTable, file_names, with_files
from magwire.scenario.quantity import OneOrEach, Quantity

if TYPE_CHECKING:
    from magwire.actuate import MPEM

Currents = Annotated[tuple[float, ...], OneOrEach(Quantity("current", "positive"))]
Resistances = Annotated[tuple[float, ...], OneOrEach(Quantity("resistance", "nonnegative"))]
Inductances = Annotated[tuple[float, ...], OneOrEach(Quantity("inductance", "nonnegative"))]
Voltages = Annotated[tuple[float, ...], OneOrEach(Quantity("voltage", "positive"))]
FILES = ("calibration", "limits", "saturation")


@kind
class MPEMTable(CoilsTable):
    """Coils as sums of point sources; its inputs are their currents, by the names in the file.

    What is given of currents and circuits, once for all coils or for each, goes before what a file
    of limits says.
    """

    kind: Literal["mpem"]
    calibration: str
    limits: str | None = None
    saturation: str | None = None
    max_current: Currents | None = None
    resistance: Resistances | None = None
    inductance: Inductances | None = None
    supply: Voltages | None = None
    extrapolate: bool = False
    checksum: str | None = Field(
        default=None, description="of the files, filled in where it is missing"
    )

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the whole places of its files."""
        return with_files(table, list(file_names(table, FILES)), folder)

    @property
    def may_leave(self) -> bool:
        """Whether the wire may leave the box of the calibration."""
        return self.extrapolate

    def create(self) -> MPEM:
        """The actuator as a model."""
        from magwire.actuate import MPEM, Circuit

        read = MPEM.read(self.calibration, self.limits, self.saturation)
        count = len(read.inputs)
        own = [Circuit(i.resistance, i.inductance, i.supply) for i in read.inputs]
        most = [i.high for i in read.inputs]
        if self.max_current is not None:
            most = _each("max_current", self.max_current, count)
        for name in ("resistance", "inductance", "supply"):
            given = getattr(self, name)
            if given is not None:
                values = _each(name, given, count)
                own = [replace(c, **{name: v}) for c, v in zip(own, values, strict=True)]
        return replace(
            read,
            pose=self.pose.build(),
            max_power=read.max_power if self.max_power is None else self.max_power,
            max_currents=tuple(most),
            circuits=tuple(own),
        )


def _each(name: str, given: tuple[float, ...], count: int) -> list[float]:
    """One value for each coil."""
    if len(given) not in (1, count):
        raise InputError(
            f"Input {name} of MPEM must be one value or one for each of the {count} coils; "
            f"received {len(given)}."
        )
    return list(given) * (count if len(given) == 1 else 1)
