"""The table [actuator]: every kind of it, its faults, and steering by its inputs."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from actuate.handed import FOLDER, needs_files
from actuate.on_an_arm import fastest, nearest
from magwire import Result
from magwire.actuate import Helmholtz, Loops, Magnet, Map, Maxwell, Omnimagnet, Uniform
from magwire.errors import InputError, ScenarioError
from magwire.navigate import arm
from magwire.navigate.inputs import InputSchedule
from magwire.scenario import inputs_of, load_actuator, parse, read_inputs, write_inputs
from magwire.scenario.reader import load, text_of
from magwire.scenario.replays import replayed

PAIR = """
[[actuator.pairs]]
axis = "{}"
radius = "{} mm"
turns = 200
max_current = "{} A"
resistance = "1 ohm"
inductance = "5 mH"
supply = "48 V"
"""
POSE = """
[actuator.pose]
translation = ["12.5 mm", "25 mm", "0 mm"]
"""
FAST = [
    'navigate={method="stable", stability_margin="10 1/s^2", update_every="1 mm"}',
    "feed.speed=4 mm/s",
    "solver.time_step=20 ms",
    "output.record_every=1 mm",
]


def platform(limit: float = 40.0, kind: str = "helmholtz") -> str:
    pairs = "".join(PAIR.format(*pair, limit) for pair in (("x", 80), ("y", 100), ("z", 120)))
    return f'[actuator]\nkind = "{kind}"\n{pairs}{POSE}'


def half_circle(table: str) -> str:
    return f"{text_of('half-circle')[0]}\n{table}"


def faults(table: str, *overrides: str, folder: Path | None = None) -> tuple[str, ...]:
    with pytest.raises(ScenarioError) as caught:
        parse(half_circle(table), ["navigate.method=none", *overrides], folder=folder)
    return caught.value.faults


def alone(table: str, tmp_path: Path) -> Path:
    path = tmp_path / "actuator.toml"
    path.write_text(table)
    return path


TABLES = {
    "uniform": ('max_component = "50 mT"\nslew = "1 T/s"', Uniform, "Bx By Bz"),
    "uniform-gradient": ('max_gradient = "1 T/m"', Uniform, "Bx By Bz Gxx Gxy Gxz Gyy Gyz"),
    "omnimagnet": (
        'moments = ["1 A m^2", "2 A m^2", "3 A m^2"]\nposition = ["0 mm", "0 mm", "120 mm"]\n'
        'max_current = "20 A"\nresistance = "2 ohm"',
        Omnimagnet,
        "Ix Iy Iz",
    ),
    "magnet": (
        'radius = "25 mm"\nlength = "50 mm"\nremanence = "1.45 T"\n'
        'parked = ["0 mm", "0.3 m", "0 mm"]\naimed = [0, -1, 0]\nkeep_out = "60 mm"\n'
        'speed = "100 mm/s"\nturning = "90 deg/s"\n'
        'reach = [["-0.3 m", "-0.3 m", "-0.3 m"], ["0.3 m", "0.3 m", "0.3 m"]]',
        Magnet,
        "x y z dx dy dz",
    ),
    "loops": (
        "coils = [\n"
        '{input = "I1", centre = ["0 mm", "0 mm", "90 mm"], axis = [0, 0, 2], radius = "50 mm", '
        'turns = 100, width = "20 mm", height = "10 mm"},\n'
        '{input = "I1", centre = ["0 mm", "0 mm", "-90 mm"], axis = [0, 0, 1], radius = "50 mm", '
        "turns = -100},\n]\n"
        'currents = [{input = "I1", max_current = "8 A", resistance = "0.5 ohm"}]',
        Loops,
        "I1",
    ),
}


@pytest.mark.parametrize("kind", TABLES)
def test_every_kind_is_read_and_written(kind: str) -> None:
    text, model, names = TABLES[kind]
    scenario = parse(
        half_circle(f'[actuator]\nkind = "{kind}"\n{text}\n'), ["navigate.method=none"]
    )
    assert scenario.actuator is not None
    actuator = scenario.actuator.build()
    assert isinstance(actuator, model)
    assert " ".join(one.name for one in actuator.inputs) == names
    again = parse(scenario.to_toml())
    assert again.to_toml() == scenario.to_toml()
    assert again.actuator is not None
    assert again.actuator.build() == actuator


@pytest.mark.parametrize(("kind", "model"), [("helmholtz", Helmholtz), ("maxwell", Maxwell)])
def test_pairs_are_those_of_the_model(kind: str, model: type, tmp_path: Path) -> None:
    path = alone(platform(kind=kind), tmp_path)
    actuator = load_actuator(path, ["actuator.max_power=2 kW"])
    assert isinstance(actuator, model)
    assert actuator.max_power == 2e3
    assert [one.high for one in actuator.inputs] == [40.0, 40.0, 40.0]
    assert actuator.inputs[0].rates(8.0) == (-(48.0 + 8.0) / 5e-3, (48.0 - 8.0) / 5e-3)
    np.testing.assert_allclose(actuator.pose.shift, (0.0125, 0.025, 0.0))


def test_a_magnet_has_its_limits(tmp_path: Path) -> None:
    magnet = load_actuator(alone(f'[actuator]\nkind = "magnet"\n{TABLES["magnet"][0]}\n', tmp_path))
    assert isinstance(magnet, Magnet)
    np.testing.assert_array_equal(magnet.idle, (0.0, 0.3, 0.0, 0.0, -1.0, 0.0))
    assert magnet.keep_out == 0.06
    assert [one.slew for one in magnet.inputs] == [0.1] * 3 + [math.pi / 2] * 3
    assert [one.high for one in magnet.inputs] == [0.3] * 3 + [1.0] * 3


def test_a_pose_in_other_axes_is_the_same_place(tmp_path: Path) -> None:
    """What is at (-1, -2, 3) in LPS is at (1, 2, 3) in RAS, and so is the field there."""
    table = platform().replace('["12.5 mm", "25 mm", "0 mm"]', '["10 mm", "-4 mm", "2 mm"]')
    turn = 'rotation = ["0 deg", "30 deg", "40 deg"]\n'
    here = load_actuator(alone(table + turn, tmp_path))
    there = load_actuator(alone(table + turn + 'axes = "RAS"\n', tmp_path))
    flip, u = np.diag([-1.0, -1.0, 1.0]), (3.0, -2.0, 1.0)
    point = np.array([[0.02, 0.01, -0.01]])
    flux, slope = here.at(point, u)
    turned, turned_slope = there.at(point @ flip, u)
    np.testing.assert_allclose(turned, flux @ flip, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(turned_slope[0], flip @ slope[0] @ flip, rtol=1e-9, atol=1e-12)


def test_a_map_is_read_from_its_file_and_told_apart_from_another(tmp_path: Path) -> None:
    axis = np.linspace(-0.1, 0.1, 5)
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    flux = np.stack([grid[:, 1], grid[:, 0], np.full(len(grid), 1e-3)], axis=1)
    lines = [
        "x,y,z,Bx,By,Bz",
        *(",".join(map(repr, row)) for row in np.hstack([grid, flux]).tolist()),
    ]
    (tmp_path / "one.csv").write_text("\n".join(lines))
    table = '[actuator]\nkind = "map"\nfields = [{input = "I1", file = "one.csv"}]\n'
    table += "[actuator.pose]\ntranslation = ['0 mm', '25 mm', '0 mm']\n"
    scenario = parse(half_circle(table), ["navigate.method=none"], folder=tmp_path)
    assert scenario.actuator is not None
    actuator = scenario.actuator.build()
    assert isinstance(actuator, Map)
    made = actuator.at(np.array([[0.02, 0.045, 0.01]]), [2.0])[0][0]
    np.testing.assert_allclose(made, (0.04, 0.04, 2e-3), atol=1e-12)
    kept = scenario.to_toml()
    assert parse(kept, folder=Path("/")).to_toml() == kept  # from wherever
    far = faults(table.replace("'25 mm'", "'225 mm'"), folder=tmp_path)
    assert len(far) == 1
    assert far[0].startswith("The box in which the actuator is calibrated must hold the lumen; at ")
    assert "the lumen is 128 mm outside" in far[0]
    assert "extrapolate" not in far[0]
    (tmp_path / "one.csv").write_text("\n".join(lines).replace("0.001", "0.002"))
    with pytest.raises(ScenarioError, match="checksum must be that of the actuator's files"):
        parse(kept)


def test_all_faults_are_told_at_once() -> None:
    table = platform().replace('axis = "z"', 'axis = "w"').replace("turns = 200", "turnz = 200", 1)
    said = faults(table, "actuator.pairs.1.radius=nan mm", "lumen.radius=-1 mm")
    assert said == (
        "Input lumen.radius must be positive; received -1 mm.",
        "Input actuator.pairs[0].turns is missing; expected a plain number from 1e-06 to 1e+06.",
        "Input actuator.pairs[0].turnz is not a key of [actuator.pairs[0]]; did you mean 'turns'?",
        "Input actuator.pairs[1].radius must be a finite number; received nan mm.",
        "Input actuator.pairs[2].axis must be 'x', 'y' or 'z'; received 'w'.",
    )


@pytest.mark.parametrize(
    ("table", "said"),
    [
        (
            'kind = "coil"',
            "Input actuator.kind must be one of 'uniform', 'helmholtz', 'loops', 'magnet', 'map', "
            "'maxwell', 'mpem', 'omnimagnet', 'uniform-gradient'; received 'coil'.",
        ),
        (
            'kind = "loops"\ncoils = [{input = "I1", centre = ["0 mm", "0 mm", "0 mm"], '
            'axis = [0, 0, 0], radius = "1 cm"}]',
            "Input actuator.coils[0].axis must have a length; received [0, 0, 0].",
        ),
        (
            'kind = "loops"\ncoils = [{input = "I 1", centre = ["0 mm", "0 mm", "0 mm"], '
            'axis = [0, 0, 1], radius = "1 cm"}]',
            "Input actuator.coils[0].input must be a name in one word such as 'I1'; "
            "received 'I 1'.",
        ),
        (
            'kind = "loops"\ncoils = [{input = "I1", centre = ["0 mm", "0 mm", "0 mm"], '
            'axis = [0, 0, 1], radius = "1 cm"}]\ncurrents = [{input = "I2"}]',
            "Currents of Loops must be those of its coils, I1; received I2.",
        ),
        (
            'kind = "helmholtz"\npairs = [{axis = "x", radius = "8 cm", turns = 9}, '
            '{axis = "x", radius = "9 cm", turns = 9}]',
            "Input actuator.pairs must be one to three pairs, each on another axis; received x, x.",
        ),
        (
            'kind = "mpem"\ncalibration = "none.yaml"',
            "Input actuator.calibration 'none.yaml' cannot be read: no such file or directory.",
        ),
    ],
)
def test_each_fault_is_one_sentence(table: str, said: str, tmp_path: Path) -> None:
    assert faults(f"[actuator]\n{table}\n") == (said,)
    with pytest.raises(ScenarioError) as caught:
        load_actuator(alone(f"[actuator]\n{table}\n", tmp_path))
    assert caught.value.faults == (said,)


def test_a_file_without_an_actuator_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"must have a table \[actuator\]; received none"):
        load_actuator("half-circle")


def test_an_objective_and_inputs_need_an_actuator() -> None:
    with pytest.raises(ScenarioError, match=r"navigate.objective needs an \[actuator\] whose"):
        load("half-circle", ["navigate.objective=power"])
    table = "navigate={method='inputs', table={feed=['0 mm'], Ix=['1 A']}}"
    with pytest.raises(ScenarioError, match=r"'inputs' needs an \[actuator\] whose"):
        load("half-circle", [table])


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("{feed=['0 mm'], Iq=['1 A']}", "must be those of the actuator, Ix, Iy, Iz; received Iq."),
        ("{feed=['0 mm'], Ix=['1 mT']}", "Input Ix of the actuator is in A; received in T."),
        (
            "{feed=['0 mm', '0 mm'], Ix=['1 A', '2 A']}",
            "must have feeds that increase; received 0 mm after 0 mm.",
        ),
        ("{feed=['0 mm'], Ix=['1 A', '2 A']}", "must have one Ix for each of 1 feeds; received 2."),
        (
            "{feed=['0 mm', '9 mm'], Ix=['1 A', '2 T']}",
            "(Ix) needs a unit of current such as '5 A'; received '2 T', which is a flux density.",
        ),
        ("{feed=['0 mm'], Ix=['1 ampere']}", "(Ix) needs a unit of current such as '5 A'"),
        ("3", "must be a table of lists such as {feed = ['0 mm', '10 mm'], Ix = ['0 A', '5 A']}"),
    ],
)
def test_faulty_inputs_are_refused_in_a_sentence(table: str, said: str) -> None:
    found = faults(platform(), f"navigate={{method='inputs', table={table}}}")
    assert len(found) == 1
    assert found[0].startswith("Input navigate.table")
    assert said in found[0]


def test_prescribed_inputs_are_applied_by_name(tmp_path: Path) -> None:
    table = "table={feed=['0 mm', '10 mm'], Iz=['0 A', '1000 mA'], Ix=['2 A', '2 A']}"
    short = ["feed.distance=12 mm", *FAST[1:]]
    scenario = parse(half_circle(platform()), [*short, f"navigate={{method='inputs', {table}}}"])
    assert parse(scenario.to_toml()).to_toml() == scenario.to_toml()
    result = scenario.run()
    assert result.input_names == (("Ix", "A"), ("Iy", "A"), ("Iz", "A"))
    expected = np.clip(100.0 * result.feed, 0.0, 1.0)
    np.testing.assert_allclose(result.inputs[:, 2], expected, atol=1e-9)
    np.testing.assert_array_equal(result.inputs[:, :2], [[2.0, 0.0]] * len(result.feed))
    np.testing.assert_allclose(result.power, 4.0 + expected**2, rtol=1e-9)
    path = write_inputs(inputs_of(result), tmp_path / "mine.csv")
    again = read_inputs(path)
    assert path.read_text().startswith("feed [m],Ix [A],Iy [A],Iz [A]\n")
    np.testing.assert_array_equal(again.inputs, inputs_of(result).inputs)
    by_file = parse(
        half_circle(platform()), [*short, f"navigate={{method='inputs', file='{path}'}}"]
    )
    np.testing.assert_array_equal(by_file.run().inputs, result.inputs)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("feed [m],Ix\n0,1\n", "must start with a header such as"),
        ("feed [m],Ix [A],Ix [A]\n0,1,1\n", "Ix comes twice"),
        ("feed [m],Ix [A]\n", "must have at least one row"),
        ("feed [m],Ix [A]\n0,nan\n", "must have 2 finite numbers in every row"),
        ("feed [m],Ix [A]\n0,1\n0,2\n", "must have feeds that increase"),
    ],
)
def test_faulty_files_of_inputs_are_refused(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "faulty.csv").write_text(text)
    with pytest.raises(InputError, match=said):
        read_inputs(tmp_path / "faulty.csv")


def test_a_schedule_of_inputs_is_looked_at() -> None:
    course = InputSchedule([0.0, 1.0], [[0.0], [2.0]], (("x", "m"),))
    np.testing.assert_allclose(course.resampled(0.25).inputs[:, 0], [0.0, 0.5, 1.0, 1.5, 2.0])
    assert course.scaled(1.0).inputs[1, 0] == 2.0
    with pytest.raises(InputError, match="must be 1 where x says how a magnet lies; received 2"):
        course.scaled(2.0)
    with pytest.raises(InputError, match="must hold at least one value and rise"):
        InputSchedule([0.0, 0.0], [[0.0], [2.0]], (("x", "m"),))


@cache
def steered() -> Result:
    return parse(half_circle(platform()), FAST).run()


def test_the_half_circle_is_steered_in_currents_and_replayed() -> None:
    result = steered()
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    assert 10.0 < np.abs(result.inputs).max() < 40.0
    again = replayed(result)
    assert again.navigate.method == "inputs"
    replay = again.run()
    assert replay.status == "complete"
    assert replay.max_tip_force == 0.0
    np.testing.assert_allclose(replay.inputs, result.inputs, atol=1e-9)


def test_a_summary_and_a_figure_show_currents_and_power() -> None:
    from magwire.report.run import lines

    said = "\n".join(lines(steered(), steered=True))
    assert "peak currents       " in said
    assert " A in Ix, " in said
    assert f"power of coils      {steered().power.max():.4g} W at most" in said
    labels = {panel.get_ylabel() for panel in steered().plot().axes}
    assert {"current [A]", "power of the coils [W]"} <= labels


def test_a_field_schedule_is_made_by_currents() -> None:
    rows = "table=[['0 mm', '0 mT', '1 mT', '0 mT'], ['10 mm', '0 mT', '3 mT', '0 mT']]"
    scenario = parse(
        half_circle(platform()),
        ["feed.distance=12 mm", *FAST[1:], f"navigate={{method='schedule', {rows}}}"],
    )
    result = scenario.run()
    np.testing.assert_allclose(1e3 * result.field[-1], (0.0, 3.0, 0.0), atol=0.05)


def test_who_cannot_steer_names_coil_feed_and_figures() -> None:
    result = parse(half_circle(platform(10)), FAST).run()
    assert result.status == "no field"
    assert "mm of feed the magnet needs" in result.message
    assert "input Ix is at its limit of 10" in result.message


def test_coils_that_are_too_slow_are_named_with_the_rate() -> None:
    slow = platform().replace('inductance = "5 mH"', 'inductance = "80 H"')
    result = parse(half_circle(slow), FAST).run()
    assert result.status == "no field"
    assert "mm of feed input I" in result.message
    assert "would have to change by" in result.message


@needs_files
def test_navion_is_refused_on_the_half_circle_with_coil_and_feed() -> None:
    navion = (
        f"actuator={{kind='mpem', calibration='{FOLDER}/navion_2_calibration.yaml', "
        f"limits='{FOLDER}/navion_2_limits.yaml', extrapolate=true, "
        "pose={translation=['12.5 mm','25 mm','0 mm']}}"
    )
    coarse = ["solver.time_step=50 ms", "feed.speed=4 mm/s", "output.record_every=1 mm"]
    result = load("half-circle", [navion, *coarse, "navigate.stability_margin=10 1/s^2"]).run()
    assert result.status == "no field"
    found = re.fullmatch(
        r"At ([\d.]+) mm of feed .*input (Coil_\d) is at its limit of 35 A; .*takes? ([\d.]+) A\.",
        result.message,
    )
    assert found, result.message
    assert 10.0 < float(found[1]) < 72.0
    assert float(found[3]) > 35.0


@needs_files
def test_calibrated_coils_are_read_with_limits_and_saturation(tmp_path: Path) -> None:
    table = f"""[actuator]
kind = "mpem"
calibration = "{FOLDER / "navion_2_calibration.yaml"}"
limits = "{FOLDER / "navion_2_limits.yaml"}"
max_current = ["20 A", "30 A", "25 A"]
inductance = "50 mH"
"""
    actuator = load_actuator(alone(table, tmp_path))
    assert [one.high for one in actuator.inputs] == [20.0, 30.0, 25.0]
    assert all(one.resistance > 0.0 and one.inductance == 0.05 for one in actuator.inputs)
    assert math.isfinite(actuator.max_power)
    with pytest.raises(ScenarioError) as caught:
        load_actuator(tmp_path / "actuator.toml", ["actuator.max_current=['1 A', '2 A']"])
    assert caught.value.faults == (
        "Input actuator.max_current must be one value or one for each of the 3 coils; received 2.",
    )


@needs_files
def test_who_leaves_the_calibrated_box_is_told_how_far(tmp_path: Path) -> None:
    table = f"""[actuator]
kind = "mpem"
calibration = "{FOLDER / "octomag_calibration.yaml"}"
"""
    said = faults(table)
    assert len(said) == 1
    assert "the lumen is 42.1 mm outside" in said[0]
    assert said[0].endswith("or ask for extrapolation by actuator.extrapolate = true.")
    parse(half_circle(table + "extrapolate = true\n"), ["navigate.method=none"])


QUICK = ["solver.time_step=50 ms", "feed.speed=2 mm/s", "output.record_every=1 mm"]


def test_the_half_circle_in_stated_coils_takes_less_power_than_its_field() -> None:
    """Of the same plan, power is never more, and here a seventh less."""
    power, field = (
        load("half-circle-helmholtz", [*QUICK, f"navigate.objective={one}"]).run()
        for one in ("power", "field")
    )
    for result in (power, field):
        assert result.status == "complete", result.message
        assert result.max_tip_force == 0.0
    assert np.all(power.power <= 1.001 * field.power + 1e-6)
    assert power.power.max() < 0.87 * field.power.max()
    assert np.abs(power.inputs).max() <= 25.0


def test_the_half_circle_by_a_magnet_keeps_tip_and_magnet_clear() -> None:
    scenario = load("half-circle-magnet", QUICK)
    result = scenario.run()
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    assert nearest(scenario, result) >= 0.06
    assert fastest(result) <= 0.1
    assert replayed(result).run().max_tip_force == 0.0


def test_a_magnet_that_is_too_weak_says_that_it_is_as_near_as_it_may(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(arm, "AROUND", 4)
    result = load("half-circle-magnet", [*QUICK, "actuator.remanence=0.6 T"]).run()
    assert result.status == "no field"
    assert "mm of feed the magnet is " in result.message
    assert "from the vessel, as near as it may" in result.message
