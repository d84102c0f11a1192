"""The references of friction against calculations of another kind."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from magwire.evidence.verify.references.sliding import (
    arc_growth,
    capstan,
    locked_up,
    slider,
    torque_arrived,
)


@pytest.mark.parametrize("friction", [0.05, 0.3, 0.6])
@pytest.mark.parametrize("turns", [0.25, 1.0, 2.0])
def test_a_limp_capstan_is_the_classical_one(friction: float, turns: float) -> None:
    angle = 2.0 * math.pi * turns
    force = capstan(2.0, angle, friction, radius=0.1, stiffness=1e-12)
    assert force == pytest.approx(2.0 * math.exp(friction * angle), rel=1e-4)


@pytest.mark.parametrize("friction", [0.05, 0.6])
@pytest.mark.parametrize("stiffness", [1e-3, 1e-2])
def test_a_stiff_capstan_by_integration(friction: float, stiffness: float) -> None:
    """The whole rod is integrated: free end, point force, arc, point force, free end."""
    pull, angle, radius = 1.0, 1.5 * math.pi, 0.1

    def free(force: float) -> tuple[float, float, float]:
        """Angle to the pull, tension and shear where a long free end has the drum's curvature."""
        rate = math.sqrt(force / stiffness)

        def bent(_: float, y: np.ndarray) -> list[float]:
            return [y[1], force / stiffness * math.sin(y[0])]

        start = 1e-9
        lifted = lambda _, y: y[1] - 1.0 / radius  # noqa: E731
        lifted.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(
            bent, (0.0, 60.0 / rate), [start, start * rate], events=lifted, rtol=1e-11, atol=1e-14
        )
        there = float(found.y[0, -1])
        assert found.y[1, -1] == pytest.approx(1.0 / radius, rel=1e-9)
        return there, force * math.cos(there), force * math.sin(there)

    force = capstan(pull, angle, friction, radius, stiffness)
    first, tension, shear = free(pull)
    last, arrived, other = free(force)
    begin = tension + friction * shear
    arc = solve_ivp(
        lambda _, y: friction * y, (0.0, angle - first - last), [begin], rtol=1e-11, atol=1e-12
    )
    assert arrived == pytest.approx(float(arc.y[0, -1]) + friction * other, rel=1e-6)


def test_a_rod_that_hardly_touches_is_refused() -> None:
    with pytest.raises(ValueError, match="at points only"):
        capstan(1.0, 0.1, 0.3, radius=0.1, stiffness=1e-2)


@pytest.mark.parametrize("friction", [0.05, 0.6])
@pytest.mark.parametrize("thickness", [0.02, 0.2])
def test_growth_of_a_thick_rod_by_integration(friction: float, thickness: float) -> None:
    def along(_: float, y: np.ndarray) -> list[float]:
        press = -y[1] / (friction * thickness)
        return [y[1] + friction * press, press - y[0]]

    found = solve_ivp(
        along, (0.0, 6.0), [1.0, 0.0], method="Radau", rtol=1e-10, atol=1e-12, t_eval=[5.0, 6.0]
    )
    growth = math.log(found.y[0, 1] / found.y[0, 0])
    assert arc_growth(friction, thickness) == pytest.approx(growth, rel=1e-6)


@pytest.mark.parametrize("friction", [0.05, 0.6])
def test_growth_of_a_thin_rod(friction: float) -> None:
    assert arc_growth(friction, 0.0) == friction
    for side in (1e-5, -1e-5):
        assert arc_growth(friction, side) == pytest.approx(friction, rel=1e-4)
    assert arc_growth(friction, -0.1) > friction > arc_growth(friction, 0.1)


def test_lock_up_by_integration() -> None:
    friction, clearance, ei, force = 0.3, 2e-3, 1e-5, 0.5
    x = np.linspace(0.0, 0.5, 6)
    rate = friction * clearance / (4.0 * ei)
    found = solve_ivp(
        lambda _, f: -rate * f**2, (0.0, 0.5), [force], t_eval=x, rtol=1e-10, atol=1e-13
    )
    expected = [locked_up(force, float(s), friction, clearance, ei) for s in x]
    np.testing.assert_allclose(found.y[0], expected, rtol=1e-8)
    assert locked_up(1e9, 0.5, friction, clearance, ei) == pytest.approx(1.0 / (rate * 0.5))


@pytest.mark.parametrize("friction", [0.1, 0.5])
def test_torque_by_the_balance_of_a_cross_section(friction: float) -> None:
    """A cross-section on the wall: what presses it, the wall's force and its friction balance."""
    pressed, radius = 3.0, 0.4e-3

    def unbalanced(y: np.ndarray) -> list[float]:
        normal, climbed = y
        return [
            normal * math.cos(climbed) + friction * normal * math.sin(climbed) - pressed,
            friction * normal * math.cos(climbed) - normal * math.sin(climbed),
        ]

    normal, climbed = fsolve(unbalanced, [pressed, 0.0], xtol=1e-12)
    assert math.tan(climbed) == pytest.approx(friction)
    left = torque_arrived(1.0, 1.0, friction, radius, pressed)
    assert left == pytest.approx(1.0 - friction * radius * normal, rel=1e-9)


def test_a_slider_takes_the_area_of_its_loop() -> None:
    course = np.concatenate(
        [np.linspace(0, 1, 50), np.linspace(1, -1, 99)[1:], np.linspace(-1, 1, 99)[1:]]
    )
    forces, taken = slider(course, stiffness=10.0, cone=2.0)
    assert max(abs(forces)) == pytest.approx(2.0, rel=1e-14)
    assert taken == pytest.approx(2.0 * (0.8 + 1.6 + 1.6), rel=1e-12)
