"""What is to be had below a field and then its currents, by quadratic programmes."""

from __future__ import annotations

import daqp
import numpy as np
import pytest

from actuate.handed import FOLDER, needs_files
from magwire.actuate import MPEM
from magwire.navigate.least_cost import allocate

Array = np.ndarray
CORNER = np.array([0.008, 0.008, 0.008])


def least(columns: Array, rows: Array, wanted: Array) -> float:
    """Least sum of squares of currents with rows . B as wanted, |u| at most 20 A."""
    count = columns.shape[1]
    solution, _, flag, _ = daqp.solve(
        np.eye(count),
        np.zeros(count),
        np.ascontiguousarray(rows @ columns),
        np.concatenate([np.full(count, 20.0), wanted]),
        np.concatenate([np.full(count, -20.0), wanted]),
        np.concatenate([np.zeros(count), np.full(len(rows), 5)]).astype(np.int32),
    )
    assert flag > 0
    return float(solution @ solution)


def saved(columns: Array, frame: Array) -> float:
    """What leaving the field along the tip free saves of the power of a field across it."""
    across, aside, _ = frame
    whole = least(columns, np.eye(3), 5e-3 * across)
    return 1.0 - least(columns, np.stack([across, aside]), np.array([5e-3, 0.0])) / whole


def frames(count: int) -> Array:
    """Random axes: that of bending, the one aside, that of the tip."""
    made, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(count, 3, 3)))
    return made


@needs_files
@pytest.mark.parametrize(("place", "most"), [(np.zeros(3), 0.155), (CORNER, 0.255)])
def test_unevenness_of_octomag_bounds_what_is_below_a_field_and_then_its_currents(
    place: Array, most: float
) -> None:
    """((q - 1)/(q + 1))^2, which one frame attains: a fifth is there in corners only."""
    calibration = MPEM.read(FOLDER / "octomag_calibration.yaml").calibration
    system = MPEM(calibration=calibration, max_currents=(20.0,) * 8)
    columns = system.response(place[None], system.idle)[0][0].T
    values, axes = np.linalg.eigh(np.linalg.inv(columns @ columns.T))
    uneven = values[-1] / values[0]
    bound = ((uneven - 1.0) / (uneven + 1.0)) ** 2
    assert bound == pytest.approx(most, abs=0.01)
    found = [saved(columns, frame) for frame in frames(300)]
    assert max(found) <= bound * (1.0 + 1e-6)
    assert np.median(found) < 0.5 * bound

    low, high = axes[:, 0], axes[:, 2]
    halves = np.stack([low + high, np.sqrt(2.0) * axes[:, 1], low - high]) / np.sqrt(2.0)
    assert saved(columns, halves) == pytest.approx(bound, rel=1e-6)

    field = 5e-3 * halves[0]
    made = allocate(system, place, field)
    assert made is not None
    assert made @ made == pytest.approx(least(columns, np.eye(3), field), rel=1e-6)
