"""Variables of a result taken a number of records at a time: a file may be larger than memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

BYTES = 2**22
"""Memory of a piece of one variable."""


def spans(data: xr.Dataset, *names: str) -> Iterator[slice]:
    """Which records to take at a time, so that a piece of each of some variables is small."""
    records = data.sizes["time"]
    rows = [data.variables[name].nbytes // max(records, 1) for name in names]
    count = max(1, BYTES // max(1, *rows))
    for first in range(0, records, count):
        yield slice(first, first + count)


def piece(data: xr.Dataset, name: str, records: slice) -> Array:
    """The values of a variable at some records, with time as their first axis."""
    return np.asarray(data.variables[name][records].values, dtype=np.float64)


def pieces(data: xr.Dataset, *names: str) -> Iterator[tuple[Array, ...]]:
    """The values of some variables, a number of records at a time; none of a run without records.

    Parameters
    ----------
    data
        A result's variables, all in memory or read from a file as they are asked for.
    names
        Variables along time.

    Yields
    ------
    tuple
        An array for each name, with time as its first axis.
    """
    for records in spans(data, *names):
        yield tuple(piece(data, name, records) for name in names)


def largest(data: xr.Dataset, of: Callable[..., Array], *names: str) -> float:
    """Largest number that a function makes of some variables, no less than zero; NaN if one is.

    Parameters
    ----------
    data
        A result's variables.
    of
        Called with a piece of each variable.
    names
        Variables along time.
    """
    found = [np.max(of(*values), initial=0.0) for values in pieces(data, *names)]
    return float(np.max(found, initial=0.0))


def at(data: xr.Dataset, name: str, record: int) -> Array:
    """The value of a variable at one record; negative numbers count from the end."""
    return np.asarray(data.variables[name][record].values, dtype=np.float64)
