"""What is planned does not hang on the mesh."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.lumen.synthetic import carotid_bifurcation


def wire(radius: float, magnet: float, edge: float) -> mw.Wire:
    """A soft wire of five magnets' length."""
    edges = round(5.0 * magnet / edge)
    return mw.Wire.uniform(
        length=edges * edge,
        radius=radius,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=edges + 1,
        magnetized_tip=magnet,
        magnetization=128e3,
    )


def test_a_body_that_comes_to_the_wall_does_not_stop_the_search() -> None:
    """Beyond the bulb the body meets the wall, and every programme sees a jump there."""
    tree = carotid_bifurcation()
    found = [
        {p.outlet: p for p in mw.plan(tree, wire(0.45e-3, 5e-3, edge))} for edge in (5e-4, 7e-4)
    ]
    for outlet in tree.outlets:
        prospects = [table[outlet] for table in found]
        assert [(p.reached, p.tip_force, p.reason) for p in prospects] == [(True, 0.0, "")] * 2
        assert min(p.clearance for p in prospects) > 0.0
        peaks = np.array([p.peak_field for p in prospects])
        assert peaks == pytest.approx(peaks[0], rel=0.02)
