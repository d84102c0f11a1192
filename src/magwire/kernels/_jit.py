"""The one decorator of every compiled kernel, and where its machine code is cached."""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import TypeVar, cast

import numba
from numba.core.registry import CPUDispatcher

from magwire.kernels._collector import hold_back
from magwire.kernels._inner import InnerCache, InnerCompiler
from magwire.kernels._known import remember_calls

Function = TypeVar("Function", bound=Callable[..., object])


def _cache_folder() -> Path | None:
    """Folder for the machine code of exactly these kernel sources and this numba.

    numba looks only at the file of a kernel, not at the kernels it calls: an edit in an imported
    file would leave stale machine code. The folder's name therefore carries a hash of them all,
    also inside the folder that a site has chosen for numba.
    """
    digest = hashlib.sha256(numba.__version__.encode())
    folder = Path(__file__).parent
    for source in sorted(folder.rglob("*.py")):
        digest.update(str(source.relative_to(folder)).encode())
        digest.update(source.read_bytes())
    name = f"kernels-{digest.hexdigest()[:16]}"
    for root in (_chosen(), _private()):
        if root is not None and _writable(root / name):
            return root / name
    return None


def _chosen() -> Path | None:
    """The folder that somebody has chosen, or the user's own; None without a home."""
    own, site = os.environ.get("MAGWIRE_CACHE"), os.environ.get("NUMBA_CACHE_DIR")
    home = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    if own or site:
        return Path(own) if own else Path(site or "") / "magwire"
    try:
        return (Path(home) if home else Path.home() / ".cache") / "magwire"
    except RuntimeError:
        return None


def _private() -> Path | None:
    """A folder for temporary files that only this user can write to; None if there is none.

    numba loads what it finds as pickles, which can run anything: nobody else may put them there.
    """
    user = os.getuid() if hasattr(os, "getuid") else None  # Windows has such folders by user
    try:
        folder = Path(tempfile.gettempdir()) / (
            f"magwire-{user}" if user is not None else "magwire"
        )
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return None
    if user is None:
        return folder
    ours = stat.S_ISDIR(found.st_mode) and found.st_uid == user and not found.st_mode & 0o077
    return folder if ours else None


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


CACHE = _cache_folder()
"""Where machine code is kept; None if there is no place to write to: each process compiles then."""
if CACHE is not None:
    numba.config.CACHE_DIR = str(CACHE)
hold_back()
remember_calls()


def compiled_before() -> bool:
    """Whether machine code of these kernels is there from an earlier run."""
    return CACHE is not None and any(CACHE.rglob("march.march-*.nbc"))


SHARED = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


class Kernel(CPUDispatcher):  # type: ignore[misc]
    """A kernel, compiled for its callers without the way in from Python.

    That way unpacks hundreds of arrays: compiled for every kernel it took a third of a cold start.
    The first call from Python compiles the function once more, with it.
    """

    _door: Callable[..., object] | None = None

    def __call__(self, *args: object) -> object:
        if self._door is None:
            self._door = entry(_under_another_name(self.py_func))
        return self._door(*args)

    def enable_caching(self) -> None:
        self._cache = InnerCache(self.py_func)


def _under_another_name(function: FunctionType) -> FunctionType:
    """The same function; its machine code has a file of its own, named by the function."""
    twin = FunctionType(
        function.__code__,
        function.__globals__,
        function.__name__,
        function.__defaults__,
        function.__closure__,
    )
    twin.__module__, twin.__doc__ = function.__module__, function.__doc__
    twin.__qualname__ = f"{function.__qualname__}-from-python"
    return twin


def kernel(function: Function) -> Function:
    """Compile a kernel on first use; cached on disk, free of the GIL, IEEE division.

    Without numba's runtime (``_nrt``) arrays are not reference-counted, which costs half of a time
    step; a kernel that allocates memory is refused.
    """
    return _inner(function)


def part(function: Function) -> Function:
    """A kernel that has one caller only: compiled as a part of it, not once more on its own."""
    return _inner(function, inline="always")


def short(function: Function) -> Function:
    """A kernel that does little with many arrays: machine code of its own in each of its callers.

    A call hands over hundreds of pointers; on the way of every step that is a tenth of its time.
    """
    return _inner(function, forceinline=True)


def entry(function: Function) -> Function:
    """Compile what only Python calls, with the way in from there; cached as kernels are."""
    made: Function = numba.njit(cache=CACHE is not None, _nrt=False, **SHARED)(function)
    return made


def summing(function: Function) -> Function:
    """A kernel that is one long sum, whose terms may be added in any order.

    Only so are several terms taken at once (SIMD): the field of dozens of coils takes a third of
    the time. Products may be joined to sums without rounding in between; no other liberty is taken
    with the arithmetic.
    """
    return _inner(function, fastmath={"reassoc", "contract"})


def _inner(function: Function, **more: object) -> Function:
    options = {"nopython": True, "no_cpython_wrapper": True, "_nrt": False, **SHARED, **more}
    made = Kernel(py_func=function, targetoptions=options, pipeline_class=InnerCompiler)
    if CACHE is not None:
        made.enable_caching()
    return cast(Function, made)
