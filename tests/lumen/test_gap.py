"""The gap: against brute force and closed forms, and its Lipschitz constant (P-8, P-9)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from magwire.lumen import Branch, Lumen, grid

from .tubes import LUMENS, RADIUS, around, brute_force

MADE = {name: make() for name, make in LUMENS.items()}


def test_gap_is_that_of_brute_force(lumen: Lumen) -> None:
    points = around(lumen, 300, 0.0, 1.95)
    gap, arc = brute_force(lumen, points)
    inside = (arc > 0.0) & (arc < lumen.length)
    assert inside.mean() > 0.8
    np.testing.assert_allclose(lumen.gap(points)[inside], gap[inside], rtol=0, atol=1e-12)
    found, branch = lumen.locate(points)
    assert (branch == 0).all()
    clear = inside & (gap < 0.9 * lumen.narrowest)
    distinct = np.abs(found - arc) > 1e-5
    assert np.count_nonzero(clear & distinct) <= 2  # two turns equally near


def test_gap_next_to_a_straight_tube_is_the_closed_form(lumens: dict[str, Lumen]) -> None:
    points = np.array([[0.05, 0.0, 0.0], [0.01, 2e-3, 0.0], [0.02, -3e-3, 4e-3], [0.07, 0.0, 3e-3]])
    expected = RADIUS - np.hypot(points[:, 1], points[:, 2])
    np.testing.assert_allclose(lumens["straight"].gap(points), expected, rtol=0, atol=1e-15)


def test_gap_in_a_half_circle_is_the_closed_form(lumens: dict[str, Lumen]) -> None:
    points = around(lumens["half-circle"], 500, 0.0, 1.9, seed=1)
    across = np.hypot(points[:, 0], points[:, 1] - 0.025) - 0.025
    expected = RADIUS - np.hypot(across, points[:, 2])
    here = points[:, 0] > 0.0
    error = np.abs(lumens["half-circle"].gap(points) - expected)[here]
    assert error.max() < 1e-6 * RADIUS


def test_gap_in_a_helix_is_that_of_the_formula(lumens: dict[str, Lumen]) -> None:
    points = around(lumens["helix"], 60, 0.0, 1.9, seed=2)
    rise = 0.01 / (2.0 * np.pi)
    w = np.linspace(0.0, 0.09 / np.hypot(0.01, rise), 200_001)
    curve = np.column_stack([0.01 * np.sin(w), 0.01 * (1.0 - np.cos(w)), rise * w])
    expected = [RADIUS - np.linalg.norm(curve - point, axis=1).min() for point in points]
    np.testing.assert_allclose(lumens["helix"].gap(points), expected, rtol=0, atol=1e-6 * RADIUS)


@settings(max_examples=150, deadline=None)
@given(
    name=st.sampled_from(sorted(MADE)),
    seed=st.integers(0, 10_000),
    exponent=st.floats(-8.0, -2.0),
)
def test_gap_is_lipschitz(name: str, seed: int, exponent: float) -> None:
    lumen = MADE[name]
    rng = np.random.default_rng(seed)
    start = around(lumen, 8, 0.0, 1.9, seed)
    move = rng.normal(size=(8, 3))
    end = start + 10.0**exponent * move / np.linalg.norm(move, axis=1)[:, None]
    gaps = lumen.gap(start), lumen.gap(end)
    arc = lumen.locate(end)[0]
    tube = np.isfinite(gaps[0]) & np.isfinite(gaps[1]) & (arc >= 0.0) & (arc <= lumen.length)
    change = np.abs(gaps[1] - gaps[0])[tube]
    assert np.all(change <= np.linalg.norm(end - start, axis=1)[tube] * (1.0 + 1e-9) + 1e-15)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_gap_does_not_see_rigid_motions(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = Rotation.random(rng=rng).as_matrix()
    shift = rng.uniform(-0.1, 0.1, 3)
    branch = MADE["random"].branches[0]
    moved = Lumen((Branch(branch.points @ turn.T + shift, branch.radius),))
    points = around(MADE["random"], 20, 0.0, 1.9, seed)
    here, there = MADE["random"].gap(points), moved.gap(points @ turn.T + shift)
    exact = here > -0.9 * moved.narrowest  # farther outside it is a bound
    np.testing.assert_allclose(there[exact], here[exact], rtol=0, atol=1e-12)


def test_gap_does_not_see_the_direction_of_the_branch(lumens: dict[str, Lumen]) -> None:
    branch = lumens["tapered"].branches[0]
    reverse = Lumen.through(branch.points[::-1], branch.radius[::-1])
    points = around(lumens["tapered"], 100, 0.0, 1.9)
    expected = lumens["tapered"].gap(points)
    np.testing.assert_allclose(reverse.gap(points), expected, rtol=0, atol=1e-11)


def test_deep_outside_the_wall_is_never_free(lumen: Lumen) -> None:
    points = around(lumen, 400, 1.001, 1.999, seed=3)
    gap, arc = brute_force(lumen, points)
    tube = (arc > 0.0) & (arc < lumen.length) & (gap < 0.0)
    found, _ = lumen.locate(points)
    tube &= (found >= 0.0) & (found <= lumen.length)  # not in the flare of an end
    assert tube.sum() > 200
    assert np.all(lumen.gap(points)[tube] < 0.0)


def test_arrays_in_other_units_give_the_same_gap(lumens: dict[str, Lumen]) -> None:
    from magwire.kernels.wall.gap import gap_jet

    scale = 0.1
    for lumen in lumens.values():
        metres, lengths = lumen.arrays(), lumen.arrays(scale)
        for point in around(lumen, 20, 0.5, 1.5):
            g, s, branch, safe, n, h = gap_jet(metres, *point)
            g2, s2, branch2, safe2, n2, h2 = gap_jet(lengths, *(point / scale))
            assert branch == branch2
            assert scale * g2 == pytest.approx(g, abs=1e-13)
            assert scale * s2 == pytest.approx(s, abs=1e-12)
            assert scale * safe2 == pytest.approx(safe, abs=1e-13)
            np.testing.assert_allclose(n2, n, rtol=0, atol=1e-9)
            np.testing.assert_allclose(np.array(h2) / scale, h, rtol=1e-7, atol=1e-4)


def test_two_branches_make_their_union_with_a_rounded_carina() -> None:
    trunk = Branch(np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0]]), np.array(2e-3))
    w = np.linspace(0.0, 1.0, 40)
    bent = np.column_stack([0.02 + 0.03 * np.sin(w), 0.03 * (1.0 - np.cos(w)), 0.0 * w])
    child = Branch(bent, np.array(1.5e-3), open_begin=False)
    rng = np.random.default_rng(5)
    points = rng.uniform([0.01, -2e-3, -2e-3], [0.04, 8e-3, 2e-3], (2000, 3))
    apart = [Lumen((branch,)).gap(points) for branch in (trunk, child)]
    largest = np.maximum(*apart)
    near = np.isfinite(largest) & (largest > -1e-3)
    sharp = Lumen((trunk, child))
    np.testing.assert_allclose(sharp.gap(points)[near], largest[near], rtol=0, atol=1e-12)
    width = 5e-4
    rounded = Lumen((trunk, replace(child, blend=width))).gap(points)[near]
    assert np.all(rounded >= largest[near] - 1e-12)
    assert np.all(rounded <= largest[near] + width / 6.0 + 1e-12)
    assert np.any(rounded > largest[near] + 0.1 * width)


def wound(seed: int) -> Lumen:
    """A tube of straights and sharp bends in turning planes, whose radius rises and falls."""
    rng, step, bend = np.random.default_rng(seed), 2e-4, 1e-3 / 0.55
    points, tangent = [np.zeros(3)], np.array([1.0, 0.0, 0.0])
    for _ in range(6):
        for _ in range(int(rng.uniform(3e-3, 8e-3) / step)):
            points.append(points[-1] + step * tangent)
        axis = np.cross(tangent, rng.normal(size=3))
        turn = Rotation.from_rotvec(step / bend * axis / np.linalg.norm(axis))
        for _ in range(int(rng.uniform(0.8, 2.2) * bend / step)):
            tangent = turn.apply(tangent)
            points.append(points[-1] + step * tangent)
    arc = step * np.arange(len(points))
    return Lumen.through(np.array(points), 1e-3 * (1 - 0.3 * np.sin(2 * np.pi * arc / 5e-3) ** 2))


@pytest.mark.parametrize("seed", [1, 2, 5])
def test_gap_does_not_jump_between_coarse_voxels(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A point's deepest ball may be another than the one that is deepest at its voxel's centre."""
    monkeypatch.setattr(grid, "VOXELS", 10_000)
    lumen = wound(seed)
    arrays, rng, count = lumen.arrays(), np.random.default_rng(seed), 20_000
    centre = lumen.branches[0].curve.at(rng.uniform(0.0, lumen.length, count))
    away = rng.normal(size=(count, 3))
    away *= (centre[:, 3] * rng.uniform(0.0, 0.95, count) / np.linalg.norm(away, axis=1))[:, None]
    below, row, axis = centre[:, :3] + away, np.arange(count), rng.integers(0, 3, count)
    corner = np.array([arrays.x0, arrays.y0, arrays.z0])[axis]
    face = corner + np.round((below[row, axis] - corner) / arrays.cell) * arrays.cell
    above = below.copy()
    below[row, axis], above[row, axis] = face - 1e-10, face + 1e-10
    gaps = lumen.gap(below), lumen.gap(above)
    inside = np.isfinite(gaps[0]) & np.isfinite(gaps[1])
    assert inside.sum() > 0.95 * count
    assert np.abs(gaps[0][inside] - gaps[1][inside]).max() < 1e-9
