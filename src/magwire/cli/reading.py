"""The options of all commands that read a vessel's file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from magwire.cli.words import CommandError
from magwire.units import DIMENSIONS, parse

if TYPE_CHECKING:
    from magwire.vessel import Source, Spot

Point = Annotated[str | None, Parameter(allow_leading_hyphen=True)]
Points = Annotated[tuple[str, ...], Parameter(allow_leading_hyphen=True, negative="")]


@Parameter(name="*")
@dataclass(frozen=True)
class Reading:
    """How a vessel's file is read.

    Parameters
    ----------
    units
        Unit of its numbers, such as mm; needed unless it states one.
    entrance
        Name or number of an end, or a point such as "1 mm, 2 mm, 3 mm"; the widest end if left out.
    radius
        Name of the array that holds the radius, or one radius for all, such as "2 mm".
    scale
        Factor on all lengths.
    rotation
        Rotation vector about the file's origin, such as "0 deg, 0 deg, 90 deg".
    translation
        What is added to all points then, such as "1 mm, 2 mm, 3 mm".
    smoothing
        Length in radii; shorter waves of the centrelines are taken out.
    extend
        By how many radii lines are made longer at their open ends.
    cut
        Points such as "1 mm, 2 mm, 3 mm" at which loops are opened.
    wall
        What a wire feels: balls around the centrelines, or the triangles of the file's surface.
    """

    units: str | None = None
    entrance: Point = None
    radius: str | None = None
    scale: float = 1.0
    rotation: Point = None
    translation: Point = None
    smoothing: float = 0.5
    extend: float = 0.0
    cut: Points = ()
    wall: Literal["balls", "surface"] = "balls"

    def options(self) -> dict[str, Any]:
        """What ``Vessel.read`` takes, but for the unit."""
        found: dict[str, Any] = {
            "entrance": spot(self.entrance, "--entrance"),
            "radius": radius_of(self.radius),
            "scale": self.scale,
            "smoothing": self.smoothing,
            "extend": self.extend,
            "cut": [triple(text, "length", "--cut") for text in self.cut],
        }
        if self.rotation is not None:
            found["rotation"] = triple(self.rotation, "angle", "--rotation")
        if self.translation is not None:
            found["translation"] = triple(self.translation, "length", "--translation")
        return found

    def refuse_any(self) -> None:
        """Refuse what is given, where no vessel's file is read."""
        values = {one.name: (getattr(self, one.name), one.default) for one in fields(self)}
        refuse({name: value for name, (value, usual) in values.items() if value != usual})


def refuse(given: Mapping[str, object]) -> None:
    """Refuse options that have a value, where no vessel's file is read."""
    for name, value in given.items():
        if value is not None:
            raise CommandError(f"Option --{name} is for a vessel's file; received {value!r}.")


USUAL = Reading()
"""How a file is read if nothing is said."""


def source_of(files: tuple[Path, ...]) -> Source:
    """One file or folder, or several files."""
    if not files:
        raise CommandError("The command needs a vessel's file, a folder or several files.")
    return files[0] if len(files) == 1 else list(files)


def spot(text: str | None, name: str) -> Spot | None:
    """An end by its name or number, or a point such as "1 mm, 2 mm, 3 mm"."""
    if text is None:
        return None
    if text.count(",") == 2:
        return triple(text, "length", name)
    return int(text) if text.strip().isdecimal() else text


def triple(text: str, dimension: str, name: str) -> list[float]:
    """Three quantities such as "1 mm, 2 mm, 3 mm"."""
    parts = text.split(",")
    if len(parts) != 3:
        example = DIMENSIONS[dimension].example
        raise CommandError(
            f"Input {name} must be three quantities such as '{example}, {example}, {example}'; "
            f"received {text!r}."
        )
    return [parse(part.strip(), dimension, name) for part in parts]


def radius_of(text: str | None) -> float | str | None:
    """One radius such as "2 mm", or the name of an array."""
    return parse(text, "length", "--radius") if text and text[:1].isdecimal() else text
