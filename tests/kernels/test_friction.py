"""Friction at one contact against differences, invariances and a spring and slider (P-29, P-30)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.evidence.verify.references.sliding import slider
from magwire.kernels.wall.friction import (
    along_wall,
    by_turning,
    lost,
    potential,
    returned,
    spread,
    transported,
    under_load,
)

Array = NDArray[np.float64]
RNG = np.random.default_rng(17)
N = np.array([0.36, 0.48, 0.8])
T = np.cross(N, [1.0, 0.0, 0.0]) / np.linalg.norm(np.cross(N, [1.0, 0.0, 0.0]))
K = 40.0
STICK, SLIP = 1.0, 0.2
"""Cones that hold and that do not, for the displacements below."""


def vector(v: Array) -> tuple[float, float, float]:
    return float(v[0]), float(v[1]), float(v[2])


def square(a: tuple[float, ...]) -> Array:
    return np.array([[a[0], a[1], a[2]], [a[1], a[3], a[4]], [a[2], a[4], a[5]]])


def on_wall(v: Array) -> tuple[float, float, float]:
    return along_wall(vector(N), vector(v))


ANCHOR = on_wall(np.array([5e-3, -2e-3, 4e-3]))
RADIUS = 0.3
TURNING = by_turning(vector(N), vector(T), RADIUS)


def reach(u: Array) -> tuple[float, float, float]:
    """From position and angle."""
    moved = np.array(on_wall(u[:3])) + u[3] * np.array(TURNING)
    return vector(np.array(ANCHOR) + moved)


def energy(u: Array, cone: float) -> float:
    return float(potential(reach(u), vector(N), cone, K)[0])


def gradient(u: Array, cone: float) -> Array:
    _, by_x, block = potential(reach(u), vector(N), cone, K)
    return np.array([*by_x, spread(by_x, block, TURNING)[0]])


def hessian(u: Array, cone: float) -> Array:
    _, by_x, block = potential(reach(u), vector(N), cone, K)
    _, mixed, twice = spread(by_x, block, TURNING)
    whole = np.empty((4, 4))
    whole[:3, :3], whole[:3, 3], whole[3, :3], whole[3, 3] = square(block), mixed, mixed, twice
    return whole


def differences(function: Callable[[Array], Array], u: Array, step: float = 1e-6) -> Array:
    rows = []
    for e in np.eye(4) * step:
        near, far = function(u + e) - function(u - e), function(u + 2 * e) - function(u - 2 * e)
        rows.append((8.0 * near - far) / (12.0 * step))
    return np.array(rows)


DISPLACED = [np.array([8e-3, 3e-3, -6e-3, 0.01]), np.array([0.0, 0.0, 0.0, 0.03])]


@pytest.mark.parametrize("cone", [STICK, SLIP])
@pytest.mark.parametrize("u", DISPLACED)
def test_derivatives(u: Array, cone: float) -> None:
    assert (K * np.linalg.norm(reach(u)) <= cone) == (cone == STICK)
    slopes = differences(lambda x: np.array([energy(x, cone)]), u)[:, 0]
    np.testing.assert_allclose(gradient(u, cone), slopes, rtol=1e-7, atol=1e-9)
    curves = differences(lambda x: gradient(x, cone), u)
    np.testing.assert_allclose(hessian(u, cone), curves, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("cone", [STICK, SLIP])
@pytest.mark.parametrize("u", DISPLACED)
def test_the_hessian_has_no_negative_eigenvalue(u: Array, cone: float) -> None:
    whole = hessian(u, cone)
    np.testing.assert_array_equal(whole, whole.T)
    assert np.linalg.eigvalsh(whole)[0] > -1e-12 * K


def test_energy_and_gradient_are_continuous_at_the_cone() -> None:
    there = np.array(on_wall(np.array([1.0, 0.3, -0.2])))
    there *= SLIP / (K * np.linalg.norm(there))
    inside, outside = (
        potential(vector(f * there), vector(N), SLIP, K) for f in (1 - 1e-9, 1 + 1e-9)
    )
    assert inside[0] == pytest.approx(outside[0], rel=1e-8)
    np.testing.assert_allclose(inside[1], outside[1], rtol=1e-8)


@pytest.mark.parametrize("cone", [0.0, SLIP, STICK])
def test_the_traction_is_in_the_cone_and_in_the_wall(cone: float) -> None:
    for _ in range(50):
        z = on_wall(RNG.normal(size=3) * 0.02)
        pull = np.array(potential(z, vector(N), cone, K)[1])
        kept = np.array(returned(z, cone, K))
        assert np.linalg.norm(pull) <= cone * (1 + 1e-14)
        assert abs(pull @ N) <= 1e-14
        np.testing.assert_allclose(pull, K * kept, rtol=1e-12, atol=1e-15)


def test_friction_takes_and_never_gives() -> None:
    """Stored and lost add up to no more than what a step of constant traction would cost."""
    slip = np.zeros(3)
    for _ in range(300):
        cone = RNG.uniform(0.0, 1.0)
        move = np.array(on_wall(RNG.normal(size=3) * 0.02))
        z = slip + move
        taken = lost(vector(z), cone, K)
        new = np.array(returned(vector(z), cone, K))
        assert taken >= 0.0
        before, after = 0.5 * K * slip @ slip, 0.5 * K * new @ new
        assert after - before + taken <= K * new @ move + 1e-15
        slip = new


def test_the_slip_is_turned_with_the_normal() -> None:
    for _ in range(20):
        old, new = (v / np.linalg.norm(v) for v in RNG.normal(size=(2, 3)))
        slip = np.array(along_wall(vector(old), vector(RNG.normal(size=3))))
        moved = np.array(transported(vector(slip), vector(old), vector(new)))
        assert np.linalg.norm(moved) == pytest.approx(np.linalg.norm(slip), rel=1e-12)
        assert abs(moved @ new) < 1e-12
        axis = np.cross(old, new)  # what lies along the axis of the rotation stays
        assert moved @ axis == pytest.approx(slip @ axis, abs=1e-12)
        back = transported(vector(moved), vector(new), vector(old))
        np.testing.assert_allclose(back, slip, atol=1e-9)
    assert transported(ANCHOR, vector(N), vector(-N)) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(("before", "now"), [(2.0, 5.0), (5.0, 2.0)])
def test_a_change_of_load_stores_nothing(before: float, now: float) -> None:
    slip = np.array(ANCHOR)
    changed = np.array(under_load(ANCHOR, before, now))
    assert now * changed @ changed <= before * slip @ slip
    assert now * np.linalg.norm(changed) <= before * np.linalg.norm(slip) * (1 + 1e-14)


def test_turning_moves_the_surface_and_rolling_does_not() -> None:
    """A wire that rolls moves by the radius times its angle without slip."""
    assert np.linalg.norm(TURNING) == pytest.approx(RADIUS, rel=1e-14)
    angle = 1e-3
    rolled = np.concatenate([-angle * np.array(TURNING), [angle]])
    np.testing.assert_allclose(reach(rolled), ANCHOR, atol=1e-17)


@pytest.mark.parametrize("steps", [40, 400])
def test_hysteresis_of_a_spring_and_a_slider(steps: int) -> None:
    """Back and forth: force and loss are the closed form's, however fine the steps."""
    direction = np.array(on_wall(np.array([1.0, 0.0, 0.0])))
    direction /= np.linalg.norm(direction)
    course = np.concatenate(
        [
            np.linspace(0, 0.05, steps),
            np.linspace(0.05, -0.05, steps)[1:],
            np.linspace(-0.05, 0.05, steps)[1:],
        ]
    )
    forces, taken = slider(course, K, SLIP)
    slip, total = np.zeros(3), 0.0
    for k in range(1, len(course)):
        z = slip + (course[k] - course[k - 1]) * direction
        total += lost(vector(z), SLIP, K)
        slip = np.array(returned(vector(z), SLIP, K))
        assert K * slip @ direction == pytest.approx(forces[k], abs=1e-13)
    assert total == pytest.approx(taken, rel=1e-12)
