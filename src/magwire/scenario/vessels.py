"""Lumens from a vessel's file: read, and put into the scenario as numbers."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import Field

from magwire.errors import MagwireError
from magwire.scenario.lumens import LumenTable
from magwire.scenario.points import unit_faults
from magwire.scenario.quantity import Quantity, Row, Rows, at_least_one
from magwire.units import parse, write

if TYPE_CHECKING:
    from magwire.lumen import Lumen
    from magwire.lumen.branch import Branch
    from magwire.vessel import Vessel

BALL = Row((Quantity("length"),) * 3 + (Quantity("length", "positive"),))
Balls = Annotated[tuple[tuple[float, float, float, float], ...], Rows(BALL, least=2)]
VECTORS = {"rotation": "angle", "translation": "length"}
NUMBERS = ("scale", "smoothing")
SPOTS = ("entrance", "target")
KEYS = ("file", "units", "radius", *SPOTS, *NUMBERS, *VECTORS)


def _note(text: str) -> Any:
    """A key that stands for something else in the file, and is gone once that is read."""
    return Field(default=None, description=text)


class VesselLumen(LumenTable):
    """A tree of tubes from the entrance to each outlet, by the names of the outlets.

    Each row of a branch is a point of its centreline and the radius there. In the file that a user
    writes, ``file`` and what goes with it stand for ``branches``.
    """

    shape: Literal["vessel"]
    target: str
    branches: Annotated[dict[str, Balls], at_least_one("branch")]
    file: str | None = _note("centrelines or a surface, in place of branches")
    units: str | None = _note("unit of the numbers in the file, unless it states one")
    radius: str | None = _note("array of the file that holds the radius, or one radius for all")
    entrance: str | int | tuple[str, str, str] | None = _note(
        "name or number of an end, or a point"
    )
    scale: float | None = _note("factor on all lengths of the file")
    rotation: tuple[str, str, str] | None = _note("rotation vector, about the file's origin")
    translation: tuple[str, str, str] | None = _note("what is added to all points, then")
    smoothing: float | None = _note("length in radii of the waves that are taken out")

    @property
    def narrowest(self) -> float:
        """Smallest radius on the way to the target [m]."""
        return min(row[3] for row in self.branches[self.target])

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        return self._model

    @cached_property
    def _model(self) -> Lumen:
        from magwire.lumen import Lumen

        tubes = {name: np.array(rows) for name, rows in self.branches.items()}
        return Lumen.tree(
            {name: Lumen.through(rows[:, :3], rows[:, 3]) for name, rows in tubes.items()},
            target=self.target,
        )


def inline(lumen: dict[str, Any], folder: Path) -> tuple[dict[str, Any], list[str]]:
    """The lumen table with the tubes of its file in it.

    Parameters
    ----------
    lumen
        The table as read, with the key ``file``.
    folder
        What a relative file name starts from.

    Returns
    -------
    tuple
        The table with ``branches`` and the name of the ``target`` in place of ``file`` and what
        goes with it, and the faults found; with a fault, the table lacks both.
    """
    rest = {key: value for key, value in lumen.items() if key not in (*KEYS, "branches")}
    options, faults = _options(lumen)
    if "branches" in lumen:
        faults.append("Input lumen.branches cannot stand next to lumen.file; remove one of them.")
    if not isinstance(lumen["file"], str):
        faults.append(f"Input lumen.file must be the name of a file; received {lumen['file']!r}.")
    if faults:
        return rest, faults
    from magwire.vessel import Vessel

    target = options.pop("target", None)
    try:
        vessel = Vessel.read(folder / lumen["file"], **options)
        name = vessel.lumen(target).target
    except MagwireError as error:
        return rest, [str(error).replace(" of Lumen.read", "").replace("Input ", "Input lumen.", 1)]
    return {**rest, "target": name, "branches": rows_of(vessel)}, []


def needing_a_file(lumen: dict[str, Any]) -> list[str]:
    """Faults of a vessel's table without a file: keys that say how to read one."""
    keys = [key for key in KEYS if key in lumen and key not in ("file", "target")]
    return [f"Input lumen.{key} needs lumen.file next to it; remove it." for key in keys]


def rows_of(vessel: Vessel) -> dict[str, list[list[str]]]:
    """The tubes of a vessel as a scenario has them."""
    return {name: _rows(tube) for name, tube in vessel.tubes.items()}


def way_length(lumen: dict[str, Any]) -> str | None:
    """Length from the entrance to the target of an inlined table, None if it is not known."""
    rows = lumen.get("branches", {}).get(lumen.get("target"))
    if rows is None:
        return None
    try:
        entry = parse(lumen.get("entry", "0 mm"), "length")
    except MagwireError:
        return None
    from magwire.lumen import Lumen

    balls = np.array(BALL_ROWS.read(rows))
    return write(Lumen.through(balls[:, :3], balls[:, 3]).length + entry, "length")


BALL_ROWS = Rows(BALL, least=2)


def _rows(tube: Branch) -> list[list[str]]:
    balls = np.column_stack([tube.points, tube.radius]).tolist()
    return [[write(value, "length") for value in ball] for ball in balls]


def _options(lumen: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """What ``Vessel.read`` is to be told, and what of it cannot be understood."""
    options: dict[str, Any] = {}
    faults: list[str] = []
    if "units" in lumen:
        options["units"] = lumen["units"]
        faults += unit_faults(lumen["units"])
    for key in (*SPOTS, *VECTORS, *NUMBERS, "radius"):
        if key in lumen:
            try:
                options[key] = _option(key, lumen[key])
            except MagwireError as error:
                faults.append(str(error))
    return options, faults


def _option(key: str, value: Any) -> Any:
    name = f"lumen.{key}"
    if key in VECTORS or (key in SPOTS and isinstance(value, list)):
        if not isinstance(value, list) or len(value) != 3:
            raise MagwireError(f"Input {name} must be a list of three; received {value!r}.")
        return [parse(entry, VECTORS.get(key, "length"), name) for entry in value]
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
