"""Wires that are not the paper's, in its half-circle, with the wall that is the default."""

from __future__ import annotations

import pytest

from any_wire import PEAK, STEPS, pushed
from tables import hard_wall


def test_peak_of_all_wires_is_that_of_the_table() -> None:
    assert hard_wall("half-circle")["tip"].max() == pytest.approx(PEAK, abs=0.005)


@pytest.mark.parametrize(
    ("modulus", "radius", "motion"),
    [
        pytest.param(1e6, 0.1e-3, "100 ms", id="gel 0.2 mm, 100 ms"),
        pytest.param(1e6, 1.2e-3, "10 ms", id="gel 2.4 mm, 10 ms"),
        pytest.param(60e9, 0.18e-3, "10 ms", id="nitinol 0.36 mm, 10 ms"),
        pytest.param(60e9, 0.18e-3, "quasi-static", id="nitinol 0.36 mm, quasi-static"),
        pytest.param(10e9, 0.3e-3, "quasi-static", id="10 GPa 0.6 mm, quasi-static"),
        pytest.param(200e9, 0.1e-3, "100 ms", id="steel 0.2 mm, 100 ms"),
    ],
)
def test_peak_of_a_hard_wall(modulus: float, radius: float, motion: str) -> None:
    result, peak = pushed(modulus, radius, STEPS[motion], push=0.25)
    assert result.status == "complete"
    assert peak == pytest.approx(PEAK, rel=0.01)


def test_what_is_above_is_inertia() -> None:
    """The softest and thinnest of them swings in seconds: fed at 1 mm/s it knocks at the wall."""
    peaks = [pushed(1e6, 0.1e-3, 1e-3, push=0.3, speed=v)[1] / PEAK - 1.0 for v in (1e-3, 2.5e-4)]
    assert 0.01 < peaks[0] < 0.011
    assert 0.0 < peaks[1] < 0.31 * peaks[0]
