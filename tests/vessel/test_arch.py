"""Femoral access to an aortic arch as a surface; finer, and to all outlets: campaigns/arch.py."""

from __future__ import annotations

import os
from typing import Literal

import numpy as np
import pytest

from campaigns.arch import entered, plans

SLOW = pytest.mark.skipif("MAGWIRE_SLOW" not in os.environ, reason="9 s; set MAGWIRE_SLOW")


@pytest.mark.parametrize("wall", ["balls", pytest.param("surface", marks=SLOW)])
def test_the_arteries_of_an_arch_are_reached_from_below(
    wall: Literal["balls", "surface"],
) -> None:
    vessel, called = entered(2e-3)
    assert np.linalg.norm(vessel.ends[vessel.entrance]) < 2e-3  # the descending aorta
    assert sorted(vessel.balls) == sorted(called.values())  # there is a way to every outlet
    assert vessel.deviation is not None
    assert vessel.deviation.outside.radii[2] < 0.1
    (plan,) = plans(vessel, [called["left subclavian"]], wall)
    assert plan.reached
    assert plan.peak_field < 30e-3
    assert plan.tip_force == 0.0
    assert plan.clearance > 0.0
