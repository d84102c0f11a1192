"""Texts and files that parsers stumble over: a sentence each, and no memory without end."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.cli import main
from magwire.errors import MagwireError, ScenarioError
from magwire.many.sweep import read as read_sweep
from magwire.scenario import load, parse, read_schedule, schedule_of
from magwire.scenario.replays import replayed
from magwire.units import parse as parse_quantity

DIGITS, HEX = "9" * 5000, "0x" + "f" * 5000


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = " + "[" * 5000, "it is nested too deeply"),
        (f"a = {DIGITS}", "integer string conversion"),
        ("a = 1979-99-99", "not valid TOML"),
        ("a = 1\nb", "not valid TOML"),
        (f"[wire]\nnodes = {HEX}", "an integer must fit into 64 bits; received 20001"),
        (f"[navigate]\nmethod = [[{HEX}]]", "not valid TOML: an integer must fit into 64 bits"),
        (f"[wire]\nnodes = {2**63 - 1}", "Input wire.nodes must be at most 100000; received 92233"),
        (f'[wire]\nlength = "{DIGITS} mm"', "Input wire.length"),
        ('[wire]\nlength = "1e99999999999999999999 mm"', "must be a finite number"),
        ("[solver]\ntolerance = 1", "solver.tolerance"),
    ],
    ids=[
        "nested",
        "digits",
        "date",
        "key",
        "nodes",
        "method",
        "64 bits",
        "text",
        "exponent",
        "unknown",
    ],
)
def test_numbers_and_nesting_without_end(text: str, said: str) -> None:
    with pytest.raises(MagwireError) as caught:
        parse(text)
    assert said in str(caught.value)
    assert max(map(len, str(caught.value).splitlines())) < 700


def test_a_wire_too_thin_to_be_computed_with() -> None:
    scenario = load("straight", ("wire.radius=1e-300 mm",))
    with pytest.raises(MagwireError, match=r"wire\.radius must be such that bending_stiffness"):
        scenario.build()


def test_the_scenario_of_a_damaged_result() -> None:
    result = load("straight", ("feed.distance=1 mm", "wire.nodes=24")).run()
    result.dataset.attrs["scenario"] = result.scenario.replace("=", "\n", 1)
    with pytest.raises(ScenarioError, match="'of the result' is not valid TOML"):
        replayed(result)


def test_the_field_that_steered_a_damaged_result() -> None:
    """Only the outside field's table counts: it is taken off what was recorded."""
    result = load(
        "straight",
        ("feed.distance=1 mm", "wire.nodes=24", "field.flux_density=['0 mT', '0 mT', '1 mT']"),
    ).run()
    whole = schedule_of(result)
    text = result.scenario
    result.dataset.attrs["scenario"] = text.replace("speed", "sped")
    assert np.array_equal(schedule_of(result).flux_density, whole.flux_density)
    result.dataset.attrs["scenario"] = text.replace('kind = "uniform"', 'kind = "even"')
    with pytest.raises(ScenarioError, match=r"Input field\.kind must be one of .*'even'"):
        schedule_of(result)
    result.dataset.attrs["scenario"] = text.replace("=", "\n", 1)
    with pytest.raises(ScenarioError, match="'of the result' is not valid TOML"):
        schedule_of(result)


def test_a_run_with_a_scenario_that_is_none() -> None:
    job = load("straight", ("wire.nodes=24",)).build()
    with pytest.raises(MagwireError, match="scenario of a run must be valid TOML"):
        job.simulation.run(mw.Feed(1e-3, 1e-3), scenario="a b")


def test_an_exponent_beyond_decimal_numbers() -> None:
    with pytest.raises(MagwireError, match="must be a finite number"):
        parse_quantity("1e99999999999999999999 mm", "length")
    assert parse_quantity("1e-99999999999999999999 mm", "length") == 0.0


@pytest.mark.skipif(sys.platform == "win32", reason="no pipes in folders")
@pytest.mark.parametrize("reader", [load, read_schedule, read_sweep])
def test_pipes_and_devices_are_refused(reader, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "device.toml").symlink_to("/dev/zero")
    for name in ("pipe.toml", "device.toml"):
        with pytest.raises(MagwireError, match="it is no regular file"):
            reader(tmp_path / name)
    with pytest.raises(MagwireError, match="no regular file"):
        load("half-circle", (f"lumen.file={tmp_path / 'pipe.toml'}", "lumen.shape=vessel"))


@pytest.mark.skipif(sys.platform == "win32", reason="no pipes in folders")
def test_a_pipe_is_no_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(tmp_path / "result.nc")
    assert main(["plot", str(tmp_path)]) == 1
    assert capsys.readouterr().err.endswith("is no regular file.\n")


def test_titles_are_written_without_what_files_do_not_take(tmp_path: Path) -> None:
    short = ("feed.distance=1 mm", "wire.nodes=24", "navigate.method=none")
    scenario = load("straight", (*short, 'title="a\\u0000b\\nc $\\\\frac{"'))
    result = scenario.run(tmp_path / "result.nc")
    assert result.dataset.attrs["title"] == r"a b c $\frac{"
    result.plot(tmp_path / "figure.svg")
    assert "\x00" not in (tmp_path / "figure.svg").read_text()
