"""Inputs by time: held, rotated and ramped while the wire stands or moves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.scenario import load, parse
from magwire.scenario.courses import read_columns
from magwire.scenario.replays import replayed

WIRE = mw.Wire.uniform(0.05, 0.6e-3, 3e6, 1e6, 2000.0, 24, magnetized_tip=5e-3, magnetization=128e3)
TIME = [0.0, 1.0, 3.0]
FLUX = [[0.0, 0.0, 0.0], [0.0, 8e-3, 0.0], [0.0, 0.0, 8e-3]]
SHORT = ("wire.nodes=24", "lumen.length=60 mm", "lumen.radius=20 mm", "wire.length=50 mm")
HELD = (*SHORT, "feed.distance=20 mm", "feed.speed=5 mm/s", "solver.time_step=50 ms")
BZ, BY = "['0 mT', '0 mT', '8 mT']", "['0 T', '8 mT', '0 T']"
TABLE = f"{{ time = ['0 s', '1 s', '3 s'], Bz = {BZ}, By = {BY} }}"


def held(navigator: mw.TimedInputs) -> mw.Result:
    """A wire that is fed for two seconds and then stands for two."""
    simulation = mw.Simulation(WIRE, mw.Lumen.open_space())
    feed = mw.Feed.table([0.0, 2.0, 2.001, 4.0], [5e-3, 5e-3, 0.0, 0.0])
    return simulation.run(feed, navigator, time_step=0.05, record_every=2.5e-4)


def test_field_of_a_run_is_that_of_its_time() -> None:
    timed = mw.TimedInputs(TIME, FLUX)
    result = held(timed)
    assert result.status == "complete"
    assert (np.diff(result.feed)[-20:] == 0.0).all()  # the wire stands, and the field turns
    np.testing.assert_allclose(result.field, timed.over(result.time), atol=1e-18)
    turned = result.position[-1, -1]
    assert turned[2] > 5e-4
    assert abs(turned[1]) < 0.1 * turned[2]


def test_inputs_are_put_in_the_order_of_the_actuator() -> None:
    names = (("Bz", "T"), ("By", "T"))
    swapped = mw.TimedInputs(TIME, [row[:0:-1] for row in FLUX], names)
    np.testing.assert_array_equal(held(swapped).field, held(mw.TimedInputs(TIME, FLUX)).field)
    with pytest.raises(mw.InputError, match="those of the actuator, Bx, By, Bz; received I"):
        held(mw.TimedInputs([0.0], [[1.0]], (("I", "A"),)))


@pytest.mark.parametrize(
    ("time", "inputs", "said"),
    [
        ([0.0, 0.0], np.zeros((2, 3)), "Input time of TimedInputs must hold at least one value"),
        ([], np.zeros((0, 3)), "received 0 values"),
        ([0.0, 1.0], np.zeros((2, 2)), "Input inputs of TimedInputs must have"),
    ],
)
def test_faulty_tables(time: list[float], inputs: np.ndarray, said: str) -> None:
    with pytest.raises(mw.InputError, match=said):
        mw.TimedInputs(time, inputs)


def test_a_session_says_that_it_goes_by_the_feed() -> None:
    simulation = mw.Simulation(WIRE, mw.Lumen.open_space())
    with (
        simulation.session(navigator=mw.TimedInputs(TIME, FLUX)) as wire,
        pytest.raises(mw.NavigationError, match="in a session give its inputs to each step"),
    ):
        wire.step(feed_speed=1e-3)


def test_a_scenario_and_its_replay(tmp_path: Path) -> None:
    scenario = load("straight", (*HELD, "navigate.method=timed", f"navigate.table={TABLE}"))
    result = scenario.run(tmp_path / "result.nc")
    assert result.status == "complete"
    assert result.field[-1] == pytest.approx([0.0, 0.0, 8e-3], abs=1e-9)
    again = replayed(result)
    assert again.to_toml() == scenario.to_toml()
    np.testing.assert_array_equal(again.run().position, result.position)
    half = replayed(result, scale=0.5).run()
    np.testing.assert_allclose(half.field, 0.5 * result.field, atol=1e-18)


def test_a_file_stands_for_the_table(tmp_path: Path) -> None:
    (tmp_path / "turn.csv").write_text("time [s],By [T],Bz [T]\n0,0,0\n1,0.008,0\n3,0,0.008\n")
    words = (*HELD, "navigate.method=timed", f"navigate.table={TABLE}")
    text = load("straight", words).to_toml()
    table = text[text.index("[navigate.table]") :]
    rest = table.partition("\n\n")[2]
    (tmp_path / "own.toml").write_text(
        text.replace(table, rest).replace('method = "timed"', 'method = "timed"\nfile = "turn.csv"')
    )
    read = load(tmp_path / "own.toml")
    assert sorted(read.navigate.table.names) == [("By", "T"), ("Bz", "T")]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("feed [m],By [T]\n0,0\n", r"such as 'time \[s\],Ix \[A\],Iy \[A\]', in SI"),
        ("time [s],By [T]\n1,0\n1,0\n", r"times that increase; received 1 s after 1 s in row 2"),
    ],
)
def test_faulty_files(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "turn.csv").write_text(text)
    with pytest.raises(mw.MagwireError, match=said):
        read_columns(tmp_path / "turn.csv", "time")


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("{ feed = ['0 mm'], By = ['1 mT'] }", "must have a list of times and one of an input"),
        ("{ time = ['1 s', '0 s'], By = ['1 mT', '1 mT'] }", "must have times that increase"),
        ("{ time = ['0 mm'], By = ['1 mT'] }", r"\(time\)"),
        ("{ time = ['0 s'], Ix = ['1 A'] }", "must be those of the actuator, Bx, By, Bz"),
        ("{ time = ['0 s'], By = ['1 A'] }", "Input By of the actuator is in T; received in A"),
    ],
)
def test_faulty_scenarios(table: str, said: str) -> None:
    text = load("straight", HELD).to_toml()
    with pytest.raises(mw.MagwireError, match=said):
        parse(text, ("navigate.method=timed", f"navigate.table={table}"))
