"""Gradient and Hessian of every energy against differences (P-5)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.kernels.arrays import Motion, Mouth
from magwire.lumen import Lumen
from wires import flux, free, magnet

from .rods import (
    ENERGIES,
    Array,
    Case,
    derivatives,
    difference_quotients,
    random_case,
    state_at,
    system,
)

STEP = 2e-4
GRADIENT = 1e-8
HESSIAN = 1e-8


def worst(computed: Array, expected: Array) -> float:
    """Largest difference, relative to the largest entry."""
    return float(np.abs(computed - expected).max() / np.abs(expected).max())


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("held", [1, 3])
@pytest.mark.parametrize("energy", [*ENERGIES, "all"])
def test_against_differences(energy: str, held: int, seed: int) -> None:
    chosen = ENERGIES if energy == "all" else (energy,)
    case = random_case(seed, *chosen, held=held)
    _, gradient, hessian = derivatives(case)
    slope, raw = difference_quotients(case, STEP)
    assert worst(gradient, slope) < GRADIENT
    assert worst(hessian, 0.5 * (raw + raw.T)) < HESSIAN


@pytest.mark.parametrize("energy", ["stretching", "uniform field", "field", "bodies"])
def test_energies_without_holonomy_have_a_symmetric_quotient(energy: str) -> None:
    case = random_case(4, energy)
    if "field" in energy:  # a moment across the axis turns with the frame, and has holonomy
        rod = case.model.rod
        rod.moment[:, :2] = 0.0  # type: ignore[attr-defined]
    _, _, hessian = derivatives(case)
    _, raw = difference_quotients(case, STEP)
    assert worst(raw, hessian) < HESSIAN


def test_bending_has_holonomy_away_from_equilibrium() -> None:
    _, raw = difference_quotients(random_case(5, "bending"), STEP)
    assert np.abs(raw - raw.T).max() > 0.01 * np.abs(raw).max()


def pressed(lumen: Lumen, seed: int) -> Case:
    """A wire whose nodes all lie within the barrier's reach of a curved wall."""
    rng = np.random.default_rng(seed)
    gap = 0.2 * 0.05
    where = system(lumen, gap=gap)
    rod = where.rod._replace(bend=np.full(len(where.rod.station), 1e-30))
    rod = rod._replace(stretch=0.0 * rod.stretch, twist=0.0 * rod.twist)
    curve = lumen.branches[0].curve
    s = np.linspace(0.1, 0.9, len(rod.station)) * lumen.length
    centre, tangent = curve.at(s)[:, :3], curve.at(s, 1)[:, :3]
    across = np.cross(tangent, rng.normal(size=(len(s), 3)))
    across /= np.linalg.norm(across, axis=1)[:, None]
    clearance = gap * rng.uniform(0.2, 0.8, len(s))
    q = np.zeros((len(s), 4))
    q[:, :3] = centre + (0.05 - clearance)[:, None] * across
    state = state_at(where, q, rng.normal(size=(len(s) - 1, 3)), 1)
    field = random_case(0).model.field
    wall = where.new_wall()
    wall = wall._replace(between=wall.between._replace(parts=1))  # nodes alone
    model = where.new_terms(field, rod=rod, wall=wall)
    return Case(where, model, state, Mouth(1, 1.0), Motion(0.0, np.zeros_like(q)))


LUMENS = {
    "straight": lambda: Lumen.straight(1.0, 0.05),
    "half-circle": lambda: Lumen.half_circle(0.3, 0.05),
    "helix": lambda: Lumen.helix(0.15, 0.2, 1.2, 0.05),
}


@pytest.mark.parametrize("name", LUMENS)
def test_barrier_against_differences(name: str) -> None:
    case = pressed(LUMENS[name](), 6)
    energy, gradient, hessian = derivatives(case)
    slope, raw = difference_quotients(case, 2e-6)
    assert energy > 0.0
    assert worst(gradient, slope) < GRADIENT
    assert worst(raw, hessian) < 1e-6


def test_holonomy_vanishes_at_equilibrium() -> None:
    wire = magnet(8, magnetization=(5e3, -8e3, 20e3), rest_curvature=(8.0, 5.0))
    state = free(wire).equilibrium(wire.length, flux(wire, 3.0, 70.0) + [0.0, 0.0, 2e-4])
    point = state.point
    where = point.system
    model = where.new_terms(point.field)
    still = Motion(0.0, np.zeros_like(point.state.q))
    _, raw = difference_quotients(Case(where, model, point.state, point.mouth, still), STEP)
    free_part = raw[7:, 7:]
    assert abs(state.positions[-1, 2]) > 0.05 * wire.length  # the wire bends out of the plane
    assert np.abs(free_part - free_part.T).max() < 1e-7 * np.abs(free_part).max()
