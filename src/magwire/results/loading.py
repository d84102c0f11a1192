"""A result file read back, and checked before anybody counts on what is in it."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from magwire.engine.record import MAY_BE_ABSENT
from magwire.errors import ResultError
from magwire.pieces import Plain
from magwire.results import plain
from magwire.results.contract import CONSTANTS, DERIVED, VARIABLES, running_attributes

if TYPE_CHECKING:
    import xarray as xr

FIRST = (
    "time", "feed", "position", "field", "contact_force", "clearance", "clearance_midpoint",
    "tip_force", "tip_offset", "newton_iterations", "stable", "wall_time",
    "normalized_push", "normalized_field", "normalized_tip_force",
)  # fmt: skip
"""Variables that every result has; those that came later may be absent from older files."""
LUMEN = ("centreline", "lumen_radius", "lumen_branch")
KNOWN: dict[str, Any] = VARIABLES | DERIVED | CONSTANTS
TEXTS = ("status", "message", "scenario")
NUMBERS = (*running_attributes(None), "length_scale", "force_scale", "field_scale")
PACKED = 1000
"""What compression makes smaller at most, over what is stored."""
CACHE = 2**17
"""Memory for chunks of each variable [bytes]; HDF5's own choice is 8 MB, times 35 variables."""
WHOLE = 2**24
"""Size of a file up to which it is read whole [bytes]."""


def load(path: Path) -> Plain | xr.Dataset:
    """The variables and attributes of a result file.

    All of a small one is in memory, and of one with compressed variables, which cannot be checked
    unread. Those of a large one are read as they are asked for.

    Raises
    ------
    ResultError
        If it is none, or damaged.
    """
    import h5py

    found: Plain | xr.Dataset | None = None
    if path.exists() and not path.is_file():  # reading a pipe may never end
        raise ResultError(f"Result file '{path}' is no regular file.")
    try:
        if not h5py.is_hdf5(path):
            raise OSError
        with h5py.File(path) as file:
            fault = _damage(file)
            large = path.stat().st_size > WHOLE
            large = large and all(file[name].compression is None for name in file)
            if large and not fault:
                fault = _gap(file, path.stat().st_size)
            elif not fault:
                found = plain.read(file, whole=True)
        if large and not fault:
            source = Source(path)  # anew: what was looked through is in memory
            found = plain.read(h5py.File(source, rdcc_nbytes=CACHE), whole=False)
            if found is not None:
                found.source = source
        if not fault:
            found = _opened(path, large=large) if found is None else found
            fault = _misfit(found)
    except Exception as error:  # a damaged file may raise anything in there
        raise ResultError(f"Result file '{path}' is not a readable NetCDF-4 file.") from error
    if fault or found is None:
        raise ResultError(f"File '{path}' {fault}.")
    return found


class Source(io.FileIO):
    """A file that closes when nothing reads from it any more, without a warning."""

    def __del__(self) -> None:
        self.close()


def _opened(path: Path, *, large: bool) -> xr.Dataset:
    """A file that is large, or not as this version writes it."""
    import xarray as xr

    return (xr.open_dataset if large else xr.load_dataset)(path, engine="h5netcdf")


def _damage(file: Any) -> str:
    """What is wrong with a file, found without reading its numbers; "" if nothing is."""
    if "status" not in file.attrs or "time" not in file:
        return "is not a result of magwire"
    absent = [name for name in FIRST if name not in file]
    absent += [name for name in (*TEXTS, *NUMBERS) if name not in file.attrs]
    if "wall_force" in file:  # not of the first version, which lacked these, see ``older``
        absent += ["tip_departure"] * ("tip_departure" not in file)
        absent += ["motion"] * ("motion" not in file.attrs)
    if absent:
        return f"is damaged: it lacks {' and '.join(absent[:3])}"
    for name in file:
        held = file[name]
        if name in KNOWN:
            stored = held.id.get_storage_size() * (1 if held.compression is None else PACKED)
            if held.size * held.dtype.itemsize > stored and not _absent(name, held, file):
                return f"is damaged: {name} claims {held.size} numbers, more than are stored"
    return ""


def _absent(name: str, held: Any, file: Any) -> bool:
    """Whether a variable has no numbers on purpose; without them it reads as zeros."""
    like = file["position"].shape[: held.ndim]
    never_written = held.fillvalue == 0 and not held.id.get_storage_size()
    return name in MAY_BE_ABSENT and never_written and held.shape == like


def _gap(file: Any, size: int) -> str:
    """What of a file's numbers is not in it, found without reading them; "" if all are."""
    for name in file:
        held, chunks, end = file[name], 0, 0
        if _absent(name, held, file):
            continue

        def look(chunk: Any) -> None:
            nonlocal chunks, end
            chunks, end = chunks + 1, max(end, chunk.byte_offset + chunk.size)

        if held.chunks is None:
            end = (held.id.get_offset() or 0) + held.id.get_storage_size()
        else:
            held.id.chunk_iter(look)
            shape = zip(held.shape, held.chunks, strict=True)
            if chunks < math.prod(-(-rows // of) for rows, of in shape):
                return f"is damaged: it lacks numbers of {name}"
        if end > size:
            return f"is damaged: {name} is not all in it"
    return ""


def _misfit(dataset: Plain | xr.Dataset) -> str:
    """What does not fit together; "" if all does."""
    for name, variable in dataset.variables.items():
        wanted = KNOWN.get(str(name))
        if wanted is None:
            continue
        if variable.dims != wanted.dims or variable.dtype.kind not in "fiu":
            return f"is damaged: {name} must have numbers along {' and '.join(wanted.dims)}"
    sizes = dataset.sizes
    if sizes.get("xyz") != 3 or sizes.get("node", 0) < 2:
        return f"is damaged: it has dimensions of {dict(sizes)}"
    absent = [name for name in LUMEN if name not in dataset.variables]
    if absent and len(absent) < len(LUMEN):  # none of them is there in open space
        return f"is damaged: it lacks {' and '.join(absent)}"
    texts = (*TEXTS, "motion")
    if any(not isinstance(dataset.attrs.get(name, ""), str) for name in texts):
        return f"is damaged: {' and '.join(texts)} must be texts"
    for name in NUMBERS:
        given = np.asarray(dataset.attrs[name])
        if given.size != 1 or given.dtype.kind not in "fiu":
            return f"is damaged: {name} must be a number"
    return ""
