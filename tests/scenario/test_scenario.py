from __future__ import annotations

import json
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

from magwire.errors import ScenarioError
from magwire.scenario import Scenario, json_schema, load, names, parse

LIBRARY = (
    "aortic-arch",
    "carotid",
    "coronary",
    "half-circle",
    "half-circle-helmholtz",
    "half-circle-magnet",
    "half-circle-narrow",
    "half-circle-wide",
    "helix",
    "left-branch",
    "middle-branch",
    "right-branch",
    "sinusoid",
    "straight",
    "tortuous",
)
VESSELS = {
    "aortic-arch": "0.45 mm",
    "carotid": "0.45 mm",
    "coronary": "0.3 mm",
    "tortuous": "0.45 mm",
}
"""Scenarios in vessels with a formula, and the radius of the wire."""
BRANCHES = ("left", "middle", "right")
PASSIVE = ("straight",)


def test_library_is_complete() -> None:
    assert names() == LIBRARY


@pytest.mark.parametrize("name", sorted(set(LIBRARY) - set(VESSELS)))
def test_library_has_the_papers_wire(name: str) -> None:
    scenario = load(name)
    wire = scenario.wire
    assert wire.length == 0.1
    assert wire.nodes == 100
    assert wire.radius == 0.6e-3
    assert wire.magnetization == (0.0, 0.0, 128e3)
    assert wire.magnetized_tip == 5e-3
    bending = wire.youngs_modulus * math.pi * wire.radius**4 / 4.0
    assert bending == pytest.approx(3.054e-7, rel=1e-3)
    moment = wire.magnetization[2] * math.pi * wire.radius**2
    assert moment == pytest.approx(0.1448, rel=1e-3)
    assert scenario.contact.wall == "centreline"
    assert scenario.contact.stiffness == 1e3
    assert scenario.contact.activation_gap == 1e-4
    assert scenario.solver.time_step == 0.01
    assert scenario.feed.distance == 0.072
    assert scenario.navigate.method == ("none" if name in PASSIVE else "stable")
    assert scenario.title
    assert scenario.description.endswith(".")


@pytest.mark.parametrize(
    ("name", "ratio"),
    [("half-circle-narrow", 0.04), ("half-circle", 0.06), ("half-circle-wide", 0.08)],
)
def test_half_circles_have_the_papers_widths(name: str, ratio: float) -> None:
    scenario = load(name)
    assert 2.0 * scenario.lumen.radius / scenario.wire.length == pytest.approx(ratio)


@pytest.mark.parametrize("target", BRANCHES)
def test_branches_are_one_tree_with_three_targets(target: str) -> None:
    """Trunk of 0.25 L, junctions at 0.25 L and 0.40 L, outlets at 0.76 L, bends in space."""
    scenario = load(f"{target}-branch")
    assert scenario.lumen.branches == load("left-branch").lumen.branches
    assert 2.0 * scenario.lumen.radius / scenario.wire.length == pytest.approx(0.06)
    tree = scenario.lumen.build()
    assert tree.outlets == BRANCHES
    assert tree.target == target
    np.testing.assert_array_equal(tree.direction, [1.0, 0.0, 0.0])
    s = np.linspace(0.0, 0.076, 761)
    ways = {name: tree.path(name).branches[0].curve.at(s)[:, :3] for name in BRANCHES}
    for name in BRANCHES:
        assert tree.path(name).length == pytest.approx(0.076)
        assert tree.path(name).bend_radius()[0].radius > 0.012
        np.testing.assert_allclose(ways[name][:251, 1:], 0.0, atol=2e-6)
        assert np.all(np.ptp(ways[name], axis=0) > 0.004)
    for one, other, junction in (("left", "right", 0.025), ("middle", "right", 0.04)):
        apart = np.linalg.norm(ways[one][:, None] - ways[other], axis=2).min(axis=1)
        assert apart[s < junction].max() < 2e-6
        assert apart[s > junction + 0.015].min() > 2.0 * scenario.lumen.radius


def test_passive_wire_enters_the_middle_branch() -> None:
    result = load("right-branch", ["navigate.method=none", "output.record_every=2 mm"]).run()
    assert result.status == "complete"
    assert float(result.dataset["feed"][-1]) == pytest.approx(0.072)
    tip = result.dataset["position"].values[-1, -1]
    tree = load("right-branch").lumen.build()
    assert tree.outlets[tree.locate(tip[None])[1][0]] == "middle"
    assert 0.0 < result.dataset.attrs["smallest_clearance"] < 1e-4
    branches = np.unique(result.dataset["lumen_branch"].values)
    np.testing.assert_array_equal(branches, [0, 1, 2])


@pytest.mark.parametrize(
    ("field", "outlet"),
    [(("0 mT", "4 mT", "1.5 mT"), "left"), (("0 mT", "-3 mT", "5 mT"), "right")],
)
def test_a_steady_field_leads_across_the_junctions(field: tuple[str, ...], outlet: str) -> None:
    """The tip slides over the start of another branch; that must not stop the solver."""
    keys = [f"field.flux_density={list(field)}", "output.record_every=2 mm"]
    keys += ["navigate.method=none"]
    result = load(f"{outlet}-branch", keys).run()
    assert result.status == "complete"
    assert result.dataset.attrs["retries_total"] == 0
    tip = result.dataset["position"].values[-1, -1]
    tree = load(f"{outlet}-branch").lumen.build()
    assert tree.outlets[tree.locate(tip[None])[1][0]] == outlet


@pytest.mark.parametrize("name", LIBRARY)
def test_toml_is_complete_and_reads_back(name: str) -> None:
    scenario = load(name)
    text = scenario.to_toml()
    assert parse(text) == scenario
    tables = tomllib.loads(text)
    assert set(tables) | {"actuator"} == set(Scenario.model_fields)
    assert tables["wire"]["radius"] == VESSELS.get(name, "0.6 mm")
    assert next(iter(tables["lumen"])) == "shape"


def test_defaults_are_filled_in() -> None:
    scenario = parse(
        """
        [wire]
        length = "100 mm"
        nodes = 50
        radius = "0.6 mm"
        youngs_modulus = "3 MPa"
        shear_modulus = "1 MPa"
        density = "2000 kg/m^3"
        [lumen]
        shape = "straight"
        length = "0.1 m"
        radius = "3 mm"
        [feed]
        speed = "1 mm/s"
        distance = "5 cm"
        """
    )
    assert scenario.contact.wall == "surface"
    assert scenario.contact.stiffness == "auto"
    assert scenario.contact.activation_gap == "auto"
    assert scenario.field.flux_density == (0.0, 0.0, 0.0)
    assert scenario.solver.release == "sliding"
    assert scenario.environment.gravity == (0.0, 0.0, 0.0)
    assert scenario.output.record_every == 1e-4


@pytest.mark.parametrize(
    ("override", "value"),
    [
        ("wire.radius=0.5 mm", 0.5e-3),
        ("wire.radius = 0.5 mm", 0.5e-3),
        ('wire.radius="0.5 mm"', 0.5e-3),
        ("wire.radius='5e-1 mm'", 0.5e-3),
    ],
)
def test_overrides_need_no_quotes(override: str, value: float) -> None:
    assert load("half-circle", [override]).wire.radius == value


def test_overrides_of_other_kinds() -> None:
    scenario = load(
        "half-circle",
        [
            "wire.nodes=80",
            "title=A title = with more",
            "navigate.method=none",
            "field.flux_density=['1 mT', '0 mT', '2 mT']",
            "environment.gravity=['0 m/s^2', '0 m/s^2', '-9.81 m/s^2']",
        ],
    )
    assert scenario.wire.nodes == 80
    assert scenario.title == "A title = with more"
    assert scenario.field.flux_density == (1e-3, 0.0, 2e-3)
    assert scenario.environment.gravity[2] == -9.81


SECTIONED = """
[wire]
nodes = 60
[[wire.sections]]
length = "90 mm"
radius = "0.6 mm"
youngs_modulus = "3 MPa"
shear_modulus = "1 MPa"
density = "2000 kg/m^3"
[[wire.sections]]
length = "10 mm"
radius = "0.5 mm"
inner_radius = "0.2 mm"
youngs_modulus = "1 MPa"
shear_modulus = "0.3 MPa"
density = "3000 kg/m^3"
magnetization = ["1 kA/m", "0 kA/m", "100 kA/m"]
rest_curvature = ["10 1/m", "0 1/m"]
[lumen]
shape = "half-circle"
centreline_radius = "25 mm"
radius = "3 mm"
[field]
kind = "gradient"
gradient = [["1 T/m", "0 T/m", "0 T/m"], ["0 T/m", "-1 T/m", "0 T/m"], ["0 T/m", "0 T/m", "0 T/m"]]
[feed]
table = [["0 s", "0 mm/s"], ["1 s", "2 mm/s"], ["20 s", "2 mm/s"], ["25 s", "-2 mm/s"]]
twist_table = [["0 s", "0 deg"], ["10 s", "90 deg"], ["30 s", "90 deg"]]
"""


def test_sections_gradient_and_tables() -> None:
    scenario = parse(SECTIONED, ["wire.sections.1.radius=0.55 mm"])
    assert scenario.wire.total_length == pytest.approx(0.1)
    assert scenario.wire.sections[1].radius == 0.55e-3
    assert scenario.wire.sections[1].rest_curvature == (10.0, 0.0)
    assert parse(scenario.to_toml()) == scenario
    lowest, highest = scenario.feed.extremes
    assert lowest == 0.0
    assert highest == pytest.approx(1e-3 + 38e-3 + 2.5e-3)
    feed = scenario.feed.build()
    assert feed.at(22.5) == pytest.approx(highest)
    assert feed.twist_at(5.0) == pytest.approx(math.pi / 4)
    assert feed.twist_at(25.0) == pytest.approx(math.pi / 2)
    wire = scenario.wire.build()
    assert wire.length == pytest.approx(0.1)
    assert scenario.field.build().at(np.array([[1.0, 0.0, 0.0]]))[0][0] == pytest.approx([1, 0, 0])


def test_points_from_a_file_end_up_in_the_scenario(tmp_path: Path) -> None:
    (tmp_path / "line.csv").write_text(
        "# a vessel\nradius, x, y, z\n" + "".join(f"{3 + 0.01 * k},{k},0,0.5\n" for k in range(90))
    )
    text = (
        load("straight")
        .to_toml()
        .replace(
            '[lumen]\nshape = "straight"\nentry = "0 mm"\nradius = "3 mm"\nlength = "100 mm"\n',
            '[lumen]\nshape = "points"\nfile = "line.csv"\nunits = "mm"\nentry = "5 mm"\n',
        )
    )
    (tmp_path / "vessel.toml").write_text(text)
    scenario = load(tmp_path / "vessel.toml")
    assert len(scenario.lumen.points) == 90
    assert scenario.lumen.points[7] == (7e-3, 0.0, 0.5e-3)
    assert scenario.lumen.radius[10] == 3.1e-3
    assert scenario.lumen.narrowest == 3e-3
    assert parse(scenario.to_toml()) == scenario  # needs the CSV file no more
    assert scenario.lumen.build().length == pytest.approx(0.094)


def test_one_radius_for_points_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "line.csv").write_text("x,y,z\n0,0,0\n5,0,0\n10,0,0\n")
    text = load("straight").to_toml()
    head, tail = text.split("[lumen]")
    rest = tail[tail.index("[field]") :]
    lumen = '[lumen]\nshape = "points"\nfile = "line.csv"\nunits = "cm"\nradius = "3 mm"\n'
    scenario = parse(head + lumen + rest, folder=tmp_path)
    assert scenario.lumen.radius == (3e-3,)
    assert scenario.lumen.points[1] == (0.05, 0.0, 0.0)


def test_path_may_be_given_as_path_or_text(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(load("helix").to_toml())
    assert load(path) == load(str(path)) == load("helix")


def test_schema_describes_the_library() -> None:
    schema = json.loads(json.dumps(json_schema()))
    assert schema["type"] == "object"
    assert set(schema["required"]) == {"wire", "lumen", "feed"}
    wire = schema["$defs"]["UniformWire"]["properties"]
    assert wire["radius"]["anyOf"][0]["type"] == "string"
    assert wire["radius"]["anyOf"][0]["examples"] == ["5 mm"]
    assert wire["magnetized_tip"]["default"] == "0 mm"
    assert wire["nodes"]["minimum"] == 4


CLINICAL = """
[wire]
nodes = 121
[[wire.sections]]
length = "80 mm"
diameter = "0.014 in"
taper_to = "0.1 mm"
youngs_modulus = "60 GPa"
poisson_ratio = 0.33
density = "6.45 g/cm^3"
[[wire.sections]]
length = "30 mm"
diameter = "1.5 Fr"
bending_stiffness = "0.2 N mm^2"
twisting_stiffness = "0.15 N mm^2"
stretching_stiffness = "20 N"
mass_per_length = "0.8 g/m"
rest_curvature = ["60 1/m", "0 1/m"]
rest_twist = "1 deg/mm"
[[wire.sections]]
length = "10 mm"
diameter = "1.5 Fr"
inner_diameter = "0.2 mm"
youngs_modulus = "3 MPa"
poisson_ratio = 0.5
density = "7500 kg/m^3"
remanence = "1.2 T"
[lumen]
shape = "straight"
length = "120 mm"
radius = "2 mm"
[feed]
speed = "10 mm/s"
distance = "5 mm"
[environment]
tip_load = ["0 mN", "0.1 mN", "0 mN"]
"""


def test_a_wire_in_the_words_of_a_maker_of_devices() -> None:
    scenario = parse(CLINICAL)
    assert parse(scenario.to_toml()) == scenario
    system = scenario.build().simulation.system
    shaft, hook, magnet = system.wire.sections
    assert shaft.radius == 0.1778e-3
    assert shaft.end_radius == 0.05e-3
    assert shaft.shear_modulus == pytest.approx(60e9 / 2.66)
    assert hook.radius == 0.25e-3
    assert (hook.bending_stiffness, hook.twisting_stiffness) == (0.2e-6, 0.15e-6)
    assert hook.stretching_stiffness == 20.0
    assert hook.density * hook.area == pytest.approx(0.8e-3)
    assert hook.rest_twist == pytest.approx(math.radians(1000.0))
    assert magnet.inner_radius == 0.1e-3
    assert magnet.magnetization[2] == pytest.approx(954.93e3, rel=1e-5)
    assert system.tip_load == (0.0, 1e-4, 0.0)


def test_a_wire_of_one_make_is_the_same_in_all_words() -> None:
    plain = load("half-circle").wire
    text = load("half-circle").to_toml()
    text = text.replace('radius = "0.6 mm"\ninner_radius = "0 mm"', 'diameter = "3.6 Fr"')
    text = text.replace('shear_modulus = "1 MPa"', "poisson_ratio = 0.5")
    other = parse(text).wire
    assert other.build() == plain.build()
    assert other.radius is None
    assert other.shear_modulus is None


def test_scenario_does_not_change() -> None:
    scenario = load("helix")
    with pytest.raises(ValueError, match="frozen"):
        scenario.title = "other"


def test_faulty_override_of_a_file_is_refused() -> None:
    with pytest.raises(ScenarioError, match="not a key of the scenario"):
        load("helix", ["colour=red"])
