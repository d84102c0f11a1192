"""Field schedules."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.errors import InputError
from magwire.navigate import Schedule

SCHEDULE = Schedule(np.array([0.0, 0.01, 0.03]), np.array([[0, 0, 0], [1, 2, 3], [3, 2, 1]]) * 1e-3)


def test_linear_between_knots_and_constant_outside() -> None:
    expected = np.array([[0, 0, 0], [0.5, 1, 1.5], [2, 2, 2], [3, 2, 1]]) * 1e-3
    assert np.allclose(SCHEDULE.at([-1.0, 0.005, 0.02, 9.0]), expected, atol=1e-18)


def test_resampling_keeps_the_end_and_the_values_at_the_new_knots() -> None:
    coarse = SCHEDULE.resampled(0.007)
    assert np.allclose(coarse.feed, [0.0, 0.007, 0.014, 0.021, 0.028, 0.03])
    assert np.array_equal(coarse.flux_density, SCHEDULE.at(coarse.feed))


def test_scaling() -> None:
    assert np.allclose(SCHEDULE.scaled(0.97).flux_density, 0.97 * SCHEDULE.flux_density)


@pytest.mark.parametrize(
    ("feed", "flux", "message"),
    [
        ([0.0, 0.0], [[0, 0, 0]] * 2, "must hold at least one value and rise"),
        ([], np.zeros((0, 3)), "must hold at least one value and rise"),
        ([0.0, 1.0], [[0, 0, 0]], r"must have shape \(2, 3\); received shape \(1, 3\)"),
        ([0.0, np.nan], [[0, 0, 0]] * 2, "must be finite"),
    ],
)
def test_faults(feed: object, flux: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Schedule(feed, flux)  # type: ignore[arg-type]
