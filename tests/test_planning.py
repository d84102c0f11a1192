"""Which outlets a wire reaches: the answer, its numbers, its table, its files and its map."""

from __future__ import annotations

import json
import os
import re
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
import surfaces
from campaigns.planner_vessels import vessel
from magwire.cli import main
from magwire.cli.errand import _wire, of_scenario
from magwire.many.planners import Crew, Task, plan_at_once
from magwire.planning import outlets
from magwire.planning.remedy import remedy
from magwire.planning.route import Route, firm_wall, fitted, route_to
from magwire.plot import prospects as maps
from magwire.report.outlets import begun, save, taken_up
from magwire.scenario import load

WIRE = mw.Wire.uniform(
    length=0.02,
    radius=0.5e-3,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    density=2000.0,
    nodes=17,
    magnetized_tip=5e-3,
    magnetization=128e3,
)
FORK = mw.Lumen.tree(
    {
        "ahead": mw.Lumen.straight(0.05, 3e-3),
        "aside": mw.Lumen.through(
            [[0.015, 0, 0], [0.022, 0.002, 0], [0.03, 0.007, 0], [0.038, 0.014, 0]], 2.5e-3
        ),
        "thin": mw.Lumen.through([[0.03, 0, 0], [0.035, -0.006, 0], [0.04, -0.02, 0]], 0.45e-3),
    }
)
CORONARY = Path(__file__).parents[1] / "examples/data/coronary_lca_centerlines_multimoda.vtp"
SLOW = pytest.mark.skipif("MAGWIRE_SLOW" not in os.environ, reason="a minute; set MAGWIRE_SLOW")
PATIENT = pytest.mark.skipif(
    not {"MAGWIRE_SLOW", "MAGWIRE_VESSELS"} <= set(os.environ),
    reason="needs MAGWIRE_SLOW, and MAGWIRE_VESSELS to name a folder of vessels",
)


@pytest.fixture(scope="module")
def found() -> dict[str, mw.Prospect]:
    asked: list[str] = []
    prospects = mw.plan(FORK, WIRE, watch=asked.append)
    assert asked == ["ahead", "aside", "thin"]
    return {p.outlet: p for p in prospects}


def test_straight_ahead_takes_no_field(found: dict[str, mw.Prospect]) -> None:
    ahead = found["ahead"]
    assert ahead.reached
    assert ahead.length == pytest.approx(0.05)
    assert 0.047 <= ahead.fed < 0.0476  # one radius before the outlet, and a record at most
    assert ahead.came == pytest.approx(ahead.fed)  # straight
    assert ahead.peak_field < 1e-6
    assert ahead.tip_force == ahead.wall_force == 0.0
    assert ahead.clearance == pytest.approx(2.5e-3, abs=2e-5)
    assert (ahead.narrowest, ahead.bend.radius) == (pytest.approx(3e-3), np.inf)
    assert ahead.reason == ""


def test_aside_takes_one_and_keeps_the_tip_off_the_wall(found: dict[str, mw.Prospect]) -> None:
    aside = found["aside"]
    assert aside.reached
    assert aside.tip_force == 0.0
    assert aside.clearance > 0.0
    assert 1e-4 < aside.peak_field < 0.05
    assert aside.flux_density.max() == aside.peak_field
    assert aside.force.max() == aside.wall_force
    assert len(aside.feed) == len(aside.arc) == len(aside.flux_density) == len(aside.force)
    assert aside.flux_density[aside.feed < 5e-3].max() < 0.2 * aside.peak_field


def test_a_lumen_narrower_than_the_wire_is_said(found: dict[str, mw.Prospect]) -> None:
    thin = found["thin"]
    assert not thin.reached
    assert thin.fed == 0.0
    assert thin.reason.startswith("The wire is 1 mm wide, the lumen 0.9 mm at ")


def test_too_weak_a_field_is_the_reason() -> None:
    limit = mw.Demands(max_field=1e-4)
    (prospect,) = [p for p in mw.plan(FORK, WIRE, demands=limit) if p.outlet == "aside"]
    assert not prospect.reached
    assert 0.01 < prospect.came < prospect.length
    assert prospect.peak_field <= 1e-4
    assert prospect.reason.split(" of feed ")[0].startswith("At ")


def test_one_tube_has_one_outlet() -> None:
    (prospect,) = mw.plan(mw.Lumen.straight(0.03, 2e-3), WIRE)
    assert prospect.outlet == "outlet"
    assert prospect.reached


def test_where_the_tip_is_counts_and_not_how_far_the_wire_is_fed() -> None:
    """Two wide bends, which the wire cuts: it is at the outlet before it is as long as the path."""
    curvatures = [[0, 0, 0], [0.01, 60, 0], [0.03, 60, 0], [0.035, -60, 0], [0.06, -60, 0]]
    bends = mw.Lumen.bends(curvatures, 3e-3)
    (prospect,) = mw.plan(bends, WIRE)
    goal = prospect.length - 3e-3
    assert prospect.reached
    assert prospect.tip_force == 0.0
    assert goal <= prospect.came < goal + 1.5 * WIRE.edge_length  # it is looked at once an edge
    assert prospect.fed < goal - 1e-3
    assert prospect.came == prospect.arc.max()


def reached_without_a_touch(lumen: mw.Lumen, outlet: str) -> None:
    """A wire of 0.6 mm gets there at once, its tip without a force, all of it clear of the wall."""
    words = {"diameter": "0.6 mm", "magnet": "3 mm", "modulus": None, "magnetization": None}
    wire = _wire(words, lumen)
    alone = replace(lumen, paths={outlet: lumen.paths[outlet]}, target=outlet)
    (prospect,) = mw.plan(alone, wire)
    assert prospect.reached, prospect.reason
    assert "fed again" not in prospect.reason
    assert prospect.tip_force < 1e-6
    assert prospect.clearance > 0.0
    assert prospect.wall_force > 0.0
    assert prospect.peak_field < 0.08


@pytest.mark.parametrize(
    "outlet", ["end-6", *(pytest.param(f"end-{k}", marks=SLOW) for k in (2, 3, 4, 5))]
)
def test_a_patients_coronary_arteries_are_reached_without_a_touch(outlet: str) -> None:
    vessel = mw.Vessel.read(CORONARY, "mm", entrance=(19.2e-3, -188.6e-3, 1751.9e-3))
    reached_without_a_touch(vessel.lumen(), outlet)


@PATIENT
@pytest.mark.parametrize("outlet", ["end-2", "end-3"])
def test_bends_of_1_mm_in_a_coronary_bifurcation_are_passed(outlet: str) -> None:
    folder = Path(os.environ["MAGWIRE_VESSELS"])
    lumen = mw.Vessel.read(folder / "coronary_721A_centreline_dbihar.vtk", "mm").lumen()
    reached_without_a_touch(lumen, outlet)


def test_sharp_bends_make_the_mesh_finer() -> None:
    words = {"diameter": "1 mm", "magnet": "5 mm", "modulus": None, "magnetization": None}
    assert _wire(words, mw.Lumen.straight(0.05, 2e-3)).edge_length == pytest.approx(0.5e-3)
    bend = mw.Lumen.half_circle(2.5e-3, 0.7e-3)
    sag = _wire(words, bend).edge_length ** 2 / (8.0 * bend.bend_radius()[0].radius)
    assert sag == pytest.approx(0.025 * 0.2e-3, rel=0.1)
    tight = mw.Lumen.half_circle(2.5e-3, 0.501e-3)  # it hardly fits: no end of nodes
    assert _wire(words, tight).edge_length == pytest.approx(0.25e-3, rel=0.05)


def test_a_wire_is_made_long_enough_and_stays_the_same_otherwise() -> None:
    longer = fitted(WIRE, 0.0461)
    assert 0.0461 <= longer.length < 0.0461 + WIRE.edge_length
    assert longer.edge_length == pytest.approx(WIRE.edge_length)
    assert longer.sections[1:] == WIRE.sections[1:]
    assert replace(longer.sections[0], length=WIRE.sections[0].length) == WIRE.sections[0]
    assert fitted(WIRE, 0.02) is WIRE


def test_the_wall_bends_the_wire_at_a_quarter_of_its_gap() -> None:
    """The slope of the barrier's energy there, by differences, is the line force EI/rho^3."""
    bend, gap = 1.5e-3, 0.1e-3
    wall = firm_wall(WIRE, bend, gap)
    assert wall.activation_gap == gap
    d = 0.25 * gap + np.array([-1e-9, 1e-9])
    energy = -wall.stiffness * (d - gap) ** 2 * np.log(d / gap)
    force = -np.diff(energy)[0] / 2e-9
    assert force == pytest.approx(WIRE.bending_stiffness / bend**3, rel=1e-4)
    modulus = WIRE.sections[0].youngs_modulus
    assert firm_wall(WIRE, np.inf, gap).stiffness == pytest.approx(1e-3 * modulus)


def test_what_cannot_be_planned_is_refused() -> None:
    with pytest.raises(mw.InputError, match="received open space"):
        mw.plan(mw.Lumen.open_space(), WIRE)
    plain = mw.Wire(tuple(replace(s, magnetization=(0.0, 0.0, 0.0)) for s in WIRE.sections), 17)
    with pytest.raises(mw.InputError, match="wire of plan must be magnetised; received none"):
        mw.plan(FORK, plain)


def test_map_shows_what_is_needed_and_what_is_not_reached(
    found: dict[str, mw.Prospect],
) -> None:
    tubes = {name: path.centreline(200) for name, path in FORK.paths.items()}
    fields = {p.outlet: (p.arc, p.flux_density) for p in found.values()}
    parts = {n: maps.shapes.Branch(1e3 * p, 1e3 * r) for n, (p, r) in tubes.items()}
    trunk = maps._needed("ahead", parts, fields)
    own = maps._needed("aside", parts, fields)
    assert np.nanmax(own) == pytest.approx(1e3 * found["aside"].peak_field)
    shared = int(0.012 / 0.05 * 200)
    assert trunk[shared] == pytest.approx(own[int(0.012 / FORK.paths["aside"].length * 200)])
    assert np.nanmax(trunk[150:]) < 1e-3  # past the fork it is straight ahead again
    thin = maps._needed("thin", parts, fields)
    assert np.isnan(thin[-20:]).all()
    assert len(maps.draw(tubes, fields).axes) == 2
    count = len(maps.draw(tubes, fields).axes[0].collections)
    more = maps.draw(tubes, fields, trunks=[tubes["ahead"]]).axes[0].collections
    assert len(more) == count + 1
    sheet = np.eye(3), np.array([[0, 1, 2]])
    (wall, *_) = maps.draw(tubes, fields, surface=sheet).axes[0].collections  # in place of tubes
    assert len(wall.get_facecolor()) == 1


def test_command_on_a_scenario(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["plan", "straight", "--max-field", "20 mT", "--out", "out"]) == 0
    seen = capsys.readouterr().out
    for words in ("tip force [mN]", "wire force [mN]", "patch force [mN]", "push [mN]"):
        assert all(word in seen for word in words.split())
    assert "yes" in seen
    files = sorted(path.name for path in Path("out").iterdir())
    assert files == ["plan.csv", "plan.json", "plan.png"]
    rows = json.loads(Path("out/plan.json").read_text())["outlets"]
    assert [row["outlet"] for row in rows] == ["outlet"]
    assert rows[0]["reached"] is True
    assert rows[0]["tightest_bend"] is None  # straight: JSON has no infinity
    length = 1e3 * load("straight").lumen.build().length
    assert rows[0]["length"] == pytest.approx(length)
    heads = Path("out/plan.csv").read_text().splitlines()[0].split(",")
    assert heads[:5] == ["outlet", "reached", "length [mm]", "fed [mm]", "came [mm]"]
    assert main(["plan", "straight", "--out", "out"]) == 1
    assert "--force" in capsys.readouterr().err


def test_command_on_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "tube.csv"
    rows = [f"{x},{0.02 * x * x:.4f},0,3" for x in range(0, 31, 2)]
    file.write_text("\n".join(["x [mm],y [mm],z [mm],radius [mm]", *rows]) + "\n")
    words = ["plan", str(file), "--wire", "1 mm", "--entrance", "0 mm, 0 mm, 0 mm"]
    assert main(words) == 0
    assert "yes" in capsys.readouterr().out
    assert main([*words, "--max-field", "0.01 mT"]) == 0
    seen = capsys.readouterr().out
    assert "no " in seen
    assert "of feed" in seen


def test_command_on_some_outlets_says_each_as_it_is_done(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import vessel_files
    from magwire.cli import errand

    file, out = tmp_path / "fork.vtp", tmp_path / "out"
    file.write_bytes(vessel_files.vtp())
    seen: list[tuple[str, str]] = []
    ahead = {p.outlet: p for p in mw.plan(FORK, WIRE, outlets=("thin",))}["thin"]

    def planned(lumen: mw.Lumen, wire: mw.Wire, *, outlets: tuple[str, ...], **_: object) -> list:  # type: ignore[type-arg]
        table = out / "plan.csv"
        done = table.read_text() if table.exists() else ""
        seen.append((capsys.readouterr().out, done))
        return [replace(ahead, outlet=name) for name in outlets]

    monkeypatch.setattr(errand, "plan", planned)
    words = ["plan", str(file), "--units", "mm", "--wire", "1 mm", "--out", str(out)]
    words += ["--workers", "1"]
    targets = ["--target", "end-3", "--target", "2", "--entrance", "-0.1 mm, 0 mm, 0 mm"]
    assert main([*words, *targets, "--smoothing", "0.4", "--radius", "Radius"]) == 0
    first, second = seen
    assert "The wall lies outside of the file's balls" in first[0]
    assert first[1] == ""
    assert second[0].startswith("end-3")  # it is there before the next one is tried
    assert "end-3" in second[1]
    assert "end-2" in capsys.readouterr().out


def test_outlets_side_by_side_are_the_same_bits(found: dict[str, mw.Prospect]) -> None:
    task = Task(FORK, WIRE, mw.Demands(), None)
    beside = {p.outlet: p for p in plan_at_once(task, ("aside", "thin"), 2)}
    assert sorted(beside) == ["aside", "thin"]
    for name, prospect in beside.items():
        same_to_the_bit(prospect, found[name])


def test_planners_may_start_before_it_is_known_what_they_plan(
    found: dict[str, mw.Prospect],
) -> None:
    """Those that are not needed end with the crew, and where too few wait there are more."""
    task = Task(FORK, WIRE, mw.Demands(), None)
    with Crew(3) as crew:
        waiting = crew._waiting
        assert len(waiting) == 3
        (first,) = list(plan_at_once(task, ("thin",), 2, crew))
        same_to_the_bit(first, found["thin"])
        assert [planner.process.poll() is None for planner in waiting] == [False, True, True]
    assert all(planner.process.poll() is not None for planner in waiting)
    with Crew(1) as crew:
        ready = crew.take(task, 2)
        assert len(ready) == 2
        for planner in ready:
            planner.stop()
            planner.close()


def same_to_the_bit(a: mw.Prospect, b: mw.Prospect) -> None:
    for one in fields(a):
        assert np.array_equal(
            *(np.asarray(getattr(p, one.name)) for p in (a, b)),
            equal_nan=(one.name not in ("outlet", "reason")),
        ), one.name


def test_what_fails_beside_is_said() -> None:
    plain = mw.Wire(tuple(replace(s, magnetization=(0.0, 0.0, 0.0)) for s in WIRE.sections), 17)
    with pytest.raises(mw.MagwireError, match="wire of plan must be magnetised; received none"):
        list(plan_at_once(Task(FORK, plain, mw.Demands(), None), ("thin", "ahead"), 2))


def test_a_plan_is_taken_up_where_it_was_left(
    tmp_path: Path,
    found: dict[str, mw.Prospect],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The second outlet is interrupted; the same command plans it, and only it."""
    import vessel_files
    from magwire.cli import errand

    file, out = tmp_path / "fork.vtp", tmp_path / "out"
    file.write_bytes(vessel_files.vtp())
    asked: list[str] = []
    stop = True

    def planned(lumen: mw.Lumen, wire: mw.Wire, *, outlets: tuple[str, ...], **_: object) -> list:  # type: ignore[type-arg]
        asked.extend(outlets)
        if stop and len(asked) == 2:
            raise KeyboardInterrupt
        return [replace(found["aside"], outlet=name) for name in outlets]

    monkeypatch.setattr(errand, "plan", planned)
    words = ["plan", str(file), "--units", "mm", "--wire", "1 mm", "--out", str(out)]
    words += ["--workers", "1", "--entrance", "-0.1 mm, 0 mm, 0 mm"]
    assert main(words) == 130
    said = capsys.readouterr()
    assert f"the same command takes up the plan in '{out}' again" in said.err
    stop = False
    first, second = asked
    assert [row["outlet"] for row in json.loads((out / "plan.json").read_text())["outlets"]] == [
        first
    ]
    assert main([*words, "--max-field", "90 mT"]) == 1  # another plan
    assert "--force" in capsys.readouterr().err
    assert main(words) == 0
    said = capsys.readouterr()
    assert "Taking up the plan" in said.err
    assert asked == [first, second, second]
    assert all(name in said.out for name in (first, second))
    known = taken_up(out)
    assert {p.outlet for p in known} == {first, second}
    for prospect in known:
        same_to_the_bit(prospect, replace(found["aside"], outlet=prospect.outlet))


def test_a_plan_is_written_and_read_to_the_bit(
    tmp_path: Path, found: dict[str, mw.Prospect]
) -> None:
    """Also infinities and what is not a number."""
    save(FORK, list(found.values())[::-1], tmp_path, "mark")
    assert begun(tmp_path, "mark")
    assert not begun(tmp_path, "other")
    assert not begun(tmp_path / "nowhere")
    known = taken_up(tmp_path)
    assert [p.outlet for p in known] == list(FORK.outlets)
    for prospect in known:
        same_to_the_bit(prospect, found[prospect.outlet])


def test_a_course_without_its_spike_is_replayed_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """If the wire does not get there along it, the course as it was planned first is taken."""
    levels: list[bool] = []

    def foresee(*_: object, level: bool) -> list[str]:
        levels.append(level)
        return ["Planned otherwise."] if level else []

    def run(route: Route, distance: float, navigator: mw.Navigator) -> mw.Result:
        short = levels[-1]  # of a course without its spike
        return route_run(route, 0.5 * distance if short else distance, navigator)

    route_run = Route.run
    monkeypatch.setattr(outlets, "foresee", foresee)
    monkeypatch.setattr(Route, "run", run)
    (kept,) = mw.plan(FORK, WIRE, outlets=("aside",))
    assert levels == [True, False]
    assert kept.reached
    assert kept.reason == ""
    levels.clear()
    monkeypatch.setattr(Route, "run", route_run)
    (kept,) = mw.plan(FORK, WIRE, outlets=("aside",))
    assert levels == [True]
    assert kept.reason == "Planned otherwise."


def test_a_wire_that_is_guessed_to_follow_itself_is_where_it_would_be() -> None:
    """In bends whose wall holds it, steered: with fewer iterations than from its velocities."""
    turns = np.linspace(0.0, 1.2 * np.pi, 60)
    bends = np.stack([turns, np.sin(turns), 0.3 * np.sin(2.0 * turns)], axis=1)
    tube = mw.Lumen.through(8e-3 * bends, 0.9e-3)
    wire = replace(WIRE.sections[0], length=10e-3, magnetization=(0.0, 0.0, 0.0))
    wire = mw.Wire((wire, replace(WIRE.sections[-1], length=4e-3)), 57)
    (planned,) = mw.plan(tube, wire)
    assert planned.reached
    route = route_to(tube, wire)
    plain = replace(route, replayed=mw.Simulation(route.replayed.system.wire, tube))
    quick, slow = (one.run(planned.fed, mw.Prescribed(planned.schedule)) for one in (route, plain))
    assert slow.max_wall_force > 1e-5
    np.testing.assert_allclose(quick.position[-1], slow.position[-1], rtol=0.0, atol=1e-8)
    assert quick.max_wall_force == pytest.approx(slow.max_wall_force, rel=1e-3)
    assert quick.newton_iterations_per_step < 0.85 * slow.newton_iterations_per_step


def test_an_outlet_that_is_missed_is_planned_for_nearer_to_the_centreline_too() -> None:
    """A random vessel in which one rim after the other is followed until there is no way on."""
    lumen, wire = vessel(21)
    (kept,) = mw.plan(lumen, wire)
    assert kept.reached
    said = r"Planned with tip_clearance 0\.7; with 0\.4 \d\.\d+ mm are left\."
    assert re.fullmatch(said, kept.reason)


def test_where_more_field_would_do_no_other_course_is_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It would be at its limit, too; and so it is where the wire has nothing to lean on."""
    asked: list[float] = []
    travel = outlets._travel

    def counted(nothing: mw.Prospect, route: Route, demands: mw.Demands) -> mw.Prospect:
        asked.append(demands.tip_clearance)
        return travel(nothing, route, demands)

    monkeypatch.setattr(outlets, "_travel", counted)
    (refused,) = mw.plan(FORK, WIRE, demands=mw.Demands(max_field=1e-3), outlets=("aside",))
    assert not refused.reached
    assert len(asked) == 1


def test_what_to_do_where_a_wire_has_nothing_to_lean_on() -> None:
    """A tube of 20 mm that narrows to 3 mm between 40 and 60 mm."""
    along = np.array([0.0, 20.0, 40.0, 45.0, 50.0, 55.0, 60.0, 80.0, 100.0])
    radii = np.array([10.0, 10.0, 9.5, 8.0, 6.0, 4.0, 2.0, 1.5, 1.5])
    points = np.stack([along, 0.0 * along, 0.0 * along], axis=1)
    system = mw.Simulation(WIRE, mw.Lumen.through(1e-3 * points, 1e-3 * radii)).system
    said = remedy(system, 0.01)
    curve = system.path.branches[0].curve
    width, half = 2e3 * curve.at(np.array([0.01]))[0, 3], 1e3 * curve.at(np.array([0.01]))[0, 3]
    assert said.startswith(f"There the lumen is {width:.3g} mm wide, 4")
    x, y, z = (float(word) for word in re.findall(r"(-?[0-9.]+) mm[,\"]", said)[-3:])
    assert 2e3 * curve.at(np.array([1e-3 * x]))[0, 3] == pytest.approx(half, rel=0.05)
    assert (y, z) == (0.0, 0.0)
    assert remedy(system, 0.07) == ""  # it is narrow already


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["x.vtp"], "Input --wire must be the wire's diameter, such as '0.6 mm'; received none."),
        (["x.vtp", "--wire", "0.6"], "Input --wire needs a unit of diameter"),
        (["x.vtp", "--wire=-1 mm"], "--wire of magwire plan must be positive"),
        (["x.vtp", "--wire", "1 mm"], "Vessel file 'x.vtp' cannot be read"),
        (["straight", "--units", "mm"], "Option --units is for a vessel's file; received 'mm'."),
    ],
)
def test_command_says_what_is_wrong(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plan", *words]) == 1
    assert said in capsys.readouterr().err


def test_a_plan_at_triangles_stays_inside_of_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stiff shaft lies on the wall; by the distance from all triangles, one after the other."""
    kept: list[mw.Result] = []
    run = Route.run

    def kept_run(route: Route, distance: float, navigator: object) -> mw.Result:
        kept.append(run(route, distance, navigator))  # type: ignore[arg-type]
        return kept[-1]

    monkeypatch.setattr(Route, "run", kept_run)
    sheet = surfaces.tube(
        surfaces.arc(25e-3, 1.2, 80), lambda _, angle: np.full(angle.shape, 2.4e-3), 20
    )
    bend = mw.Lumen.through(surfaces.arc(25e-3, 1.2, 300), 2.3e-3).with_surface(*sheet)
    shaft = mw.Wire.uniform(
        length=0.02,
        radius=0.6e-3,
        youngs_modulus=60e6,
        shear_modulus=20e6,
        density=2000.0,
        nodes=17,
    )
    tip = mw.Wire.uniform(
        length=8e-3,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=17,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )
    wire = mw.Wire([*shaft.sections, *tip.sections], 41)
    (found,) = mw.plan(bend, wire, demands=mw.Demands(max_field=80e-3))
    assert found.reached
    assert found.wall_force > 5e-3
    assert 0.0 < found.clearance < 0.1e-3
    for nodes in kept[-1].position[8::8]:
        fed = nodes[nodes[:, 0] > 0.5e-3]  # past the plane of the entrance
        assert not surfaces.crossings(fed[:-1], fed[1:], *sheet).any()
        assert surfaces.apart(fed[:-1], fed[1:], *sheet) > 0.6e-3


def test_who_plans_a_scenario_with_coils_is_told_that_they_play_no_part() -> None:
    words = dict.fromkeys(("diameter", "field"))
    (said,) = of_scenario(load("half-circle-helmholtz"), words).notes
    assert said.startswith("The plan is one of a uniform field: the scenario's [actuator] plays no")
    assert of_scenario(load("half-circle"), words).notes == ()
