"""The shapes of the paper, their descriptions, and lumens that cannot be."""

from __future__ import annotations

import re

import numpy as np
import pytest

from magwire.errors import InputError
from magwire.kernels.wall.gap import work_many
from magwire.lumen import Branch, Lumen

from .tubes import RADIUS, around


def test_half_circle_is_the_papers() -> None:
    lumen = Lumen.half_circle(0.025, RADIUS)
    points, radius = lumen.centreline()
    w = np.linspace(0.0, np.pi, 200)
    expected = [0.025 * np.cos(w - np.pi / 2), 0.025 * np.sin(w - np.pi / 2) + 0.025, 0.0 * w]
    np.testing.assert_allclose(points, np.transpose(expected), rtol=0, atol=1e-17)
    assert np.all(radius == RADIUS)
    np.testing.assert_allclose(lumen.direction, [1.0, 0.0, 0.0], atol=1e-14)
    np.testing.assert_array_equal(lumen.entrance, np.zeros(3))
    assert lumen.length == pytest.approx(0.025 * np.pi, rel=1e-9)
    assert lumen.planar
    (bend,) = lumen.bend_radius()
    assert bend.radius == pytest.approx(0.025, rel=1e-3)


def test_sinusoid_is_the_papers() -> None:
    lumen = Lumen.sinusoid(0.015, 0.08, 0.08, RADIUS)
    points, _ = lumen.centreline()
    expected = 0.015 * (np.cos(np.pi * points[:, 0] / 0.04) - 1.0)
    np.testing.assert_allclose(points[:, 1], expected, rtol=0, atol=1e-16)
    assert points[-1, 0] == pytest.approx(0.08)
    np.testing.assert_allclose(lumen.direction, [1.0, 0.0, 0.0], atol=1e-14)
    sharpest = 1.0 / (0.015 * (np.pi / 0.04) ** 2)
    assert lumen.bend_radius()[0].radius == pytest.approx(sharpest, rel=1e-3)


def test_helix_is_the_papers() -> None:
    lumen = Lumen.helix(0.01, 0.01, 0.09, RADIUS)
    assert lumen.length == pytest.approx(0.09, rel=1e-7)
    rise = 0.01 / (2.0 * np.pi)
    direction = np.array([0.01, 0.0, rise]) / np.hypot(0.01, rise)
    np.testing.assert_allclose(lumen.direction, direction, atol=1e-14)
    assert not lumen.planar
    curvature = 0.01 / (0.01**2 + rise**2)
    assert lumen.bend_radius()[0].radius == pytest.approx(1.0 / curvature, rel=1e-3)


def test_straight_tube_and_its_offsets() -> None:
    lumen = Lumen.straight(0.1, RADIUS)
    assert lumen.length == pytest.approx(0.1)
    assert lumen.bend_radius()[0].radius == np.inf
    assert lumen.narrowest == RADIUS
    points = np.array([[0.05, 1e-3, 0.0], [-0.02, 0.0, 2e-3], [0.3, 0.0, 0.0], [0.05, 0.05, 0.0]])
    np.testing.assert_allclose(lumen.offset(points), [1e-3, 2e-3, 0.0, 0.05], atol=1e-9)


def test_entry_is_a_straight_tube_in_front() -> None:
    lumen = Lumen.half_circle(0.025, RADIUS).with_entry(0.015)
    np.testing.assert_allclose(lumen.entrance, [-0.015, 0.0, 0.0], atol=1e-16)
    np.testing.assert_allclose(lumen.direction, [1.0, 0.0, 0.0], atol=1e-14)
    assert lumen.length == pytest.approx(0.015 + 0.025 * np.pi, rel=1e-6)
    points = np.array([[-0.01, 2e-3, 0.0], [-0.001, 0.0, -2.5e-3]])
    np.testing.assert_allclose(lumen.gap(points), [1e-3, 0.5e-3], rtol=0, atol=1e-8)


def test_a_step_in_curvature_does_not_ring() -> None:
    """Straight entry into an arc: the spline leaves both by no more than kappa h^2 / 24."""
    lumen = Lumen.half_circle(0.025, RADIUS).with_entry(0.015)
    curve = lumen.branches[0].curve
    s = np.linspace(0.0, lumen.length, 20_000)
    points = curve.at(s)[:, :3]
    line = points[:, 0] < 0.0
    bound = (0.025 * np.pi / 199) ** 2 / 0.025 / 24.0
    lower = points[:, 1] < 0.025
    arc = np.abs(np.hypot(points[:, 0], points[:, 1] - 0.025) - 0.025)
    assert np.abs(points[line & lower, 1]).max() < bound
    assert arc[~line].max() < bound
    curvature, at = curve.sharpest_bends()
    assert curvature.max() < 1.2 / 0.025
    settled = np.abs(at - 0.015) > 3e-3
    exact = np.where(at < 0.015, 0.0, 1.0 / 0.025)
    assert np.abs(curvature - exact)[settled].max() < 0.01 / 0.025


@pytest.mark.parametrize("points", [200, 2000, 20_000])
def test_cost_does_not_depend_on_the_number_of_points(points: int) -> None:
    lumen = Lumen.helix(0.01, 0.01, 0.09, RADIUS, points=points)
    where = around(lumen, 2000, 0.8, 1.05)
    seeds, iterations = np.empty(2000, dtype=np.int64), np.empty(2000, dtype=np.int64)
    work_many(lumen.arrays(), where, seeds, iterations)
    assert seeds.mean() < 1.3
    assert seeds.max() <= 3
    assert iterations.mean() < 3.0
    assert len(lumen.arrays().coefficients) < 1000


FAULTS = {
    "radius of Branch must be positive; received -0.001 m": lambda: Lumen.through(
        [[0, 0, 0], [1, 0, 0]], -1e-3
    ),
    "radius of Branch must be positive; received 0 m at point 1": lambda: Lumen.through(
        [[0, 0, 0], [1, 0, 0]], [0.1, 0.0]
    ),
    "points of Lumen.through must be finite": lambda: Lumen.through(
        [[0, 0, 0], [np.nan, 0, 0]], 0.1
    ),
    "points of Branch must be at least two points; received 1": lambda: Lumen.through(
        [[0, 0, 0]], 0.1
    ),
    "points of Branch must be distinct; points 1 and 2 are both (1, 0, 0) m": lambda: Lumen.through(
        [[0, 0, 0], [1, 0, 0], [1, 0, 0]], 0.1
    ),
    "points of Lumen.through must have shape (n, 3); received shape (2, 2)": lambda: Lumen.through(
        [[0, 0], [1, 0]], 0.1
    ),
    "radius of Branch must have shape (2,); received shape (3,)": lambda: Lumen.through(
        [[0, 0, 0], [1, 0, 0]], [0.1, 0.1, 0.1]
    ),
    "in a lumen of radius 0.003 m at arc length": lambda: Lumen.half_circle(0.0025, RADIUS),
    "received a bend of radius 0.0024": lambda: Lumen.half_circle(0.0025, RADIUS),
    "must change by at most 0.95 m per metre": lambda: Lumen.through(
        [[0, 0, 0], [0.001, 0, 0]], [1e-3, 3e-3]
    ),
    "must stay positive between its points": lambda: Lumen.through(
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2.1, 0, 0]], [0.5, 0.02, 0.02, 0.5]
    ),
    "begin_tangent of Branch must not be zero": lambda: Branch(
        np.eye(3)[:2], np.array(0.1), begin_tangent=np.zeros(3)
    ),
    "centreline_radius of Lumen.half_circle must be positive": lambda: Lumen.half_circle(0, 0.1),
    "points of Lumen.helix must be at least 5": lambda: Lumen.helix(1, 1, 1, 0.1, points=2),
    "points of Lumen must have shape (n, 3)": lambda: Lumen.straight(1, 0.1).gap([0.0, 0.0, 0.0]),
    "branches of Lumen must be a sequence of Branch; received Branch": lambda: Lumen(
        Branch(np.eye(3)[:2], np.array(0.1))  # type: ignore[arg-type]
    ),
    "received one of str": lambda: Lumen(("tube",)),  # type: ignore[arg-type]
    "length of Lumen.with_entry must be zero or positive": lambda: Lumen.straight(
        1, 0.1
    ).with_entry(-1.0),
}


@pytest.mark.parametrize("message", FAULTS)
def test_faults_are_found_at_construction(message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)):
        FAULTS[message]()


def test_points_cannot_be_changed_afterwards() -> None:
    lumen = Lumen.straight(0.1, RADIUS)
    with pytest.raises(ValueError, match="read-only"):
        lumen.branches[0].points[0, 0] = 1.0
