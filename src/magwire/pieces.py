"""Variables of a result taken a number of records at a time: a file may be larger than memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

BYTES = 2**20
"""Memory of a piece of one variable."""


@dataclass(frozen=True)
class Column:
    """The numbers of a variable, with the words of an xarray variable.

    Attributes
    ----------
    dims
        Names of the dimensions.
    data
        An array, or what gives one when it is indexed.
    attrs
        Units and other words.
    """

    dims: tuple[str, ...]
    data: Any
    attrs: Mapping[str, Any]

    @property
    def values(self) -> NDArray[Any]:
        """All of it, in memory."""
        return np.asarray(self.data)

    @property
    def nbytes(self) -> int:
        """Size of the numbers [bytes]."""
        return int(self.data.nbytes)

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the numbers."""
        found: np.dtype[Any] = self.data.dtype
        return found

    def __getitem__(self, key: Any) -> Column:
        return Column(self.dims, self.data[key], self.attrs)


class Plain:
    """Variables and attributes, as far as summaries and figures ask an ``xarray.Dataset`` for them.

    Parameters
    ----------
    variables
        By name.
    attrs
        Attributes of the file.
    source
        The open file that variables are read from; None if all of them are in memory.
    """

    def __init__(
        self, variables: dict[str, Column], attrs: dict[str, Any], source: Any = None
    ) -> None:
        self.variables, self.attrs, self.source = variables, attrs, source
        self.sizes = {
            name: size
            for column in variables.values()
            for name, size in zip(column.dims, column.data.shape, strict=True)
        }

    def __contains__(self, name: object) -> bool:
        return name in self.variables

    def __getitem__(self, name: str) -> Column:
        return self.variables[name]


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
