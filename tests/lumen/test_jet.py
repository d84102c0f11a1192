"""Gradient and Hessian of the gap, against differences and across pieces (P-9)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.kernels.wall.gap import gap_jet, gap_value
from magwire.lumen import Branch, Lumen

from .tubes import RADIUS, around

Array = NDArray[np.float64]
UNIT = 1e-3  # millimetres: numbers of order one


def jets(lumen: Lumen, points: Array) -> tuple[Array, Array, Array]:
    """Gap, gradient and Hessian at points in metres; lengths in millimetres."""
    arrays = lumen.arrays(UNIT)
    gap, gradient, hessian = [], [], []
    for x, y, z in points / UNIT:
        g, _, _, _, n, (xx, xy, xz, yy, yz, zz) = gap_jet(arrays, x, y, z)
        gap.append(g)
        gradient.append(n)
        hessian.append([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return np.array(gap), np.array(gradient), np.array(hessian)


def smooth(lumen: Lumen, points: Array) -> Array:
    """Points at which the gap has a Hessian: away from ridges, where two balls compete."""
    _, _, hessian = jets(lumen, points)
    return points[np.abs(hessian).max(axis=(1, 2)) < 4.0]


def test_value_and_jet_agree_to_the_last_bit(lumen: Lumen) -> None:
    arrays = lumen.arrays()
    for point in around(lumen, 200, 0.0, 1.9):
        assert gap_value(arrays, *point) == gap_jet(arrays, *point)[:4]


def test_gradient_is_that_of_differences(lumen: Lumen) -> None:
    points = smooth(lumen, around(lumen, 200, 0.6, 1.2))
    assert len(points) > 100
    _, gradient, _ = jets(lumen, points)
    h = 1e-3 * UNIT
    for axis, step in enumerate(h * np.eye(3)):
        near = [lumen.gap(points + k * step) for k in (-2.0, -1.0, 1.0, 2.0)]
        difference = (near[0] - 8.0 * near[1] + 8.0 * near[2] - near[3]) / (12.0 * h)
        np.testing.assert_allclose(gradient[:, axis], difference, rtol=0, atol=1e-8)


def test_gradient_has_length_one(lumen: Lumen) -> None:
    _, gradient, _ = jets(lumen, around(lumen, 300, 0.3, 1.9))
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1), 1.0, rtol=0, atol=1e-12)


def test_hessian_is_that_of_differences(lumen: Lumen) -> None:
    points = smooth(lumen, around(lumen, 200, 0.6, 1.2))
    _, _, hessian = jets(lumen, points)
    h = 1e-3
    for axis, step in enumerate(h * UNIT * np.eye(3)):
        near = [jets(lumen, points + k * step)[1] for k in (-2.0, -1.0, 1.0, 2.0)]
        difference = (near[0] - 8.0 * near[1] + 8.0 * near[2] - near[3]) / (12.0 * h)
        error = np.abs(hessian[:, :, axis] - difference).max(axis=1)
        # Where the stencil crosses a knot the Hessian has a kink: c''' jumps.
        assert np.quantile(error, 0.85) < 1e-8
        assert error.max() < 1e-3


def test_there_are_no_facets(lumen: Lumen) -> None:
    """Along short segments the gradient turns no faster than the Hessian says (P-9)."""
    rng = np.random.default_rng(11)
    start = smooth(lumen, around(lumen, 300, 0.6, 1.2, seed=4))
    _, n, hessian = jets(lumen, start)
    bound = 1.2 * np.linalg.norm(hessian, ord=2, axis=(1, 2)) + 0.02
    for size in (1e-5, 1e-3, 1e-2):
        move = rng.normal(size=start.shape)
        move *= size / np.linalg.norm(move, axis=1)[:, None]
        turn = np.linalg.norm(jets(lumen, start + UNIT * move)[1] - n, axis=1)
        assert np.all(turn <= bound * size + 1e-11)


def test_hessian_has_no_jump_across_knots() -> None:
    """A crude helix of 60 points: C2 in the curve is C1 in the gradient."""
    lumen = Lumen.helix(0.01, 0.01, 0.09, RADIUS, points=60)
    curve = lumen.branches[0].curve
    knots = curve.knots()[5:-5]
    step = 1e-7 * curve.spacing
    sides = []
    for shift in (-step, step):
        centre, tangent = curve.at(knots + shift)[:, :3], curve.at(knots + shift, 1)[:, :3]
        across = np.cross(tangent, [0.0, 0.0, 1.0])
        points = centre + 0.9 * RADIUS * across / np.linalg.norm(across, axis=1)[:, None]
        sides.append(jets(lumen, points)[2])
    np.testing.assert_allclose(sides[0], sides[1], rtol=0, atol=1e-6)


def test_rounded_carina_is_smooth() -> None:
    w = np.linspace(0.0, 1.0, 40)
    bent = np.column_stack([0.02 + 0.03 * np.sin(w), 0.03 * (1.0 - np.cos(w)), 0.0 * w])
    lumen = Lumen(
        (
            Branch(np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0]]), np.array(2e-3)),
            Branch(bent, np.array(1.5e-3), open_begin=False, blend=5e-4),
        )
    )
    points = np.random.default_rng(5).uniform([0.03, -1e-3, -1e-3], [0.04, 4e-3, 1e-3], (300, 3))
    points = smooth(lumen, points)
    _, gradient, hessian = jets(lumen, points)
    assert np.all(np.linalg.norm(gradient, axis=1) <= 1.0 + 1e-12)
    h = 1e-4
    for axis, step in enumerate(h * UNIT * np.eye(3)):
        after, before = jets(lumen, points + step), jets(lumen, points - step)
        value, turn = (after[0] - before[0]) / (2.0 * h), (after[1] - before[1]) / (2.0 * h)
        np.testing.assert_allclose(gradient[:, axis], value, rtol=0, atol=1e-6)
        error = np.abs(hessian[:, :, axis] - turn)
        assert np.quantile(error, 0.95) < 1e-5
        assert error.max() < 5e-3


@pytest.mark.parametrize("away", [0.0, 1e-18, 1e-13, 1e-9])
def test_on_the_centreline_everything_is_finite(lumen: Lumen, away: float) -> None:
    s = np.linspace(0.0, lumen.length, 57)
    points = lumen.branches[0].curve.at(s)[:, :3] + away
    gap, gradient, hessian = jets(lumen, points)
    assert np.all(np.isfinite(gap))
    assert np.all(np.isfinite(gradient))
    assert np.all(np.isfinite(hessian))
    assert np.all(np.linalg.norm(gradient, axis=1) <= 1.0 + 1e-12)
