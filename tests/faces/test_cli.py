"""The command line, as a user meets it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from cyclopts import App

import magwire
from magwire.cli import app, main
from magwire.results import Result
from magwire.scenario import load, names

SHORT = ("--set", "feed.distance=3 mm", "solver.time_step=100 ms", "wire.nodes=40")
SHORT += ("navigate.method=none",)
FILES = ["figure.png", "figure.svg", "result.nc", "scenario.toml"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that went to its end."""
    out = tmp_path_factory.mktemp("cli") / "out"
    assert main(["run", "half-circle", *SHORT, "--out", str(out)]) == 0
    return out


def files_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def python(*words: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "magwire", *words]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)


def test_list_names_every_scenario(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(names())
    assert all(len(line.split()) > 3 for line in lines)


def test_schema_is_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "Scenario"


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == magwire.__version__


def commands(group: App) -> Iterator[App]:
    """All commands, also those of groups of commands."""
    for name in (name for name in group if not name.startswith("-")):
        command = group[name]
        yield from (command,) if command.default_command else commands(command)


def test_every_option_is_explained() -> None:
    count = 0
    for command in commands(app):
        for option in command.assemble_argument_collection(parse_docstring=True):
            assert option.parameter.help, f"{command.name} {option.name}"
            assert not option.negatives, f"{command.name} {option.name}"
            count += 1
    assert count > 50


@pytest.mark.parametrize("words", [["--help"], [], ["run", "--help"]], ids=["help", "none", "run"])
def test_help(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 0
    assert "magwire" in capsys.readouterr().out


@pytest.mark.parametrize(
    "words",
    [["rnu"], ["run"], ["run", "helix", "--bad"], ["plot"], ["plot", "a", "b"], ["list", "more"]],
    ids=" ".join,
)
def test_wrong_words_are_one_line_on_stderr(
    words: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 1
    seen = capsys.readouterr()
    assert seen.out == ""
    assert len(seen.err.splitlines()) == 1
    assert files_in(folder) == []


def test_a_run_without_a_figure_leaves_the_rest(folder: Path) -> None:
    assert main(["run", "half-circle", *SHORT, "--out", "plain", "--no-figure"]) == 0
    assert files_in(folder / "plain") == ["result.nc", "scenario.toml"]
    assert main(["plot", "plain"]) == 0
    assert files_in(folder / "plain") == FILES


def test_run_leaves_four_files(finished: Path) -> None:
    assert files_in(finished) == FILES
    result = Result.load(finished)
    assert result.status == "complete"
    assert result.feed[-1] == pytest.approx(3e-3)
    assert result.time[-1] == pytest.approx(3.0)
    assert result.steps == 30
    assert result.dataset.attrs["title"] == "Half-circle"
    assert (finished / "figure.png").read_bytes().startswith(b"\x89PNG")
    assert "<svg" in (finished / "figure.svg").read_text()
    with xr.open_dataset(finished / "result.nc", engine="h5netcdf") as data:
        assert data["position"].dims == ("time", "node", "xyz")


def test_scenario_is_complete_and_runs_again(finished: Path, tmp_path: Path) -> None:
    text = (finished / "scenario.toml").read_text()
    assert Result.load(finished).scenario == text
    assert load(finished / "scenario.toml").wire.nodes == 40
    again = tmp_path / "again"
    assert main(["run", str(finished / "scenario.toml"), "--out", str(again)]) == 0
    assert (again / "scenario.toml").read_text() == text
    first, second = Result.load(finished), Result.load(again)
    np.testing.assert_array_equal(first.position, second.position)


def test_summary(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "half-circle", *SHORT]) == 0
    lines = dict(line.split("  ", 1) for line in capsys.readouterr().out.splitlines())
    assert lines["status"].strip() == "complete"
    assert lines["inserted"].strip() == "3 mm in 30 steps, 3 s simulated"
    assert "N, normalised" in lines["peak tip force"]
    assert "N, normalised" in lines["mean tip force"]
    assert lines["smallest clearance"].strip().endswith(" m")
    assert lines["first contact"].strip() == "none"
    assert lines["Newton iterations"].strip().endswith("per step")
    assert "s per simulated second" in lines["wall time"]
    assert lines["written to"].strip() == "half-circle-result"
    assert files_in(folder / "half-circle-result") == FILES


def test_former_output_is_kept_without_force(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = {path.name: path.read_bytes() for path in finished.iterdir()}
    assert main(["run", "straight", *SHORT, "--out", str(finished)]) == 1
    said = capsys.readouterr().err
    assert said == (
        f"Output folder '{finished}' exists already; use --force to overwrite it, or --out for "
        "another.\n"
    )
    assert before == {path.name: path.read_bytes() for path in finished.iterdir()}


def test_force_overwrites_only_its_own_files(folder: Path) -> None:
    (folder / "out").mkdir()
    (folder / "out" / "notes.txt").write_text("keep me")
    (folder / "out" / "result.nc").write_text("old")
    assert main(["run", "straight", *SHORT, "--out", "out", "--force"]) == 0
    assert files_in(folder / "out") == sorted([*FILES, "notes.txt"])
    assert (folder / "out" / "notes.txt").read_text() == "keep me"
    assert Result.load(folder / "out").status == "complete"


def test_empty_folder_may_be_used(folder: Path) -> None:
    (folder / "out").mkdir()
    assert main(["run", "straight", *SHORT, "--out", "out"]) == 0


def test_output_to_a_file_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "out").write_text("a file")
    assert main(["run", "straight", "--out", "out"]) == 1
    said = "Output folder 'out' is a file; expected a folder or a new name.\n"
    assert capsys.readouterr().err == said
    assert main(["run", "straight", "--out", "out/in"]) == 1
    said = "Output folder 'out/in' cannot be written: not a directory.\n"
    assert capsys.readouterr().err == said


def test_plot_redraws_next_to_the_result(
    finished: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (finished / "figure.svg").read_bytes()
    (finished / "figure.svg").unlink()
    assert main(["plot", str(finished)]) == 0
    assert (finished / "figure.svg").read_bytes() == before
    assert main(["plot", str(finished / "result.nc"), "--out", "pictures"]) == 0
    assert files_in(folder / "pictures") == ["figure.png", "figure.svg"]
    capsys.readouterr()
    assert main(["plot", str(finished), "--out", "pictures"]) == 1
    assert "use --force to overwrite" in capsys.readouterr().err
    assert main(["plot", str(finished), "--out", "pictures", "--force"]) == 0


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda path: None, "Result file 'thing' does not exist.\n"),
        (lambda path: path.mkdir(), "Folder 'thing' holds no result.nc.\n"),
        (
            lambda path: path.write_text("x"),
            "Result file 'thing' is not a readable NetCDF-4 file.\n",
        ),
    ],
    ids=["nothing", "folder", "text"],
)
def test_plot_of_no_result(make, said, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:  # type: ignore[no-untyped-def]
    make(folder / "thing")
    assert main(["plot", "thing"]) == 1
    assert capsys.readouterr().err == said


def test_module_is_the_command(tmp_path: Path) -> None:
    seen = python("run", "straight", *SHORT, cwd=tmp_path)
    assert seen.returncode == 0, seen.stderr
    assert seen.stderr == ""
    assert files_in(tmp_path / "straight-result") == FILES


def test_faults_by_the_module(tmp_path: Path) -> None:
    seen = python("run", "helix", "--set", "wire.radius=-1 mm", "wire.nodes=3", cwd=tmp_path)
    assert seen.returncode == 1
    assert seen.stdout == ""
    assert seen.stderr.splitlines() == [
        "Input wire.radius must be positive; received -1 mm.",
        "Input wire.nodes must be at least 4; received 3.",
    ]
    assert files_in(tmp_path) == []


@pytest.mark.skipif(sys.platform == "win32", reason="SIGINT cannot be sent to one process")
def test_interruption_leaves_a_readable_result(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "magwire", "run", "half-circle", "--out", "out"]
    command += ["--set", "solver.time_step=0.2 ms", "navigate.method=none"]
    process = subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    file = tmp_path / "out" / "result.nc"
    for _ in range(2400):
        if process.poll() is not None or (file.exists() and Result.load(file).time.size > 0):
            break
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 130, err
    assert "interrupted" in out
    assert "interrupted" in err
    result = Result.load(file)
    assert result.status == "interrupted"
    assert 0.0 < result.feed[-1] < 0.072
    assert files_in(tmp_path / "out") == ["result.nc", "scenario.toml"]  # nobody waits for figures
    assert "'magwire plot out' draws what there is" in err


@pytest.mark.parametrize(
    ("program", "heavy"),
    [
        ("import magwire; magwire.InputError", {"rich", "cyclopts"}),
        ("from magwire.cli import main; main(['--help'])", {"scipy"}),
    ],
    ids=["import", "help"],
)
def test_it_begins_light(program: str, heavy: set[str]) -> None:
    heavy = heavy | {"matplotlib", "xarray", "pydantic", "numba", "h5py"}
    program += f"; import sys; print(sorted({heavy} & set(sys.modules)))"
    seen = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert seen.stdout.splitlines()[-1] == "[]"


def test_every_public_name_is_there() -> None:
    for name in magwire.__all__:
        assert getattr(magwire, name) is not None
    assert set(dir(magwire)) >= set(magwire.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'wires'"):
        magwire.wires  # noqa: B018
