"""The direction of the tip, and a dead force on it, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import magwire as mw
from magwire.engine.system import System
from magwire.evidence.verify.wires import order
from magwire.field import UniformField
from magwire.lumen import Lumen
from magwire.operate import March
from wires import L, flux, free, magnet

SIZES = (21, 41, 81, 161)


def bent_magnet(turn: float, b: float) -> float:
    """Angle of the tip of a magnet with rest curvature turn/L in a field b across the clamp.

    theta'' = -b cos(theta) and theta'(1) = turn, so that
    theta'^2 = turn^2 + 2 b (sin theta(1) - sin theta).
    """

    def length(end: float) -> float:
        return quad(lambda a: 1.0 / np.sqrt(turn**2 + 2.0 * b * (np.sin(end) - np.sin(a))), 0, end)[
            0
        ]

    return float(brentq(lambda end: length(end) - 1.0, turn, 0.5 * np.pi))


def angle(direction: np.ndarray) -> float:
    return float(np.arctan2(direction[1], direction[0]))


def test_second_order_at_the_tip_of_a_bent_magnet() -> None:
    """The last edge's own direction is off by half an edge of rest curvature: first order."""
    turn, b = 1.1, 0.8
    exact = bent_magnet(turn, b)
    errors, last = [], []
    for nodes in SIZES:
        wire = magnet(nodes, rest_curvature=(0.0, -turn / L))
        state = free(wire).equilibrium(L, flux(wire, b, 90.0))
        errors.append(abs(angle(state.tip_direction) - exact))
        edge = state.positions[-1] - state.positions[-2]
        last.append(abs(angle(edge) - exact))
    edges = 1.0 / (np.array(SIZES) - 1)
    assert order(edges, last) == pytest.approx(1.0, abs=0.1)
    assert order(edges, errors) == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("turn", [(60.0, 0.0), (0.0, 60.0), (-30.0, 45.0)])
def test_tip_of_an_unloaded_hook_on_any_mesh(turn: tuple[float, float]) -> None:
    """60 1/m over 10 mm: 34.4 degrees, to round-off, be the last edge 1.7 degrees off or not."""
    stuff = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "radius": 0.4e-3, "density": 2000.0}
    shaft = mw.Section(0.09, **stuff)  # type: ignore[arg-type]
    hook = mw.Section(0.01, rest_curvature=turn, **stuff)  # type: ignore[arg-type]
    for nodes in (41, 101, 138):
        state = free(mw.Wire((shaft, hook), nodes)).equilibrium(L)
        bend = np.arccos(state.tip_direction[0])
        assert bend == pytest.approx(0.01 * np.hypot(*turn), abs=1e-7)
        across = np.array([-turn[1], turn[0]]) / np.hypot(*turn)  # m1 is z, m2 is -y
        np.testing.assert_allclose(state.tip_direction[1:] / np.sin(bend), across, atol=1e-6)


def test_tip_points_along_the_guide_until_it_is_let_go() -> None:
    sim = free(magnet(rest_curvature=(60.0, 0.0)))
    assert np.array_equal(sim.equilibrium(0.0).tip_direction, [1.0, 0.0, 0.0])


def test_a_march_tells_the_same_direction() -> None:
    """At rest in quasi-static motion the plant's tip points where the equilibrium's does."""
    wire = magnet(31, rest_curvature=(20.0, 10.0))
    system = System(wire, Lumen.open_space(), mw.Barrier())
    march = March(system, UniformField(), mw.Feed(0.1 * L, L), time_step=0.1, inertia=False)
    assert march.advance(march.steps)
    expected = mw.Simulation(wire, Lumen.open_space()).equilibrium(L).tip_direction
    np.testing.assert_allclose(march.plant.observe().tip_direction, expected, atol=1e-6)


def test_dead_force_on_the_tip() -> None:
    """Small deflection P L^3/(3 EI), and the force stays as it is when the wire has turned away."""
    wire = magnet(101, 0.0)
    unit = wire.bending_stiffness / L**2
    small = free(wire, tip_load=(0.0, 1e-3 * unit, 0.0)).equilibrium(L)
    assert small.tip[1] / L == pytest.approx(1e-3 / 3.0, rel=2e-4)
    large = free(wire, tip_load=(0.0, 400.0 * unit, 0.0)).equilibrium(L)
    np.testing.assert_allclose(large.tip_direction, [0.0, 1.0, 0.0], atol=1e-4)


def test_the_energy_of_a_dead_force_is_that_of_a_weight() -> None:
    """Castigliano: of the whole energy at rest, the derivative by the force is where it acts."""
    wire = magnet(41, 0.0)
    unit = wire.bending_stiffness / L**2
    sims = [free(wire, tip_load=(0.0, f * unit, 0.3 * unit)) for f in (0.999, 1.0, 1.001)]
    low, middle, high = (sim.equilibrium(L) for sim in sims)
    work = middle.point.system.new_work()
    energies = [state.point.energy(work)[0] for state in (low, high)]
    slope = (energies[1] - energies[0]) / 0.002
    assert slope == pytest.approx(-middle.tip[1] / L, rel=1e-6)
