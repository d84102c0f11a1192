"""The one decorator of every compiled kernel, and where its machine code is cached."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numba

Function = TypeVar("Function", bound=Callable[..., object])


def _cache_folder() -> Path:
    """Folder for the machine code of exactly these kernel sources and this numba.

    numba looks only at the file of a kernel, not at the kernels it calls: an edit in an imported
    file would leave stale machine code. The folder's name therefore carries a hash of them all.
    """
    digest = hashlib.sha256(numba.__version__.encode())
    folder = Path(__file__).parent
    for source in sorted(folder.rglob("*.py")):
        digest.update(str(source.relative_to(folder)).encode())
        digest.update(source.read_bytes())
    base = os.environ.get("MAGWIRE_CACHE")
    root = Path(base) if base else _user_cache()
    return root / f"kernels-{digest.hexdigest()[:16]}"


def _user_cache() -> Path:
    """The user's cache folder, or a temporary one where there is no home to write to."""
    home = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    folder = (Path(home) if home else Path.home() / ".cache") / "magwire"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        folder = Path(tempfile.gettempdir()) / "magwire"
    return folder


def compiled_before() -> bool:
    """Whether machine code of these kernels is there from an earlier run."""
    return any(Path(numba.config.CACHE_DIR).rglob("march.march-*.nbc"))


if "NUMBA_CACHE_DIR" not in os.environ:
    numba.config.CACHE_DIR = str(_cache_folder())


def kernel(function: Function) -> Function:
    """Compile a kernel on first use; cached on disk, free of the GIL, IEEE division.

    Without numba's runtime (``_nrt``) arrays are not reference-counted, which costs half of a time
    step; a kernel that allocates memory is refused.
    """
    compiled: Function = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=False)(
        function
    )
    return compiled


def part(function: Function) -> Function:
    """A kernel that has one caller only: compiled as a part of it, not once more on its own."""
    compiled: Function = numba.njit(
        cache=True, nogil=True, error_model="numpy", _nrt=False, inline="always"
    )(function)
    return compiled
