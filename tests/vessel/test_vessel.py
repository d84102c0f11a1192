"""Vessels: lines joined, cleaned and smoothed, by a stated amount."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from magwire.errors import InputError
from magwire.lumen import Lumen
from magwire.vessel import Vessel, survey
from magwire.vessel.interior import SAMPLES, wall_samples
from magwire.vessel.placement import Placement
from magwire.vessel.smooth import smooth
from vessel_files import Lines, fork, pieces, table, vtp

S = np.arange(0.0, 100.5, 0.5)


def read(folder: Path, lines: Lines, **options: object) -> Vessel:
    path = folder / "vessel.vtp"
    path.write_bytes(vtp(lines=lines))
    return Vessel.read(path, "mm", **options)  # type: ignore[arg-type]


def straight(radius: float = 2.0) -> tuple[np.ndarray, np.ndarray]:
    return np.column_stack([S, 0 * S, 0 * S]), np.full(len(S), radius)


def test_smoothing_is_a_low_pass() -> None:
    """A wave of wave number k is damped by 1 / (1 + (length k)^6), in radii."""
    s, length = np.linspace(0.0, 200.0, 8001), 0.5
    for k in (0.5, 1.0, 2.0, 3.0, 4.0):
        wave = 0.05 * np.sin(k * s)
        found = smooth(np.column_stack([s, wave, 0 * s]), np.ones(len(s)), length)
        inside = np.abs(found.points[:, 0] - 100.0) < 60.0
        damped = found.points[inside, 1].std() * np.sqrt(2.0) / 0.05
        assert damped == pytest.approx(1.0 / (1.0 + (length * k) ** 6), abs=0.02)
        assert found.deviation.max() == pytest.approx(0.05 * (1.0 - damped), abs=6e-3)


def test_noise_goes_and_the_deviation_says_so(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    points, radius = straight()
    noisy = points + 0.1 * rng.normal(size=points.shape)
    with pytest.raises(InputError, match="must bend with a radius larger"):
        Lumen.through(1e-3 * noisy, 1e-3 * radius)
    vessel = read(tmp_path, [(noisy, radius)])
    (tube,), (way,) = vessel.tubes.values(), vessel.ways.values()
    off = np.linalg.norm(tube.points[:, 1:], axis=1)
    assert off.max() < 0.3e-3
    assert 0.05e-3 < way.deviation[1] < 0.2e-3
    assert tube.bend_radius().radius > 2.0 * 2e-3


def test_spikes_and_repeated_points_go(tmp_path: Path) -> None:
    points, radius = straight()
    broken = np.insert(points, [50, 50, 120], [[24.5, 0, 0], [24.5, 0, 0], [60.0, 9.0, 0]], axis=0)
    wide = np.insert(radius, [50, 50, 120], [2.0, 2.0, 2.0])
    wide[80] = 40.0
    vessel = read(tmp_path, [(broken, wide)])
    (tube,) = vessel.tubes.values()
    assert np.abs(tube.points[:, 1:]).max() < 1e-6
    assert tube.radius.max() < 2.01e-3
    assert any("3, left out" in note for note in vessel.notes)


def test_a_wide_bend_is_narrowed_and_says_so(tmp_path: Path) -> None:
    w = np.linspace(0.0, 0.5 * np.pi, 60)
    points = np.column_stack([4.0 * np.sin(w), 4.0 * (1.0 - np.cos(w)), 0 * w])
    ahead = points[-1] + np.arange(1, 40)[:, None] * [0.0, 0.5, 0.0]
    before = np.arange(-40, 0)[:, None] * [0.5, 0.0, 0.0]
    line = np.concatenate([before, points, ahead])
    radius = np.full(len(line), 2.0)
    radius[40:100] = 4.5 - 2.5 * np.abs(np.linspace(-1, 1, 60))
    vessel = read(tmp_path, [(line, radius)], smoothing=0.2)
    (way,) = vessel.ways.values()
    assert way.narrowed > 0.3e-3
    assert np.linalg.norm(1e3 * way.where - points[30]) < 3.0


def test_orientation_and_entrance(tmp_path: Path) -> None:
    flipped = [(p[::-1], r[::-1]) for p, r in fork()]
    for lines in (fork(), flipped, pieces()):
        vessel = read(tmp_path, lines)
        assert np.allclose(vessel.lumen().entrance, 0.0)  # the widest end
        assert len(vessel.tubes) == 2
    side = np.column_stack([np.full(80, 50.0), 0.5 * np.arange(80), np.zeros(80)])
    vessel = read(tmp_path, [straight(), (side, np.full(80, 1.5))], entrance=3)
    assert set(vessel.tubes) == {"end-1", "end-2"}
    for tube in vessel.tubes.values():
        assert tube.length == pytest.approx(89.5e-3, abs=2e-3)
        assert np.allclose(tube.entrance, vessel.ends["end-3"])


def test_a_way_that_turns_back_is_left_out_and_moves_no_other(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"has no open end to go to: the path to 'end-2' is left"):
        read(tmp_path, [hairpin()])
    there, back = read(tmp_path, fork()), read(tmp_path, fork(), entrance="end-2")
    for vessel in (there, back):
        assert vessel.deviation is not None
        assert vessel.deviation.outside.radii[2] < 0.1
    # far from the fork, which the way back rounds more gently, trunk and branch are what they were
    trunk = there.tubes["end-2"].centreline()[0]
    other = back.lumen().path("end-1")
    at = np.linalg.norm(trunk - [30e-3, 0, 3e-3], axis=1)
    assert other.offset(trunk[at > 15e-3][5:-5]).max() < 0.02e-3


def test_an_entrance_inside_cuts_off_what_is_behind(tmp_path: Path) -> None:
    vessel = read(tmp_path, fork(), entrance=(20e-3, 0.0, 2e-3))
    assert vessel.entrance == "point"
    assert set(vessel.tubes) == {"end-2", "end-3"}
    for tube in vessel.tubes.values():
        assert tube.entrance == pytest.approx([20e-3, 0.0, 2e-3], abs=0.3e-3)


def test_targets_by_name_number_and_point(tmp_path: Path) -> None:
    vessel = read(tmp_path, fork())
    end = vessel.ends["end-3"]
    assert vessel.lumen("end-3").target == "end-3"
    assert vessel.lumen(3).target == "end-3"
    assert vessel.lumen(tuple(end)).target == "end-3"
    assert vessel.lumen((50e-3, -2e-3, 5e-3)).target == "end-3"
    with pytest.raises(InputError, match="must be the number of an end, one of 2, 3; received 1"):
        vessel.lumen(1)
    with pytest.raises(InputError, match="must be 'end-2' or 'end-3'; received 'left'"):
        vessel.lumen("left")


def test_names_come_from_the_file(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(table())
    vessel = Vessel.read(tmp_path / "a.csv", "mm")
    assert list(vessel.tubes) == ["way0", "way1"]


def test_placement(tmp_path: Path) -> None:
    plain = read(tmp_path, fork())
    moved = read(
        tmp_path, fork(), scale=2.0, rotation=(0, 0, np.pi / 2), translation=(0.1, 0.0, 0.0)
    )
    for name, tube in plain.tubes.items():
        x, y, z = 2.0 * tube.points.T
        assert np.allclose(moved.tubes[name].points, np.column_stack([0.1 - y, x, z]), atol=1e-9)
        assert np.allclose(moved.tubes[name].radius, 2.0 * tube.radius, atol=1e-9)


def test_pieces_that_do_not_touch_are_refused(tmp_path: Path) -> None:
    far = pieces()
    far[1] = (far[1][0] + [0.0, 30.0, 0.0], far[1][1])
    with pytest.raises(
        InputError, match=r"in 2 disconnected pieces; the closest ones are 30 mm apart"
    ):
        read(tmp_path, far)


def test_small_gaps_are_bridged_and_noted(tmp_path: Path) -> None:
    apart = pieces()
    apart[0] = (apart[0][0][:-6], apart[0][1][:-6])
    vessel = read(tmp_path, apart)
    assert any("gap of 3" in note and "is bridged" in note for note in vessel.notes)
    assert len(vessel.tubes) == 2


def ring() -> Lines:
    """A straight tube, and half a circle that leaves it and comes back."""
    w = np.linspace(0.0, np.pi, 120)
    aside = np.column_stack([40 - 20 * np.cos(w), 20 * np.sin(w), 0 * w])
    return [straight(), (aside, np.full(120, 1.5))]


def test_loops_are_opened_where_they_are_farthest(tmp_path: Path) -> None:
    vessel = read(tmp_path, ring())
    (note,) = [note for note in vessel.notes if "loop" in note]
    # sides of 20 pi and 40 mm: two ways of the same length meet (20 pi - 40) / 2 mm before the end
    length = 20.0 * np.pi + 40.0
    assert float(note.split()[3]) == pytest.approx(length, rel=0.01)
    assert "is opened near" in note
    assert "'cut' opens it elsewhere" in note
    w = np.pi * (1.0 - 0.5 * (20.0 * np.pi - 40.0) / (20.0 * np.pi))
    meet = 1e-3 * np.array([40 - 20 * np.cos(w), 20 * np.sin(w), 0.0])
    ends = [place for name, place in vessel.ends.items() if name.startswith("cut-")]
    assert len(ends) == 2
    assert all(np.linalg.norm(place - meet) < 3e-3 for place in ends)
    assert vessel.lumen().length == pytest.approx(0.1, rel=0.02)


def test_a_loop_is_opened_where_one_says(tmp_path: Path) -> None:
    vessel = read(tmp_path, ring(), cut=[(40e-3, 20e-3, 0.0)])
    assert not any("loop" in note for note in vessel.notes)
    ends = [place for name, place in vessel.ends.items() if name.startswith("cut-")]
    assert sorted(place[0] for place in ends) == pytest.approx([38e-3, 42e-3], abs=0.5e-3)
    with pytest.raises(InputError, match=r"cannot be cut near .* mm, which is not in the vessel"):
        read(tmp_path, ring(), cut=[(40e-3, 50e-3, 0.0)])


def hairpin() -> tuple[np.ndarray, np.ndarray]:
    """Out and back beside itself, closer than it is wide."""
    out = np.linspace(0.0, 30.0, 61)
    points = np.concatenate(
        [np.column_stack([out, 0 * out]), np.column_stack([out, 0 * out])[::-1]]
    )
    points = np.column_stack([points[:, 0], np.repeat([0.0, 1.5], 61), np.zeros(122)])
    return points, np.full(122, 2.0)


def test_lines_are_made_longer_at_their_ends(tmp_path: Path) -> None:
    short, long = read(tmp_path, [straight()]), read(tmp_path, [straight()], extend=1.0)
    assert long.lumen().length - short.lumen().length == pytest.approx(2 * 2e-3, rel=1e-6)
    assert long.ends["end-1"] == pytest.approx([-2e-3, 0, 0], abs=1e-9)


def test_of_ends_of_the_same_width_that_where_lines_begin_is_the_entrance(tmp_path: Path) -> None:
    lines = [(p[::-1], np.full(len(r), 2.0) + 0.002 * np.linspace(1, 0, len(r))) for p, r in fork()]
    vessel = read(tmp_path, lines)  # they all stop at the origin, and are wider at the other ends
    assert np.allclose(vessel.ends[vessel.entrance], 0.0, atol=1e-6)
    assert any("is taken to be" in note and "about as wide" in note for note in vessel.notes)


def test_the_wall_is_nowhere_outside_of_the_files_own(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    off = 0.1 * rng.normal(size=fork()[0][0].shape)
    noisy = [(p + off, r) for p, r in fork()]
    for end in ("end-1", "end-2", "end-3"):
        vessel = read(tmp_path, noisy, entrance=end)
        points, walls = 1e-3 * np.concatenate([p for p, _ in noisy]), vessel.lumen()
        radius = 1e-3 * np.concatenate([r for _, r in noisy])
        for name in walls.outlets:  # an independent look at it: rings of points on each tube
            centre, wide = walls.path(name).centreline(points=400)
            around = centre[:, None] + wide[:, None, None] * rng.normal(size=(400, 20, 3))
            around = centre[:, None] + wide[:, None, None] * (
                (around - centre[:, None])
                / np.linalg.norm(around - centre[:, None], axis=2, keepdims=True)
            )
            flat = around.reshape(-1, 3)
            depth = (radius - np.linalg.norm(flat[:, None] - points, axis=2)).max(axis=1)
            inner = np.repeat(np.arange(400), 20)
            keep = (inner > 10) & (inner < 390)  # a ball at an end is no cap
            assert -depth[keep].min() < 0.1 * wide.max()


def test_spurs_are_left_out(tmp_path: Path) -> None:
    spur = np.column_stack([np.full(5, 50.0), np.linspace(0.0, 2.0, 5), np.zeros(5)])
    vessel = read(tmp_path, [straight(), (spur, np.full(5, 1.0))])
    assert list(vessel.tubes) == ["end-2"]
    assert any("spur" in note for note in vessel.notes)


def test_repeated_lines_are_one(tmp_path: Path) -> None:
    vessel = read(tmp_path, [straight(), straight()])
    assert list(vessel.tubes) == ["end-2"]
    assert any("repeat others are left out: 2" in note for note in vessel.notes)


def test_survey(tmp_path: Path) -> None:
    vessel = read(tmp_path, fork())
    first, second = survey.courses(vessel)
    assert first.own == pytest.approx(first.length)
    assert 18e-3 < second.own < 30e-3
    assert first.radii == pytest.approx((1.8e-3, 3e-3), rel=2e-3)
    assert first.narrowest == pytest.approx(first.length, rel=1e-6)
    reach = survey.reach(first, 1e-3, 1e-7)
    assert reach.fits
    assert reach.force == pytest.approx(1e-7 / first.bend.radius**2)
    assert not survey.reach(first, 1.9e-3, 1e-7).fits


def test_flipped_axes_are_found(tmp_path: Path) -> None:
    from magwire.vessel.files import load

    lines = [(p + [30.0, 70.0, -20.0], r) for p, r in fork()]
    vessel = read(tmp_path, lines)
    (tmp_path / "other.vtp").write_bytes(vtp(lines=[(p * [-1, -1, 1], r) for p, r in lines]))
    (tmp_path / "same.vtp").write_bytes(vtp(lines=lines))
    other, same = load(tmp_path / "other.vtp"), load(tmp_path / "same.vtp")
    assert survey.flipped_axes(vessel, other, Placement(1e-3)) == "x and y"
    assert survey.flipped_axes(vessel, same, Placement(1e-3)) is None


def test_a_tube_that_meets_itself(tmp_path: Path) -> None:
    w = np.linspace(0.0, 2.0 * np.pi, 200)
    ring = np.column_stack([20 * np.sin(w), 20 * (1 - np.cos(w)), 3.0 * w / (2 * np.pi)])
    vessel = read(tmp_path, [(ring, np.full(200, 2.0))])
    (sentence,) = survey.self_contacts(vessel)
    assert "meets itself" in sentence
    assert not list(survey.self_contacts(read(tmp_path, fork())))


def test_a_surface_of_more_triangles_than_samples_is_sampled_at_its_corners() -> None:
    points = np.random.default_rng(0).random((300, 3))
    triangles = np.random.default_rng(1).integers(300, size=(SAMPLES // 3 + 10, 3))
    found, _ = wall_samples(points, triangles, 1e-3)
    assert len(found) == 300
