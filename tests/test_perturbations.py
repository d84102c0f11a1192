"""What is tried of a planned way: changes of mesh, wire, vessel and field, and their outcome."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
import surfaces
from magwire.cli import main
from magwire.lumen.displaced import displaced
from magwire.many.planners import Check, Task, check_at_once
from magwire.planning.perturbations import CHANGES, REGISTRATION, remeshed, stiffened, tried
from magwire.report import outlets
from magwire.wire.section import Stiffness
from test_planning import FORK, WIRE

SHIFT = np.array([0.1e-3, -0.2e-3, 0.15e-3])
RAMP = 5e-3


@pytest.fixture(scope="module")
def aside() -> mw.Prospect:
    (found,) = mw.plan(FORK, WIRE, outlets=("aside",))
    return found


def test_a_vessel_beside_has_its_wall_there_and_its_entrance_where_it_was() -> None:
    moved = displaced(FORK, SHIFT, RAMP)
    assert np.array_equal(moved.entrance, FORK.entrance)
    assert moved.direction == pytest.approx(FORK.direction, abs=1e-9)
    ways = {n: np.concatenate([p.centreline(50)[0]]) for n, p in FORK.paths.items()}
    for name, points in ways.items():
        far = points[np.linalg.norm(points - FORK.entrance, axis=1) > RAMP + 4e-3]  # of all balls
        assert moved.gap(far + SHIFT) == pytest.approx(FORK.gap(far), abs=5e-8)
        arc = moved.paths[name].curve.at(np.linspace(0.0, moved.paths[name].length, 400))[:, :3]
        nearest = np.linalg.norm(far[:, None] + SHIFT - arc, axis=2).min(axis=1)
        assert nearest.max() < 1e-4
    near = FORK.entrance + np.array([[0.05 * RAMP, 0.0, 0.0]])
    assert moved.gap(near) == pytest.approx(FORK.gap(near), abs=2e-3 * np.linalg.norm(SHIFT))


def test_triangles_move_with_their_branches() -> None:
    line = surfaces.arc(25e-3, 1.2, 80)
    sheet = surfaces.tube(line, lambda _, angle: np.full(angle.shape, 2.4e-3), 20)
    bend = mw.Lumen.through(surfaces.arc(25e-3, 1.2, 300), 2.3e-3).with_surface(*sheet)
    moved = displaced(bend, SHIFT, RAMP)
    assert moved.sheet is not None
    assert bend.sheet is not None
    way = moved.sheet.points - bend.sheet.points
    far = np.linalg.norm(bend.sheet.points - bend.entrance, axis=1) > RAMP
    assert way[far] == pytest.approx(np.tile(SHIFT, (far.sum(), 1)))
    points = bend.centreline(points=30)[0][15:25]
    assert moved.gap(points + SHIFT) == pytest.approx(bend.gap(points), rel=0.02)


def test_a_stiffer_wire_is_stiffer_in_all_ways() -> None:
    measured = replace(
        WIRE.sections[0],
        youngs_modulus=None,
        shear_modulus=None,
        stiffness=Stiffness(1e-6, 2e-6, 3.0),
    )
    wire = mw.Wire((measured, *WIRE.sections), 33)
    for before, after in zip(wire.sections, stiffened(wire, 0.05).sections, strict=True):
        for name in ("bending_stiffness", "twisting_stiffness", "stretching_stiffness"):
            assert getattr(after, name) == pytest.approx(1.05 * getattr(before, name))
        assert after.moment_per_length == before.moment_per_length
        assert after.length == before.length


def test_other_edges_are_of_the_same_wire() -> None:
    for factor in (0.75, 1.25):
        other = remeshed(WIRE, factor)
        assert other.sections == WIRE.sections
        assert other.edge_length == pytest.approx(factor * WIRE.edge_length, rel=0.05)


def test_a_way_with_room_holds_in_all_trials(aside: mw.Prospect) -> None:
    asked: list[str] = []
    trials = mw.robustness(aside, FORK, WIRE, watch=asked.append)
    assert tuple(asked) == CHANGES == tuple(trial.change for trial in trials)
    assert len(set(CHANGES)) == 12
    assert all(trial.reached and trial.reason == "" for trial in trials)
    peaks = {trial.change: trial.peak_field / aside.peak_field for trial in trials}
    assert peaks["field -3 %"] == pytest.approx(0.97, rel=1e-9)
    assert 1.02 < peaks["field +3 %"] <= 1.03 + 1e-9  # it is there before the last field
    assert peaks["E +5 %"] == pytest.approx(1.0, rel=1e-9)
    assert peaks["planned with edges x 0.75"] != 1.0  # another plan
    assert len({trial.clearance for trial in trials}) == 12  # each is another run


def test_a_way_that_does_not_hold_says_how_far_it_came(aside: mw.Prospect) -> None:
    """Its field turned the other way: the tip goes to the far side of the trunk."""
    wrong = replace(aside, field_components=-aside.field_components)
    trial = tried("E +5 %", wrong, FORK, WIRE)
    assert not trial.reached
    assert 0.01 < trial.came < aside.came
    left = aside.length - FORK.paths["aside"].radius[-1] - trial.came
    assert trial.reason.startswith(f"{1e3 * left:.3g} mm are left")


def test_a_change_that_leaves_no_room_is_a_trial_that_failed(aside: mw.Prospect) -> None:
    """A magnet of one edge is shorter than a longer one."""
    one = mw.Wire((WIRE.sections[0], replace(WIRE.sections[-1], length=1.25e-3)), 14)
    trial = tried("edges x 1.25", aside, FORK, one)
    assert not trial.reached
    assert "so that the section of 0.00125 m spans an edge" in trial.reason
    assert np.isnan(trial.clearance)


def test_what_is_not_reached_cannot_be_tried(aside: mw.Prospect) -> None:
    with pytest.raises(mw.InputError, match=r"must be one that is reached; .* to 'aside'"):
        mw.robustness(replace(aside, reached=False), FORK, WIRE)


def test_the_registration_is_a_fifth_of_a_millimetre_in_all_directions(aside: mw.Prospect) -> None:
    assert REGISTRATION == 0.2e-3
    ways = [name for name in CHANGES if name.startswith("vessel")]
    parts = np.array([name[8:-4].split(", ") for name in ways], dtype=float)
    assert np.linalg.norm(parts, axis=1) == pytest.approx(0.2, rel=0.05)
    assert parts.sum(axis=0) == pytest.approx(0.0, abs=1e-9)


def test_trials_side_by_side_are_the_same_bits(aside: mw.Prospect) -> None:
    orders = [Check(change, aside) for change in ("E +5 %", "field -3 %")]
    beside = list(check_at_once(Task(FORK, WIRE, mw.Demands(), None), orders, 2))
    assert {name for name, _ in beside} == {"aside"}
    for order in orders:
        (trial,) = [trial for _, trial in beside if trial.change == order.change]
        assert trial == tried(order.change, aside, FORK, WIRE)


def test_command_tries_what_is_reached_and_what_was_planned_before(
    tmp_path: Path,
    aside: mw.Prospect,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import vessel_files
    from magwire.cli import errand

    file, out = tmp_path / "fork.vtp", tmp_path / "out"
    file.write_bytes(vessel_files.vtp())
    planned: list[str] = []
    asked: list[tuple[str, str]] = []

    def plan(lumen: mw.Lumen, wire: mw.Wire, *, outlets: tuple[str, ...], **_: object) -> list:  # type: ignore[type-arg]
        planned.extend(outlets)
        return [
            replace(aside, outlet=n, reached=n == "end-2", reason="" if n == "end-2" else "No.")
            for n in outlets
        ]

    def check(change: str, prospect: mw.Prospect, *_: object) -> mw.Trial:
        asked.append((prospect.outlet, change))
        bad = change == "E -5 %"
        return mw.Trial(
            change,
            not bad,
            0.01,
            2e-3 if bad else 1e-3,
            3e-6,
            1e-6,
            "5 mm are left." if bad else "",
        )

    monkeypatch.setattr(errand, "plan", plan)
    monkeypatch.setattr(errand, "tried", check)
    words = ["plan", str(file), "--units", "mm", "--wire", "1 mm", "--out", str(out)]
    words += ["--workers", "1", "--entrance", "-0.1 mm, 0 mm, 0 mm"]
    assert main(words) == 0
    assert "when off" not in capsys.readouterr().out
    assert not asked
    assert main([*words, "--robust"]) == 0
    said = capsys.readouterr().out
    assert sorted(planned) == ["end-2", "end-3"]  # once each
    assert asked == [("end-2", change) for change in CHANGES]
    head, row = [line for line in said.splitlines() if "when off" in line or "11 of 12" in line]
    assert row.split() == ["end-2", "11", "of", "12", "0.001", "0.003", "2"]
    assert len(head) >= len(row)
    assert "end-2, E -5 %: not reached. 5 mm are left." in said.splitlines()
    rows = {r["outlet"]: r for r in json.loads((out / "plan.json").read_text())["outlets"]}
    assert rows["end-2"]["robust_reached"] == 11
    assert rows["end-2"]["robust_failed"] == "E -5 %"
    assert rows["end-3"]["robust_tried"] == 0
    assert rows["end-3"]["robust_clearance"] is None
    (known,) = [p for p in outlets.taken_up(out) if p.outlet == "end-2"]
    assert tuple(trial.change for trial in known.trials) == CHANGES
    assert known.schedule.flux_density == pytest.approx(aside.schedule.flux_density, abs=0.0)
    assert main([*words, "--robust"]) == 0  # all of it is there
    assert len(asked) == 12
    assert "11 of 12" in capsys.readouterr().out
