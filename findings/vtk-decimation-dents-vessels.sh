#!/usr/bin/env bash
# VTK 9.7.2, pyvista 0.49.1: DecimatePro dents and bulges a vessel by a tenth to a fifth of its radius.
#
# Meshes of vessels from images have many more triangles than contact needs, and VTK has two filters that take a part
# of them away, of which vtkDecimatePro is thought to be the safer one, since it can be told to preserve the topology.
# Asked for a fifth of the triangles of a smooth bent vessel, 2 mm wide, vtkQuadricDecimation gives radii from 0.996
# to 1.002 of the vessel's, and vtkDecimatePro from 0.88 to 1.20, at a twentieth from 0.80 to 1.25: vertices stay
# where they were, but long triangles cut across the lumen and stand out of it. The mean is right within a percent, so
# that a width in the mean does not tell, only the clearance of a wire, which in this vessel comes and goes by 0.3 mm
# along its way. Remedy: vtkQuadricDecimation (pyvista's decimate).
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "vtk==9.7.2" "pyvista==0.49.1"
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import pyvista
import vtk

RADIUS, BEND, AROUND, EDGE = 1.0, 20.0, 48, 0.13  # mm


def vessel():
    """Half a turn of an open round tube."""
    along = round(np.pi * BEND / EDGE)
    turn, angles = np.linspace(0.0, np.pi, along + 1)[:, None], np.arange(AROUND) * 2.0 * np.pi / AROUND
    out = BEND + RADIUS * np.cos(angles)
    places = np.stack((out * np.cos(turn), out * np.sin(turn), 0.0 * turn + RADIUS * np.sin(angles)), axis=-1)
    i, j = np.meshgrid(np.arange(along), np.arange(AROUND), indexing="ij")
    a, b = (i * AROUND + j).ravel(), (i * AROUND + (j + 1) % AROUND).ravel()
    triangles = np.vstack((np.column_stack((a, b, b + AROUND)), np.column_stack((a, b + AROUND, a + AROUND))))
    return pyvista.PolyData.from_regular_faces(places.reshape(-1, 3), triangles)


def radii(surface):
    """Distances from the axis of even places on its triangles, away from its ends [mm]."""
    corners = surface.points.astype(float)[surface.regular_faces]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    random = np.random.default_rng(1)
    chosen = random.choice(len(areas), 20000, p=areas / areas.sum())
    parts = random.random((20000, 2))
    parts[parts.sum(axis=1) > 1.0] = 1.0 - parts[parts.sum(axis=1) > 1.0]
    found = corners[chosen, 0] + np.einsum("ni,nij->nj", parts, sides[chosen])
    found = found[found[:, 1] > 2.0]
    return np.hypot(np.hypot(found[:, 0], found[:, 1]) - BEND, found[:, 2])


print("VTK", vtk.vtkVersion.GetVTKVersion(), "- pyvista", pyvista.__version__)
whole, spread = vessel(), {}
for left in (1.0, 0.2, 0.1, 0.05):
    for name, surface in (
        ("quadric", whole.decimate(1.0 - left) if left < 1.0 else whole),
        ("DecimatePro", whole.decimate_pro(1.0 - left, preserve_topology=True) if left < 1.0 else whole),
    ):
        found = radii(surface)
        spread[name, left] = found.min(), found.max()
        print(f"{surface.n_cells:5} triangles, {name:11}: radius {found.min():.3f} to {found.max():.3f},"
              f" in the mean {found.mean():.3f} mm")
assert abs(found.mean() - 1.0) < 0.02
assert spread["quadric", 0.2][0] > 0.99 and spread["quadric", 0.2][1] < 1.01
assert spread["DecimatePro", 0.2][0] < 0.9 and spread["DecimatePro", 0.2][1] > 1.1
assert spread["quadric", 0.05][0] > 0.97 and spread["DecimatePro", 0.05][0] < 0.85
print("As described: right in the mean, and dented.")
PY
