"""A cantilever under a force at its tip: a magnet where the field is zero and its gradient is not.

On a short magnet along t the gradient G pulls with m G t. At the tip of the exact solution that
is made the transverse force of the table, so that the exact solution is in equilibrium.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.references.pendulum import under_force
from magwire.evidence.verify.wires import order
from magwire.field import GradientField
from magwire.wire import Section, Wire
from tables import closed_form
from wires import L, free

NODES = np.array([26, 51, 101, 201])
ROWS = closed_form("cantilever_tip_force_bisshopp_drucker")


def loaded(
    load: float, angle: float, tip: tuple[float, float], nodes: int, radius: float = 0.1e-3
) -> Equilibrium:
    """Equilibrium under P L^2/EI at arc length L, the middle of the last edge."""
    edge = L / (nodes - 1.5)
    stuff = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "radius": radius, "density": 2000.0}
    magnet = Section(edge, magnetization=(0.0, 0.0, 128e3), **stuff)
    wire = Wire((Section((nodes - 2) * edge, **stuff), magnet), nodes)
    pull = load * wire.bending_stiffness / (L**2 * edge * wire.moment_per_length)
    a, b = -pull * np.sin(angle), pull * np.cos(angle)
    field = GradientField(
        (0.0, 0.0, 0.0), ((a, b, 0.0), (b, -a, 0.0), (0.0, 0.0, 0.0)), (tip[0] * L, tip[1] * L, 0.0)
    )
    sim = free(wire)
    torque = angle * wire.bending_stiffness / (L * edge * wire.moment_per_length)
    across = angle + 0.5 * np.pi
    bent = sim.equilibrium(wire.length, torque * np.array([np.cos(across), np.sin(across), 0.0]))
    return sim.equilibrium(wire.length, field, start=bent)


def magnet_of(state: Equilibrium) -> NDArray[np.float64]:
    """Where the force acts, over L."""
    return np.asarray(0.5 * (state.positions[-1] + state.positions[-2]) / L)


@pytest.mark.parametrize("row", ROWS, ids=[f"P={row[0]:g}" for row in ROWS])
def test_bisshopp_drucker(row: tuple[float, ...]) -> None:
    load, angle, _, deflection, shortening = row
    state = loaded(load, angle, (1.0 - shortening, deflection), 101)
    assert np.arctan2(*state.tip_direction[1::-1]) == pytest.approx(angle, abs=1e-4)
    expected = [1.0 - shortening, deflection, 0.0]
    np.testing.assert_allclose(magnet_of(state), expected, atol=1e-4)
    assert state.stable


@pytest.mark.parametrize("row", ROWS[4::4], ids=[f"P={row[0]:g}" for row in ROWS[4::4]])
def test_second_order_in_space(row: tuple[float, ...]) -> None:
    load, angle, _, deflection, shortening = row
    tip = (1.0 - shortening, deflection)
    found = [magnet_of(loaded(load, angle, tip, nodes)) for nodes in NODES]
    errors = [np.hypot(*(middle[:2] - tip)) for middle in found]
    assert order(1.0 / (NODES - 1.5), errors) == pytest.approx(2.0, abs=0.2)


def exact(load: float) -> tuple[float, float, float]:
    """Tip angle, deflection and abscissa of theta'' = -P cos(theta), over L."""
    bent = under_force(load, 0.5 * np.pi)
    return bent.angle, bent.y, bent.x


def test_clamp_at_the_entrance_not_in_the_middle_of_an_edge() -> None:
    """(P-15): 50 uN bend the paper's wire by 43.60 mm; with its first edge held, by 43.09 mm."""
    stiffness = 3e6 * np.pi * 0.6e-3**4 / 4.0
    load = 50e-6 * L**2 / stiffness
    angle, deflection, along = exact(load)
    assert deflection * L == pytest.approx(43.60e-3, abs=0.01e-3)
    shorter = 1.0 - 0.5 / 99.0
    assert exact(load * shorter**2)[1] * shorter * L == pytest.approx(43.09e-3, abs=0.01e-3)
    state = loaded(load, angle, (along, deflection), 100, radius=0.6e-3)
    assert magnet_of(state)[1] * L == pytest.approx(43.60e-3, abs=0.01e-3)
