"""Four at a time: each of the four is what it is alone (P-2, P-14)."""

from __future__ import annotations

import math

import numpy as np
import pytest

from magwire.kernels._jit import kernel
from magwire.kernels.angles import sine_cosine
from magwire.kernels.frames import twist_between
from magwire.kernels.groups import group, numbers, put_numbers, vectors
from magwire.kernels.hinge import reference_twist
from magwire.kernels.lanes import clear_rows, copy_rows, load, store
from magwire.kernels.newton import longest, residual

from .rods import Array


@kernel
def _sines(x: Array, sine: Array, cosine: Array) -> None:
    for i in range(0, len(x), 4):
        s, c = sine_cosine(load(x, i, 0))
        store(sine, i, 0, s)
        store(cosine, i, 0, c)


@kernel
def _twists(first: Array, te: Array, second: Array, tf: Array, before: Array, out: Array) -> None:
    g = group(0, len(out) - 1)
    found = twist_between(
        vectors(first, g), vectors(te, g), vectors(second, g), vectors(tf, g), numbers(before, g)
    )
    put_numbers(out, 0, len(out), found)


@kernel
def _copied(source: Array, target: Array) -> None:
    copy_rows(source, target, 2, 5)
    clear_rows(target, 6, 7)


@pytest.mark.parametrize("size", [0.7, 10.0, 9e4])
def test_sine_and_cosine(size: float) -> None:
    x = np.concatenate([np.random.default_rng(0).uniform(-size, size, 4000), np.zeros(4)])
    x[:9] = np.arange(-4, 5) * math.pi / 4.0
    sine, cosine = np.empty_like(x), np.empty_like(x)
    _sines(x, sine, cosine)
    np.testing.assert_allclose(sine, np.sin(x), rtol=0.0, atol=3e-16)
    np.testing.assert_allclose(cosine, np.cos(x), rtol=0.0, atol=3e-16)
    assert sine[-1] == 0.0
    assert cosine[-1] == 1.0


@pytest.mark.parametrize("count", [1, 3, 4])
@pytest.mark.parametrize("angle", [1e-9, 0.3, 3.0])
def test_twist_of_several_hinges_is_that_of_each(count: int, angle: float) -> None:
    rng = np.random.default_rng(count)
    tangents = rng.normal([1.0, 0.0, 0.0], 0.2, (2, count, 3))
    tangents /= np.linalg.norm(tangents, axis=2)[:, :, None]
    frames = []
    for turn, t in zip((0.0, angle), tangents, strict=True):
        across = np.cross(t, [0.0, 0.0, 1.0])
        across /= np.linalg.norm(across, axis=1)[:, None]
        frames.append(math.cos(turn) * across + math.sin(turn) * np.cross(t, across))
    before = rng.integers(-3, 4, count) * 2.0 * math.pi + angle + rng.uniform(-1.0, 1.0, count)
    out = np.zeros(count)
    _twists(frames[0], tangents[0], frames[1], tangents[1], before, out)
    for i in range(count):
        rows = [tuple(a[i]) for a in (frames[0], tangents[0], frames[1], tangents[1])]
        assert out[i] == pytest.approx(reference_twist(*rows, before[i]), abs=1e-14)


def test_rows_are_copied_and_cleared_and_no_others() -> None:
    source, target = np.arange(32.0).reshape(8, 4), np.full((8, 4), -1.0)
    _copied(source, target)
    expected = np.full((8, 4), -1.0)
    expected[2:5], expected[6] = source[2:5], 0.0
    assert np.array_equal(target, expected)


def test_what_is_not_finite_is_an_infinite_residual() -> None:
    gradient = np.random.default_rng(3).normal(size=(12, 4))
    gradient[-1, 3] = 1e9  # there is no edge after the tip
    gradient[3, :3] = 1e9  # held
    gradient[6, 2] = -50.0
    assert residual(gradient, 3) == 50.0
    for bad in (math.nan, math.inf):
        for place in ((3, 3), (4, 0), (8, 1), (11, 2)):
            broken = gradient.copy()
            broken[place] = bad
            assert residual(broken, 3) == math.inf


def test_longest_component_of_a_step() -> None:
    step = np.zeros(60)
    step[7:35] = np.random.default_rng(1).uniform(-1.0, 1.0, 28)
    step[34] = -3.0
    assert longest(step, 1, 9) == 3.0
