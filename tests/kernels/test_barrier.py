"""The wall's barrier against its closed form (P-11)."""

from __future__ import annotations

import cmath

import numpy as np
import pytest

from magwire.kernels.wall.barrier import barrier

GAPS = [1e-3, 0.1, 2.0]
PARTS = [1e-12, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999]


def closed_form(d: complex, gap: float) -> complex:
    return -((d - gap) ** 2) * cmath.log(d / gap)


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("part", PARTS)
def test_value_and_derivatives(part: float, gap: float) -> None:
    d = part * gap
    value, first, second = barrier(d, gap)
    tiny = 1e-30 * d
    assert value == pytest.approx(closed_form(d, gap).real, rel=1e-14)
    assert first == pytest.approx(closed_form(d + 1j * tiny, gap).imag / tiny, rel=1e-12)
    steps = d * 1e-4 * np.array([1.0, -1.0, 2.0, -2.0])
    slopes = [barrier(d + step, gap)[1] for step in steps]
    quotient = (8.0 * (slopes[0] - slopes[1]) - (slopes[2] - slopes[3])) / (12.0 * steps[0])
    assert second == pytest.approx(quotient, rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("gap", GAPS)
def test_it_repels_and_is_convex(gap: float) -> None:
    d = gap * np.linspace(1e-3, 0.999, 200)
    value, first, second = np.array([barrier(x, gap) for x in d]).T
    assert np.all(value > 0.0)
    assert np.all(first < 0.0)
    assert np.all(second > 0.0)
    assert np.all(np.diff(value) < 0.0)


@pytest.mark.parametrize("gap", GAPS)
def test_it_fades_out_twice_continuously(gap: float) -> None:
    """Value, slope and curvature tend to the zero beyond the gap as (gap - d)^3, ^2 and ^1."""
    near = np.array([1e-2, 1e-3, 1e-4])
    terms = np.array([barrier(gap * (1.0 - x), gap) for x in near])
    for order, column in zip((3, 2, 1), terms.T, strict=True):
        slopes = np.diff(np.log(np.abs(column))) / np.diff(np.log(near))
        np.testing.assert_allclose(slopes, order, atol=0.02)


def test_it_is_infinite_at_the_wall() -> None:
    values = [barrier(10.0**-k, 1.0)[0] for k in range(1, 300, 20)]
    assert np.all(np.diff(values) > 10.0)
