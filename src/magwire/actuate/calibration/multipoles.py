"""Calibration files of the multipole electromagnet model (MPEM).

Coil_List names the coils; each has a Source_List; each source has Source_Position [m],
Source_Direction, B_Coeff b_1, b_2 ... and A_Coeff (P-25). An Offset is a constant field.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from magwire.actuate.calibration import yaml
from magwire.actuate.calibration.fields import Entry
from magwire.actuate.inputs import Box, Vector3

OFFSET = "Offset"
NOT_UNIT = 1e-3
"""Directions are normalised; one whose length is off by more is a fault, not a rounding."""


@dataclass(frozen=True)
class Source:
    """A point source: position [m], unit direction, b_n [T m^(n+2)/A] and a_n [T m^(1-n)/A]."""

    position: Vector3
    direction: Vector3
    outward: tuple[float, ...]
    inward: tuple[float, ...]


@dataclass(frozen=True)
class CoilSources:
    """The sources of one coil."""

    name: str
    sources: tuple[Source, ...]


@dataclass(frozen=True)
class Calibration:
    """A calibrated system: its coils, the sources of a constant field, and its workspace."""

    name: str
    coils: tuple[CoilSources, ...]
    offset: tuple[Source, ...]
    workspace: Box


def read_calibration(path: Path) -> Calibration:
    """Read a calibration file.

    Raises
    ------
    InputError
        With one sentence, if it cannot be used.
    """
    kind = "Calibration file"
    top = Entry(f"{kind} '{path}'", "", yaml.read(path, kind))
    names = [name for name in top.names("Coil_List") if name != OFFSET]
    if not names:
        raise top.fault("must have a coil in Coil_List")
    coils = tuple(CoilSources(name, _sources(top.below(name))) for name in names)
    offset = _sources(top.below(OFFSET)) if top.values.get(OFFSET) else ()
    name = top.get("System_Name")
    return Calibration(str(name), coils, offset, _workspace(top))


def _sources(coil: Entry) -> tuple[Source, ...]:
    return tuple(_source(coil.below(name)) for name in coil.names("Source_List"))


def _source(entry: Entry) -> Source:
    x, y, z = entry.numbers("Source_Position", 3)
    a, b, c = entry.numbers("Source_Direction", 3)
    size = (a * a + b * b + c * c) ** 0.5
    if size == 0.0:
        raise entry.fault(
            f"must have a direction of length 1 in {entry.name('Source_Direction')}; "
            "received length 0"
        )
    if abs(size - 1.0) > NOT_UNIT:
        raise entry.fault(
            f"must have a direction of length 1 in {entry.name('Source_Direction')}; "
            f"received length {size:.6g}"
        )
    outward, inward = entry.numbers("B_Coeff"), entry.numbers("A_Coeff")
    if not outward and not inward:
        raise entry.fault(f"must have a coefficient in {entry.name('B_Coeff')}; received none")
    return Source((x, y, z), (a / size, b / size, c / size), outward, inward)


def _workspace(top: Entry) -> Box:
    rows = top.get("Workspace_Dimensions")
    if not isinstance(rows, list) or len(rows) != 3:
        raise top.fault("must have three pairs of numbers in Workspace_Dimensions")
    ends = [
        Entry(top.file, "Workspace_Dimensions", {axis: row}).numbers(axis, 2)
        for axis, row in zip("xyz", rows, strict=True)
    ]
    for axis, (low, high) in zip("xyz", ends, strict=True):
        if low >= high:
            raise top.fault(
                f"must have the lower end first in Workspace_Dimensions: {axis}; "
                f"received {low:g} and {high:g}"
            )
    (x0, x1), (y0, y1), (z0, z1) = ends
    return Box((x0, y0, z0), (x1, y1, z1))
