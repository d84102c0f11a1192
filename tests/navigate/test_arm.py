"""A magnet that gets to another side of the vessel before it has to be there."""

from __future__ import annotations

import numpy as np
import pytest

from actuate.on_an_arm import fastest, nearest
from magwire.navigate import arm
from magwire.scenario import load
from magwire.scenario.replays import replayed

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
    assert nearest(scenario, result) >= 0.06
    assert fastest(result) <= 0.1 * (1.0 + 1e-6)
    assert replayed(result).run().max_tip_force == 0.0

    monkeypatch.setattr(arm, "AROUND", 0)
    alone = load("half-circle-magnet", [*COARSE, *TIGHT]).run()
    assert alone.status == "no field"
    assert alone.feed[-1] < 0.06
