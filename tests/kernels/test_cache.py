"""Where machine code is kept: in folders that nobody else can write to."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path

import pytest

from magwire.kernels import _jit
from magwire.kernels.vectors import dot
from magwire.kernels.wall.barrier import barrier

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


def test_a_kernel_for_kernels_is_called_from_python_all_the_same() -> None:
    """Without the way in that numba compiles, a call from Python would end the process."""
    assert isinstance(dot, _jit.Inner)
    assert not isinstance(barrier, _jit.Inner)
    assert dot((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)) == 32.0


def test_what_magwire_calls_from_python_is_compiled_for_that() -> None:
    """A kernel for kernels would be compiled once more in every process."""
    source = Path(_jit.__file__).parents[1]
    seen, made_on_the_spot = 0, []
    for file in source.rglob("*.py"):
        if "kernels" in file.parts:
            continue
        tree = ast.parse(file.read_text(encoding="utf-8"))
        homes = {
            name.asname or name.name: (node.module, name.name)
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom)
            and (node.module or "").startswith("magwire.kernels")
            for name in node.names
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                module, name = homes.get(node.func.id, (None, ""))
                if module is not None:
                    seen += 1
                    if isinstance(getattr(import_module(module), name), _jit.Inner):
                        made_on_the_spot.append(f"{file.name}: {name}")
    assert seen > 50
    assert made_on_the_spot == []
