"""The reference data of tests/data and the authors' curves, read once."""

from __future__ import annotations

import csv
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.published import curve

DATA = Path(__file__).parent / "data"
Array = NDArray[np.float64]


@lru_cache
def closed_form(name: str) -> tuple[tuple[float, ...], ...]:
    """Rows of a table of numbers in closed_form/, without its header."""
    with (DATA / "closed_form" / f"{name}.csv").open(encoding="utf-8") as file:
        return tuple(tuple(map(float, row)) for row in list(csv.reader(file))[1:])


@lru_cache
def critical_load(case: str) -> float:
    """A number of critical_loads.csv, by the first word of its case."""
    with (DATA / "closed_form" / "critical_loads.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row[0].startswith(case)]
    assert len(rows) == 1, case
    return float(rows[0][1])


@lru_cache
def hard_wall(case: str) -> dict[str, Array]:
    """Columns of a table of hard_wall/, by their names."""
    with (DATA / "hard_wall" / f"{case}.csv").open(encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return dict(zip(names, np.array(rows, dtype=np.float64).T, strict=True))


figure = curve
"""The numbers of one series of a file of the authors' curves, shape (n, columns)."""


@lru_cache
def control_field() -> tuple[tuple[str, float, float], ...]:
    """Series, push and value of the authors' field in their earlier half-circle."""
    colours = ("green_square", "red_circle")
    rows = [(c, *row) for c in colours for row in figure("control_halfcircle_field", c).tolist()]
    return tuple(rows)
