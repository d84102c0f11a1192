"""What friction adds to a step: derivatives, what it takes, and what a node keeps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kernels.rods import (
    Case,
    derivatives,
    difference_quotients,
    random_field,
    random_rod,
    random_state,
    system,
)
from magwire.contact import Friction
from magwire.kernels.arrays import Motion, Mouth
from magwire.kernels.wall.traction import keep, recall, set_load

HELD = 2


def rubbing(seed: int, slide: float, *, drag: float = 0.0) -> Case:
    """A crumpled wire that feels nothing but friction, after a step of some size."""
    rng = np.random.default_rng(seed)
    friction = Friction(drag=drag) if drag else Friction(0.3, 0.2)
    where = replace(system(), friction=friction)
    rod = random_rod(rng, where.rod, ())
    wall, state = where.new_wall(), random_state(rng, where, HELD, 0.1)
    wall = wall._replace(friction=(wall.friction[0]._replace(slip=0.01),))
    state.held[0] = HELD
    recall(wall.friction[0], state, HELD)
    wall.friction[0].rate[0] = 2.0
    wall.friction[0].factor[:] = 1.0
    normals = rng.normal(size=(len(state.q), 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    for i in range(HELD + 1, len(state.q)):
        set_load(wall.friction[0], state, state, i, tuple(normals[i]), rng.uniform(0.5, 2.0))
    wall.friction[0].slides[:] = rng.uniform(size=len(state.q)) < 0.5
    state.q[:, :] += slide * rng.normal(size=state.q.shape)
    field = random_field(rng, len(rod.rest), uniform=True)
    model = where.new_terms(field, rod=rod, wall=wall)
    still = Motion(0.0, np.zeros_like(state.q))
    return Case(where, model, state, Mouth(HELD, 1.0), still)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("slide", "drag"), [(1e-3, 0.0), (0.3, 0.0), (0.3, 2.0)])
def test_gradient_and_hessian_are_the_energys(seed: int, slide: float, drag: float) -> None:
    """In stick, whose slips are small, in slip, and with drag."""
    case = rubbing(seed, slide, drag=drag)
    energy, gradient, hessian = derivatives(case)
    by_energy, by_gradient = difference_quotients(case, 1e-5)
    assert energy > 0.0
    assert np.abs(gradient).max() > 1e-3
    np.testing.assert_allclose(gradient, by_energy, atol=1e-6 * np.abs(gradient).max())
    np.testing.assert_allclose(hessian, by_gradient, atol=1e-6 * np.abs(hessian).max())


@pytest.mark.parametrize("slide", [1e-3, 0.3])
def test_what_it_takes_is_never_negative(slide: float) -> None:
    case = rubbing(7, slide)
    _, _, hessian = derivatives(case)
    assert np.linalg.eigvalsh(hessian).min() > -1e-9 * np.abs(hessian).max()
    before = case.state._replace(contact=case.state.contact.copy())
    keep(case.model.rod, case.model.wall.friction[0], before, case.state)
    if slide < 0.01:
        assert before.spent[0] == 0.0
    else:
        assert before.spent[0] > 0.0
    assert before.contact[HELD + 1 :, 8].min() >= 0.0
