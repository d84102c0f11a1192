"""A smooth curve through given points, or through those of a CSV file."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import Field

from magwire import units
from magwire.errors import MagwireError
from magwire.files import read_text
from magwire.scenario.kind import Faults, Inlined, kind
from magwire.scenario.kinds.lumen import LumenTable
from magwire.scenario.measured import Measured, Numbers
from magwire.scenario.quantity import OneOrEach, Quantity, Row, Rows

if TYPE_CHECKING:
    from magwire.lumen import Lumen

AXES = ("x", "y", "z")
Polyline = Annotated[Numbers, Rows(Row((Quantity("length"),) * 3), least=2)]
Radii = Annotated[tuple[float, ...], OneOrEach(Quantity("length", "positive"))]


@kind
class PointsLumen(LumenTable):
    """A smooth curve through given points, entrance first.

    ``file`` and ``units`` stand for ``points`` and ``radius`` in the file that a user writes; they
    are replaced by the numbers they stand for before the table is checked.
    """

    shape: Literal["points"]
    points: Polyline
    radius: Radii
    file: str | None = Field(
        default=None,
        description="CSV file with columns x, y, z and radius, in place of points and radius; "
        "relative to the scenario's folder",
    )
    units: str | None = Field(
        default=None, description="unit of the numbers in the file, such as 'mm'"
    )

    @classmethod
    def inline(cls, table: dict[str, Any], folder: Path) -> Inlined:
        """The table with the points of its file in it."""
        if "file" not in table:
            return Inlined(table, [])
        unread = (("lumen", "points"), ("lumen", "radius"))
        rest = {key: value for key, value in table.items() if key not in ("file", "units")}
        faults = []
        if "points" in table:
            faults.append("Input lumen.points cannot stand next to lumen.file; remove one of them.")
        unit = table.get("units")
        if unit is None:
            faults.append(
                "Input lumen.units is missing; expected the unit of lumen.file such as 'mm'."
            )
        else:
            faults += unit_faults(unit)
        name = table["file"]
        if not isinstance(name, str):
            faults.append(f"Input lumen.file must be the name of a CSV file; received {name!r}.")
            return Inlined(rest, faults, unread)
        columns = AXES if "radius" in table else (*AXES, "radius")
        try:
            cells = _cells(folder / name, name, columns)
        except MagwireError as error:
            return Inlined(_without_points(rest), [*faults, str(error)], unread)
        try:
            found = _numbers(cells, "m" if faults else str(unit))
        except MagwireError as error:
            faults += _wrong(cells, columns, name) or [f"Input lumen.file: {error}"]
        if faults:
            return Inlined(_without_points(rest), faults, unread)
        return Inlined({**rest, **found}, [])

    @property
    def narrowest(self) -> float:
        """Smallest radius [m]."""
        return min(self.radius)

    def faults(self) -> Faults:
        """There is one radius for all points, or one for each; and the model can be made."""
        if len(self.radius) not in (1, len(self.points)):
            yield (
                f"Input lumen.radius must be one value or one for each of the {len(self.points)} "
                f"points; received {len(self.radius)}."
            )
        else:
            yield from super().faults()

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        radii = np.broadcast_to(np.array(self.radius), (len(self.points),)).copy()
        return Lumen.through(self.points.values, radii)


def unit_faults(unit: Any) -> list[str]:
    """What is wrong with the unit of a lumen's file; nothing if it is one of length."""
    known = units.DIMENSIONS["length"].units
    if unit in known:
        return []
    words = ", ".join(f"'{name}'" for name in known)
    return [f"Input lumen.units must be one of {words}; received {unit!r}."]


def _cells(path: Path, name: str, columns: Sequence[str]) -> list[tuple[str, ...]]:
    """The texts of a CSV file by columns, those that are asked for."""
    try:
        text = read_text(path)
    except OSError as error:
        reason = (error.strerror or "unknown reason").lower()
        raise MagwireError(f"Input lumen.file '{name}' cannot be read: {reason}.") from None
    except UnicodeDecodeError:
        raise MagwireError(f"Input lumen.file '{name}' is not a text file.") from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    plain = '"' not in text
    rows = [line.split(",") for line in lines] if plain else list(csv.reader(lines))
    heads = [word.strip() for word in rows.pop(0)] if rows else []
    absent = [column for column in columns if column not in heads]
    if absent:
        raise MagwireError(
            f"Input lumen.file must have the columns {', '.join(columns)}; "
            f"'{name}' lacks {' and '.join(absent)}."
        )
    # Of columns with one name the last one counts.
    places = [len(heads) - 1 - heads[::-1].index(column) for column in columns]
    if len({len(heads), *map(len, rows)}) > 1:
        width = max(len(heads), *map(len, rows))
        rows = [row + [""] * (width - len(row)) for row in rows]
    table = list(zip(*rows, strict=True)) or [()] * len(heads)
    return [table[place] for place in places]


def _wrong(cells: list[tuple[str, ...]], columns: Sequence[str], name: str) -> list[str]:
    """Faults of texts that are no finite numbers, in the order of the file."""
    return [
        f"Input lumen.file must hold finite numbers; received {text.strip()!r} for {column} "
        f"in row {number} of '{name}'."
        for number, row in enumerate(zip(*cells, strict=True), start=1)
        for column, text in zip(columns, row, strict=True)
        if not _is_finite(text)
    ]


def _is_finite(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _numbers(cells: list[tuple[str, ...]], unit: str) -> dict[str, Any]:
    """Points and, if the file has them, radii, as the scenario's table has them."""
    columns = [np.array(units.parse_column(texts, unit, "length")) for texts in cells]

    def points() -> list[object]:
        return [[f"{text.strip()} {unit}" for text in row] for row in zip(*cells[:3], strict=True)]

    def radii() -> list[object]:
        return [f"{text.strip()} {unit}" for text in cells[3]]

    found: dict[str, Any] = {"points": Measured(np.column_stack(columns[:3]), points)}
    if len(columns) > 3:
        found["radius"] = Measured(columns[3], radii)
    return found


def _without_points(table: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if key != "points"}
