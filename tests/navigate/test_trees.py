"""Into the chosen branch of a tree, without a touch of the tip."""

from __future__ import annotations

import os

import numpy as np
import pytest

from magwire.lumen import Lumen
from magwire.scenario import load


def nearest_way(lumen: Lumen, tip: np.ndarray) -> str:
    """The outlet whose path is nearest to a point."""
    return min(lumen.outlets, key=lambda name: lumen.path(name).offset(tip[None])[0])


@pytest.mark.parametrize("target", ["left", "middle", "right"])
@pytest.mark.parametrize("method", ["stable", "newton"])
def test_tip_ends_in_the_branch_it_was_sent_to(target: str, method: str) -> None:
    scenario = load(f"{target}-branch", [f"navigate.method={method}"])
    result = scenario.run()
    assert result.status == "complete"
    assert result.max_tip_force == 0.0
    lumen = scenario.lumen.build()
    tip = result.position[-1][-1]
    distance = {name: lumen.path(name).offset(tip[None])[0] for name in lumen.outlets}
    assert min(distance, key=lambda name: distance[name]) == target
    assert distance[target] < 0.65 * lumen.radius_range[1]
    others = [distance[name] for name in lumen.outlets if name != target]
    assert np.min(others) > 2.0 * lumen.radius_range[1]


def test_small_steps_through_the_first_contact_of_the_body() -> None:
    """Where the wire behind the tip meets the wall, programmes must not jump to and fro."""
    keys = ["navigate.update_every=0.1 mm", "feed.distance=60 mm"]
    result = load("right-branch", keys).run()
    assert result.status == "complete", result.message
    assert 0.05 < result.first_contact < 0.06
    assert result.max_tip_force == 0.0


def test_passively_it_goes_where_the_tube_goes_on() -> None:
    scenario = load("left-branch", ["navigate.method=none"])
    result = scenario.run()
    lumen = scenario.lumen.build()
    tip = result.position[-1][-1]
    assert lumen.path("middle").offset(tip[None])[0] < lumen.radius_range[1]
    assert lumen.path("left").offset(tip[None])[0] > 2.0 * lumen.radius_range[1]


@pytest.mark.skipif("MAGWIRE_SLOW" not in os.environ, reason="half a minute; set MAGWIRE_SLOW")
def test_from_the_descending_aorta_into_the_left_carotid() -> None:
    scenario = load("aortic-arch")
    result = scenario.run()
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    assert result.smallest_clearance > 0.0
    assert result.peak_field < 0.02
    lumen, tip = scenario.lumen.build(), result.position[-1][-1]
    assert nearest_way(lumen, tip) == "left carotid"


@pytest.mark.parametrize(
    ("name", "outlet", "field"),
    [("carotid", "internal", 2e-3), ("coronary", "anterior", 10e-3), ("tortuous", None, 6e-3)],
)
def test_through_vessels_with_a_formula(name: str, outlet: str | None, field: float) -> None:
    scenario = load(name)
    result = scenario.run()
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    assert result.smallest_clearance > 0.0
    assert 0.0 < result.peak_field < field
    lumen, tip = scenario.lumen.build(), result.position[-1][-1]
    assert outlet is None or nearest_way(lumen, tip) == outlet
    assert lumen.path().length - result.feed[-1] < 4e-3
