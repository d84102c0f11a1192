"""Limits of an electromagnetic system: currents, resistances, power (P-27)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from magwire.actuate.calibration import yaml
from magwire.actuate.calibration.fields import Entry
from magwire.actuate.inputs import Circuit


@dataclass(frozen=True)
class Limits:
    """Largest current of each coil [A], its circuit, and the power of all together [W]."""

    currents: tuple[float, ...] | None = None
    circuits: tuple[Circuit, ...] | None = None
    power: float = math.inf


def read_limits(path: Path, coils: int) -> Limits:
    """Read a limits file for so many coils.

    Raises
    ------
    InputError
        With one sentence, if it cannot be used.
    """
    kind = "Limits file"
    top = Entry(f"{kind} '{path}'", "", yaml.read(path, kind))
    count = top.number("num_electromagnets")
    if count != coils:
        raise top.fault(f"must be for the {coils} coils of the calibration; received {count:g}")
    currents = top.numbers("max_currents", coils)
    resistances = top.numbers("coil_resistances", coils)
    power = top.number("max_power")
    for key, values in (("max_currents", currents), ("coil_resistances", resistances)):
        if min(values) <= 0.0:
            raise top.fault(f"must have positive numbers in {key}; received {min(values):g}")
    if power <= 0.0:
        raise top.fault(f"must have a positive number in max_power; received {power:g}")
    return Limits(currents, tuple(Circuit(resistance) for resistance in resistances), power)
