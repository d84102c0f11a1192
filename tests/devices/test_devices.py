"""The library of devices: every number has a source and a range, and every device runs."""

from __future__ import annotations

import tomllib
from importlib.resources import files

import numpy as np
import pytest

import magwire as mw
from magwire.cli import main
from magwire.devices import load, names
from magwire.devices.device import DIMENSIONS
from magwire.units import parse

PLACE = """
[lumen]
shape = "half-circle"
centreline_radius = "100 mm"
radius = "4 mm"
points = 200
[field]
kind = "uniform"
[solver]
time_step = "10 ms"
[navigate]
method = "none"
[feed]
speed = "10 mm/s"
"""


def scenario(wire: str, distance: str) -> str:
    return f'title = "a device"\n[wire]\n{wire}\n{PLACE}distance = "{distance}"\n'


def parsed(wire: str, distance: str = "5 mm") -> mw.Scenario:
    from magwire.scenario.reader import parse as read

    return read(scenario(wire, distance))


@pytest.mark.parametrize("name", names())
def test_every_number_has_a_source_and_lies_in_its_range(name: str) -> None:
    device = load(name)
    used = set()
    for part in device.parts:
        for key, number in part.numbers.items():
            low, high = number.range(key)
            size = float(np.linalg.norm(np.atleast_1d(number.value(key))))
            assert low <= size <= high, (part.name, key)
            assert low < high
            used.add(number.source)
    assert used <= set(device.sources)


@pytest.mark.parametrize("name", names())
def test_files_have_no_key_that_is_not_read(name: str) -> None:
    text = files("magwire.devices").joinpath("library", f"{name}.toml").read_text("utf-8")
    raw = tomllib.loads(text)
    assert set(raw) == {"description", "edge_length", "sources", "sections"}
    for section in raw["sections"]:
        assert set(section) <= {"name", *DIMENSIONS}
        for key in set(section) - {"name"}:
            assert set(section[key]) == {"value", "between", "source", "note"}


@pytest.mark.parametrize("name", names())
def test_every_device_is_fed(name: str) -> None:
    result = parsed(f'device = "{name}"', "8 mm").run()
    assert result.status == "complete"
    assert np.isfinite(result.max_tip_force)


@pytest.mark.parametrize("name", names())
def test_scenario_and_python_mean_the_same_wire(name: str) -> None:
    ours = mw.load_device(name).wire(length=0.3)
    theirs = parsed(f'device = "{name}"\nlength = "300 mm"').wire.build()
    assert ours.nodes == theirs.nodes
    assert ours.length == pytest.approx(0.3, rel=1e-12)
    for a, b in zip(ours.sections, theirs.sections, strict=True):
        assert a.bending_stiffness == b.bending_stiffness
        assert a.length == pytest.approx(b.length, rel=1e-12)
        assert a.magnetization == b.magnetization
        assert a.rest_curvature == b.rest_curvature


def test_published_bending_tests() -> None:
    """0.035 inch shafts: 2.9e-4 to 4.9e-3 N m^2."""
    soft, stiff = (load(f"guidewire-035{end}").wire() for end in ("", "-extra-stiff"))
    assert soft.bending_stiffness == pytest.approx(2.9e-4, rel=0.01)
    assert stiff.bending_stiffness == pytest.approx(4.86e-3, rel=0.01)
    moment = np.pi * parse("0.035 in", "length") ** 4 / 64.0
    assert soft.bending_stiffness == pytest.approx(9.5e9 * moment, rel=0.01)
    assert stiff.bending_stiffness == pytest.approx(158.4e9 * moment, rel=0.01)


def test_the_papers_wire() -> None:
    assert load("paper-wire").wire().bending_stiffness == pytest.approx(3.054e-7, rel=1e-3)


def test_a_ratio_of_stiffness_of_more_than_ten_thousand_runs() -> None:
    """All of the tip, the taper and a piece of the shaft, against the wall, at the usual step."""
    setup = parsed('device = "soft-magnet-on-steel"', "50 mm")
    stiffness = [s.bending_stiffness for s in setup.wire.build().sections]
    assert max(stiffness) > 10_000.0 * min(stiffness)
    result = setup.run()
    assert result.status == "complete"
    assert result.max_tip_force > 0.0


@pytest.mark.parametrize("nodes", [181, 361])
def test_a_step_in_diameter_does_not_leave_the_wall(nodes: int) -> None:
    """The shoulder of the magnet on the ground shaft, in a bend of 60 mm, at the usual step."""
    wire = load("soft-magnet-on-steel").wire(nodes=nodes)
    bend = mw.Lumen.half_circle(centreline_radius=60e-3, radius=4e-3)
    run = mw.Simulation(wire, bend).run(mw.Feed(10e-3, 80e-3), record_every=1e-3)
    assert run.status == "complete", run.message
    assert run.smallest_clearance > 0.0


def test_a_scenario_keeps_what_it_ran() -> None:
    """The scenario that a result carries has the sections, and the name of the device."""
    first = parsed('device = "guidewire-014"')
    from magwire.scenario.reader import parse as read

    text = first.to_toml()
    assert 'device = "guidewire-014"' in text
    assert "sections" in text
    assert read(text) == first


def test_an_override_makes_the_wire_a_device() -> None:
    changed = mw.load_scenario("half-circle", ["wire.device=paper-wire", "wire.nodes=120"])
    assert changed.wire.build().nodes == 120
    assert changed.wire.build().length == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("wire", "expected"),
    [
        ('device = "guidewire-35"', "There is no device 'guidewire-35'; did you mean"),
        ('device = "paper-wire"\nradius = "1 mm"', "wire.radius cannot stand next to wire.device"),
        ('device = "paper-wire"\nlength = "4 mm"', "length of Device 'paper-wire' must be at"),
        ('device = "paper-wire"\nlength = 4', "wire.length needs a unit of length"),
        ("device = 4", "There is no device '4'"),
    ],
)
def test_faults(wire: str, expected: str) -> None:
    with pytest.raises(mw.ScenarioError, match=expected) as caught:
        parsed(wire)
    assert len(caught.value.faults) == 1


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["devices"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in mw.device_names())
    assert main(["devices", "guidewire-035"]) == 0
    shown = capsys.readouterr().out
    assert "291 N mm^2" in shown
    assert "(261 N mm^2 to 321 N mm^2)" in shown
    assert "J. Endovasc. Ther." in shown
    assert main(["devices", "guidewire"]) == 1
    assert "There is no device 'guidewire'" in capsys.readouterr().err
