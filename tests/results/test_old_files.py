"""What version 0.1.0 wrote is read, drawn and run again."""

from __future__ import annotations

import lzma
from pathlib import Path

import numpy as np
import pytest

from magwire.cli import main
from magwire.results import Result
from magwire.scenario import load, parse

OLD = Path(__file__).parents[1] / "data" / "results" / "0.1.0.nc.xz"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """An output folder as 0.1.0 left it: its result and its scenario."""
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "result.nc").write_bytes(lzma.decompress(OLD.read_bytes()))
    text = Result.load(tmp_path / "old").scenario
    (tmp_path / "old" / "scenario.toml").write_text(text, encoding="utf-8")
    return tmp_path / "old"


def test_a_result_is_read(folder: Path) -> None:
    result = Result.load(folder)
    assert result.dataset.attrs["magwire_version"] == "0.1.0"
    assert (result.status, result.motion) == ("complete", "dynamic")
    assert result.feed == pytest.approx(np.linspace(0.0, 0.03, 7))
    assert result.max_tip_force == pytest.approx(6.468126e-4, rel=1e-6)
    force = np.linalg.norm(result.contact_force, axis=2).sum(axis=1)
    np.testing.assert_allclose(result.dataset["wall_force"], force)
    assert np.isnan(result.largest_tip_departure)  # nobody kept it


def test_a_result_is_drawn(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(folder)]) == 0
    assert (folder / "figure.png").stat().st_size > 10_000
    assert capsys.readouterr().err == ""


def test_a_result_is_run_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The wire ends within its own radius of where 0.1.0 had it: contact has changed since."""
    out = folder.parent / "again"
    words = ["replay", str(folder), "--out", str(out), "--set", "solver.time_step=100 ms"]
    assert main(words) == 0, capsys.readouterr().err
    old, new = Result.load(folder), Result.load(out)
    assert new.feed[-1] == pytest.approx(old.feed[-1])
    assert np.linalg.norm(new.position[-1, -1] - old.position[-1, -1]) < 0.6e-3
    np.testing.assert_allclose(new.field[-1], [0.0, 1e-3, 0.0])


def test_a_scenario_is_read(folder: Path) -> None:
    """What it left open was as it is now, and what it wrote out is kept."""
    scenario = load(folder / "scenario.toml")
    assert scenario.contact.stiffness == 1e3
    assert scenario.contact.activation_gap == 1e-4
    assert parse(scenario.to_toml()) == scenario
    assert scenario.build().simulation.system.lumen.length == pytest.approx(np.pi * 0.025)
