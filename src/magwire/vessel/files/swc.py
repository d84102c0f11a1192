"""SWC: one row per point, with the number of the point that it follows."""

from __future__ import annotations

import numpy as np

from magwire.vessel.files.drawing import Drawing, FileFaultError, Line, chains


def read(data: bytes, radius: str | None) -> Drawing:
    """The contents of a file.

    Parameters
    ----------
    data
        The bytes of the file: rows of number, type, x, y, z, radius, parent.
    radius
        Not used: the radius has its column.
    """
    text = data.decode("utf-8", "replace")
    rows = [row.split() for row in text.splitlines() if row.strip() and row.strip()[0] != "#"]
    for number, row in enumerate(rows, start=1):
        if len(row) < 7:
            raise FileFaultError(
                f"has {len(row)} columns in row {number}; expected seven, as SWC has"
            )
    try:
        table = np.array([row[:7] for row in rows], dtype=np.float64).reshape(-1, 7)
        numbers = [int(row[0]) for row in rows]
        parents = [int(row[6]) for row in rows]
    except (ValueError, OverflowError):
        raise FileFaultError("has a row that is not of numbers") from None
    place = {number: i for i, number in enumerate(numbers)}
    if len(place) < len(numbers):
        raise FileFaultError("gives two points the same number")
    lost = [parent for parent in parents if parent >= 0 and parent not in place]
    if lost:
        raise FileFaultError(f"has a point whose parent {lost[0]} is not there")
    edges = [(place[p], i) for i, p in enumerate(parents) if p >= 0]
    runs = chains(np.array(edges, dtype=np.int64), len(rows)) if edges else []
    return Drawing(tuple(Line("", table[run, 2:5], table[run, 5]) for run in runs))
