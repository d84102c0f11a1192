"""Parallel transport and the reference twist (P-2)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from magwire.kernels.hinge import hinge, material_frame, reference_twist, transport

from .rods import Array

vectors = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array)
ROUND_OFF = 1e-13


def unit(v: Array) -> Array:
    return np.asarray(v / np.linalg.norm(v))


def across(t: Array, v: Array) -> Array:
    return v - (v @ t) * t


def carry(v: Array, a: Array, b: Array) -> Array:
    return np.array(transport(tuple(v), tuple(a), tuple(b)))


@given(a=vectors, b=vectors, v=vectors)
def test_transport_is_the_shortest_rotation(a: Array, b: Array, v: Array) -> None:
    assume(min(np.linalg.norm(a), np.linalg.norm(b)) > 1e-3)
    a, b = unit(a), unit(b)
    assume(a @ b > -0.99 and np.linalg.norm(across(a, v)) > 1e-3)
    v = unit(across(a, v))
    moved = carry(v, a, b)
    axis = np.cross(a, b)
    angle = np.arctan2(np.linalg.norm(axis), a @ b)
    size = np.linalg.norm(axis)
    turn = Rotation.from_rotvec(axis * (angle / size if size > 0.0 else 1.0))
    np.testing.assert_allclose(moved, turn.apply(v), atol=1e-11)
    assert abs(moved @ b) < ROUND_OFF
    assert np.linalg.norm(moved) == pytest.approx(1.0, abs=ROUND_OFF)
    np.testing.assert_allclose(carry(moved, b, a), v, atol=1e-11)


def test_transport_around_a_loop_turns_by_its_solid_angle() -> None:
    x, y, z = np.eye(3)
    v = carry(carry(carry(y, x, y), y, z), z, x)
    # An octant of the sphere: pi/2, in the sense of the loop.
    np.testing.assert_allclose(v, z, atol=ROUND_OFF)


def test_many_transports_stay_orthonormal() -> None:
    rng = np.random.default_rng(0)
    t = np.array([1.0, 0.0, 0.0])
    d = np.array([0.0, 1.0, 0.0])
    for _ in range(5000):
        new = unit(t + 0.3 * rng.normal(size=3))
        d, t = carry(d, t, new), new
    assert abs(d @ t) < ROUND_OFF
    assert np.linalg.norm(d) == pytest.approx(1.0, abs=ROUND_OFF)


@given(t=vectors, v=vectors, angle=st.floats(-10.0, 10.0))
def test_material_frame_turns_about_the_tangent(t: Array, v: Array, angle: float) -> None:
    assume(np.linalg.norm(t) > 1e-3)
    t = unit(t)
    assume(np.linalg.norm(across(t, v)) > 1e-3)
    d1 = unit(across(t, v))
    m1, m2 = material_frame(tuple(d1), tuple(t), angle)
    np.testing.assert_allclose(m1, Rotation.from_rotvec(angle * t).apply(d1), atol=1e-12)
    np.testing.assert_allclose(m2, np.cross(t, m1), atol=1e-12)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_reference_twist_counts_whole_turns(direction: float) -> None:
    rng = np.random.default_rng(1)
    te, tf = unit(rng.normal(size=3)), unit(rng.normal(size=3))
    d_e = unit(across(te, rng.normal(size=3)))
    start = carry(d_e, te, tf)
    twist = 0.0
    for angle in direction * np.linspace(0.0, 5.0 * 2.0 * np.pi, 101):
        d_f = Rotation.from_rotvec(angle * tf).apply(start)
        twist = reference_twist(tuple(d_e), tuple(te), tuple(d_f), tuple(tf), twist)
        assert twist == pytest.approx(angle, abs=1e-12)


@pytest.mark.parametrize("degrees", [1e-4, 30.0, 90.0, 150.0, 179.0])
def test_curvature_is_twice_the_tangent_of_half_the_angle(degrees: float) -> None:
    """Beyond 90 degrees too, where the denominator as printed would turn back (P-3)."""
    angle = np.radians(degrees)
    h = hinge((1.0, 0.0, 0.0), (np.cos(angle), np.sin(angle), 0.0), 0.5, 0.25)
    expected = (0.0, 0.0, 2.0 * np.tan(0.5 * angle))
    np.testing.assert_allclose(h.binormal, expected, rtol=1e-11)
