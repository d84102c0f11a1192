"""The lumen table of a scenario (.toml) with a vessel's tubes, as magwire writes it."""

from __future__ import annotations

import numpy as np

from magwire.errors import InputError
from magwire.files import TextFaultError, parse_toml
from magwire.units import parse
from magwire.vessel.files.drawing import NO_WAY, Drawing, FileFaultError, Line

ENTRANCE = "entrance"


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file.
    radius
        Not used: the radius has its column.
    """
    try:
        table = parse_toml(data.decode("utf-8-sig"))["lumen"]
        given = [*table["branches"].items(), *((NO_WAY, rows) for rows in table.get("trunks", ()))]
        balls = [
            (name, np.array([[parse(value, "length") for value in row] for row in rows]))
            for name, rows in given
        ]
    except (TextFaultError, UnicodeDecodeError) as error:
        raise FileFaultError(f"is not valid TOML: {error}") from None
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        why = str(error).rstrip(".") if isinstance(error, InputError) else ""
        raise FileFaultError(
            "has no lumen.branches of points with radii" + (f": {why}" if why else "")
        ) from None
    if any(rows.ndim != 2 or rows.shape[1] != 4 for _, rows in balls):
        raise FileFaultError("has lumen.branches with rows that are not x, y, z and radius")
    lines = tuple(Line(name, rows[:, :3], rows[:, 3]) for name, rows in balls)
    return Drawing(lines, unit="m", entrance=ENTRANCE if lines else "")
