"""What others have published, as numbers; see the README beside this file."""

from __future__ import annotations

import csv
from functools import lru_cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray


@lru_cache
def curve(name: str, series: str) -> NDArray[np.float64]:
    """The numbers of one series of a file, without its name, shape (points, columns)."""
    text = files("magwire.evidence.published").joinpath(f"{name}.csv").read_text(encoding="utf-8")
    rows = [row[1:] for row in csv.reader(text.splitlines()) if row[0] == series]
    return np.array(rows, dtype=np.float64)
