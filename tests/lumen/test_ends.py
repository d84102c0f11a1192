"""Open ends, the free space past them, and open space (P-8)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.kernels.wall.gap import gap_jet, gap_value
from magwire.lumen import Branch, Lumen

from .tubes import RADIUS, around

LIPSCHITZ = np.sqrt(10.0)


def outlet(lumen: Lumen) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Point, outward tangent and a normal of the far end."""
    curve = lumen.branches[0].curve
    end = np.array([lumen.length])
    tangent = curve.at(end, 1)[0, :3]
    tangent = tangent / np.linalg.norm(tangent)
    normal = np.cross(tangent, [0.3, 0.5, -0.8])
    return curve.at(end)[0, :3], tangent, normal / np.linalg.norm(normal)


def rim(lumen: Lumen) -> tuple[float, float]:
    """Radius of the far end, and its slope dR/dS."""
    curve = lumen.branches[0].curve
    end = np.array([lumen.length])
    return float(curve.at(end)[0, 3]), float(curve.at(end, 1)[0, 3])


@pytest.mark.parametrize("past", [0.1, 0.5, 0.99])
@pytest.mark.parametrize("lateral", [0.0, 0.8, 1.1, 1.9, 2.5])
def test_wall_flares_out_past_the_plane(lumen: Lumen, past: float, lateral: float) -> None:
    point, tangent, normal = outlet(lumen)
    radius, slope = rim(lumen)
    cosine = np.sqrt(1.0 - slope**2)
    axial = past * radius - slope / cosine * lateral * radius
    x = point + axial * tangent + lateral * radius * normal
    expected = radius + slope * axial - cosine * lateral * radius + radius * past**3
    g, s, _, safe = gap_value(lumen.arrays(), *x)
    assert g == pytest.approx(expected, abs=1e-9)
    assert s == pytest.approx(lumen.length + past * radius, abs=1e-9)
    if g > 0.0:
        assert 0.0 < safe <= max(g, radius)


@pytest.mark.parametrize("past", [1.01, 2.0, 10.0, 1000.0])
@pytest.mark.parametrize("lateral", [0.0, 1.0, 1.9])
def test_past_the_flare_there_is_no_wall(lumen: Lumen, past: float, lateral: float) -> None:
    point, tangent, normal = outlet(lumen)
    radius, slope = rim(lumen)
    axial = past - slope / np.sqrt(1.0 - slope**2) * lateral
    x = point + radius * (axial * tangent + lateral * normal)
    g, _, _, safe, n, h = gap_jet(lumen.arrays(), *x)
    assert g == np.inf
    assert safe > 0.0
    assert n == (0.0, 0.0, 0.0)
    assert h == (0.0,) * 6


def test_entrance_is_as_open_as_the_outlet(lumen: Lumen) -> None:
    back = lumen.entrance - np.array([[0.5], [2.0], [30.0]]) * RADIUS * lumen.direction
    gap = lumen.gap(back)
    assert 0.0 < gap[0] < np.inf
    assert np.all(gap[1:] == np.inf)
    arc, _ = lumen.locate(back[:1])
    assert arc[0] == pytest.approx(-0.5 * RADIUS, rel=1e-6)


def test_gap_and_its_derivatives_go_smoothly_through_the_plane(lumen: Lumen) -> None:
    """No jump in value and gradient; at the plane itself the curvature of the tube ends."""
    point, tangent, normal = outlet(lumen)
    arrays = lumen.arrays(1e-3)
    for lateral in (0.5, 0.9, 1.2):
        line = [
            (point + lateral * RADIUS * normal + z * RADIUS * tangent) / 1e-3
            for z in np.linspace(-0.1, 0.4, 501)
        ]
        jets = [gap_jet(arrays, *x) for x in line]
        step = np.linalg.norm(line[1] - line[0])
        gap, n = np.array([j[0] for j in jets]), np.array([j[4] for j in jets])
        assert np.abs(np.diff(gap)).max() < 1.5 * step
        assert np.linalg.norm(np.diff(n, axis=0), axis=1).max() < 3.0 * step
        along = n @ tangent
        np.testing.assert_allclose(
            np.diff(gap), 0.5 * (along[1:] + along[:-1]) * step, rtol=0, atol=step**2
        )


def test_hessian_in_the_flare_is_that_of_differences(lumen: Lumen) -> None:
    point, tangent, normal = outlet(lumen)
    radius, slope = rim(lumen)
    arrays = lumen.arrays(1e-3)
    h = 1e-4
    for past, lateral in ((0.3, 0.9), (0.6, 1.1), (0.95, 1.7)):
        axial = past - slope / np.sqrt(1.0 - slope**2) * lateral
        x = (point + radius * (axial * tangent + lateral * normal)) / 1e-3
        _, _, _, _, n, (xx, xy, xz, yy, yz, zz) = gap_jet(arrays, *x)
        hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        for axis, step in enumerate(h * np.eye(3)):
            after, before = gap_jet(arrays, *(x + step)), gap_jet(arrays, *(x - step))
            assert n[axis] == pytest.approx((after[0] - before[0]) / (2.0 * h), abs=1e-7)
            turn = (np.array(after[4]) - np.array(before[4])) / (2.0 * h)
            np.testing.assert_allclose(hessian[:, axis], turn, rtol=0, atol=1e-6)


def test_moves_within_the_safe_distance_do_not_cross_the_wall(lumen: Lumen) -> None:
    """From anywhere around either end, also from the flare and from past it."""
    rng = np.random.default_rng(3)
    arrays = lumen.arrays()
    point, tangent, _ = outlet(lumen)
    ends = ((point, tangent), (lumen.entrance, -lumen.direction))
    tried = 0
    for _ in range(1500):
        centre, axis = ends[rng.integers(2)]
        x = centre + RADIUS * (rng.uniform(-1.0, 3.0) * axis + rng.uniform(-1.5, 1.5, 3))
        g, _, _, safe = gap_value(arrays, *x)
        if g <= 0.0:
            continue
        assert safe > 0.0
        move = rng.normal(size=3)
        move *= 0.999999 * min(safe, 5.0 * RADIUS) / np.linalg.norm(move)
        stops = [gap_value(arrays, *(x + t * move)) for t in np.linspace(0.0, 1.0, 12)]
        path, arc = np.array([stop[0] for stop in stops]), np.array([stop[1] for stop in stops])
        if np.isfinite(g):
            assert np.all(path > 0.0)
        tube = (path > 0.0) & (arc > 0.0) & (arc < lumen.length)
        assert not np.any(np.maximum.accumulate(path <= 0.0) & tube)
        tried += 1
    assert tried > 500


def test_turns_of_a_helix_that_its_end_plane_cuts_keep_their_wall(
    lumens: dict[str, Lumen],
) -> None:
    helix = lumens["helix"]
    point, tangent, _ = outlet(helix)
    points = around(helix, 4000, 0.9, 1.5)
    beyond = (points - point) @ tangent > RADIUS
    elsewhere = np.linalg.norm(points - point, axis=1) > 4.0 * RADIUS
    behind = (points - helix.entrance) @ helix.direction < -RADIUS
    cut = (beyond | behind) & elsewhere
    assert cut.sum() > 500
    assert np.all(np.isfinite(helix.gap(points)[cut]))


def test_a_closed_end_is_a_cap() -> None:
    points = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0]])
    lumen = Lumen((Branch(points, np.array(RADIUS), open_end=False),))
    x = np.array([[0.051, 0.001, 0.0], [0.053, 0.002, 0.0]])
    expected = RADIUS - np.linalg.norm(x - points[1], axis=1)
    np.testing.assert_allclose(lumen.gap(x), expected, rtol=0, atol=1e-15)
    _, _, _, safe, n, h = gap_jet(lumen.arrays(), *x[0])
    assert safe == pytest.approx(expected[0])
    away = (x[0] - points[1]) / np.linalg.norm(x[0] - points[1])
    np.testing.assert_allclose(n, -away, atol=1e-12)
    assert h[0] + h[3] + h[5] == pytest.approx(-2.0 / np.linalg.norm(x[0] - points[1]))


def test_open_space_has_no_wall() -> None:
    space = Lumen.open_space()
    points = np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 1e6]])
    assert np.all(space.gap(points) == np.inf)
    assert np.all(np.isnan(space.offset(points)))
    g, s, branch, safe, n, h = gap_jet(space.arrays(0.1), 0.1, 0.2, 0.3)
    assert (g, branch, safe) == (np.inf, -1, np.inf)
    assert np.isnan(s)
    assert n + h == (0.0,) * 9
    assert space.length == np.inf
    assert space.narrowest == np.inf
    assert space.with_entry(0.01) is space
    np.testing.assert_array_equal(space.direction, [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(space.entrance, np.zeros(3))
