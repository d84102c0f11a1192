"""Files: read within bounds, replaced in one step, claimed by one process at a time."""

from __future__ import annotations

import errno
import os
import secrets
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import IO, Any

from magwire.errors import MagwireError

LARGEST_TEXT = 32_000_000
"""Bytes of a file that people write or that holds a table, at most."""


DRAFT, LOCK = ".draft", ".magwire.lock"


class InUseError(MagwireError):
    """A file or folder that another process is writing to."""


def read_bytes(path: str | Path, most: int = LARGEST_TEXT) -> bytes:
    """The bytes of a regular file.

    A pipe or a device may never end, and a file may be larger than memory.

    Parameters
    ----------
    path
        The file.
    most
        Size up to which it is read.

    Raises
    ------
    OSError
        If it cannot be read; ``strerror`` says why, also of what is no regular file or too large.
    """
    found = os.stat(path)
    if not S_ISREG(found.st_mode) and not S_ISDIR(found.st_mode):
        raise OSError(errno.EINVAL, "it is no regular file", str(path))
    if found.st_size > most:
        raise OSError(errno.EFBIG, f"it is larger than {most / 1e6:.0f} MB", str(path))
    with open(path, "rb") as file:
        return file.read(found.st_size)


def read_text(path: str | Path, most: int = LARGEST_TEXT) -> str:
    """The text of a regular file in UTF-8, with line ends as in Python.

    Raises
    ------
    OSError, UnicodeDecodeError
        As ``read_bytes``, and if it is no text.
    """
    text = read_bytes(path, most).decode("utf-8-sig")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def draft_of(path: Path) -> Path:
    """A new name next to a file for what is to take its place."""
    return path.with_name(f".{path.stem}.{secrets.token_hex(4)}{DRAFT}{path.suffix}")


@contextmanager
def successor(path: Path) -> Iterator[Path]:
    """A draft next to a file that takes its place in one step, if nothing goes wrong.

    Its name is its own, so that two processes do not write into one draft; it ends like the file's,
    which tells libraries what to write.
    """
    draft = draft_of(path)
    try:
        yield draft
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def write_whole(path: Path, data: bytes | str) -> None:
    """Write a file in one step: the former one stays if there is no room for the new one."""
    with successor(path) as draft:
        draft.write_bytes(data.encode() if isinstance(data, str) else data)


@contextmanager
def claimed(path: Path, name: str) -> Iterator[None]:
    """Keep other processes from writing what this one does; drafts that dead ones left are removed.

    Parameters
    ----------
    path
        A file to be written, or a folder.
    name
        What messages call it.

    Raises
    ------
    InUseError
        If another process has claimed it.
    OSError
        If nothing can be written there.
    """
    lock = path / LOCK if path.is_dir() else path.with_name(f".{path.name}.lock")
    with _held(lock) as ours:
        if not ours:
            raise InUseError(f"{name} '{path}' is being written by another process.")
        clear(path)
        yield


def is_left_over(path: Path) -> bool:
    """Whether a file is a lock or a draft, which stay behind when a process is killed."""
    return path.name.startswith(".") and (DRAFT in path.name or path.suffix == ".lock")


def clear(path: Path) -> None:
    """Remove what processes have left: a file's drafts, or all drafts and locks in a folder."""
    kind = f"*{DRAFT}*" if path.is_dir() else f"{path.stem}.????????{DRAFT}{path.suffix}"
    for draft in (path if path.is_dir() else path.parent).glob(f".{kind}"):
        with suppress(OSError):  # one that is a folder, or on Windows in use
            draft.unlink(missing_ok=True)
    for lock in path.glob(".*.lock") if path.is_dir() else ():
        with suppress(OSError), _held(lock):  # one that nobody holds goes when it is let go of
            pass


@contextmanager
def _held(lock: Path) -> Iterator[bool]:
    """Whether the lock is ours; the system lets go of it when the process ends in any way."""
    while True:
        file = lock.open("ab")
        if not _seize(file):
            file.close()
            yield False
            return
        # The one before may have removed the file that was just opened: then it locks nothing.
        with suppress(OSError):
            if os.path.samestat(os.fstat(file.fileno()), os.stat(lock)):
                break
        file.close()
    try:
        yield True
    finally:
        if os.name == "posix":
            lock.unlink(missing_ok=True)
        file.close()
        if os.name != "posix":  # Windows removes no file that is open
            with suppress(OSError):
                lock.unlink()


def _seize(file: IO[bytes]) -> bool:
    """Lock an open file; True, too, where the file system knows no locks."""
    try:
        if os.name == "posix":
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
    except OSError as error:
        return error.errno not in (errno.EWOULDBLOCK, errno.EACCES, errno.EDEADLK)
    return True


class TextFaultError(ValueError):
    """A text that is no TOML; the message is the end of a sentence."""


def parse_toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text.

    Raises
    ------
    TextFaultError
        If it is not valid, nested too deeply, or has a number that Python does not take; of
        integers, TOML 1.0 has those of 64 bits.
    """
    try:
        tables = tomllib.loads(text)
        _refuse_long_integers(tables)
        return tables
    except RecursionError:
        raise TextFaultError("it is nested too deeply") from None
    except TextFaultError:
        raise
    except ValueError as error:  # its own, and those of numbers and dates
        why = str(error).split(";")[0].rstrip(".")
        raise TextFaultError(why[:1].lower() + why[1:]) from None


def _refuse_long_integers(value: object) -> None:
    if isinstance(value, int) and value.bit_length() > 63:
        raise TextFaultError(f"an integer must fit into 64 bits; received {value.bit_length() + 1}")
    if isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            _refuse_long_integers(item)
