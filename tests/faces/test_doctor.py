"""What goes into a bug report, and the check that comes with it."""

from __future__ import annotations

import pytest

from magwire.cli import main
from magwire.report import health


def test_doctor_says_what_there_is_and_that_it_is_right(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["doctor"]) == 0
    seen = capsys.readouterr()
    assert seen.err == ""
    lines = dict(line.split("  ", 1) for line in seen.out.splitlines())
    assert {"magwire", "python", "packages", "system", "processor", "kernels' cache"} <= set(lines)
    assert {f"extra {name}" for name in health.EXTRAS} <= set(lines)
    assert sum("right:" in text for text in lines.values()) == 3
    for name in ("numba", "h5py", "numpy"):
        assert f"{name} " in lines["packages"]


def test_a_wrong_number_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = (health.Check("a", 1.1, 1.0, 1e-3), health.Check("b", float("nan"), 1.0, 1e-3))
    monkeypatch.setattr(health, "checks", lambda: iter(wrong))
    assert main(["doctor"]) == 1
    seen = capsys.readouterr()
    assert seen.out.count("WRONG:") == 2
    assert "must not be relied on" in seen.err


def test_help_says_what_a_report_needs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    assert "magwire doctor" in " ".join(capsys.readouterr().out.split())
