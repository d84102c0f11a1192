"""What must not change the elastic energy: rigid motion, reversal, turned frames (P-2, P-3)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from magwire.kernels.arrays import Mouth
from magwire.kernels.assembly import assemble

from .rods import Array, Case, derivatives, random_case, state_at

ELASTIC = ("stretching", "bending", "twisting")
ROUND_OFF = 1e-12
angles = st.floats(-np.pi, np.pi)
vectors = st.tuples(*[st.floats(-1.0, 1.0)] * 3)


def turned(case: Case, rotation: Rotation, shift: Array) -> Case:
    """The case with its wire rotated about the origin and shifted."""
    q = case.state.q.copy()
    q[:, :3] = rotation.apply(q[:, :3]) + shift
    state = case.system.new_state()
    state.q[:] = q
    state.tangent[:] = rotation.apply(case.state.tangent)
    state.length[:] = case.state.length
    state.director[:] = rotation.apply(case.state.director)
    state.twist[:] = case.state.twist
    return case._replace(state=state)


@settings(max_examples=30)
@given(seed=st.integers(0, 1000), axis=vectors, shift=vectors)
def test_rigid_motion(seed: int, axis: tuple[float, ...], shift: tuple[float, ...]) -> None:
    case = random_case(seed, *ELASTIC)
    rotation = Rotation.from_rotvec(3.0 * np.array(axis))
    energy, gradient, _ = derivatives(case)
    moved, turned_gradient, _ = derivatives(turned(case, rotation, np.array(shift)))
    # next to a fold 1 + te.tf cancels: its relative error grows as its inverse, as the energy does
    assert moved == pytest.approx(energy, rel=ROUND_OFF * max(1.0, 1e-3 * energy))
    forces = np.append(gradient, 0.0).reshape(-1, 4)
    expected = np.column_stack([rotation.apply(forces[:, :3]), forces[:, 3]])
    size = np.abs(gradient).max()
    np.testing.assert_allclose(
        np.append(turned_gradient, 0.0).reshape(-1, 4), expected, atol=ROUND_OFF * size
    )


@pytest.mark.parametrize("seed", range(3))
def test_elastic_forces_and_torques_are_in_balance(seed: int) -> None:
    case = random_case(seed, "bending", "twisting")
    _, gradient, _ = derivatives(case)
    rows = np.append(gradient, 0.0).reshape(-1, 4)
    size = np.abs(rows).max()
    assert np.abs(rows[:, :3].sum(axis=0)).max() < ROUND_OFF * size
    # Turning the whole wire about an axis turns its frames: about edge i by axis . t_i.
    torque = np.cross(case.state.q[:, :3], rows[:, :3]).sum(axis=0)
    assert np.abs(torque + _frames_torque(case, rows)).max() < 10.0 * ROUND_OFF * size


def _frames_torque(case: Case, rows: Array) -> Array:
    """What time-parallel frames miss of a rigid turn: dE/dtheta_i about each edge's tangent."""
    return np.asarray((rows[:-1, 3:] * case.state.tangent).sum(axis=0))


@settings(max_examples=30)
@given(seed=st.integers(0, 1000), angle=angles)
def test_turning_the_reference_frames(seed: int, angle: float) -> None:
    """The material frame is what counts: turn d1 by an angle, take the angle off theta."""
    case = random_case(seed, *ELASTIC)
    state = case.state
    about = Rotation.from_rotvec(angle * state.tangent)
    q = state.q.copy()
    q[:, 3] -= angle
    other = state_at(case.system, q, about.apply(state.director), case.mouth.held)
    other.twist[:] = state.twist
    energy, gradient, hessian = derivatives(case)
    same, same_gradient, same_hessian = derivatives(case, other)
    assert same == pytest.approx(energy, rel=ROUND_OFF)
    np.testing.assert_allclose(same_gradient, gradient, atol=ROUND_OFF * np.abs(gradient).max())
    np.testing.assert_allclose(same_hessian, hessian, atol=ROUND_OFF * np.abs(hessian).max())


@pytest.mark.parametrize("seed", range(5))
def test_reversal(seed: int) -> None:
    """A wire read from its other end: tangents, m2 and the second curvature change their sign."""
    case = random_case(seed, "bending", "twisting")
    rod, *others = case.model
    count = len(case.state.q)
    inner = np.arange(1, count - 1)
    back = rod._replace(  # type: ignore[attr-defined]
        bend=rod.bend[::-1].copy(),  # type: ignore[attr-defined]
        twist=rod.twist[::-1].copy(),  # type: ignore[attr-defined]
        rest_curvature=rod.rest_curvature[::-1] * np.array([1.0, -1.0]),  # type: ignore[attr-defined]
    )
    q = case.state.q[::-1].copy()
    q[:-1, 3] = -case.state.q[-2::-1, 3]
    state = state_at(case.system, q, case.state.director[::-1], 1)
    state.twist[inner] = case.state.twist[inner][::-1]
    whole = case._replace(mouth=Mouth(1, 1.0))
    energy, gradient, _ = derivatives(whole)
    work = case.system.new_work()
    reversed_energy, _ = assemble(
        (back, *others), state, whole.mouth, whole.motion, work.gradient, work.no_band
    )
    assert reversed_energy == pytest.approx(energy, rel=ROUND_OFF)
    forces = np.append(gradient, 0.0).reshape(-1, 4)[:, :3]
    np.testing.assert_allclose(
        work.gradient[::-1, :3], forces, atol=ROUND_OFF * np.abs(forces).max()
    )
