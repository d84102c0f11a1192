"""HDF5 files on disks that may be full: whole, or not there and one error."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, cast

from magwire.files import successor

if TYPE_CHECKING:
    import xarray as xr


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


def change(path: Path, act: Callable[[Any], None]) -> None:
    """Change an HDF5 file where it is.

    Parameters
    ----------
    path
        The file.
    act
        Called with the open file.

    Raises
    ------
    OSError
        If there is no room, or the file cannot be written; it is spoilt then.
    """
    import h5py

    with path.open("r+b", buffering=0) as file:
        sink = Sink(cast("IO[bytes]", file))
        try:
            with h5py.File(sink, "r+") as opened:
                act(opened)
        finally:
            sink.settle()


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
