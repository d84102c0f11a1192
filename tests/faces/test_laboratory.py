"""From a plan to the laboratory on the command line: export, check, replay through hardware."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from magwire.cli import main
from magwire.export import read_timetable
from magwire.results import Result

PAIR = """
[[actuator.pairs]]
axis = "{axis}"
radius = "{radius} mm"
turns = 200
max_current = "{limit} A"
resistance = "1 ohm"
inductance = "5 mH"
supply = "{supply} V"
"""


def platform(limit: float = 40.0, supply: float = 48.0) -> str:
    pairs = (("x", 80), ("y", 100), ("z", 120))
    text = "".join(PAIR.format(axis=a, radius=r, limit=limit, supply=supply) for a, r in pairs)
    pose = '\n[actuator.pose]\ntranslation = ["12.5 mm", "25 mm", "0 mm"]\n'
    return f'[actuator]\nkind = "helmholtz"\n{text}{pose}'


INPUTS = """
[navigate]
method = "inputs"

[navigate.table]
feed = ["0 mm", "3 mm", "6 mm"]
Ix = ["0 A", "-7 A", "-8 A"]
Iy = ["0 A", "1 A", "3 A"]
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run in the currents of a table, and its platform in a file."""
    from magwire.scenario import load

    folder = tmp_path_factory.mktemp("laboratory")
    sets = ["feed.distance=6 mm", "solver.time_step=50 ms", "output.record_every=0.5 mm"]
    text = load("half-circle", sets).to_toml()
    head = text.split("[navigate]")[0] + text.split("[navigate]")[1].split("\n\n", 1)[1]
    scenario = folder / "lab.toml"
    scenario.write_text(head + INPUTS + platform())
    (folder / "platform.toml").write_text(platform())
    assert main(["run", str(scenario), "--out", str(folder / "result"), "--no-figure"]) == 0
    return folder


STEPPER = ["--resolution", "5 um", "--backlash", "50 um", "--max-speed", "5 mm/s"]


@pytest.fixture(scope="module")
def schedule(made: Path) -> Path:
    words = ["export", str(made / "result"), "--to", "inputs", "--rate", "50"]
    assert main([*words, *STEPPER, "--out", str(made / "schedule")]) == 0
    return made / "schedule"


def test_export_follows_the_plan_in_samples(made: Path, schedule: Path) -> None:
    plan, table = Result.load(made / "result"), read_timetable(schedule)
    np.testing.assert_allclose(np.diff(table.time), 0.02, rtol=1e-9)
    assert table.names == ("Ix", "Iy", "Iz")
    assert table.feed[-1] == plan.feed[-1]
    for k in range(3):
        along = np.interp(plan.feed[1:], table.feed, table.inputs[:, k])
        np.testing.assert_allclose(along, plan.inputs[1:, k], atol=0.02)
    assert table.steps is not None
    assert table.steps[-1] == 1200
    np.testing.assert_array_equal(table.centreline, plan.dataset["centreline"])


def test_check_passes_and_ends_with_0(
    made: Path, schedule: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in (schedule, schedule / "inputs.csv", schedule / "inputs.nc"):
        assert main(["check", str(path), "--actuator", str(made / "platform.toml")]) == 0
        said = capsys.readouterr().out
        assert said.endswith("All limits are kept, and the field is the planned one.\n")
        assert "input Ix            -8 to 0 A\n" in said


def test_check_names_what_is_wrong_and_ends_with_1(
    made: Path, schedule: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = made / "other.toml"
    other.write_text(platform(limit=7.5).replace('radius = "100', 'radius = "110'))
    assert main(["check", str(schedule), "--actuator", str(other), "--max-speed", "0.5 mm/s"]) == 1
    said = capsys.readouterr().out.splitlines()
    current = next(line for line in said if "input Ix is" in line)
    assert "6 mm of feed, input Ix is -8 A; the limit is -7.5 A." in current
    assert any("the wire is fed by 1 mm/s; the limit is 0.5 mm/s." in line for line in said)
    assert any("mT from the planned one; the tolerance is" in line for line in said)
    assert said[-1].startswith("3 violations: ")
    wide = ["--tolerance", "2 mT"]
    assert main(["check", str(schedule), "--actuator", str(other), *wide]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == "1 violation: input."


def test_replay_through_hardware(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("magwire.plot.save", lambda *_, **__: None)  # figures take long
    plan = Result.load(made / "result")
    out = made / "replay"
    words = ["replay", str(made / "result"), "--out", str(out), "--quantum", "10 mA"]
    words += ["--delay", "50 ms", "--gain-error", "-0.03", "0.03", "0.03"]
    tilts = [f"--tilt={text}" for text in ("-1 deg, 0 deg, 0 deg", *["0 deg, 0 deg, 1 deg"] * 2)]
    assert main([*words, *tilts, "--force"]) == 0
    made_by = Result.load(out)
    assert "0.05 s late, too large by -0.03 0.03 0.03" in made_by.dataset.attrs["hardware"]
    ratio = made_by.inputs[-1, :2] / plan.inputs[-1, :2]
    np.testing.assert_allclose(ratio, [0.97, 1.03], atol=0.012)  # and late by 50 um
    assert not np.array_equal(made_by.position[-1], plan.position[-1])
    assert main(["replay", str(made / "result"), "--out", str(out), "--force"]) == 0
    exact = Result.load(out)
    assert "hardware" not in exact.dataset.attrs
    # Between two records the inputs of the plan are taken as linear: its kink is at one.
    np.testing.assert_allclose(exact.position[-1], plan.position[-1], atol=1e-7)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--to", "csv", "--rate", "50"], "Option --rate is for --to inputs; received '50.0'."),
        (["--to", "inputs", "--frame", "ras"], "Option --frame must be lps for inputs"),
        (["--to", "inputs", "--backlash", "50 um"], "Option --backlash needs --resolution"),
        (["--to", "inputs", "--rate", "0"], "Input rate of retime must be positive"),
    ],
)
def test_refused_exports(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    out = tmp_path / "out"
    assert main(["export", str(made / "result"), *words, "--out", str(out)]) == 1
    assert said in capsys.readouterr().err
    assert not out.exists()


def test_refused_hardware(made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    words = ["replay", str(made / "result"), "--out", str(out)]
    assert main([*words, "--gain-error", "0.1", "0.1"]) == 1
    assert "one for each of 3 inputs, or one for all; received 2." in capsys.readouterr().err
    assert main([*words, "--quantum", "10 mT"]) == 1
    assert "--quantum" in capsys.readouterr().err
    assert not out.exists()
