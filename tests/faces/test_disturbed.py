"""Disks that fill up, processes that are told to end, two at once: nothing is lost or let in."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from magwire.cli import main
from magwire.files import InUseError, claimed
from magwire.interrupt import nothing_dropped
from magwire.results import Result, Writer
from records import info, records

if sys.platform == "win32":
    pytest.skip("signals and limits of POSIX", allow_module_level=True)
import resource

CASES = Path(__file__).parents[1] / "data" / "robustness"
SCENARIO = CASES / "title-mathtext.toml"
LONG = ("--set", "navigate.method=none", "solver.time_step=0.2 ms")


def command(*words: str | Path) -> list[str]:
    return [sys.executable, "-m", "magwire", *map(str, words)]


def left_over(folder: Path) -> list[Path]:
    """Drafts and locks anywhere in a folder."""
    return [path for path in folder.rglob(".*") if path.is_file()]


def limited(size: int) -> Callable[[], None]:
    """Files of at most ``size`` bytes: to a process it is as though the disk were full."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run whose title is broken mathematical markup."""
    out = tmp_path_factory.mktemp("disturbed") / "out"
    assert main(["run", str(SCENARIO), "--out", str(out)]) == 0
    return out


def test_titles_are_drawn_letter_by_letter(finished: Path, tmp_path: Path) -> None:
    assert (finished / "figure.png").exists()
    assert Result.load(finished).dataset.attrs["title"] == r"a $\frac{$ b"
    movie = tmp_path / "a.gif"
    assert main(["animate", str(finished), "--out", str(movie), "--seconds", "0.3"]) == 0
    assert left_over(finished) == left_over(tmp_path) == []


@pytest.mark.parametrize("size", [100, 3_000, 20_000, 300_000])
def test_full_disk_is_one_sentence(finished: Path, tmp_path: Path, size: int) -> None:
    assert size < (finished / "result.nc").stat().st_size
    ended = subprocess.run(
        command("run", SCENARIO, "--out", tmp_path / "out"),
        preexec_fn=limited(size), capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 1
    assert len(ended.stderr.splitlines()) == 1
    assert "cannot be written: file too large." in ended.stderr
    assert left_over(tmp_path) == []
    if (tmp_path / "out" / "result.nc").exists():
        assert Result.load(tmp_path / "out").status == "running"


def test_what_was_flushed_before_the_disk_was_full_is_there(tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    program = f"""
import sys; sys.path.insert(0, {str(Path(__file__).parents[1])!r})
import resource
from pathlib import Path
from magwire.errors import ResultError
from magwire.results import Writer
from records import info, records
path, run = Path({str(path)!r}), info(nodes=50)
writer = Writer(run, path)
try:
    for k, record in enumerate(records(run, 1000, step=1e-6)):
        writer.append(record)
        if k % 10 == 9:
            writer.flush()
        if k == 500:
            size = path.stat().st_size + 5000
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
except ResultError as error:
    print(writer._written, error)
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    flushed, sentence = ended.stdout.split(" ", 1)
    assert "cannot be written: file too large" in sentence
    assert Result.load(path).time.size == int(flushed) >= 500
    assert left_over(tmp_path) in ([tmp_path / ".result.nc.lock"], [])  # it was not closed


def started(folder: Path, *words: str) -> subprocess.Popen[str]:
    """A long run that has written records, in ``folder / "out"``."""
    process = subprocess.Popen(
        command("run", "half-circle", "--out", folder / "out", *LONG, *words),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    file = folder / "out" / "result.nc"
    until = time.monotonic() + 240.0
    while time.monotonic() < until and process.poll() is None:
        if file.exists() and Result.load(file).time.size:
            break
        time.sleep(0.05)
    return process


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_being_told_to_end_closes_the_result(tmp_path: Path, number: signal.Signals) -> None:
    process = started(tmp_path)
    process.send_signal(number)
    _, said = process.communicate(timeout=120)
    assert process.returncode == 128 + number
    assert said == f"The process was told to end by {number.name}.\n"
    result = Result.load(tmp_path / "out")
    assert result.status == "terminated"
    assert result.message == f"The process was told to end by {number.name}."
    assert result.time.size > 0
    assert left_over(tmp_path) == []


def test_an_interrupt_that_a_compiler_drops_is_one_still(
    capsys: pytest.CaptureFixture[str],
) -> None:
    def called_back() -> None:
        raise KeyboardInterrupt

    def compiling() -> None:
        ctypes.CFUNCTYPE(None)(called_back)()
        raise RuntimeError("no compiled object yet")

    with pytest.raises(KeyboardInterrupt), nothing_dropped():
        compiling()
    with pytest.raises(RuntimeError), nothing_dropped():
        raise RuntimeError("of another kind")
    assert not capsys.readouterr().err


def test_the_second_run_into_a_folder_is_refused(tmp_path: Path) -> None:
    process = started(tmp_path)
    second = subprocess.run(
        command("run", "straight", "--out", tmp_path / "out", "--force"),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert second.returncode == 1
    assert second.stderr == (
        f"Output folder '{tmp_path / 'out'}' is being written by another process.\n"
    )
    process.kill()
    process.communicate()
    assert Result.load(tmp_path / "out").dataset.attrs["title"] == "Half-circle"
    # What the killed one leaves is gone with the next one, which is not kept off by it.
    assert main(["run", str(SCENARIO), "--out", str(tmp_path / "out"), "--force"]) == 0
    assert left_over(tmp_path) == []


def test_a_result_has_one_writer(tmp_path: Path) -> None:
    path, run = tmp_path / "result.nc", info()
    (tmp_path / ".result.12345678.draft.nc").write_text("left by a process that was killed")
    first = Writer(run, path)
    with pytest.raises(InUseError, match="is being written by another process"):
        Writer(run, path)
    for record in records(run, 3):
        first.append(record)
    first.close("complete")
    assert Result.load(path).time.size == 3
    assert left_over(tmp_path) == []
    Writer(run, path).close("complete")


def test_a_claim_ends_with_its_block(tmp_path: Path) -> None:
    for _ in range(2):
        with claimed(tmp_path, "Folder"), pytest.raises(InUseError):  # noqa: SIM117
            with claimed(tmp_path, "Folder"):
                pass
    assert os.listdir(tmp_path) == []


def test_whoever_claims_a_folder_takes_away_what_nobody_holds(tmp_path: Path) -> None:
    for name in (".result-none.nc.lock", ".result.1234.draft.nc"):
        (tmp_path / name).touch()
    with claimed(tmp_path / "result.nc", "Result file"):
        with claimed(tmp_path, "Folder"):
            there = sorted(os.listdir(tmp_path))
            assert there == [".magwire.lock", ".result.nc.lock"]  # both of them are held
        with pytest.raises(InUseError), claimed(tmp_path / "result.nc", "Result file"):
            pass
    assert os.listdir(tmp_path) == []


def damage(what: str, file: h5py.File) -> None:
    if what == "variable":
        del file["normalized_push"]
    elif what == "attribute":
        del file.attrs["scenario"]
    elif what == "number":
        file.attrs["force_scale"] = "many"
    elif what == "rows":
        file["tip_force"].resize(1_000_000_000, axis=0)
    else:
        del file["lumen_radius"]


@pytest.mark.parametrize("what", ["variable", "attribute", "number", "rows", "constant"])
def test_damaged_results_are_refused_in_a_sentence(
    finished: Path, tmp_path: Path, what: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "result.nc"
    path.write_bytes((finished / "result.nc").read_bytes())
    with h5py.File(path, "r+") as file:
        damage(what, file)
    for words in (["plot"], ["animate"], ["replay", "--out", str(tmp_path / "r")]):
        assert main([words[0], str(path), *words[1:]]) == 1
        said = capsys.readouterr().err
        assert said.startswith(f"File '{path}' is damaged: ")
        assert len(said.splitlines()) == 1
    assert not (tmp_path / "r").exists()


def test_results_say_when_and_with_what_they_were_made(finished: Path) -> None:
    made = Result.load(finished).dataset.attrs
    assert time.strptime(made["date_created"], "%Y-%m-%dT%H:%M:%SZ")
    assert f"h5py {h5py.__version__}" in made["packages"]
    assert "python 3." in made["packages"]
    assert made["platform"]
