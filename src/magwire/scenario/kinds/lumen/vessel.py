"""A tree of tubes through balls, or that of a vessel's file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from magwire.errors import MagwireError
from magwire.scenario.kind import Faults, Inlined, kind
from magwire.scenario.kinds.lumen import LumenTable, unknown_target
from magwire.scenario.kinds.lumen.points import unit_faults
from magwire.scenario.measured import Measured, Numbers
from magwire.scenario.quantity import Quantity, Row, Rows, at_least_one
from magwire.scenario.table import preset
from magwire.scenario.triangles import Triangles, TrianglesText
from magwire.units import parse, write

if TYPE_CHECKING:
    from magwire.lumen import Lumen
    from magwire.lumen.sheet import Sheet
    from magwire.vessel import Vessel

BALL = Row((Quantity("length"),) * 3 + (Quantity("length", "positive"),))
Balls = Annotated[Numbers, Rows(BALL, least=2)]
VECTORS = {"rotation": "angle", "translation": "length"}
NUMBERS = ("scale", "smoothing", "extend")
SPOTS = ("entrance", "target")
MADE = ("branches", "trunks", "surface")
KEYS = ("file", "units", "radius", "cut", *SPOTS, *NUMBERS, *VECTORS)


def _note(text: str) -> Any:
    """A key that stands for something else in the file, and is gone once that is read."""
    return Field(default=None, description=text)


@kind
class VesselLumen(LumenTable):
    """A tree of tubes from the entrance to each outlet, by the names of the outlets.

    Each row of a branch is a point of its centreline and the radius there. In the file that a user
    writes, ``file`` and what goes with it stand for ``branches``.
    """

    ruled_by = ("file",)
    shape: Literal["vessel"]
    target: str
    branches: Annotated[dict[str, Balls], at_least_one("branch")]
    trunks: list[Balls] | None = Field(
        default=None, description="tubes that are wall, but no way to an outlet"
    )
    wall: Literal["balls", "surface"] = preset("balls")
    surface: Annotated[Triangles, TrianglesText()] | None = Field(
        default=None, description="the wall's triangles, in place of balls"
    )
    file: str | list[str] | None = _note("centrelines or a surface, in place of branches")
    units: str | None = _note("unit of the numbers in the file, unless it states one")
    radius: str | None = _note("array of the file that holds the radius, or one radius for all")
    entrance: str | int | tuple[str, str, str] | None = _note(
        "name or number of an end, or a point"
    )
    scale: float | None = _note("factor on all lengths of the file")
    rotation: tuple[str, str, str] | None = _note("rotation vector, about the file's origin")
    translation: tuple[str, str, str] | None = _note("what is added to all points, then")
    smoothing: float | None = _note("length in radii of the waves that are taken out")
    extend: float | None = _note("radii by which lines are made longer at their open ends")
    cut: list[tuple[str, str, str]] | None = _note("points at which loops are opened")

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the tubes of its file, and the name of its target, in it."""
        if "file" not in table:
            keys = [key for key in KEYS if key in table and key not in ("file", "target")]
            return Inlined(
                table,
                [f"Input lumen.{key} needs lumen.file next to it; remove it." for key in keys],
            )
        rest = {key: value for key, value in table.items() if key not in (*KEYS, *MADE)}
        rest["shape"] = "vessel"
        found = _read(table, rest, folder)
        return found if found.faults else found._replace(reach=_reach(found.table or {}))

    @property
    def narrowest(self) -> float:
        """Smallest radius on the way to the target [m]."""
        return float(self.branches[self.target].values[:, 3].min())

    def clashes(self) -> Faults:
        """The target is one of the outlets, and a wall that is a surface has one."""
        yield from unknown_target(self.target, self.branches)
        if (self.wall == "surface") != (self.surface is not None):
            yield (
                "Input lumen.wall must be 'surface' where there is a lumen.surface, and nowhere "
                f"else; received '{self.wall}'."
            )

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        tubes = {name: rows.values for name, rows in self.branches.items()}
        trunks = [rows.values for rows in self.trunks or ()]
        lumen = Lumen.ways(tubes, trunks=trunks, target=self.target)
        if self.surface is None:
            return lumen
        return lumen.with_surface(self.surface.points, self.surface.triangles)


def rows_of(vessel: Vessel) -> dict[str, list[list[str]]]:
    """The tubes of a vessel as a scenario's file has them."""
    return {name: _rows(balls) for name, balls in vessel.balls.items()}


def trunks_of(vessel: Vessel) -> list[list[list[str]]]:
    """The trunks of a vessel that are no way, as a scenario's file has them."""
    return [_rows(balls) for balls in vessel.trunks]


def surface_of(sheet: Sheet) -> dict[str, str]:
    """A wall of triangles as a scenario's file has it."""
    return TrianglesText().write(Triangles(sheet.points, sheet.triangles))


def _read(table: dict[str, Any], rest: dict[str, Any], folder: Path) -> Inlined:
    """The rest of a table with the tubes of its file."""
    unread = (("lumen", "branches"), ("lumen", "target"), ("feed", "distance"))
    options, faults = _options(table)
    for key in MADE:
        if key in table:
            faults.append(f"Input lumen.{key} cannot stand next to lumen.file; remove one of them.")
    given = table["file"] if isinstance(table["file"], list) else [table["file"]]
    if not given or not all(isinstance(name, str) for name in given):
        faults.append(
            "Input lumen.file must be the name of a file or a folder, or a list of files; received "
            f"{table['file']!r}."
        )
    if faults:
        return Inlined(rest, faults, unread)
    from magwire.vessel import Vessel

    target = options.pop("target", None)
    try:
        paths = [folder / name for name in given]
        vessel = Vessel.read(paths[0] if len(paths) == 1 else paths, **options)
        wall: Literal["balls", "surface"] = "surface" if rest.get("wall") == "surface" else "balls"
        lumen = vessel.lumen(target, wall=wall)
        notes = vessel.record(wall)
    except MagwireError as error:
        text = str(error).replace(" of Lumen.read", "").replace("Input ", "Input lumen.", 1)
        return Inlined(rest, [text], unread)
    tubes = {outlet: _measured(balls) for outlet, balls in vessel.balls.items()}
    made = {**rest, "target": lumen.target, "branches": tubes}
    if vessel.trunks:
        made["trunks"] = [_measured(balls) for balls in vessel.trunks]
    if lumen.sheet is not None:
        made["surface"] = Triangles(lumen.sheet.points, lumen.sheet.triangles)
    return Inlined(made, [], notes=notes)


def _measured(balls: NDArray[np.float64]) -> Measured:
    return Measured(balls, lambda: list(_rows(balls)))


def _rows(balls: NDArray[np.float64]) -> list[list[str]]:
    return [[write(value, "length") for value in ball] for ball in balls.tolist()]


def _reach(table: dict[str, Any]) -> str | None:
    """Length from the entrance to the target, None if it is not known."""
    try:
        entry = parse(table.get("entry", "0 mm"), "length")
    except MagwireError:
        return None
    from magwire.lumen import Lumen

    balls = table["branches"][table["target"]].values
    return write(Lumen.through(balls[:, :3], balls[:, 3]).length + entry, "length")


def _options(lumen: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """What ``Vessel.read`` is to be told, and what of it cannot be understood."""
    options: dict[str, Any] = {}
    faults: list[str] = []
    if "units" in lumen:
        options["units"] = lumen["units"]
        faults += unit_faults(lumen["units"])
    for key in (*SPOTS, *VECTORS, *NUMBERS, "radius", "cut"):
        if key in lumen:
            try:
                options[key] = _option(key, lumen[key])
            except MagwireError as error:
                faults.append(str(error))
    return options, faults


def _option(key: str, value: Any) -> Any:
    name = f"lumen.{key}"
    if key == "cut":
        if not isinstance(value, list):
            raise MagwireError(f"Input {name} must be a list of points; received {value!r}.")
        return [_triple(point, "length", name) for point in value]
    if key in VECTORS or (key in SPOTS and isinstance(value, list)):
        return _triple(value, VECTORS.get(key, "length"), name)
    if key in SPOTS:
        if isinstance(value, bool) or not isinstance(value, (str, int)):
            raise MagwireError(
                f"Input {name} must be the name or the number of an end, or a point; received "
                f"{value!r}."
            )
        return value
    if key == "radius" and isinstance(value, str) and not value[:1].isdecimal():
        return value
    return parse(value, "length" if key == "radius" else "dimensionless", name)


def _triple(value: Any, dimension: str, name: str) -> list[float]:
    """Three quantities."""
    if not isinstance(value, list) or len(value) != 3:
        raise MagwireError(f"Input {name} must be a list of three; received {value!r}.")
    return [parse(entry, dimension, name) for entry in value]
