"""From a plan to a timetable that the hardware can play, and its dry run."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from magwire.actuate import (
    MPEM,
    Advancer,
    Box,
    Circuit,
    Helmholtz,
    Magnet,
    Pair,
    Timetable,
    Uniform,
    Violation,
    dry_run,
    retime,
)
from magwire.actuate.actuator import Actuator
from magwire.errors import InputError
from magwire.export import read_timetable, write_timetable

from .handed import FOLDER, needs_files


def platform(limit: float = 40.0, supply: float = 48.0, power: float = math.inf) -> Helmholtz:
    circuit = Circuit(resistance=1.0, inductance=5e-3, supply=supply)
    return Helmholtz(
        pairs=tuple(
            Pair(axis, radius, 200.0, max_current=limit, circuit=circuit)
            for axis, radius in (("x", 0.08), ("y", 0.10), ("z", 0.12))
        ),
        max_power=power,
    )


def plan(actuator: Actuator, inputs: np.ndarray, speed: float = 1e-3) -> Timetable:
    """Half a second between the rows, fed evenly along x."""
    time = 0.5 * np.arange(len(inputs))
    tip = np.outer(speed * time, [1.0, 0.0, 0.0])
    flux = np.array([actuator.at(x[None], u)[0][0] for x, u in zip(tip, inputs, strict=True)])
    names = tuple(one.name for one in actuator.inputs)
    units = tuple(one.unit for one in actuator.inputs)
    return Timetable(time, speed * time, inputs, names, units, tip, flux)


WAVE = np.stack([10.0 + 6.0 * np.sin(np.arange(21) / 2.0 + k) for k in range(3)], axis=1)


def kinds(found: tuple[Violation, ...]) -> list[str]:
    return [one.kind for one in found]


def test_what_the_hardware_can_follow_keeps_its_times() -> None:
    actuator = platform()
    made = retime(plan(actuator, WAVE), actuator, rate=50.0)
    np.testing.assert_allclose(np.diff(made.time), 0.02, rtol=1e-12)
    np.testing.assert_array_equal(made.inputs[0], 0.0)  # from nothing,
    lead = float(made.time[-1]) - 10.0  # before the wire moves
    assert 0.0 < lead < 0.1
    moving = made.time > lead + 1e-9
    np.testing.assert_allclose(made.feed[moving], 1e-3 * (made.time[moving] - lead), atol=1e-12)
    wave = [np.interp(made.time[moving] - lead, 0.5 * np.arange(21), column) for column in WAVE.T]
    np.testing.assert_allclose(made.inputs[moving].T, wave, atol=1e-9)
    assert np.isnan(made.flux_density[0]).all()
    assert dry_run(made, actuator) == ()


@pytest.mark.parametrize("supply", [17.0, 16.05])
def test_a_weak_supply_slows_the_wire_down_on_the_same_course(supply: float) -> None:
    actuator = platform(supply=supply)
    course = plan(actuator, WAVE)
    slow = retime(course, actuator, rate=50.0)
    assert slow.time[-1] > retime(course, platform(), rate=50.0).time[-1]
    assert dry_run(slow, actuator) == ()
    moving = slow.feed > 0.0
    wave = [np.interp(slow.feed[moving], course.feed, column) for column in WAVE.T]
    np.testing.assert_allclose(slow.inputs[moving].T, wave, atol=1e-9)
    assert slow.feed[-1] == course.feed[-1]
    # The plan as it stands, in the same samples, is too fast for that supply.
    found = dry_run(retime(course, platform(), rate=50.0), actuator)
    assert set(kinds(found)) == {"supply"}
    assert found[0].figure > supply == found[0].limit


def test_what_the_supply_cannot_hold_is_named() -> None:
    actuator = platform(supply=15.0)
    with pytest.raises(InputError, match=r"input I[xyz] goes .*supply of 15 V holds 15 A at most"):
        retime(plan(actuator, WAVE), actuator, rate=50.0)


def test_slew_of_a_field() -> None:
    actuator = Uniform(slew=4e-3)
    inputs = np.zeros((5, 3))
    inputs[2:, 1] = 10e-3
    made = retime(plan(actuator, inputs), actuator, rate=100.0)
    # 10 mT at 4 mT/s where the plan has half a second: one sample at the kink may be lost
    assert made.time[-1] == pytest.approx(2.0 + 2.0, abs=0.021)
    assert np.abs(np.diff(made.inputs, axis=0)).max() <= 4e-5 * (1.0 + 1e-9)
    assert dry_run(made, actuator) == ()
    fast = replace(made, time=0.9 * made.time)
    (one,) = dry_run(fast, actuator)
    assert (one.kind, one.limit) == ("slew", 4e-3)
    assert one.figure == pytest.approx(4e-3 / 0.9)
    assert "input By changes by 0.004444 T/s; the limit is 0.004 T/s." in str(one)


@pytest.mark.parametrize("backlash", [0.0, 50e-6])
def test_steps_bring_the_wire_where_it_should_be(backlash: float) -> None:
    """There, back and there again, through the play."""
    actuator = Uniform()
    course = plan(actuator, np.zeros((9, 3)))
    feed = 1e-3 * np.array([0.0, 1.0, 2.0, 1.5, 1.5, 1.0, 2.0, 3.0, 4.0])
    advancer = Advancer(resolution=5e-6, backlash=backlash, max_speed=2.5e-3)
    made = retime(replace(course, feed=feed), actuator, rate=50.0, advancer=advancer)
    assert made.steps is not None
    moved = advancer.moved(made.steps)
    assert np.abs(moved - made.feed).max() <= 0.5 * advancer.resolution * (1.0 + 1e-6)
    assert np.abs(np.diff(made.steps)).max() <= 10  # 2.5 mm/s in whole steps
    # the play is turned through at 2.5 mm/s, in whole samples, twice
    waiting = 2 * math.ceil(backlash / 2.5e-3 * 50.0) / 50.0
    assert made.time[-1] == pytest.approx(4.0 + waiting, abs=0.061)
    assert dry_run(made, actuator) == ()
    if backlash:
        forgotten = replace(made, steps=advancer.steps(made.feed))
        assert kinds(dry_run(forgotten, actuator)) == ["steps"]
    slow = replace(made, advancer=replace(advancer, max_speed=1e-3))
    assert set(kinds(dry_run(slow, actuator))) == {"speed"}


@pytest.mark.parametrize("advancer", [None, Advancer(5e-6, 20e-6, 3e-3)])
def test_files_read_back_to_the_same_numbers(tmp_path: Path, advancer: Advancer | None) -> None:
    actuator = platform()
    course = plan(actuator, WAVE)
    lumen = {"centreline": course.tip, "lumen_radius": np.full(len(course.tip), 3e-3)}
    made = retime(replace(course, **lumen), actuator, rate=50.0, advancer=advancer)
    table, data = write_timetable(made, tmp_path)
    for path in (table, data, tmp_path):
        back = read_timetable(path)
        assert (back.names, back.units) == (made.names, made.units)
        for name in ("time", "feed", "inputs", "tip", "flux_density"):
            np.testing.assert_array_equal(getattr(back, name), getattr(made, name))
        assert dry_run(back, actuator) == ()
    assert back.advancer == advancer
    if advancer:
        np.testing.assert_array_equal(back.steps, made.steps)
    np.testing.assert_array_equal(back.centreline, made.centreline)
    np.testing.assert_array_equal(back.lumen_radius, made.lumen_radius)
    head, first = table.read_text().splitlines()[:2]
    assert head.startswith("time [s],feed [m],Ix [A],Iy [A],Iz [A],tip_x [m]")
    assert first.startswith("0.0,0.0,0.0,0.0,0.0,")


def test_a_pose_is_written_with_its_numbers_without_units(tmp_path: Path) -> None:
    magnet = Magnet(radius=0.02, remanence=1.4, turning=math.radians(90.0), speed=0.1)
    inputs = np.array([[0.0, 0.0, 1.0, 0.0, 0.0, 3.0], [0.0, 0.02, 1.0, 0.0, 1.0, 1.0]])
    made = retime(plan(magnet, inputs), magnet, rate=20.0)
    assert made.time[-1] == pytest.approx(0.5, abs=0.051)
    # 45 degrees at 90 degrees a second; the first planned row is where the magnet is parked
    np.testing.assert_allclose(np.linalg.norm(made.inputs[[0, -1], 3:], axis=1), 1.0)
    assert "turning" not in kinds(dry_run(made, magnet, tolerance=1.0))
    hurried = replace(made, time=0.5 * made.time)
    assert kinds(dry_run(hurried, magnet, tolerance=1.0)) == ["turning"]
    for path in write_timetable(made, tmp_path):
        back = read_timetable(path)
        assert back.units == ("m", "m", "m", "", "", "")
        np.testing.assert_array_equal(back.inputs, made.inputs)


def test_each_limit_of_currents_and_power() -> None:
    made = retime(plan(platform(), WAVE), platform(), rate=50.0)
    peak = np.abs(made.inputs).max(axis=0)
    found = dry_run(made, platform(limit=15.0))
    assert set(kinds(found)) == {"input"}
    for k, name in enumerate(made.names):
        worst = max(one.figure for one in found if f"input {name} " in one.message)
        assert worst == peak[k]
    assert sorted(one.begin for one in found) == [one.begin for one in found]
    above = made.inputs[:, 0] > 15.0
    first = next(one for one in found if "input Ix" in one.message)
    assert first.begin == made.time[np.argmax(above)]
    assert first.feed == made.feed[np.flatnonzero(made.time == first.time)[0]]
    watts = (made.inputs**2).sum(axis=1)
    over = dry_run(made, platform(power=0.9 * float(watts.max())))
    assert set(kinds(over)) == {"power"}
    assert max(one.figure for one in over) == pytest.approx(watts.max())


def test_outside_of_the_calibrated_box_and_too_near() -> None:
    actuator = replace(platform(), workspace=Box((-5e-3,) * 3, (5e-3,) * 3))
    made = retime(plan(actuator, WAVE), actuator, rate=50.0)
    (one,) = dry_run(made, actuator)
    assert (one.kind, one.end) == ("workspace", made.time[-1])
    assert one.figure == pytest.approx(5e-3)  # at 10 mm of feed
    assert "the tip is 5 mm outside of where the actuator is calibrated." in one.message
    magnet = Magnet(radius=0.02, remanence=1.4, keep_out=0.06, parked=(0, 0.1, 0, 0, 1, 0))
    inputs = np.tile([0.0, 0.1, 0.0, 0.0, 1.0, 0.0], (3, 1))
    inputs[2, 1] = 0.079
    course = plan(magnet, inputs)
    with pytest.raises(InputError, match="must know the lumen"):
        dry_run(course, magnet)
    lumen = {"centreline": course.tip, "lumen_radius": np.full(3, 3e-3)}
    (near,) = dry_run(replace(course, **lumen), magnet)
    assert near.kind == "keep-out"
    expected = math.hypot(0.0, 0.079) - 0.02 - 3e-3
    assert near.figure == pytest.approx(expected, abs=1e-9)


def test_samples_beyond_any_use_are_refused() -> None:
    with pytest.raises(InputError, match=r"rate of retime must be at most .* 1/s for a plan of"):
        retime(plan(platform(), WAVE), platform(), rate=1e9)


def test_the_inputs_must_be_those_of_the_actuator() -> None:
    made = plan(platform(), WAVE)
    with pytest.raises(InputError, match=r"Ix \[A\], Iy \[A\], Iz \[A\]; received Bx \[T\]"):
        dry_run(made, Uniform())
    with pytest.raises(InputError, match="must have the plan's inputs, Ix, Iy, Iz"):
        retime(made, Uniform(), rate=50.0)


@needs_files
def test_a_plan_that_ignores_saturation_fails_and_one_that_knows_it_passes() -> None:
    """CardioMag: from 17 to 34 A the field rises by about a quarter, not twofold (P-26)."""
    names = ("cardiomag_2019_calibration.yaml", "cardiomag_2019_saturation.yaml")
    iron = MPEM.read(FOLDER / names[0], saturation=FOLDER / names[1])
    linear = replace(iron, saturation=None)
    inside = (np.array(iron.workspace.low) + iron.workspace.high) / 2.0  # type: ignore[union-attr]

    def at(actuator: MPEM, amperes: float) -> float:
        return float(np.linalg.norm(actuator.at(inside[None], amperes * np.eye(8)[0])[0]))

    assert at(linear, 34.0) / at(linear, 17.0) == pytest.approx(2.0)
    rise = at(iron, 34.0) / at(iron, 17.0)
    assert 1.2 < rise < 1.3
    currents = np.outer(np.linspace(0.0, 34.0, 9), np.eye(8)[0])

    def table(actuator: MPEM) -> Timetable:
        course = plan(actuator, currents, speed=0.0)
        tip = np.tile(inside, (9, 1))
        flux = np.array([actuator.at(inside[None], u)[0][0] for u in currents])
        return replace(course, tip=tip, flux_density=flux)

    assert dry_run(table(iron), iron) == ()
    (one,) = dry_run(table(linear), iron)
    assert one.kind == "field"
    assert one.figure == pytest.approx(at(linear, 34.0) - at(iron, 34.0))
    assert one.time == 4.0


def test_faulty_files(tmp_path: Path) -> None:
    actuator = platform()
    path = write_timetable(plan(actuator, WAVE), tmp_path)[0]
    good = path.read_text().splitlines()
    cases = {
        "header": ["a,b", *good[1:]],
        "received 2": [good[0], "1.0,2.0"],
        "a finite number as feed": [good[0], good[1].replace("0.0,0.0", "0.0,nan", 1)],
        "rows whose times rise": [good[0], good[1], good[1]],
    }
    for said, lines in cases.items():
        path.write_text("\n".join(lines))
        with pytest.raises(InputError, match=said):
            read_timetable(path)
    with pytest.raises(InputError, match="cannot be read"):
        read_timetable(tmp_path / "none.csv")
    other = tmp_path / "other.nc"
    other.write_bytes(b"no")
    with pytest.raises(InputError, match="no NetCDF file"):
        read_timetable(other)
