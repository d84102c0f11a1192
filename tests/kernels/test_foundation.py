"""A wall that gives way: its response against differences, and the whole energy's derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kernels.rods import Case, derivatives, difference_quotients, random_case, state_at, system
from magwire.contact import Barrier
from magwire.kernels.arrays import Mouth
from magwire.kernels.wall.barrier import barrier
from magwire.kernels.wall.foundation import on_foundation, pressed_in
from magwire.lumen import Lumen

GAP = 0.02
DEEP = [0.9 * GAP, 0.3 * GAP, 0.0, -GAP, -30.0 * GAP]


@pytest.mark.parametrize("ratio", [1e-8, 0.3, 1.0, 50.0, 1e8])
@pytest.mark.parametrize("d", [GAP * (1.0 - 1e-9), *DEEP, -1e5 * GAP])
def test_barrier_and_foundation_carry_the_same_force(ratio: float, d: float) -> None:
    y, _, first, _ = on_foundation(d, GAP, ratio)
    assert 0.0 < y < GAP
    assert first == barrier(y, GAP)[1]
    indentation = -ratio * first
    assert y == pytest.approx(d + indentation, rel=1e-9, abs=1e-11 * (GAP + abs(d)))
    assert pressed_in((ratio, 1.0), d, GAP) == indentation


@pytest.mark.parametrize("ratio", [1e-3, 1.0, 300.0])
@pytest.mark.parametrize("d", DEEP)
def test_derivatives_are_those_of_the_energy(ratio: float, d: float) -> None:
    step = 1e-4 * GAP
    ahead, behind = on_foundation(d + step, GAP, ratio), on_foundation(d - step, GAP, ratio)
    _, _, first, second = on_foundation(d, GAP, ratio)
    assert (ahead[1] - behind[1]) / (2.0 * step) == pytest.approx(first, rel=1e-4)
    assert (ahead[2] - behind[2]) / (2.0 * step) == pytest.approx(second, rel=1e-4)


def test_a_hard_foundation_is_the_barrier() -> None:
    d = 0.3 * GAP
    assert on_foundation(d, GAP, 1e-12)[1:] == pytest.approx(barrier(d, GAP), rel=1e-8)


def pressed(foundation: float, seed: int) -> Case:
    """A wire of crumpled edges that lies partly in the wall of a bend."""
    bend = Lumen.half_circle(centreline_radius=0.6, radius=0.3)
    where = replace(
        system(bend, gap=GAP), contact=Barrier(1e3, GAP, wall="centreline", foundation=foundation)
    )
    rng = np.random.default_rng(seed)
    arc = where.rod.station[:, None] * where.wire.length - 0.1
    centre = bend.branches[0].curve.at(np.clip(arc[:, 0], 0.0, None))[:, :3]
    away = rng.normal(size=centre.shape)
    away *= rng.uniform(0.27, 0.35, len(centre))[:, None] / np.linalg.norm(away, axis=1)[:, None]
    q = np.column_stack((centre + away, np.zeros(len(centre))))
    state = state_at(where, q, rng.normal(size=(len(q) - 1, 3)), 1)
    state.held[0] = 1
    base = random_case(seed)
    rod = where.rod._replace(stretch=0.0 * where.rod.stretch + 1e-12, mass=0.0 * where.rod.mass)
    rod = rod._replace(bend=1e-30 + 0.0 * rod.bend, twist=0.0 * rod.twist, moment=0.0 * rod.moment)
    model = where.new_terms(base.model.field, rod=rod)
    return Case(where, model, state, Mouth(1, 1.0), base.motion._replace(factor=0.0))


@pytest.mark.parametrize("foundation", [1e6, 1e9])
def test_gradient_and_hessian_of_the_walls_energy(foundation: float) -> None:
    case = pressed(foundation, 5)
    assert case.model.wall.between.parts > 1  # type: ignore[attr-defined]
    energy, gradient, hessian = derivatives(case)
    by_energy, by_gradient = difference_quotients(case, 2e-6)
    assert 0.0 < energy < np.inf
    np.testing.assert_allclose(gradient, by_energy, atol=1e-6 * np.abs(gradient).max())
    np.testing.assert_allclose(hessian, by_gradient, atol=1e-5 * np.abs(hessian).max())
