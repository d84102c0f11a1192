"""HDF5 files on disks that may be full: whole, or not there and one error."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from magwire.files import draft_of, successor

if TYPE_CHECKING:
    import xarray as xr


CHUNK_CACHE = 0
"""Memory that HDF5 keeps of each variable: rows come in pieces that are larger [bytes]."""


class Sink:
    """A file that seems to take all that HDF5 writes; ``settle`` tells what it did not take.

    HDF5 does not bear a write that fails: it tries once more when the process ends, and that brings
    the process down.

    Parameters
    ----------
    file
        Unbuffered, for reading and writing.
    """

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._failure: OSError | None = None
        self._place = 0

    def settle(self) -> None:
        """Raise the first ``OSError`` that there was."""
        if self._failure is not None:
            raise self._failure

    def write(self, data: bytes | memoryview) -> int:
        """Write at the place where the file is, if nothing has gone wrong so far."""
        size = memoryview(data).nbytes
        self._try(lambda: self._write(memoryview(data).cast("B")))
        self._place += size
        return size

    def _write(self, data: memoryview) -> None:
        self._file.seek(self._place)
        while data:
            data = data[self._file.write(data) :]

    def read(self, size: int) -> bytes:
        """So many bytes; h5py knows a file by this and reads with ``readinto``."""
        data = bytearray(size)
        self.readinto(data)
        return bytes(data)

    def readinto(self, buffer: Any) -> int:
        """Read; zeros where a write has failed before."""
        room = memoryview(buffer).cast("B")
        self._file.seek(self._place)
        found = self._file.read(len(room)) or b""
        room[: len(found)] = found
        room[len(found) :] = bytes(len(room) - len(found))
        self._place += len(room)
        return len(room)

    def seek(self, place: int, whence: int = os.SEEK_SET) -> int:
        """Go to a place."""
        start = {os.SEEK_SET: 0, os.SEEK_CUR: self._place}.get(whence)
        self._place = place + (self._file.seek(0, os.SEEK_END) if start is None else start)
        return self._place

    def tell(self) -> int:
        """The place where the file is."""
        return self._place

    def truncate(self, size: int) -> int:
        """Cut or lengthen the file."""
        self._try(lambda: self._file.truncate(size))
        return size

    def flush(self) -> None:
        """Nothing waits here."""

    def _try(self, act: Callable[[], object]) -> None:
        if self._failure is None:
            try:
                act()
            except OSError as error:
                self._failure = error


class Draft:
    """A copy of a NetCDF-4 file that gets more records, and then takes the file's place.

    Rows are added through h5py, as all that is special about NetCDF-4 is in the file by now.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    OSError
        By all it does, if there is no room or the file cannot be written; it is spoilt then, and
        to be dropped.
    """

    def __init__(self, path: Path) -> None:
        import h5py

        self._path, self._copy = path, draft_of(path)
        with ExitStack() as stack:
            stack.callback(self._copy.unlink, missing_ok=True)
            shutil.copyfile(path, self._copy)
            raw = stack.enter_context(self._copy.open("r+b", buffering=0))
            self._sink = Sink(cast("IO[bytes]", raw))
            self._file = stack.enter_context(h5py.File(self._sink, "r+", rdcc_nbytes=CHUNK_CACHE))
            growing = {n: s for n, s in self._file.items() if s.maxshape[:1] == (None,)}
            self._sets = {name: held.id for name, held in growing.items()}
            self._ending = stack.pop_all()

    def read(self, name: str, count: int) -> Any:
        """The first numbers of a variable."""
        return self._file[name][:count]

    def add(self, first: int, columns: Mapping[str, NDArray[Any]]) -> None:
        """Put rows of variables behind the first ones, and forget what was there before.

        Variables that get none are made as long: HDF5 reads what was never written as their fill
        value, and keeps no room for it.
        """
        from h5py import h5s

        count = first + len(columns["time"])
        for name, held in self._sets.items():
            held.set_extent((count, *held.shape[1:]))
            values = columns.get(name)
            if values is not None and len(values):
                space = held.get_space()
                space.select_hyperslab((first,) + (0,) * (values.ndim - 1), values.shape)
                held.write(h5s.create_simple(values.shape), space, np.ascontiguousarray(values))
        self._sink.settle()

    def take_its_place(self, attributes: Mapping[str, Any]) -> None:
        """Replace the file, with these attributes."""
        self._sets.clear()
        try:
            for name, value in attributes.items():
                self._file.attrs.modify(name, value)
            self._file.close()
        finally:
            self._sink.settle()
        self._copy.replace(self._path)
        self._ending.close()

    def drop(self) -> None:
        """Leave the file as it is."""
        self._sets.clear()
        # A file that could not be written may not be closed in order, either.
        with suppress(OSError, RuntimeError):
            self._ending.close()


def create(path: Path, fill: Callable[[Any], None]) -> None:
    """Make a NetCDF-4 file in one step.

    Parameters
    ----------
    path
        The file; an existing one is overwritten.
    fill
        Called with the open ``h5netcdf.File``.

    Raises
    ------
    OSError
        If there is no room, or the file cannot be written; it is as it was then.
    """
    import h5netcdf

    with successor(path) as draft, draft.open("x+b", buffering=0) as file:
        sink = Sink(cast("IO[bytes]", file))
        try:
            with h5netcdf.File(sink, "w") as opened:
                fill(opened)
        finally:
            sink.settle()


def save(dataset: xr.Dataset, path: Path, unlimited: tuple[str, ...] = ()) -> None:
    """Write a dataset as NetCDF-4, in one step.

    Raises
    ------
    OSError
        As in ``create``.
    """
    from xarray.backends import H5NetCDFStore

    def fill(file: Any) -> None:
        dataset.dump_to_store(H5NetCDFStore(file), unlimited_dims=list(unlimited))

    create(path, fill)
