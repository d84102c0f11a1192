"""SWC: one row per point, with the number of the point that it follows."""

from __future__ import annotations

import numpy as np

from magwire.vessel.files.drawing import Array, Drawing, FileFaultError, Line, chains

SOMA = 1  # type of the points of a cell's body
SOMA_POINTS = 3  # of a body as NeuroMorpho.org writes it: the middle, and one at each side


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
        numbers = _whole(table[:, 0])
        parents = _whole(table[:, 6])
    except (ValueError, OverflowError):
        raise FileFaultError(
            "has a row that is not of numbers, or numbers its points otherwise than 1, 2, 3"
        ) from None
    place = {number: i for i, number in enumerate(numbers)}
    if len(place) < len(numbers):
        raise FileFaultError("gives two points the same number")
    lost = [parent for parent in parents if parent >= 0 and parent not in place]
    if lost:
        raise FileFaultError(f"has a point whose parent {lost[0]} is not there")
    soma = _soma(table[:, 1], numbers, parents)
    edges = [(place[p], i) for i, p in enumerate(parents) if p >= 0 and i not in soma]
    notes = ("The two side points of a soma of three are left out.",) if soma else ()
    runs = chains(np.array(edges, dtype=np.int64), len(rows)) if edges else []
    lines = tuple(Line("", table[run, 2:5], table[run, 5]) for run in runs)
    return Drawing(lines, notes=notes)


def _whole(column: Array) -> list[int]:
    """The whole numbers of a column, some of which may be written as 1.0."""
    if not np.array_equal(column, np.round(column)):
        raise ValueError
    return [int(number) for number in column]


def _soma(kinds: Array, numbers: list[int], parents: list[int]) -> set[int]:
    """Rows of the two points at the sides of a cell's body of three; they are no vessel."""
    body = np.flatnonzero(kinds == SOMA).tolist()
    if len(body) != SOMA_POINTS:
        return set()
    middle = [row for row in body if parents[row] < 0]
    sides = {row for row in body if parents[row] >= 0}
    ends = all(numbers[row] not in parents for row in sides)
    at_middle = all(parents[row] == numbers[m] for row in sides for m in middle)
    return sides if len(middle) == 1 and ends and at_middle else set()
