"""Small deflections under gravity, buoyancy and the pull of a field gradient, by beam theory."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.field import GradientField
from magwire.wire import Wire
from wires import L, free, magnet, paper_wire

GENTLE = 0.01  # m/s^2: a deflection of 1e-3 L


def test_sag_under_gravity() -> None:
    """q L^4/(8 EI)."""
    wire = paper_wire()
    q = wire.body.density * wire.body.area * GENTLE
    expected = q * L**4 / (8.0 * wire.bending_stiffness)
    state = free(wire, gravity=(0.0, 0.0, -GENTLE)).equilibrium(L)
    assert expected < 0.02 * L
    assert state.tip[2] == pytest.approx(-expected, rel=1e-3)
    assert abs(state.tip[1]) < 1e-9 * L


@pytest.mark.parametrize("feed", [0.03, 0.0505, 0.08])
def test_sag_of_what_is_past_the_entrance(feed: float) -> None:
    wire = paper_wire()
    pull = GENTLE * (L / feed) ** 3
    q = wire.body.density * wire.body.area * pull
    state = free(wire, gravity=(0.0, -pull, 0.0)).equilibrium(feed)
    expected = q * feed**4 / (8.0 * wire.bending_stiffness)
    assert state.tip[1] == pytest.approx(-expected, rel=5e-3)


@pytest.mark.parametrize("fluid", [500.0, 2000.0, 3000.0])
def test_buoyancy(fluid: float) -> None:
    """Weight times 1 - rho_fluid/rho: less, none, upwards."""
    wire = paper_wire()
    dry = free(wire, gravity=(0.0, -GENTLE, 0.0)).equilibrium(L).tip[1]
    wet = free(wire, gravity=(0.0, -GENTLE, 0.0), fluid_density=fluid).equilibrium(L).tip[1]
    assert wet == pytest.approx(dry * (1.0 - fluid / 2000.0), rel=1e-4, abs=1e-12)


def test_a_bore_displaces_no_fluid_and_weighs_nothing() -> None:
    tube = Wire.uniform(L, 0.6e-3, 3e6, 1e6, 2000.0, 100, inner_radius=0.4e-3)
    q = (2000.0 - 500.0) * np.pi * (0.6e-3**2 - 0.4e-3**2) * GENTLE
    stiffness = 3e6 * np.pi * (0.6e-3**4 - 0.4e-3**4) / 4.0
    state = free(tube, gravity=(0.0, -GENTLE, 0.0), fluid_density=500.0).equilibrium(L)
    assert state.tip[1] == pytest.approx(-q * L**4 / (8.0 * stiffness), rel=1e-3)


def test_hanging_wire_stretches_and_stays_straight() -> None:
    """Straight along gravity: longer by q L^2/(2 EA)."""
    wire = paper_wire()
    state = free(wire, gravity=(9.81, 0.0, 0.0)).equilibrium(L)
    q = wire.body.density * wire.body.area * 9.81
    longer = q * L**2 / (2.0 * wire.body.stretching_stiffness)
    assert state.tip[0] - L == pytest.approx(longer, rel=0.01)
    assert state.stable


def test_gradient_pulls_a_magnetised_tip() -> None:
    """M lm dBx/dy across the wire where B = 0: P a^2 (3 L - a)/(6 EI) at the middle of the tip."""
    part = 0.05
    wire = magnet(101, part)
    along = L * (1.0 - 0.5 * part)
    moment = wire.moment_per_length * part * L
    slope = 1e-3 * wire.bending_stiffness / (L**2 * moment)
    field = GradientField(
        (0.0, 0.0, 0.0), ((0.0, slope, 0.0), (slope, 0.0, 0.0), (0.0, 0.0, 0.0)), (along, 0.0, 0.0)
    )
    state = free(wire).equilibrium(L, field)
    pull = moment * slope
    expected = pull * along**2 * (3.0 * L - along) / (6.0 * wire.bending_stiffness)
    assert state.tip[1] == pytest.approx(expected, rel=2e-3)


def test_gradient_along_the_wire_stretches_it() -> None:
    """A pure pull: M lm dBx/dx, carried by EA in front of the magnet."""
    wire = magnet(101, 0.05)
    moment = wire.moment_per_length * 0.05 * L
    slope = wire.bending_stiffness / (L**2 * moment)
    field = GradientField(
        (1e-6, 0.0, 0.0), ((slope, 0.0, 0.0), (0.0, -0.5 * slope, 0.0), (0.0, 0.0, -0.5 * slope))
    )
    state = free(wire).equilibrium(L, field)
    longer = moment * slope * 0.975 * L / wire.body.stretching_stiffness
    assert state.tip[0] - L == pytest.approx(longer, rel=1e-3)


def test_rest_curvature_bends_an_unloaded_wire_into_an_arc() -> None:
    for curvature in (5.0, 20.0):
        wire = magnet(101, 0.0, rest_curvature=(curvature, 0.0))
        state = free(wire).equilibrium(L)
        radius = 1.0 / curvature
        angle = L * curvature
        height = np.linalg.norm(state.tip[1:])
        assert state.tip[0] == pytest.approx(radius * np.sin(angle), rel=1e-3)
        assert height == pytest.approx(radius * (1.0 - np.cos(angle)), rel=1e-3)
        turned = np.arctan2(np.linalg.norm(state.tip_direction[1:]), state.tip_direction[0])
        assert turned == pytest.approx(angle, abs=1e-9)
        assert state.stable
