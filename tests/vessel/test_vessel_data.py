"""Vessels of patients, where ``MAGWIRE_VESSELS`` names the folder that holds them."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import KDTree

from magwire.vessel import Vessel, vmtk
from magwire.vessel.extract import extract
from magwire.vessel.files import load
from magwire.vessel.placement import guessed_unit

FOLDER = Path(os.environ.get("MAGWIRE_VESSELS", ""))
FILES = {
    "coronary_lca_centerlines_multimoda.vtp": ("mm", 5, (96.3, 216.6)),
    "coronary_721A_centreline_dbihar.vtk": ("mm", 2, (94.7, 131.4)),
    "carotids_beamadapter_centerlines_by_us.vtp": ("mm", 2, (90.4, 93.8)),
    "aortoiliac_simvascular_demo_centerlines_cm.vtp": ("cm", 2, (430.0, 450.0)),
    "carotids_beamadapter.stl": ("mm", 2, (90.4, 93.8)),
    "aortoiliac_simvascular_demo_surface_cm.vtp": ("cm", 2, (430.0, 450.0)),
}
PAIRS = {
    "carotids_beamadapter.stl": "carotids_beamadapter_centerlines_by_us.vtp",
    "aortoiliac_simvascular_demo_surface_cm.vtp": "aortoiliac_simvascular_demo_centerlines_cm.vtp",
}
there = pytest.mark.skipif(
    "MAGWIRE_VESSELS" not in os.environ, reason="MAGWIRE_VESSELS names no folder of vessels"
)


@there
@pytest.mark.parametrize("name", sorted(FILES))
def test_every_file_is_read(name: str) -> None:
    unit, outlets, (shortest, longest) = FILES[name]
    assert guessed_unit(load(FOLDER / name)) == unit
    vessel = Vessel.read(FOLDER / name, unit)
    lengths = [1e3 * tube.length for tube in vessel.tubes.values()]
    assert len(lengths) == outlets
    # smoothing shortens a noisy line, by a few percent where it is as wide as an aortic root
    assert min(lengths) == pytest.approx(shortest, rel=0.03)
    assert max(lengths) == pytest.approx(longest, rel=0.03)
    lumen = vessel.lumen()
    for target in vessel.tubes:
        path = lumen.path(target)
        middle, _ = path.centreline(points=200)
        assert lumen.gap(middle[1:-1]).min() > 0.3 * path.narrowest


@there
@pytest.mark.parametrize("name", sorted(PAIRS))
@pytest.mark.parametrize("by", ["voxels", "vmtk"])
def test_extraction_agrees_with_vmtk(name: str, by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if by == "voxels":
        monkeypatch.setattr(vmtk, "installed", lambda: False)
    elif not vmtk.installed():
        pytest.skip("VMTK is not installed")
    surface, lines = load(FOLDER / name).surface, load(FOLDER / PAIRS[name]).lines
    assert surface is not None
    millimetres = 10.0 if FILES[name][0] == "cm" else 1.0
    points = np.concatenate([line.points for line in lines])
    radius = np.concatenate([line.radius for line in lines])
    found = extract(surface)
    assert ("The centrelines are by VMTK." in found.notes) == (by == "vmtk")
    ours = np.concatenate([line.points for line in found.lines])
    wide = np.concatenate([line.radius for line in found.lines])
    distance, nearest = KDTree(points).query(ours)
    assert millimetres * np.median(distance) < 0.2
    assert millimetres * np.percentile(distance, 95) < 1.0
    assert millimetres * np.median(np.abs(wide - radius[nearest])) < 0.15
