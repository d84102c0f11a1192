"""Records that wait in memory, as the columns of a result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.engine.record import BLOCKS, Record, RunInfo, block, row_type
from magwire.kernels.sheet import NUMBERS, TIME
from magwire.results.contract import VARIABLES, Variable


class Rows:
    """The numbers of records that are all of the same kind.

    Parameters
    ----------
    info
        What is known of their run.
    memory
        How much to have for them, about [bytes].
    """

    def __init__(self, info: RunInfo, memory: int) -> None:
        self._info = info
        self._kind = row_type(info.nodes, len(info.inputs), info.absent)
        room = max(1, memory // self._kind.itemsize)
        self._numbers = np.empty((room, self._kind.itemsize // 8))
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def full(self) -> bool:
        """Whether there is no room for another one."""
        return self._count == len(self._numbers)

    def append(self, record: Record) -> None:
        """Copy a record; there must be room for it."""
        self._numbers[self._count] = record.row
        self._count += 1

    def before(self, time: float) -> int:
        """How many are of a time [s] before this one."""
        return int(np.searchsorted(self._numbers[: self._count, TIME], time))

    def drop(self, count: int) -> None:
        """Keep only so many of them."""
        self._count = count

    def columns(self) -> dict[str, NDArray[Any]]:
        """The variables, each with time as its first axis: in part views of this memory.

        Those that the records are without are left out.
        """
        return {
            name: self._column(name, variable).astype(variable.dtype, copy=False)
            for name, variable in VARIABLES.items()
            if name not in self._info.absent
        }

    def _column(self, name: str, variable: Variable) -> NDArray[Any]:
        numbers = self._numbers[: self._count]
        if variable.read is not None:
            records = (Record(row, self._kind) for row in numbers)
            return np.array([variable.read(record, self._info) for record in records])
        rows = numbers.view(self._kind)[:, 0]
        if variable.column is None:
            return block(rows, name)
        return np.asarray(variable.column(Named(rows), self._info))


class Named(Mapping[str, NDArray[Any]]):
    """The numbers of many records by the names of ``Record``, each with time as its first axis."""

    def __init__(self, rows: NDArray[Any]) -> None:
        self._rows = rows

    def __getitem__(self, name: str) -> NDArray[Any]:
        return block(self._rows, name)

    def __iter__(self) -> Iterator[str]:
        return iter((*NUMBERS, *BLOCKS))

    def __len__(self) -> int:
        return len(NUMBERS) + len(BLOCKS)


class Held:
    """Columns of records in memory, piece by piece, as ``disk.Draft`` has them in a file."""

    def __init__(self) -> None:
        self._pieces: list[dict[str, NDArray[Any]]] = []

    def read(self, name: str, count: int) -> NDArray[Any]:
        """The first numbers of a variable."""
        pieces = [piece[name] for piece in self._pieces]
        return np.concatenate(pieces or [np.zeros(0)])[:count]

    def add(self, first: int, columns: dict[str, NDArray[Any]]) -> None:
        """Put rows of variables behind the first ones, and forget what was there before."""
        kept, left = [], first
        for piece in self._pieces:
            some = {name: column[:left] for name, column in piece.items()} if left else {}
            left -= len(some.get("time", ()))
            kept += [some] if some else []
        self._pieces = [*kept, columns]

    def columns(self) -> dict[str, NDArray[Any]]:
        """All of them, after the last piece; the memory of the pieces is given back."""
        names, pieces = list(self._pieces[0]), self._pieces
        self._pieces = []
        return {name: np.concatenate([piece.pop(name) for piece in pieces]) for name in names}
