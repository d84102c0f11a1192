"""Saturation of the iron cores of an electromagnetic system (P-26)."""

from __future__ import annotations

import re
from pathlib import Path

from magwire.actuate.calibration import yaml
from magwire.actuate.calibration.fields import Entry
from magwire.actuate.tables import CURVES, Saturation


def read_saturation(path: Path, coils: int) -> tuple[Saturation, ...]:
    """Read the curve of each of so many coils, in the order of the numbers in their names.

    Raises
    ------
    InputError
        With one sentence, if the file cannot be used.
    """
    kind = "Saturation file"
    top = Entry(f"{kind} '{path}'", "", yaml.read(path, kind)).below("saturation_functions")
    names = sorted(top.values, key=_by_number)  # coil_10 comes after coil_9, not after coil_1
    if len(names) != coils:
        raise top.fault(f"must have curves for {coils} coils; received {len(names)}")
    return tuple(_curve(top.below(name)) for name in names)


def _by_number(name: str) -> tuple[str, int]:
    digits = re.search(r"\d+$", name)
    return (name[: digits.start()], int(digits[0])) if digits else (name, -1)


def _curve(entry: Entry) -> Saturation:
    kind = entry.get("type")
    if kind not in CURVES:
        raise entry.fault(
            f"must have {', '.join(CURVES)} in {entry.name('type')}; received {kind!r}"
        )
    a, b = entry.numbers("params", 2)
    if a <= 0.0 or b <= 0.0:
        raise entry.fault(
            f"must have positive numbers in {entry.name('params')}; received {a:g} and {b:g}"
        )
    return Saturation(str(kind), a, b)
