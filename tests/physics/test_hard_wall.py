"""Forces of the wall at every push, against walls that do not give way at all."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from hard_walls import departures, run

THIN = mw.Barrier(100e3, 20e-6)
TODAY = pytest.mark.xfail(reason="the default wall of 1 kPa and 0.1 mm is too soft here")


@pytest.mark.parametrize(
    ("case", "wall"),
    [
        pytest.param("sinusoid", None, marks=TODAY),
        pytest.param("helix", None, marks=TODAY),
        pytest.param("cone", None, marks=TODAY),
        pytest.param("thin", None, marks=TODAY),
        ("sinusoid", THIN),
        ("helix", THIN),
        ("cone", THIN),
        ("thin", THIN),
    ],
    ids=lambda value: {None: "default", THIN: "100 kPa, 20 um"}.get(value, value),
)
def test_forces_at_every_push(case: str, wall: mw.Barrier | None) -> None:
    """On the tip, on the distal 5 mm and on the wire, within 3 percent of the tip's peak."""
    result = run(case, wall)
    assert result.status == "complete"
    for name, where in departures(case, result).items():
        np.testing.assert_array_equal(where, [], err_msg=name)
