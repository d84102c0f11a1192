"""The record of a run, kept in memory or written to a NetCDF-4 file as the run goes."""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Callable
from contextlib import ExitStack
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self, cast

import numpy as np

import magwire
from magwire.engine.record import Record, RunInfo
from magwire.errors import ResultError
from magwire.files import claimed
from magwire.interrupt import Terminated
from magwire.pieces import Column, Plain
from magwire.results import disk
from magwire.results.contract import (
    CONSTANTS,
    DERIVED,
    FLOAT,
    VARIABLES,
    Constant,
    Derived,
    Variable,
    derive,
    layout_of,
    opening_attributes,
    running_attributes,
    sizes,
)
from magwire.results.rows import Held, Rows
from magwire.status import RunStatus

if TYPE_CHECKING:
    from magwire.results.result import Result

FLUSH_SECONDS = 2.0
"""Wall time between flushes [s]."""
FLUSH_SHARE = 0.03
"""Share of the wall time that flushing may take: flushes of a very large file come less often."""
CHUNK_BYTES = 2**16
MOST_WAITING = 2**23
"""Memory of the records that wait for a flush, and of the first ones without a file [bytes].

From 4 MB on numpy asks for large pages: to touch new memory costs a tenth.
"""
SAME = 1e-9
"""Times that differ by less are the same [s]."""


class Writer:
    """Takes the records of a run and makes its result.

    Between flushes records wait in memory; where there are too many of them, as the file is large
    and flushes come less often, in a draft of the file. A flush appends them to a copy of the file,
    which then takes the place of the file in one step: a process that is killed at any time leaves
    a file that is complete up to its last flush, and others may read it while the run goes.

    As a context manager the writer closes itself when the block is left by an exception:
    "interrupted" after Ctrl-C, "terminated" when the process is told to end, "failed" else. No
    other process may write the same file meanwhile.

    Parameters
    ----------
    info
        What is known of the run before its first step.
    path
        File to write, overwritten if it exists; None keeps the result in memory.

    Raises
    ------
    ResultError
        If the file cannot be written.
    InUseError
        If another process is writing it.
    """

    def __init__(self, info: RunInfo, path: str | Path | None = None) -> None:
        self.info = info
        self.layout = layout_of(info)
        self.sizes = sizes(info, self.layout)
        self.path = None if path is None else Path(path)
        self.closed = False
        self._waiting = Rows(info, MOST_WAITING)
        self._kept = Held()
        self._last: Record | None = None
        self._written = 0
        self._due = 0.0
        self._draft: disk.Draft | None = None
        self._flushed: tuple[int, Record | None] = (0, None)
        self._claim = ExitStack()
        self._attributes = opening_attributes(info, self.layout, magwire.__version__)
        self._attributes |= {"status": RunStatus.RUNNING.value, "message": ""}
        self._attributes |= running_attributes(None)
        if self.path is not None:
            self._begin(self.path)

    def append(self, record: Record) -> None:
        """Take a record."""
        self._last = record
        self._waiting.append(record)
        if self.path is None:
            if self._waiting.full:
                self._hold()
        elif time.monotonic() >= self._due:
            self.flush()
        elif self._waiting.full:
            self._try(self._put_aside)

    def _hold(self) -> None:
        """Keep what waits in memory for good."""
        self._kept.add(self._written, self._columns())
        self._written += len(self._waiting)
        self._waiting = Rows(self.info, MOST_WAITING)

    def rewind(self, record: Record) -> None:
        """Go on from a record of a wire that went back: what was recorded since is dropped.

        A file keeps what was flushed until the next flush, which takes it out.
        """
        kept = self._before(record.time - SAME)
        self._waiting.drop(max(0, kept - self._written))
        self._written = min(self._written, kept)
        if kept < self._flushed[0]:
            self._flushed = (kept, record)
        self.append(record)

    def _before(self, time: float) -> int:
        """How many records are of a time [s] before this one."""
        waiting = self._waiting.before(time)
        if waiting or not self._written:
            return self._written + waiting
        there = self._kept if self.path is None else self._draft
        if there is not None:
            return int(np.searchsorted(there.read("time", self._written), time))
        import h5py

        with h5py.File(cast(Path, self.path)) as file:
            return int(np.searchsorted(file["time"][: self._written], time))

    def flush(self) -> None:
        """Bring what waits in memory into the file, so that it survives the end of the process."""
        if self.path is None or self.closed or not (self._waiting or self._draft is not None):
            return
        begin = time.monotonic()
        self._try(self._commit)
        end = time.monotonic()
        self._due = end + max(FLUSH_SECONDS, (end - begin) / FLUSH_SHARE)

    def close(self, status: str, message: str = "") -> None:
        """End the record.

        Parameters
        ----------
        status
            A ``RunStatus``, or the word of the watcher that ends the run.
        message
            One sentence on why, "" if the run is complete.
        """
        if self.closed:
            return
        ending = {"status": str(status), "message": message}
        self._attributes |= running_attributes(self._last) | ending
        self.closed = True
        if self.path is not None:
            try:
                self._commit(self.path, **ending)
            except OSError as error:
                raise _unwritable(self.path, error) from None
            finally:
                self._drop_draft()
                self._claim.close()

    def result(self) -> Result:
        """What has been recorded; of a closed writer only."""
        from magwire.results.result import Result

        if not self.closed:
            raise ResultError("A result can be had from its writer only after the run has ended.")
        return Result.of(self._held) if self.path is None else Result.load(self.path)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self.close(RunStatus.COMPLETE)
        elif isinstance(error, KeyboardInterrupt):
            self.close(RunStatus.INTERRUPTED, "The run was interrupted.")
        elif isinstance(error, Terminated):
            self.close(RunStatus.TERMINATED, str(error))
        else:
            self.close(RunStatus.FAILED, str(error) or type(error).__name__)

    def _columns(self) -> dict[str, Any]:
        """The variables of the records that wait, each with time as its first axis."""
        columns = self._waiting.columns()
        derived = derive(columns, self.layout)
        return columns | {name: derived[name] for name in derived if self._exists(DERIVED[name])}

    @cached_property
    def _held(self) -> Plain:
        """What has been recorded in memory."""
        data: dict[str, Column] = {}
        self._hold()
        columns = self._kept.columns()
        for name, variable in self._growing().items():
            shape = (self._written, *(self.sizes[dim] for dim in variable.dims[1:]))
            column = np.zeros(shape) if name in self.info.absent else columns.pop(name)
            notes = {"units": variable.units, "long_name": variable.long_name}
            data[name] = Column(variable.dims, column, notes | dict(variable.extra))
        for name, constant in self._constants().items():
            notes = {"units": constant.units, "long_name": constant.long_name}
            data[name] = Column(constant.dims, self._constant(constant), notes)
        return Plain(data, self._attributes)

    def _growing(self) -> dict[str, Variable | Derived]:
        """The variables that grow with time."""
        return {name: v for name, v in (VARIABLES | DERIVED).items() if self._exists(v)}

    def _constants(self) -> dict[str, Constant]:
        """The variables without time; a run in open space has none."""
        return {name: c for name, c in CONSTANTS.items() if self._exists(c)}

    def _constant(self, constant: Constant) -> Any:
        return np.asarray(constant.read(self.info, self.layout)).astype(constant.dtype)

    def _exists(self, variable: Variable | Derived | Constant) -> bool:
        """Whether a variable has anything to say: none of its dimensions is empty."""
        return all(self.sizes.get(dim, 1) > 0 for dim in variable.dims)

    def _begin(self, path: Path) -> None:
        """Make the file, without records."""
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            if path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            self._claim.enter_context(claimed(path, "Result file"))
            disk.create(path, self._lay_out)
        except OSError as error:
            self._claim.close()
            raise _unwritable(path, error) from None

    def _try(self, act: Callable[[Path], None]) -> None:
        """Write while the run goes."""
        if self.path is None:
            return
        before = self._written
        try:
            act(self.path)
        except PermissionError as error:
            # On Windows, while others read the file: the next flush takes it all, if it is there.
            if self._written < before:
                raise _unwritable(self.path, error) from None
        except OSError as error:
            raise _unwritable(self.path, error) from None

    def _commit(self, path: Path, **attributes: str) -> None:
        """Add what waits, and these attributes, to the file: all of it or nothing."""
        self._put_aside(path)
        if self._draft is not None:
            self._draft.take_its_place(running_attributes(self._last) | attributes)
        self._draft, self._flushed = None, (self._written, self._last)

    def _put_aside(self, path: Path) -> None:
        """Add what waits to a draft that is to take the place of the file."""
        try:
            if self._draft is None:
                self._draft = disk.Draft(path)
            self._draft.add(self._written, self._columns())
        except BaseException:
            # Rows that were put aside are lost with the draft, and those that follow would not fit.
            self._drop_draft()
            if self._written > self._flushed[0]:
                self._waiting.drop(0)
                self._written, self._last = self._flushed
            raise
        self._written += len(self._waiting)
        self._waiting.drop(0)

    def _drop_draft(self) -> None:
        if self._draft is not None:
            self._draft.drop()
            self._draft = None

    def _lay_out(self, file: Any) -> None:
        """All that is known from the start, and no records."""
        lengths = {name: size for name, size in self.sizes.items() if size > 0}
        file.dimensions = {"time": None, **lengths}
        for name, value in self._attributes.items():
            file.attrs[name] = value
        for name, variable in self._growing().items():
            shape = tuple(lengths[dim] for dim in variable.dims[1:])
            rows = max(1, CHUNK_BYTES // (variable.dtype.itemsize * int(np.prod(shape))))
            # What is missing is NaN, what is absent is zero; coordinates have no fill value.
            zero = name == "time" or name in self.info.absent
            fill = np.nan if variable.dtype == FLOAT and not zero else None
            made = file.create_variable(
                name, variable.dims, variable.dtype, chunks=(rows, *shape), fillvalue=fill
            )
            notes = {"units": variable.units, "long_name": variable.long_name}
            made.attrs.update(notes | dict(variable.extra))
        for name, constant in self._constants().items():
            made = file.create_variable(name, constant.dims, constant.dtype)
            made[...] = self._constant(constant)
            made.attrs.update({"units": constant.units, "long_name": constant.long_name})


def _unwritable(path: Path, error: OSError) -> ResultError:
    reason = (error.strerror or str(error)).lower()
    return ResultError(f"Result file '{path}' cannot be written: {reason}.")
