"""Where machine code is kept: in folders that nobody else can write to."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from magwire.kernels import _jit
from magwire.kernels.vectors import dot

if sys.platform == "win32":
    pytest.skip("folders of POSIX", allow_module_level=True)


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine without a home and without wishes; the folder for temporary files."""
    for name in ("MAGWIRE_CACHE", "NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", "/proc/none")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_a_home_that_cannot_be_written_to(temporary: Path) -> None:
    folder = _jit._cache_folder()
    assert folder is not None
    assert folder.parent == temporary / f"magwire-{os.getuid()}"
    assert folder.parent.stat().st_mode & 0o777 == 0o700
    assert _jit._cache_folder() == folder  # it serves the next process, too


@pytest.mark.parametrize("how", ["open to others", "a link", "a file"])
def test_a_folder_that_others_may_have_made_is_not_used(temporary: Path, how: str) -> None:
    planted = temporary / f"magwire-{os.getuid()}"
    if how == "open to others":
        planted.mkdir()
        planted.chmod(0o777)
    elif how == "a link":
        (temporary / "theirs").mkdir(mode=0o700)
        planted.symlink_to(temporary / "theirs")
    else:
        planted.write_text("")
    assert _jit._cache_folder() is None


def test_no_home_at_all(temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", homeless)
    folder = _jit._cache_folder()
    assert folder is not None
    assert folder.parent.name.startswith("magwire-")


def test_the_hash_is_inside_of_what_a_site_sets(
    temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(temporary / "site"))
    folder = _jit._cache_folder()
    assert folder is not None
    assert folder.parent == temporary / "site" / "magwire"
    assert folder.name.startswith("kernels-")
    monkeypatch.setenv("MAGWIRE_CACHE", str(temporary / "own"))
    own = _jit._cache_folder()
    assert own == temporary / "own" / folder.name


def test_a_cache_that_cannot_be_written_to(
    temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MAGWIRE_CACHE", "/proc/cache")
    folder = _jit._cache_folder()
    assert folder is not None
    assert folder.parent.parent == temporary


def test_machine_code_lies_where_the_site_wants_it(tmp_path: Path) -> None:
    """In a process of its own, since numba reads its settings once."""
    call = "from magwire.kernels.wall.barrier import barrier; barrier(0.5, 1.0)"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    environment.pop("MAGWIRE_CACHE", None)
    subprocess.run([sys.executable, "-c", call], env=environment, check=True)
    (folder,) = (tmp_path / "magwire").iterdir()
    assert folder.name == _jit._cache_folder().name  # type: ignore[union-attr]
    assert list(folder.rglob("barrier.barrier-*.nbi"))
    assert list(tmp_path.rglob("*.nbi")) == list(folder.rglob("*.nbi"))


def in_a_new_process(call: str, folder: Path) -> list[str]:
    """What a call of kernels prints, and the names of the functions that numba compiled for it."""
    listening = (
        "from numba.core import event; made = event.RecordingListener();"
        "event.register('numba:compile', made);"
    )
    names = "print(*sorted({e.data['dispatcher'].py_func.__qualname__ for _, e in made.buffer}))"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder)}
    environment.pop("MAGWIRE_CACHE", None)
    done = subprocess.run(
        [sys.executable, "-c", f"{listening}{call};{names}"],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    return done.stdout.splitlines()


def test_a_kernel_is_called_from_python_too(tmp_path: Path) -> None:
    """The second process finds what the first compiled, and compiles nothing."""
    assert isinstance(dot, _jit.Kernel)
    call = "from magwire.kernels.vectors import dot; print(dot((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)))"
    assert in_a_new_process(call, tmp_path) == ["32.0", "dot-from-python"]
    assert in_a_new_process(call, tmp_path) == ["32.0", ""]


def test_callers_take_in_what_is_cached(tmp_path: Path) -> None:
    """A new caller compiles itself alone where the kernels that it calls have been compiled."""
    turned = "from magwire.kernels.hinge import {0}; print({0}((0.0, 0.0, 1.0), {1}))"
    across = "(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)"
    assert in_a_new_process(turned.format("transport", across), tmp_path) == [
        "(0.0, 0.0, 1.0)",
        "add cross dot scale sub transport-from-python",
    ]
    assert in_a_new_process(turned.format("material_frame", "(1.0, 0.0, 0.0), 0.0"), tmp_path) == [
        "((0.0, 0.0, 1.0), (0.0, -1.0, 0.0))",
        "material_frame-from-python",
    ]
