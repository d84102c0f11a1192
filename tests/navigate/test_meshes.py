"""What is planned does not hang on the mesh."""

from __future__ import annotations

import os
from pathlib import Path

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


@pytest.mark.skipif(
    not {"MAGWIRE_VESSELS", "MAGWIRE_SLOW"} <= set(os.environ),
    reason="minutes, with files of patients; set MAGWIRE_SLOW, and MAGWIRE_VESSELS to their folder",
)
@pytest.mark.parametrize(
    ("name", "unit", "radius", "magnet", "edges"),
    [
        ("carotids_beamadapter_centerlines_by_us.vtp", "mm", 0.45e-3, 5e-3, (0.45e-3, 0.51e-3)),
        ("aortoiliac_simvascular_demo_centerlines_cm.vtp", "cm", 0.9e-3, 10e-3, (0.9e-3, 1.1e-3)),
    ],
)
def test_wide_vessels_of_patients(
    name: str, unit: str, radius: float, magnet: float, edges: tuple[float, ...]
) -> None:
    tree = mw.Lumen.read(Path(os.environ["MAGWIRE_VESSELS"]) / name, unit)
    demands = mw.Demands(max_field=50e-3)
    found = [mw.plan(tree, wire(radius, magnet, edge), demands=demands) for edge in edges]
    for prospects in zip(*found, strict=True):
        assert [(p.reached, p.tip_force) for p in prospects] == [(True, 0.0)] * len(edges)
        assert min(p.clearance for p in prospects) > 0.0
        peaks = np.array([p.peak_field for p in prospects])
        assert peaks == pytest.approx(peaks[0], rel=0.06)
