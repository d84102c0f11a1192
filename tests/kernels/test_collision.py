"""The step filter: no step crosses the wall, and sliding along it is not held back (P-8)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from magwire.kernels.arrays import JET
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.collision import CLOSEST, travel
from magwire.lumen import Lumen

from .rods import Array

RADIUS = 3e-3
TUBES = {
    "straight": lambda: Lumen.straight(0.1, RADIUS),
    "half-circle": lambda: Lumen.half_circle(0.025, RADIUS),
    "helix": lambda: Lumen.helix(0.01, 0.01, 0.09, RADIUS),
    "tapered": lambda: Lumen.through(
        np.linspace([0.0, 0.0, 0.0], [0.1, 0.01, 0.0], 30), np.linspace(4e-3, 2e-3, 30)
    ),
}
UNKNOWN = -np.inf


@lru_cache
def tube(name: str) -> tuple[Lumen, LumenArrays]:
    lumen = TUBES[name]()
    return lumen, lumen.arrays()


def go(name: str, x: Array, dx: Array, offset: float = 0.0, limit: float = 1.0) -> float:
    memory = np.full(4, UNKNOWN), np.zeros(JET)
    return float(travel(tube(name)[1], tuple(x), tuple(dx), offset, *memory, limit))


def inside(lumen: Lumen, s: float, depth: float, seed: int) -> tuple[Array, Array, Array]:
    """A point at a part ``depth`` of the radius off the centreline; tangent, outward normal."""
    curve = lumen.branches[0].curve
    arc = np.array([s * lumen.length])
    centre, tangent = curve.at(arc)[0], curve.at(arc, 1)[0, :3]
    normal = np.cross(tangent, np.random.default_rng(seed).normal(size=3))
    normal /= np.linalg.norm(normal)
    return centre[:3] + depth * centre[3] * normal, tangent, normal


@pytest.mark.parametrize("name", TUBES)
@settings(max_examples=60)
@given(
    s=st.floats(0.1, 0.9),
    depth=st.floats(0.0, 0.999),
    seed=st.integers(0, 10**6),
    size=st.floats(1e-6, 0.05),
    offset=st.sampled_from([0.0, 0.6e-3]),
)
@example(
    s=0.109375, depth=0.5, seed=5161, size=0.03125, offset=0.6e-3
)  # out past the entrance's rim
def test_no_step_crosses_the_wall(
    name: str, s: float, depth: float, seed: int, size: float, offset: float
) -> None:
    lumen, _ = tube(name)
    x, _, _ = inside(lumen, s, depth, seed)
    start = float(lumen.gap(x[None])[0]) - offset
    assume(start > 1e-9)
    dx = np.random.default_rng(seed + 1).normal(size=3)
    dx *= size / np.linalg.norm(dx)
    part = go(name, x, dx, offset)
    assert 0.0 < part <= 1.0
    path = x + np.linspace(0.0, part, 400)[:, None] * dx
    gaps = lumen.gap(path) - offset
    assert gaps.min() > 0.0
    curve = lumen.branches[0].curve
    along = (path[-1] - curve.at(np.zeros(1))[0, :3]) @ curve.at(np.zeros(1), 1)[0, :3]
    if part < 1.0 and along > 0.0:  # it stopped for a reason: the wall is near, or a rim
        assert gaps[-1] <= CLOSEST * start + 1e-12 or gaps[-1] < 0.05 * RADIUS


@pytest.mark.parametrize("name", TUBES)
@pytest.mark.parametrize("clearance", [1e-6, 1e-5, 1e-4])
def test_sliding_along_the_wall(name: str, clearance: float) -> None:
    """A hundred clearances along the tangent, where the wall does not bend into the way."""
    lumen, _ = tube(name)
    curve = lumen.branches[0].curve
    arc = np.array([0.5 * lumen.length])
    tangent, bend = curve.at(arc, 1)[0, :3], curve.at(arc, 2)[0, :3]
    across = np.cross(tangent, [0.3, 0.5, 0.7])
    inner = bend / np.linalg.norm(bend) if np.linalg.norm(bend) > 1.0 else across
    inner = inner - (inner @ tangent) * tangent
    inner /= np.linalg.norm(inner)
    centre = curve.at(arc)[0]
    x = centre[:3] + (centre[3] - clearance) * inner  # on the inside of the bend
    backwards = -1.0  # a tapered tube gets wider that way
    assert go(name, x, backwards * 100.0 * clearance * tangent) == 1.0


@pytest.mark.parametrize("name", ["straight", "half-circle", "tapered"])
@pytest.mark.parametrize("past", [0.05, 0.3, 0.6, 0.95, 1.2])
@pytest.mark.parametrize("offset", [1e-3, 1.6e-3])
def test_a_thick_wire_gets_out_past_the_rim(name: str, past: float, offset: float) -> None:
    lumen, _ = tube(name)
    curve = lumen.branches[0].curve
    arc = np.array([lumen.length])
    end, tangent = curve.at(arc)[0], curve.at(arc, 1)[0, :3]
    across = np.cross(tangent, [0.3, 0.5, 0.7])
    across /= np.linalg.norm(across)
    x = end[:3] + past * end[3] * tangent + (end[3] - 1.05 * offset) * across
    assert lumen.gap(x[None])[0] > offset
    assert go(name, x, 0.1 * end[3] * tangent, offset) == 1.0


@pytest.mark.parametrize("limit", [0.1, 0.37, 1.0])
def test_what_others_allow_is_kept(limit: float) -> None:
    x, tangent, _ = inside(tube("straight")[0], 0.5, 0.0, 0)
    assert go("straight", x, 1e-3 * tangent, limit=limit) == limit


def test_head_on_into_the_wall_stops_short() -> None:
    x, _, normal = inside(tube("straight")[0], 0.5, 0.0, 0)
    part = go("straight", x, 2.0 * RADIUS * normal)
    assert 0.45 < part < 0.5


@settings(max_examples=60)
@given(s=st.floats(0.1, 0.9), depth=st.floats(0.0, 0.99), seed=st.integers(0, 10**6))
def test_what_is_remembered_of_the_gap_stays_true(s: float, depth: float, seed: int) -> None:
    """Two steps that share the memory are as safe as two that ask anew."""
    lumen, arrays = tube("half-circle")
    rng = np.random.default_rng(seed)
    memory = np.full(4, UNKNOWN), np.zeros(JET)
    x, _, _ = inside(lumen, s, depth, seed)
    for _ in range(5):
        dx = rng.normal(size=3) * 10.0 ** rng.uniform(-6, -2)
        part = travel(arrays, tuple(x), tuple(dx), 0.0, *memory, 1.0)
        path = x + np.linspace(0.0, part, 100)[:, None] * dx
        assert lumen.gap(path).min() > 0.0
        x = path[-1]


def test_open_space_has_no_wall() -> None:
    arrays = Lumen.open_space().arrays()
    memory = np.full(4, UNKNOWN), np.zeros(JET)
    assert travel(arrays, (0.0, 0.0, 0.0), (9.0, 9.0, 9.0), 0.0, *memory, 1.0) == 1.0
