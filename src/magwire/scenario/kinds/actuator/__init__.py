"""Kinds of actuator, and what they have in common."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field

from magwire.files import read_bytes
from magwire.scenario.kind import Faults, Inlined, ModelTable, refusals
from magwire.scenario.quantity import Direction, Place, Quantity, Row, Share
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.actuate import Actuator, Circuit, Pose

Current = Annotated[float, Quantity("current", "positive")]
Resistance = Annotated[float, Quantity("resistance", "nonnegative")]
Inductance = Annotated[float, Quantity("inductance", "nonnegative")]
Voltage = Annotated[float, Quantity("voltage", "positive")]
Power = Annotated[float, Quantity("power", "positive")]
Turns = Annotated[float, Share(1e-6, 1e6)]
Heading = Annotated[tuple[float, float, float], Direction()]
Turn = Annotated[tuple[float, float, float], Row((Quantity("angle"),) * 3)]
LARGEST = 256 * 1024 * 1024
"""Bytes of a file that an actuator is read from."""
DIGITS = 16
"""Of a checksum, in hexadecimal notation."""


class PoseTable(Table):
    """Where the actuator stands: its own frame in that of the vessel.

    A rotation vector, then a translation, in the axes of the vessel (LPS) or in RAS.
    """

    translation: Place = preset(["0 mm", "0 mm", "0 mm"])
    rotation: Turn = preset(["0 deg", "0 deg", "0 deg"])
    axes: Literal["LPS", "RAS"] = "LPS"

    def build(self) -> Pose:
        """The pose in the vessel's axes."""
        from magwire.actuate import Pose

        angle = math.hypot(*self.rotation)
        pose = Pose(translation=self.translation)
        if angle > 0.0:
            pose = Pose.turned(self.rotation, angle, self.translation)
        if self.axes == "RAS":  # x and y of the vessel point the other way
            pose = Pose(((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))).after(pose)
        return pose


class CircuitTable(Table):
    """The electrical side of a coil."""

    max_current: Current | None = None
    resistance: Resistance = preset("0 ohm")
    inductance: Inductance = preset("0 H")
    supply: Voltage | None = None

    @property
    def most(self) -> float:
        """Largest current [A]."""
        return unlimited(self.max_current)

    def circuit(self) -> Circuit:
        """Resistance, inductance and supply."""
        from magwire.actuate import Circuit

        return Circuit(self.resistance, self.inductance, unlimited(self.supply))


class ActuatorTable(ModelTable):
    """A kind of actuator: its key ``kind`` says which."""

    family = "actuator"
    kind: str
    pose: PoseTable = Field(default={})  # type: ignore[assignment]

    @property
    def may_leave(self) -> bool:
        """Whether the wire may leave the box in which the actuator is calibrated."""
        return False

    def create(self) -> Actuator:
        """The actuator as a model."""
        raise NotImplementedError

    def build(self) -> Actuator:
        """The actuator as a model, created once."""
        model: Actuator = super().build()
        return model

    def faults(self) -> Faults:
        """What the model refuses."""
        yield from refusals("actuator", self.build)


class CoilsTable(ActuatorTable):
    """Coils, which share a power."""

    max_power: Power | None = None


def unlimited(value: float | None) -> float:
    """A limit; infinity if there is none."""
    return math.inf if value is None else value


def with_files(
    table: dict[str, Any], names: Sequence[tuple[tuple[str | int, ...], str]], folder: Path
) -> Inlined:
    """The table with the places of its files whole, and with a checksum of what they hold.

    Parameters
    ----------
    table
        As read.
    names
        Where a file is named, as keys inside of the table, and what the text there says.
    folder
        What a relative file name starts from.
    """
    faults, unread, digest = [], [], hashlib.sha256()
    made = _copy(table)
    for keys, name in names:
        place = (folder / name).absolute()
        try:
            digest.update(read_bytes(place, LARGEST))
        except OSError as error:
            reason = (error.strerror or "unknown reason").lower()
            faults.append(f"Input {_spell(keys)} '{name}' cannot be read: {reason}.")
            unread.append(("actuator", *keys))
            _inside(made, keys).pop(keys[-1])
        else:
            _inside(made, keys)[keys[-1]] = str(place)
    found = digest.hexdigest()[:DIGITS]
    given = made.setdefault("checksum", found)
    if not faults and given != found:
        faults.append(
            f"Input actuator.checksum must be that of the actuator's files, {found}: they are not "
            f"those that the scenario was written for; received {given}."
        )
    return Inlined(made, faults, unread=tuple(unread))  # type: ignore[arg-type]


def file_names(table: dict[str, Any], keys: Sequence[str]) -> Iterator[tuple[tuple[str], str]]:
    """Those of these keys that name a file, and the names."""
    for key in keys:
        if isinstance(table.get(key), str):
            yield (key,), table[key]


def _copy(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _copy(entry) for key, entry in value.items()}
    return [_copy(entry) for entry in value] if isinstance(value, list) else value


def _inside(table: Any, keys: Sequence[str | int]) -> Any:
    """The table in which the last key is."""
    for key in keys[:-1]:
        table = table[key]
    return table


def _spell(keys: Sequence[str | int]) -> str:
    text = "actuator"
    for key in keys:
        text += f"[{key}]" if isinstance(key, int) else f".{key}"
    return text
