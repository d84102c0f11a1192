#!/usr/bin/env bash
# VTK 9.7.2, pyvista 0.49.1: even steps along a spline of a centreline are anything but even at its ends.
#
# vtkParametricSpline (pyvista's Spline) and vtkSplineFilter go by the length along the points that they pass, so that
# even steps are thought to be about even lengths: the nodes of a rod, or the steps of a robot that feeds one. But
# both are clamped as they come, to a derivative of 0 at both ends: the curve starts from rest. Of a straight line
# through 11 even points, cut into 100 elements, the first has 0.17 of the mean length and others 1.36; cut into 400,
# 0.04; the more elements, the worse. An explicit rod on such nodes needs steps as much shorter, and whatever is by
# element, contact or damping, is as much denser there. In a bend the curvature that is missing at the ends comes
# beside them, up to 1.7 times the bend's. Remedy: SetLeftConstraint(2) and SetRightConstraint(2), the natural spline.
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
from vtkmodules.util.numpy_support import vtk_to_numpy


def straight(points):
    return np.column_stack((np.linspace(0.0, 100.0, points), np.zeros((points, 2))))


def bend(points):
    angles = np.linspace(0.0, np.pi / 2.0, points)
    return 20.0 * np.column_stack((np.cos(angles), np.sin(angles), 0.0 * angles))


def by_pyvista(places, elements):
    return pyvista.Spline(places, elements + 1).points.astype(float)


def by_filter(places, elements):
    spline = vtk.vtkSplineFilter()
    spline.SetInputData(pyvista.MultipleLines(places))
    spline.SetSubdivideToSpecified()
    spline.SetNumberOfSubdivisions(elements)
    spline.Update()
    return vtk_to_numpy(spline.GetOutput().GetPoints().GetData()).astype(float)


def natural(places, elements):
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for place in places:
        points.InsertNextPoint(place)
    spline = vtk.vtkParametricSpline()
    spline.SetPoints(points)
    spline.SetLeftConstraint(2)
    spline.SetRightConstraint(2)
    found = np.zeros((elements + 1, 3))
    for u, place in zip(np.linspace(0.0, 1.0, elements + 1), found, strict=True):
        spline.Evaluate([u, 0.0, 0.0], place, [0.0] * 9)
    return found


def lengths(curve):
    """Of the elements, over their mean."""
    found = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    return found / found.mean()


def most_curved(curve):
    """Largest curvature over that of the bend, of arcs through every fourth point."""
    a, b, c = curve[:-8], curve[4:-4], curve[8:]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    sides = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - b, axis=1) * np.linalg.norm(c - a, axis=1)
    return (20.0 * 2.0 * area / sides)[10:-10].max()


print("VTK", vtk.vtkVersion.GetVTKVersion(), "- pyvista", pyvista.__version__)
first = {}
for points, elements in ((5, 400), (11, 100), (11, 400), (21, 400)):
    for way in (by_pyvista, by_filter, natural):
        found = lengths(way(straight(points), elements))
        first[way, points, elements] = found[0]
        print(f"straight line through {points:2} even points, {elements} elements {way.__name__:10}:"
              f" first {found[0]:.3f}, longest {found.max():.3f} of the mean")
curved = {way: most_curved(way(bend(21), 400)) for way in (by_pyvista, natural)}
for way, found in curved.items():
    print(f"bend through 21 points {way.__name__:10}: curvature up to {found:.2f} of the bend's")
for way in (by_pyvista, by_filter):
    assert 0.15 < first[way, 11, 100] < 0.18 and first[way, 11, 400] < 0.05 and first[way, 5, 400] < 0.02
assert all(abs(found - 1.0) < 1e-3 for (way, *_), found in first.items() if way is natural)
assert curved[by_pyvista] > 1.55 > 1.3 > curved[natural]
print("As described: splines start and end at rest.")
PY
