"""Verdicts both ways, and the report that carries them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from magwire import cli
from magwire.errors import InputError
from magwire.evidence.verify import report
from magwire.evidence.verify.evidence import Curve, Line, Raised, Skipped
from magwire.evidence.verify.page import to_html

GOOD = Line("twist", "a case", "angle", "rad", 2.0, "a <book>", 2.001, 1e-2)
BAD = replace(GOOD, case="another case", value=2.1)


@pytest.mark.parametrize(
    ("changes", "passed"),
    [
        ({}, True),
        ({"value": 2.01 - 1e-12}, True),
        ({"value": 2.011}, False),
        ({"value": 1.989}, False),
        ({"value": 2.019, "relative": True}, True),
        ({"value": 2.021, "relative": True}, False),
        ({"value": -2.0, "relative": True}, False),
        ({"value": math.nan}, False),
        ({"value": math.inf}, False),
        ({"reference": math.nan}, False),
        ({"reference": math.inf, "value": math.inf}, False),
        ({"value": math.inf, "tolerance": math.inf}, False),
        ({"order": 1.81, "expected_order": 2.0}, True),
        ({"order": 2.21, "expected_order": 2.0}, False),
        ({"order": 1.79, "expected_order": 2.0}, False),
        ({"order": math.nan, "expected_order": 2.0}, False),
        ({"value": 3.0, "order": 2.0, "expected_order": 2.0}, False),
    ],
)
def test_verdict(changes: dict[str, float], passed: bool) -> None:
    line = replace(GOOD, **changes)  # type: ignore[arg-type]
    assert line.passed is passed
    assert line.verdict == ("pass" if passed else "fail")


@pytest.mark.parametrize(
    "changes",
    [
        {"tolerance": math.nan},
        {"tolerance": -1.0},
        {"reference": 0.0, "relative": True},
        {"order": 2.0},
        {"expected_order": 2.0},
    ],
)
def test_lines_that_cannot_be_judged_are_refused(changes: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="a case: angle"):
        replace(GOOD, **changes)  # type: ignore[arg-type]


def give(monkeypatch: pytest.MonkeyPatch, *pieces: object) -> None:
    """Make the groups twist and contact give these pieces; an exception is raised."""

    def evidence(full: bool) -> Iterator[object]:
        for piece in pieces:
            if isinstance(piece, Exception):
                raise piece
            yield piece

    modules = {f"magwire.evidence.verify.{name}": SimpleNamespace(evidence=evidence) for name in
               ("twist", "contact")}  # fmt: skip
    monkeypatch.setattr(report, "import_module", modules.__getitem__)


@pytest.mark.parametrize(
    ("pieces", "passed"),
    [
        ((GOOD,), True),
        ((GOOD, Skipped("twist", "an engine", "it is not installed")), True),
        ((GOOD, BAD), False),
        ((BAD,), False),
        ((), False),
        ((Skipped("twist", "an engine", "it is not installed"),), False),
        ((GOOD, ZeroDivisionError("there is nothing\nto divide by")), False),
    ],
)
def test_report_and_exit_status(
    pieces: tuple[object, ...],
    passed: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    give(monkeypatch, *pieces)
    assert report.gather(["twist"]).passed is passed
    assert cli.main(["verify", "--only", "twist"]) == (0 if passed else 1)
    printed = capsys.readouterr().out
    for piece in (piece for piece in pieces if isinstance(piece, Line)):
        assert re.search(rf"{piece.name} .* {piece.verdict}\b", printed)


def test_an_error_is_a_line_and_the_other_groups_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    give(monkeypatch, GOOD, ZeroDivisionError("there is nothing\nto divide by"))
    first, second = report.gather(["twist", "contact"]).groups
    assert first.entries[0] == second.entries[0] == GOOD
    assert isinstance(second.entries[1], Raised)
    assert "ZeroDivisionError: there is nothing to divide by" in second.entries[1].reason


def test_unknown_groups_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(InputError, match="received chemistry, alchemy"):
        report.gather(["twist", "chemistry", "alchemy"])
    assert cli.main(["verify", "--only", "chemistry"]) == 1
    assert "received chemistry." in capsys.readouterr().err


def test_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    x = np.linspace(0.0, 1.0, 5)
    curve = Curve("A & B", "x", "y", {"theory": (x, x, "line"), "magwire": (x, x, "points")})
    broken = replace(BAD, value=math.nan)
    give(monkeypatch, GOOD, broken, Skipped("twist", "an engine", "not installed"), curve)
    words = ["verify", "--only", "twist", "--out", str(tmp_path / "out")]
    assert cli.main(words) == 1
    assert "a case: angle [rad]" in capsys.readouterr().out
    page = (tmp_path / "out" / "verify.html").read_text(encoding="utf-8")
    for text in ("Not all lines pass", "a &lt;book&gt;", "2.001", "A &amp; B", "not installed"):
        assert text in page
    assert not re.search(r"<(?:script|link)|src=\"(?!data:)", page), "one file, all in it"
    data = json.loads((tmp_path / "out" / "verify.json").read_text(encoding="utf-8"))
    assert data["passed"] is False
    assert data["counts"] == {"pass": 1, "fail": 1, "skipped": 1}
    good, bad, skipped = data["groups"][0]["entries"]
    assert good["error"] == pytest.approx(1e-3)
    assert (bad["value"], bad["verdict"]) == (None, "fail")
    assert skipped["reason"] == "not installed"
    assert cli.main(words) == 1, "the folder is not empty"
    assert "--force" in capsys.readouterr().err
    assert cli.main([*words, "--force"]) == 1


def test_the_page_of_a_good_report_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    give(monkeypatch, GOOD)
    assert "All lines pass." in to_html(report.gather(["twist"]))
