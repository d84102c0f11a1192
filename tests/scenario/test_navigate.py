"""How a scenario is steered: the navigate table, and schedules in files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from magwire.errors import InputError, ResultError, ScenarioError
from magwire.navigate import Prescribed, Schedule
from magwire.navigate.newton import NewtonNavigator
from magwire.navigate.paper import Optimiser, PaperNavigator
from magwire.navigate.stable import StableNavigator
from magwire.results import Result
from magwire.scenario import load, parse, read_schedule, schedule_of, write_schedule
from magwire.scenario.replays import replayed
from magwire.scenario.schedules import HEADER

SHORT = ("feed.distance=2 mm", "solver.time_step=100 ms", "wire.nodes=40", "navigate.method=none")
HEAD = ",".join(HEADER)
KNOTS = Schedule(
    np.array([0.0, 0.1, 0.3]) / 100.0,
    np.array([[0.0, 0.0, 1e-3 / 3.0], [1e-3, 0.0, 0.0], [0.0, -2e-3, 1e-9]]),
)


def same(first: Schedule, second: Schedule) -> bool:
    return np.array_equal(first.feed, second.feed) and np.array_equal(
        first.flux_density, second.flux_density
    )


def test_defaults_of_stable_are_written_out() -> None:
    scenario = load("half-circle")
    assert scenario.navigate.update_every == 5e-4
    assert scenario.navigate.tip_clearance == 0.4
    assert scenario.navigate.stability_margin == 1.0
    assert scenario.navigate.field_tolerance == 0.05
    assert scenario.navigate.max_field is None
    text = scenario.to_toml()
    written = text.split('method = "stable"\n')[1].split("\n[")[0]
    assert 'update_every = "0.5 mm"\n' in written
    assert "\ntip_clearance = 0.4\n" in written
    assert 'stability_margin = "1 1/s^2"' in text
    assert parse(text) == scenario


def test_demands_reach_the_navigator() -> None:
    keys = ["method=stable", "update_every=1 mm", "plan_every=0.3 mm", "tip_clearance=0.3"]
    keys += ["stability_margin=2 1/s²", "field_tolerance=0", "max_field=60 mT"]
    keys += ["max_field_rate=5 T/m"]
    scenario = load("half-circle", [f"navigate.{key}" for key in keys])
    assert parse(scenario.to_toml()) == scenario
    assert scenario.navigate.interval == 1e-3
    simulation = scenario.build().simulation
    navigator = scenario.navigate.build(simulation)
    assert isinstance(navigator, StableNavigator)
    assert navigator.plan_every == 3e-4
    demands = navigator.demands
    assert (demands.tip_clearance, demands.stability_margin) == (0.3, 2.0)
    assert (demands.field_tolerance, demands.max_field, demands.max_field_rate) == (0.0, 0.06, 5.0)
    assert scenario.navigate.build(simulation) is not navigator  # each run has its own memory


def test_another_method_starts_the_table_anew() -> None:
    keys = ["navigate.tip_clearance=0.3", "navigate.method=stable"]
    steered = load("half-circle", keys)
    assert steered.navigate.tip_clearance == 0.3
    passive = parse(steered.to_toml(), ["navigate.method=none"])
    assert passive == load("half-circle", ["navigate.method=none"]) == steered.unsteered()
    assert parse(steered.to_toml(), ["navigate.method=stable"]) == steered


def test_faults_of_navigate_next_to_others() -> None:
    keys = ["navigate.method=schedule", "navigate.file=none.csv", "wire.radius=4 mm"]
    with pytest.raises(ScenarioError) as caught:
        load("half-circle", keys)
    assert caught.value.faults == (
        "Input navigate.file 'none.csv' cannot be read: no such file or directory.",
        "Input wire.radius must be smaller than the lumen's smallest radius, 3 mm; received 4 mm.",
    )


def test_a_wire_of_sections_needs_a_magnet_somewhere() -> None:
    text = load("half-circle").to_toml()
    head, tail = text[: text.index("[wire]")], text[text.index("[lumen]") :]
    section = "[[wire.sections]]\nlength = '50 mm'\nradius = '0.6 mm'\nyoungs_modulus = '3 MPa'\n"
    section += "shear_modulus = '1 MPa'\ndensity = '2000 kg/m^3'\n"
    magnet = "magnetization = '128 kA/m'\n"
    assert parse(f"{head}[wire]\nnodes = 40\n{section}{section}{magnet}{tail}")
    with pytest.raises(ScenarioError) as caught:
        parse(f"{head}[wire]\nnodes = 40\n{section}{section}{tail}")
    assert caught.value.faults == (
        "Input wire.sections must have a magnetisation for navigate.method 'stable'; "
        "received none.",
    )


def test_schedule_file_is_read_back_to_the_same_numbers(tmp_path: Path) -> None:
    path = write_schedule(KNOTS, tmp_path / "mine.csv")
    assert path.read_text().splitlines()[0] == "feed [m],Bx [T],By [T],Bz [T]"
    assert same(read_schedule(path), KNOTS)


def test_schedule_ends_up_in_the_scenario(tmp_path: Path) -> None:
    write_schedule(KNOTS, tmp_path / "mine.csv")
    text = load("half-circle", ["navigate.method=none"]).to_toml()
    text = text.replace('method = "none"', 'method = "schedule"\nfile = "mine.csv"')
    (tmp_path / "scheduled.toml").write_text(text)
    scenario = load(tmp_path / "scheduled.toml")
    again = parse(scenario.to_toml())  # needs the CSV file no more
    assert again == scenario
    navigator = again.navigate.build(again.build().simulation)
    assert isinstance(navigator, Prescribed)
    assert same(navigator.schedule, KNOTS)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", f"must start with the header '{HEAD}'; received ''."),
        ("X,Y\n1,2\n", f"must start with the header '{HEAD}'; received 'X,Y'."),
        (f"# no rows\n{HEAD}\n", "must have at least one row; received none."),
        (f"{HEAD}\n0,0,0,0\n1,0,much,0\n", "every row; received '1,0,much,0' in row 2."),
        (f"{HEAD}\n0,0,0\n", "must have 4 finite numbers in every row; received '0,0,0' in row 1."),
        (f"{HEAD}\n0,0,inf,0\n", "every row; received '0,0,inf,0' in row 1."),
        (
            f"{HEAD}\n0,0,0,0\n2e-3,0,0,0\n1e-3,0,0,0\n",
            "must have feeds that increase; received 0.001 m after 0.002 m in row 3.",
        ),
    ],
    ids=["empty", "header", "no rows", "word", "short", "infinite", "falling"],
)
def test_faulty_schedule_files(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "faulty.csv"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_schedule(path)
    assert str(caught.value).startswith(f"Schedule file '{path}' must ")
    assert str(caught.value).endswith(said)


def test_schedule_file_that_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "some.csv").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(InputError, match=r"is not a text file\.$"):
        read_schedule(tmp_path / "some.csv")
    with pytest.raises(ResultError, match=r"holds no result\.nc\.$"):
        read_schedule(tmp_path)


def run(*keys: str) -> Result:
    return load("half-circle", [*SHORT, *keys]).run()


KEYS = (
    "navigate.method=schedule",
    "navigate.table=[['0 mm', '0 mT', '0 mT', '0 mT'], ['2 mm', '0 mT', '2 mT', '1 mT']]",
)


def test_schedule_of_a_result_is_what_steered_it() -> None:
    result = run(*KEYS)
    schedule = schedule_of(result)
    np.testing.assert_array_equal(schedule.feed, result.feed)
    np.testing.assert_array_equal(schedule.flux_density, result.field)
    np.testing.assert_allclose(schedule.flux_density[:, 1], schedule.feed, atol=1e-12)


@pytest.mark.parametrize("kind", ["uniform", "gradient"])
def test_the_fields_own_part_is_no_steering(kind: str) -> None:
    keys = ["field.flux_density=['1 mT', '0 mT', '0 mT']", f"field.kind={kind}"]
    if kind == "gradient":
        rows = "['1 T/m', '0 T/m', '0 T/m'], ['0 T/m', '-1 T/m', '0 T/m']"
        keys += [f"field.gradient=[{rows}, ['0 T/m', '0 T/m', '0 T/m']]"]
    result = run(*KEYS, *keys)
    assert np.linalg.norm(result.field[0]) > 5e-4
    schedule = schedule_of(result)
    expected = schedule.feed[:, None] * [0.0, 1.0, 0.5]
    np.testing.assert_allclose(schedule.flux_density, expected, atol=1e-12)
    again = replayed(result).run()
    np.testing.assert_allclose(again.position, result.position, rtol=0.0, atol=1e-9)


def test_only_rising_feeds_count() -> None:
    text = load("half-circle", [*SHORT, *KEYS]).to_toml()
    head, tail = text[: text.index("[feed]")], text[text.index("[navigate]") :]
    feed = '[feed]\ntable = [["0 s", "1 mm/s"], ["2 s", "1 mm/s"], ["4 s", "-1 mm/s"]]\n'
    result = parse(head + feed + tail).run()
    schedule = schedule_of(result)
    assert len(schedule.feed) < result.feed.size
    assert schedule.feed[-1] == result.feed.max()


def test_replay_scales_and_resamples() -> None:
    result = run(*KEYS)
    scenario = replayed(result, ["solver.time_step=50 ms"], scale=1.5, resample=1e-3)
    assert scenario.solver.time_step == 0.05
    rows = np.array(scenario.navigate.table)
    np.testing.assert_allclose(rows[:, 0], [0.0, 1e-3, 2e-3], atol=1e-15)
    np.testing.assert_allclose(rows[:, 2], [0.0, 1.5e-3, 3e-3], atol=1e-12)
    with pytest.raises(InputError, match="Input resample of a replay must be positive"):
        replayed(result, resample=0.0)


def test_replay_needs_a_scenario_and_records() -> None:
    result = run()
    bare = Result(result.dataset.isel(time=slice(0, 0)))
    with pytest.raises(InputError, match="must hold at least one record; received 0"):
        replayed(bare)
    result.dataset.attrs["scenario"] = ""
    with pytest.raises(InputError, match="must have a scenario"):
        replayed(result)


def test_the_virtual_tubes_navigators_get_their_numbers() -> None:
    newton = load("half-circle", ["navigate.method=newton", "navigate.plan_every=0.3 mm"])
    assert parse(newton.to_toml()) == newton
    navigator = newton.navigate.build(newton.build().simulation)
    assert isinstance(navigator, NewtonNavigator)
    assert navigator.plan_every == 3e-4

    keys = ["method=paper", "difference=0.2 mT", "beta1=0.8", "beta2=0.001", "iterations=7"]
    paper = load("half-circle", [f"navigate.{key}" for key in keys])
    assert parse(paper.to_toml()) == paper
    baseline = paper.navigate.build(paper.build().simulation)
    assert isinstance(baseline, PaperNavigator)
    assert baseline.optimiser == Optimiser(2e-4, 0.8, 1e-3, 0.05, 7)


def test_a_run_with_the_virtual_tube_in_the_navigators_model_only() -> None:
    short = ["feed.distance=30 mm", "solver.time_step=100 ms", "navigate.method=newton"]
    result = load("half-circle", short).run()
    assert result.status == "complete"
    assert result.max_tip_force == 0.0
    assert result.largest_tip_offset < 0.1 * 3e-3


def test_steering_knows_the_field_that_is_there() -> None:
    """Next to a background the tip stays as free as without it."""
    keys = ["feed.distance=12 mm", "solver.time_step=100 ms", "navigate.method=stable"]
    keys += ["field.flux_density=['0 mT', '-5 mT', '0 mT']"]
    result = load("half-circle", keys).run()
    assert result.status == "complete"
    assert result.max_tip_force == 0.0
    assert result.dataset["field"].values[0].tolist() == [0.0, -5e-3, 0.0]
