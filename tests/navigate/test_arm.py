"""A magnet that gets to another side of the vessel before it has to be there."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.actuate import Magnet
from magwire.navigate import arm
from magwire.scenario import load
from magwire.scenario.schedules import replayed

COARSE = ["solver.time_step=50 ms", "feed.speed=2 mm/s", "output.record_every=1 mm"]
TIGHT = ["navigate.stability_margin=10 1/s^2", "feed.distance=62 mm"]


def test_directions_are_of_length_one_and_everywhere() -> None:
    found = arm.directions(60)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0)
    any_way = np.random.default_rng(0).normal(size=(200, 3))
    any_way /= np.linalg.norm(any_way, axis=1, keepdims=True)
    assert (any_way @ found.T).max(axis=1).min() > np.cos(np.radians(25.0))


def test_a_place_from_which_there_is_no_going_on_is_left_early_enough(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With the least way alone the half-circle ends at 56 mm: the magnet is on the wrong side."""
    monkeypatch.setattr(arm, "AROUND", 12)
    scenario = load("half-circle-magnet", [*COARSE, *TIGHT])
    result = scenario.run()
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    assert scenario.actuator is not None
    magnet = scenario.actuator.build()
    assert isinstance(magnet, Magnet)
    lumen = np.column_stack([result.dataset["centreline"].values, result.dataset["lumen_radius"]])
    near = min(float((magnet.distance(u, lumen[:, :3]) - lumen[:, 3]).min()) for u in result.inputs)
    assert near >= 0.06
    steps = np.diff(result.time)[:, None]
    assert (np.abs(np.diff(result.inputs[:, :3], axis=0)) / steps).max() <= 0.1 * (1.0 + 1e-6)
    assert replayed(result).run().max_tip_force == 0.0

    monkeypatch.setattr(arm, "AROUND", 0)
    alone = load("half-circle-magnet", [*COARSE, *TIGHT]).run()
    assert alone.status == "no field"
    assert alone.feed[-1] < 0.06
