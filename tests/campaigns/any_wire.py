"""All wires in all motions: `pytest tests/campaigns/any_wire.py`; not one of the default tests."""

from __future__ import annotations

import pytest

from any_wire import MODULI, PEAK, RADII, STEPS, pushed


@pytest.mark.parametrize("motion", STEPS)
@pytest.mark.parametrize("radius", RADII, ids=lambda r: f"{1e3 * r:g}mm")
@pytest.mark.parametrize("modulus", MODULI, ids=lambda e: f"{1e-6 * e:g}MPa")
def test_peak_of_a_hard_wall(modulus: float, radius: float, motion: str) -> None:
    result, peak = pushed(modulus, radius, STEPS[motion])
    assert result.status == "complete", result.message
    assert peak == pytest.approx(PEAK, rel=0.01)
