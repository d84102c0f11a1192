"""Rows of numbers as arrays: a line of 20,000 points is not to be handled one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Measured:
    """Numbers from a file, which stand in a table as read in place of a list of texts.

    Attributes
    ----------
    values
        The numbers in SI, one each, or a row of them each.
    written
        The same as the list of texts for which they stand; asked for where one of them is at fault.
    """

    values: NDArray[np.float64]
    written: Callable[[], list[object]]


class Numbers(Sequence[tuple[float, ...]]):
    """Rows of numbers that do not change; to those who go through them, a sequence of tuples.

    Parameters
    ----------
    rows
        Shape (rows, columns), in SI.
    """

    __slots__ = ("values",)

    def __init__(self, rows: ArrayLike) -> None:
        values = np.array(rows, dtype=float)
        values.setflags(write=False)
        self.values = values

    def __len__(self) -> int:
        return len(self.values)

    @overload
    def __getitem__(self, place: int) -> tuple[float, ...]: ...

    @overload
    def __getitem__(self, place: slice) -> tuple[tuple[float, ...], ...]: ...

    def __getitem__(self, place: int | slice) -> Any:
        found = self.values[place].tolist()
        return tuple(map(tuple, found)) if isinstance(place, slice) else tuple(found)

    def __iter__(self) -> Iterator[tuple[float, ...]]:
        return map(tuple, self.values.tolist())

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.values, dtype=dtype)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Numbers):
            return np.array_equal(self.values, other.values)
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(self.values.tobytes())

    def __repr__(self) -> str:
        return f"Numbers({self.values.tolist()})"


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns by name, the first of which is the feed [m] or the time [s].

    Attributes
    ----------
    names
        Those of the others, each with its SI unit.
    values
        Shape (rows, 1 + columns), in SI.
    """

    names: tuple[tuple[str, str], ...]
    values: NDArray[np.float64]

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Columns)
            and self.names == other.names
            and np.array_equal(self.values, other.values)
        )

    def __hash__(self) -> int:
        return hash((self.names, self.values.tobytes()))
