"""Trees: smooth junctions, paths to named outlets, and what is refused (P-10)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import KDTree

from magwire.errors import InputError
from magwire.kernels.wall.gap import gap_jet, gap_value, work_many
from magwire.lumen import Branch, Lumen
from magwire.lumen.curve import Curve

from .trees import LINES, RADIUS, angled, junctions, shared
from .tubes import around

Array = NDArray[np.float64]
TREES = {name: Lumen.tree(lines()) for name, lines in LINES.items()}
UNIT = 1e-3  # millimetres: numbers of order one
EACH = pytest.mark.parametrize("name", sorted(TREES))


def around_all(tree: Lumen, count: int, low: float, high: float, seed: int = 0) -> Array:
    """Points around every branch."""
    return np.concatenate(
        [around(tree.path(name), count, low, high, seed) for name in tree.outlets]
    )


def jets(tree: Lumen, points: Array) -> tuple[Array, Array, Array]:
    """Gap, gradient and Hessian; lengths in millimetres."""
    arrays = tree.arrays(UNIT)
    found = [gap_jet(arrays, *point) for point in points / UNIT]
    hessian = [[[h[0], h[1], h[2]], [h[1], h[3], h[4]], [h[2], h[4], h[5]]] for *_, h in found]
    return np.array([f[0] for f in found]), np.array([f[4] for f in found]), np.array(hessian)


def off_axis(tree: Lumen, points: Array) -> Array:
    """Distance to the nearest of all centrelines [m]: there every gap has its peak."""
    return np.asarray(dense(tree).query(points)[0])


@cache
def dense(tree: Lumen) -> KDTree:
    """Points of all centrelines, close to each other."""
    parts = [b.curve.at(np.linspace(0.0, b.length, 4001))[:, :3] for b in tree.branches]
    return KDTree(np.concatenate(parts))


def cross(tree: Lumen, centre: Array, radius: float, seed: int) -> int:
    """Go through a junction in steps of a thousandth of a radius; how many were inside.

    Gap and gradient may change by what the Hessian allows, and no more.
    """
    rng = np.random.default_rng(seed)
    ends = centre + 2.5 * radius * rng.uniform(-1.0, 1.0, (2, 3))
    points = ends[0] + np.linspace(0.0, 1.0, 3001)[:, None] * (ends[1] - ends[0])
    step = np.linalg.norm(ends[1] - ends[0]) / 3000 / UNIT
    gap, gradient, _ = jets(tree, points)
    inside = (gap > 0.0) & np.isfinite(gap) & (off_axis(tree, points) > 0.1 * radius)
    arc, branch = tree.locate(points)
    lengths = np.array([part.length for part in tree.branches])
    inside &= (arc >= 0.0) & (arc <= lengths[branch])  # not in the flare of an end
    pairs = inside[1:] & inside[:-1]
    gap[~inside] = 0.0
    assert np.all(np.abs(np.diff(gap))[pairs] <= step * (1.0 + 1e-9))
    narrowest = min(branch.blend for branch in tree.branches[1:])
    steepest = (1.5 / (0.1 * radius) + 4.0 / narrowest) * UNIT
    turns = np.linalg.norm(np.diff(gradient, axis=0), axis=1)[pairs]
    assert turns.max(initial=0.0) <= steepest * step
    middle = 0.5 * (gradient[1:] + gradient[:-1]) @ (ends[1] - ends[0]) / 3000 / UNIT
    error = np.abs(np.diff(gap) - middle)[pairs]
    assert error.max(initial=0.0) <= steepest * step**2
    return int(pairs.sum())


@settings(max_examples=60, deadline=None)
@given(name=st.sampled_from(sorted(TREES)), which=st.integers(0, 2), seed=st.integers(0, 10_000))
def test_gap_and_gradient_have_no_jump_across_a_junction(name: str, which: int, seed: int) -> None:
    tree = TREES[name]
    places = junctions(tree)
    cross(tree, *places[which % len(places)], seed)


@pytest.fixture(scope="module")
def coronary() -> Lumen:
    """The patient's tree of the examples, whose branches have radii of 0.5 to 2.5 mm."""
    file = Path(__file__).parents[2] / "examples/data/coronary_lca_centerlines_multimoda.vtp"
    return Lumen.read(file, "mm", entrance=(19.2e-3, -188.6e-3, 1751.9e-3))


@pytest.mark.parametrize("which", range(4))
def test_nor_across_the_junctions_of_a_patient(coronary: Lumen, which: int) -> None:
    centre, radius = junctions(coronary)[which]
    assert sum(cross(coronary, centre, radius, seed) for seed in range(4)) > 800


def test_blend_is_a_fifth_of_the_radius_at_each_junction(coronary: Lumen) -> None:
    blends = [branch.blend for branch in TREES["angled"].branches]
    assert blends == pytest.approx([0.0, 0.2 * 4e-3, 0.2 * 3e-3, 0.2 * 2e-3])
    blends = [branch.blend for branch in Lumen.tree(angled(), blend=1e-4).branches]
    assert blends == [0.0, 1e-4, 1e-4, 1e-4]
    assert coronary.narrowest < 0.5e-3  # far from any junction
    assert min(branch.blend for branch in coronary.branches[1:]) > 0.25e-3


@EACH
def test_derivatives_at_the_junctions_are_those_of_differences(name: str) -> None:
    tree = TREES[name]
    rng = np.random.default_rng(4)
    h = 1e-6  # m
    tried = 0
    for centre, radius in junctions(tree):
        points = centre + 2.0 * radius * rng.uniform(-1.0, 1.0, (1200, 3))
        gap = tree.gap(points)
        points = points[(gap > 0.1 * radius) & np.isfinite(gap)]
        points = points[off_axis(tree, points) > 0.3 * radius]
        _, gradient, hessian = jets(tree, points)
        for axis, step in enumerate(h * np.eye(3)):
            (after, n_after, _), (before, n_before, _) = (
                jets(tree, points + step),
                jets(tree, points - step),
            )
            slope = (after - before) / (2.0 * h / UNIT)
            np.testing.assert_allclose(gradient[:, axis], slope, rtol=0, atol=2e-5)
            bend = (n_after - n_before) / (2.0 * h / UNIT)
            close = np.abs(bend - hessian[:, :, axis]).max(axis=1) < 0.02
            assert close.mean() > 0.97  # C2 but where the blend sets in: there a kink
        tried += len(points)
    assert tried > 200


@EACH
def test_gap_is_lipschitz(name: str) -> None:
    tree = TREES[name]
    rng = np.random.default_rng(5)
    start = around_all(tree, 3000, 0.0, 1.3)
    end = start + 1e-4 * rng.normal(size=start.shape)
    change = np.abs(tree.gap(end) - tree.gap(start))
    assert np.all(change <= np.linalg.norm(end - start, axis=1) * (1.0 + 1e-9) + 1e-12)


@EACH
def test_safe_distance_is_the_gap_also_where_branches_blend(name: str) -> None:
    """Between two branches the blended gap may be positive where both of theirs are not."""
    tree = TREES[name]
    arrays = tree.arrays()
    rng = np.random.default_rng(6)
    between = 0
    for centre, radius in junctions(tree):
        points = centre + 2.0 * radius * rng.uniform(-1.0, 1.0, (3000, 3))
        single = np.array([Lumen((branch,)).gap(points) for branch in tree.branches])
        single = np.where(np.isfinite(single), single, -np.inf).max(axis=0)  # +inf: far outside
        for point, alone in zip(points, single, strict=True):
            g, _, _, safe = gap_value(arrays, *point)
            assert safe == gap_jet(arrays, *point)[3]
            if 0.0 < g < np.inf:
                assert safe == g
                between += alone <= 0.0
    assert between > 0


@EACH
def test_the_wall_is_that_of_the_tubes(name: str) -> None:
    """Near the wall: at most a sixth of the blend wider, at most 4 percent of a radius narrower."""
    tree, lines = TREES[name], [line.branches[0] for line in LINES[name]().values()]
    tubes = Lumen((lines[0], *(replace(line, open_begin=False) for line in lines[1:])))
    points = around_all(tree, 4000, 0.8, 1.1)
    wanted = tubes.gap(points)
    near = np.abs(wanted) < 0.1 * tree.narrowest
    more = (tree.gap(points) - wanted)[near]
    assert near.sum() > 1000
    widest = max(branch.blend for branch in tree.branches)
    assert more.max() <= widest / 6.0 + 2e-6
    assert more.min() >= -0.04 * tree.radius_range[1]


@EACH
def test_the_start_of_a_branch_cannot_be_felt(name: str) -> None:
    """Where the cap of its first ball is nearest, a branch changes nothing, not even a bit."""
    tree = TREES[name]
    for i, branch in enumerate(tree.branches[1:], start=1):
        rest = Lumen(tree.branches[:i])
        rng = np.random.default_rng(i)
        points = branch.entrance + 2.0 * branch.radius.max() * rng.uniform(-1.0, 1.0, (4000, 3))
        points = points[Lumen((branch,)).locate(points)[0] <= 0.0]
        whole = Lumen(tree.branches[: i + 1])
        before, after = rest.gap(points), whole.gap(points)
        felt = np.isfinite(before) & (before > -0.5 * branch.radius.max())
        np.testing.assert_allclose(after[felt], before[felt], rtol=0, atol=1e-12)


@EACH
def test_paths_are_smooth_and_inside(name: str) -> None:
    tree = TREES[name]
    for outlet, line in LINES[name]().items():
        path = tree.path(outlet)
        curve = path.branches[0].curve
        s = np.linspace(0.0, path.length, 20_001)
        ball, first, second = curve.at(s), curve.at(s, 1), curve.at(s, 2)
        np.testing.assert_allclose(np.linalg.norm(first[:, :3], axis=1), 1.0, atol=2e-3)
        assert np.linalg.norm(np.diff(second[:, :3], axis=0), axis=1).max() < 30.0
        np.testing.assert_allclose(ball[0, :3], tree.entrance, atol=2e-6)
        end = line.branches[0].curve.at(np.array([line.length]))[0, :3]
        np.testing.assert_allclose(ball[-1, :3], end, atol=1e-9)
        assert path.bend_radius()[0].radius > 1.1 * line.narrowest
        room = tree.gap(ball[1:-1, :3]) / np.minimum(ball[1:-1, 3], line.narrowest)
        assert room.min() > (0.6 if name == "angled" else 0.93)


def test_a_path_from_the_entrance_is_the_line_itself() -> None:
    for outlet, line in shared().items():
        assert TREES["shared"].path(outlet).length == line.length


def test_a_path_around_a_corner_keeps_to_its_lines_elsewhere() -> None:
    path, line = TREES["angled"].path("second"), angled()["second"]
    points, _ = path.centreline()
    cut = 8e-3 + 3e-3
    before = points[points[:, 0] < 0.06 - 1.01 * cut]
    np.testing.assert_allclose(before[:, 1:], 0.0, atol=1e-12)
    far = points[points[:, 2] > 1.01 * cut]
    assert len(far) > 20
    assert line.offset(far).max() < 1e-6
    assert path.length < 0.06 + line.length  # the corner is cut


def test_target_does_not_change_the_wall() -> None:
    points = around_all(TREES["shared"], 500, 0.5, 1.2)
    for outlet in TREES["shared"].outlets:
        tree = Lumen.tree(shared(), target=outlet)
        assert tree.target == outlet
        assert tree.length == tree.path().length == tree.path(outlet).length
        np.testing.assert_array_equal(tree.gap(points), TREES["shared"].gap(points))


def test_order_of_the_branches_hardly_matters() -> None:
    lines = shared()
    other = Lumen.tree({name: lines[name] for name in reversed(lines)})
    points = around_all(other, 2000, 0.0, 1.1)
    change = other.gap(points) - TREES["shared"].gap(points)
    assert np.abs(change).max() < 0.06 * RADIUS


def test_outlets_have_names() -> None:
    tree = TREES["shared"]
    assert tree.outlets == ("left", "middle", "right")
    assert len(tree.branches) == 3
    assert tree.target == "left"
    assert [branch.blend for branch in tree.branches] == pytest.approx(
        [0.0, 0.2 * RADIUS, 0.2 * RADIUS]
    )
    arc, branch = tree.locate([tree.path("middle").centreline()[0][-1]])
    assert branch[0] == 1
    assert arc[0] == pytest.approx(tree.branches[1].length)


def test_a_tube_is_its_own_path() -> None:
    tube = Lumen.straight(0.1, RADIUS)
    assert tube.outlets == ()
    assert tube.path() is tube
    assert Lumen.open_space().path().length == np.inf


def test_one_branch_makes_a_tree() -> None:
    tree = Lumen.tree({"only": Lumen.straight(0.1, RADIUS)})
    assert tree.path("only").length == tree.length == pytest.approx(0.1)


def test_entry_is_in_front_of_every_path() -> None:
    tree = Lumen.tree(shared(), target="right").with_entry(0.01)
    assert tree.outlets == ("left", "middle", "right")
    assert tree.target == "right"
    for outlet in tree.outlets:
        assert tree.path(outlet).length == pytest.approx(0.086, rel=1e-5)
        np.testing.assert_allclose(tree.path(outlet).entrance, [-0.01, 0.0, 0.0], atol=1e-12)
    points = np.array([[-0.005, 2e-3, 0.0], [0.01, 0.0, -2.5e-3]])
    np.testing.assert_allclose(tree.gap(points), [1e-3, 0.5e-3], rtol=0, atol=1e-6)


def test_query_on_a_tree_costs_little_more_than_on_a_tube() -> None:
    """Seeds a query reads, counted: those of other branches only near a junction."""
    tree = TREES["shared"]
    points = around_all(tree, 2000, 0.8, 1.05)
    seeds, iterations = np.empty(6000, dtype=np.int64), np.empty(6000, dtype=np.int64)
    work_many(tree.arrays(), points, seeds, iterations)
    assert seeds.mean() < 1.6
    assert seeds.max() <= 4


def test_query_costs_the_same_with_500_times_as_many_points() -> None:
    """Counted: seeds that a query reads, and Newton steps from them."""
    tables = {name: tube.branches[0] for name, tube in angled().items()}
    work = []
    for count in (200, 100_000):
        lines = {name: Lumen.through(*b.centreline(count)) for name, b in tables.items()}
        tree = Lumen.tree(lines)
        assert len(tree.branches[0].points) == count
        points = around_all(tree, 1000, 0.5, 1.05)
        seeds, steps = np.empty(4000, dtype=np.int64), np.empty(4000, dtype=np.int64)
        work_many(tree.arrays(), points, seeds, steps)
        work.append((seeds.mean(), steps.mean()))
    np.testing.assert_allclose(work[1], work[0], rtol=0.1)


def straight(*points: list[float], radius: float = RADIUS) -> Lumen:
    return Lumen.through(points, radius)


STEM = straight([0, 0, 0], [0.1, 0, 0])
FAULTS: dict[str, Callable[[], Any]] = {
    "target of Lumen must be one of the outlets 'left', 'middle', 'right'; received 'lfet'": (
        lambda: Lumen.tree(shared(), target="lfet")
    ),
    "target of Lumen must be one of the outlets 'aorta', 'first', 'second', 'twig'; received ''": (
        lambda: TREES["angled"].path("")
    ),
    "target of Lumen must be left out for a lumen without outlets; received 'left'": (
        lambda: STEM.path("left")
    ),
    "received 'off', which starts at (0.02, 0.009, 0) m, 0.009 m from the centreline of 'stem'": (
        lambda: Lumen.tree({"stem": STEM, "off": straight([0.02, 0.009, 0], [0.05, 0.05, 0])})
    ),
    "'same' runs along 'stem' to its end": lambda: Lumen.tree({"stem": STEM, "same": STEM}),
    "'wide' is wider (0.005 m) than what it leaves (0.003 m)": lambda: Lumen.tree(
        {"stem": STEM, "wide": straight([0.05, 0, 0], [0.08, 0.05, 0], radius=5e-3)}
    ),
    "'loop' comes back to another branch near (": lambda: Lumen.tree(
        {
            "stem": STEM,
            "loop": straight([0.02, 0, 0], [0.04, 0.015, 0], [0.06, 0, 0], [0.08, -0.015, 0]),
        }
    ),
    "the outlet 'short' lies inside of 'stem'": lambda: Lumen.tree(
        {"stem": STEM, "short": straight([0.02, 0, 0], [0.025, 0.002, 0])}
    ),
    "the outlet 'stem' lies inside of 'past'": lambda: Lumen.tree(
        {"stem": STEM, "past": straight([0.02, 0, 0], [0.06, 0.012, 0], [0.1, 0.002, 0.001])}
    ),
    "'back' turns by 135 degrees from 'stem', which is too sharp": lambda: Lumen.tree(
        {"stem": STEM, "back": straight([0.06, 0, 0], [0.0, 0.06, 0])}
    ),
    "'early' leaves 'stem' too close to the entrance": lambda: Lumen.tree(
        {"stem": STEM, "early": straight([0.001, 0, 0], [0.02, 0.03, 0])}
    ),
    "blend of Lumen.tree must be smaller than the branches are wide": lambda: Lumen.tree(
        shared(), blend=2.9e-3
    ),
    "blend of Lumen.tree must be zero or positive": lambda: Lumen.tree(shared(), blend=-1e-3),
    "must be a mapping of names to lumens with at least one entry; received none": (
        lambda: Lumen.tree({})
    ),
    "must be a mapping of names to lumens with at least one entry; received list": (
        lambda: Lumen.tree([STEM])  # type: ignore[arg-type]
    ),
    "must map names to lumens of one branch; received Lumen with 3 branches for 'tree'": (
        lambda: Lumen.tree({"tree": TREES["shared"]})
    ),
    "must map names to lumens of one branch; received float for 'number'": (
        lambda: Lumen.tree({"number": 3.0})  # type: ignore[dict-item]
    ),
    "table of Lumen.bends must have two rows at least": lambda: Lumen.bends([[0, 0, 0]], RADIUS),
    "that start at 0 m and increase; received [0.0, 0.2, 0.1] m": lambda: Lumen.bends(
        [[0, 0, 0], [0.2, 0, 0], [0.1, 0, 0]], RADIUS
    ),
}


@pytest.mark.parametrize("message", FAULTS)
def test_faults_are_found_at_construction(message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)):
        FAULTS[message]()


def test_bends_of_constant_curvature_are_a_circle_and_a_helix() -> None:
    circle = Lumen.bends([[0.0, 40.0, 0.0], [0.025 * np.pi, 40.0, 0.0]], RADIUS)
    points = around(circle, 300, 0.0, 1.2)
    wanted = Lumen.half_circle(0.025, RADIUS).gap(points)
    np.testing.assert_allclose(circle.gap(points), wanted, rtol=0, atol=1e-8)
    np.testing.assert_allclose(circle.centreline()[0][-1], [0.0, 0.05, 0.0], atol=1e-10)


def test_paths_belong_to_the_lumen() -> None:
    paths: Mapping[str, Branch] = TREES["shared"].paths
    with pytest.raises(TypeError):
        paths["left"] = paths["right"]  # type: ignore[index]
    assert replace(TREES["shared"], target="right").length == paths["right"].length


def test_the_work_of_a_tree_grows_with_its_branches(monkeypatch: pytest.MonkeyPatch) -> None:
    def comb(count: int) -> dict[str, Lumen]:
        """A straight tube, and others that leave it to both sides."""
        places = 6e-3 * np.arange(1, count + 1)
        tubes = {"trunk": Lumen.straight(float(places[-1]) + 6e-3, 2e-3)}
        for number, (x, side) in enumerate(zip(places, np.resize([1.0, -1.0], count), strict=True)):
            line = [[x, 0.0, 0.0], [x + 4e-3, side * 8e-3, 0.0], [x + 8e-3, side * 16e-3, 2e-3]]
            tubes[f"side-{number}"] = Lumen.through(line, 1e-3)
        return tubes

    looked_at = 0
    at = Curve.at

    def counted(curve: Curve, s: Array, derivative: int = 0) -> Array:
        nonlocal looked_at
        looked_at += len(s)
        return at(curve, s, derivative)

    monkeypatch.setattr(Curve, "at", counted)
    work = []
    for count in (10, 40):
        tubes = comb(count)
        looked_at = 0
        tree = Lumen.tree(tubes)
        work.append(looked_at)
    assert work[1] < 4.8 * work[0]
    assert tree.path("side-30").length == pytest.approx(31 * 6e-3 + 18e-3, rel=0.02)


def test_a_chain_of_tubes_has_paths_through_all_before_them() -> None:
    begin, tubes = np.zeros(3), {"0": Lumen.straight(0.04, 2e-3)}
    for number in range(1, 6):
        begin = begin + 0.02 * np.array([1.0, 0.0, 0.0] if number % 2 else [0.8, 0.6, 0.0])
        ahead = 0.04 * np.array([0.8, 0.6, 0.0] if number % 2 else [1.0, 0.0, 0.0])
        tubes[str(number)] = Lumen.through([begin, begin + ahead], 2e-3 * 0.9**number)
    tree = Lumen.tree(tubes)
    assert [tree.path(str(k)).length for k in (5, 2)] == pytest.approx([0.14, 0.08], rel=0.02)
    np.testing.assert_allclose(tree.path("5").entrance, 0.0, atol=1e-12)


@EACH
def test_towards_another_outlet_nothing_is_made_again(name: str) -> None:
    tree = TREES[name]
    for outlet in tree.outlets:
        other = tree.towards(outlet)
        assert other.target == outlet
        assert other.length == tree.paths[outlet].length
        assert other.path() is tree.path(outlet)
        assert other.arrays().cells is tree.arrays().cells
    assert replace(tree, target=tree.outlets[-1]).arrays().cells is not tree.arrays().cells
    with pytest.raises(InputError, match="must be one of the outlets"):
        tree.towards("nowhere")
