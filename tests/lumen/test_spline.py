"""Piecewise cubics against scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from magwire.lumen.branch import Branch
from magwire.lumen.spline import hermite, spline

Array = NDArray[np.float64]


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(1)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 30])
@pytest.mark.parametrize("begins", [True, False])
@pytest.mark.parametrize("ends", [True, False])
def test_splines_are_those_of_scipy(
    rng: np.random.Generator, count: int, begins: bool, ends: bool
) -> None:
    knots = np.cumsum(rng.uniform(0.2, 2.0, count))
    values = rng.normal(size=(count, 4))
    begin, end = (rng.normal(size=4) if given else None for given in (begins, ends))
    scipys = CubicSpline(
        knots,
        values,
        bc_type=tuple("not-a-knot" if slope is None else (1, slope) for slope in (begin, end)),
    )
    x = np.linspace(knots[0] - 0.1, knots[-1] + 0.1, 97)
    ours = spline(knots, values, begin, end)
    size = np.abs(scipys(x, 1)).max()
    np.testing.assert_allclose(ours(x), scipys(x), atol=1e-13 * size)
    np.testing.assert_allclose(ours(x, 1), scipys(x, 1), atol=1e-13 * size)


def test_hermite_cubics_are_those_of_scipy(rng: np.random.Generator) -> None:
    knots = np.cumsum(rng.uniform(0.2, 2.0, 20))
    values, slopes = rng.normal(size=(2, 20, 3))
    scipys = CubicHermiteSpline(knots, values, slopes)
    x = rng.uniform(knots[0], knots[-1], (7, 5))
    ours = hermite(knots, values, slopes)
    assert ours(x).shape == (7, 5, 3)
    np.testing.assert_allclose(ours(x), scipys(x), atol=1e-12)
    np.testing.assert_allclose(ours(x, 1), scipys(x, 1), atol=1e-11)


def test_one_place_on_a_curve_is_that_of_many_to_the_bit(rng: np.random.Generator) -> None:
    points = np.cumsum(rng.uniform(0.5e-3, 2e-3, (9, 3)), axis=0)
    curve = Branch(points, rng.uniform(4e-4, 6e-4, 9)).curve
    for s in (-1e-3, 0.0, *rng.uniform(0.0, curve.length, 20), curve.length, curve.length + 1e-3):
        point, slope = curve.place(float(s))
        np.testing.assert_array_equal(point, curve.at(np.array([s]))[0])
        np.testing.assert_array_equal(slope, curve.at(np.array([s]), 1)[0])
