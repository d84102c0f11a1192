"""Steering from the command line: run, compare, replay, schedule files."""

from __future__ import annotations

import contextlib
import io
import shutil
from pathlib import Path

import numpy as np
import pytest

from magwire import plot
from magwire.cli import main
from magwire.report.run import gains, lines
from magwire.results import Result
from magwire.scenario import load, read_schedule

STEERED = ("--set", "feed.distance=16 mm", "solver.time_step=100 ms", "wire.nodes=40")
STEERED += ("navigate.update_every=1 mm", "navigate.plan_every=1 mm")
SHORT = ("--set", "feed.distance=2 mm", "solver.time_step=100 ms", "wire.nodes=40")
SHORT += ("navigate.method=none",)
FILES = ["figure.png", "figure.svg", "result.nc", "scenario.toml", "schedule.csv"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """The folder of a steered run with the passive one next to it, and what the command said."""
    out = tmp_path_factory.mktemp("steering") / "out"
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        words = ["run", "half-circle", *STEERED, "--compare", "none", "--out", str(out)]
        assert main(words) == 0
    return out, said.getvalue()


@pytest.fixture(scope="module")
def compared(finished: tuple[Path, str]) -> Path:
    """The folder of the run."""
    return finished[0]


def files_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def rows_in(said: str) -> dict[str, str]:
    lines = [line for line in said.splitlines() if line]
    return {line[:20].strip(): line[20:].strip() for line in lines}


def test_steering_keeps_the_tip_off_the_wall(compared: Path) -> None:
    assert files_in(compared) == sorted([*FILES, "result-none.nc"])
    steered, passive = Result.load(compared), Result.load(compared / "result-none.nc")
    assert steered.status == passive.status == "complete"
    assert steered.contact_free
    assert not passive.contact_free
    assert passive.peak_field == 0.0
    assert 'method = "none"' in passive.scenario


def test_summary_tells_of_steering(finished: tuple[Path, str]) -> None:
    rows = rows_in(finished[1])
    assert rows["peak tip force"] == "0 N, normalised 0"
    assert float(rows["not steered"].split()[0]) > 0.0
    assert rows["tip contact-free"] == "yes, at every step"
    assert rows["wire contact-free"].startswith(("yes", "no, though its tip is: up to "))
    for name in ("peak wire force", "on 5.13 mm of it", "on the magnet", "peak push at guide"):
        assert "N, normalised" in rows[name]  # 5.13 mm: two edges of a coarse mesh
    assert rows["largest tip offset"].endswith("mm")
    assert rows["motion"] == "dynamic"
    assert rows["stable"] == "at every record"
    result = Result.load(finished[0])
    away, at = result.largest_tip_departure, result.feed[np.nanargmax(result.tip_departure)]
    said = f"{1e3 * away:.3g} mm at most at the tip, at a feed of {1e3 * at:.6g} mm"
    assert rows["model error"] == said
    assert 0.0 < away < 1e-4
    field, normalised = rows["peak field"].split(", normalised ")
    assert field.endswith(" mT")
    assert float(normalised) == pytest.approx(float(field.split()[0]) * 4.742, rel=1e-3)


def test_summary_of_quasi_static_motion(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [*STEERED, "solver.motion=quasi-static", "--out", "out"]
    assert main(["run", "half-circle", *words]) == 0
    rows = rows_in(capsys.readouterr().out)
    assert rows["inserted"].startswith("16 mm in 160 steps")
    assert rows["motion"] == "quasi-static, an equilibrium at every step"
    assert rows["largest move"].endswith("mm beyond what was inserted, between two records")
    assert float(rows["largest move"].split()[0]) < 0.1
    assert Result.load(folder / "out").motion == "quasi-static"


def test_unstable_equilibrium_is_an_error(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    keys = ["solver.motion=quasi-static", "field.flux_density=['-20 mT', '0 mT', '0 mT']"]
    keys += ["output.record_every=0.5 mm", "feed.distance=30 mm"]
    assert main(["run", "straight", "--set", *keys, "--out", "out"]) == 1
    seen = capsys.readouterr()
    rows = rows_in(seen.out)
    assert rows["status"] == "unstable"
    assert rows["stable"] == "not at 1 of 50 records, first at a feed of 24.5 mm"
    assert seen.err.startswith("The equilibrium at 24.5 mm of feed is unstable: ")
    assert files_in(folder / "out") == FILES[:-1]


def test_what_was_gained_is_said_in_the_end(finished: tuple[Path, str]) -> None:
    out, said = finished
    passive = Result.load(out / "result-none.nc")
    peak, mean = (f"{1e3 * f:.3g} mN" for f in (passive.max_tip_force, passive.mean_tip_force))
    rows = rows_in(said)
    assert list(rows)[-4:] == ["gained, tip", "gained, wire", "gained, guide", "written to"]
    assert rows["gained, tip"] == f"peak force from {peak} to none, mean from {mean} to none"
    steered = Result.load(out)
    before, after = (f"{1e3 * run.max_push_force:.3g} mN" for run in (passive, steered))
    assert rows["gained, guide"] == f"peak push from {before} to {after}"


def test_gain_over_a_shorter_way_says_so(compared: Path) -> None:
    passive = Result.load(compared / "result-none.nc")
    part = Result(passive.dataset.isel(time=slice(0, 101)))
    assert gains(part, passive)[0].endswith("; over 10 mm of 16")


def test_a_free_tip_does_not_hide_what_presses_behind_it(compared: Path) -> None:
    data = Result.load(compared).dataset.copy(deep=True)
    data["wall_force"][-1], data["patch_force"][-1] = 96e-3, 40e-3
    data.attrs["first_contact_feed"] = 0.012
    rows = rows_in("\n".join(lines(Result(data), steered=True)))
    assert rows["tip contact-free"] == "yes, at every step"
    said = "no, though its tip is: up to 96 mN in all, 40 mN on 5.13 mm"
    assert rows["wire contact-free"] == said
    data["wall_force"][-1], data["patch_force"][-1] = 2.03, 0.201  # a stiff wire's
    rows = rows_in("\n".join(lines(Result(data), steered=True)))
    assert "up to 2.03 N in all, 201 mN on" in rows["wire contact-free"]


def test_comparison_needs_steering(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "half-circle", *SHORT, "--compare", "none"]) == 1
    assert capsys.readouterr().err == (
        "Option --compare none needs a scenario that is steered; navigate.method is 'none'.\n"
    )
    assert files_in(folder) == []


def test_comparison_is_drawn_again(compared: Path, folder: Path) -> None:
    steered, passive = Result.load(compared), Result.load(compared / "result-none.nc")
    axes = plot.draw(steered.dataset, passive.dataset).get_axes()
    legends = [ax.get_legend() for ax in axes]
    texts = [[text.get_text() for text in legend.get_texts()] for legend in legends if legend]
    assert ["steered", "not steered"] in texts
    assert ["$B_x$", "$B_y$", "$B_z$"] in texts
    assert any(ax.get_ylabel() == "field [mT]" for ax in axes)
    before = (compared / "figure.svg").read_bytes()
    assert main(["plot", str(compared), "--out", "again"]) == 0
    assert (folder / "again" / "figure.svg").read_bytes() == before
    assert main(["plot", str(compared / "result-none.nc"), "--out", "passive"]) == 0
    assert (folder / "passive" / "figure.svg").read_bytes() != before


def test_passive_run_in_place_of_a_steered_one(
    compared: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(compared, folder / "out")
    assert main(["run", "half-circle", *SHORT, "--out", "out", "--force"]) == 0
    assert "peak field" not in rows_in(capsys.readouterr().out)
    assert files_in(folder / "out") == FILES[:-1]


def test_replay_without_a_change_is_the_same_run(
    compared: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", str(compared)]) == 0
    rows = rows_in(capsys.readouterr().out)
    assert rows["tip contact-free"].startswith("yes")
    assert rows["written to"] == "out-replay"
    assert files_in(folder / "out-replay") == FILES
    first, second = Result.load(compared), Result.load(folder / "out-replay")
    np.testing.assert_allclose(second.position, first.position, rtol=0.0, atol=1e-9)
    again = load(folder / "out-replay" / "scenario.toml")
    assert again.navigate.method == "schedule"
    assert again.to_toml() == second.scenario


def test_replay_in_another_field(compared: Path, folder: Path) -> None:
    words = ["replay", str(compared / "result.nc"), "--scale", "1.03", "--resample", "2 mm"]
    assert main([*words, "--out", "off"]) == 0
    first, second = Result.load(compared), Result.load(folder / "off")
    assert second.peak_field == pytest.approx(1.03 * first.peak_field, rel=1e-6)
    assert main([*words, "--out", "off"]) == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nowhere",), "Result file 'nowhere' does not exist.\n"),
        (
            ("OUT", "--resample", "2 s"),
            "Input --resample needs a unit of length such as '5 mm'; received '2 s', which is a "
            "time.\n",
        ),
        (("OUT", "--scale", "nan"), "Input scale of a replay must be a finite number; "),
        (("OUT", "--set", "wire.radius=4 mm"), "Input wire.radius must be smaller than "),
    ],
    ids=["nothing", "resample", "scale", "scenario"],
)
def test_faulty_replay(
    words: tuple[str, ...],
    said: str,
    compared: Path,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    given = [str(compared) if word == "OUT" else word for word in words]
    assert main(["replay", *given]) == 1
    seen = capsys.readouterr()
    assert seen.err.startswith(said)
    assert len(seen.err.splitlines()) == 1
    assert files_in(folder) == []


def test_schedule_from_a_file(compared: Path, folder: Path) -> None:
    first = read_schedule(compared / "schedule.csv")
    assert np.array_equal(first.flux_density, Result.load(compared).field)
    assert np.array_equal(first.flux_density, read_schedule(compared).flux_density)
    file = compared / "schedule.csv"
    keys = [*STEERED[:4], "navigate.method=schedule", f"navigate.file={file}"]
    assert main(["run", "half-circle", *keys, "--out", "out"]) == 0
    assert (folder / "out" / "schedule.csv").read_text() == file.read_text()
    again = Result.load(folder / "out")
    np.testing.assert_array_equal(again.position, Result.load(compared).position)


def test_no_field_is_said_with_the_reason(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [*STEERED, "navigate.max_field=0.1 mT", "--out", "out"]
    assert main(["run", "half-circle", *words]) == 1
    seen = capsys.readouterr()
    assert rows_in(seen.out)["status"] == "no field"
    assert len(seen.err.splitlines()) == 1
    assert seen.err.endswith("mT; the limit is 0.1 mT.\n")
    assert files_in(folder / "out") == FILES
    result = Result.load(folder / "out")
    assert result.status == "no field"
    assert seen.err.strip() == result.message
    assert 0.0 < result.feed[-1] < 16e-3
