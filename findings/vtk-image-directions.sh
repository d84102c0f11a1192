#!/usr/bin/env bash
# VTK 9.7.2: where an oriented image lies in space hangs on the format that it was saved in.
#
# Vessels are segmented in images whose axes are oblique, and vtkImageData has a direction matrix for
# that. One would expect its readers to fill it or to ignore it, all alike. The same image, written by
# SimpleITK 2.5.7, which reads all of them back to where it was, comes with the matrix transposed from
# MetaImage (.mha, .mhd), that is, turned by its angle the wrong way, and from NRRD unturned, both with
# the right origin and spacing and without a word. pyvista reads by these readers. A plain
# axial scan in .mha is read rightly, so that nothing looks amiss until the first oblique or sagittal one.
# Remedy: read with SimpleITK, and set origin, spacing and direction by hand.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "vtk==9.7.2" "SimpleITK==2.5.7" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import SimpleITK as sitk
import vtk
from vtk.util.numpy_support import vtk_to_numpy

angle = np.deg2rad(30.0)
turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
image = sitk.Image(40, 30, 20, sitk.sitkFloat32)
image.SetSpacing((0.5, 0.5, 1.0))
image.SetOrigin((10.0, 20.0, 30.0))
image.SetDirection(turn.ravel().tolist())
marked = (35, 20, 10)
image[marked] = 1.0
true = np.array(image.TransformIndexToPhysicalPoint(marked))

print("VTK", vtk.vtkVersion.GetVTKVersion(), "- SimpleITK", sitk.Version.VersionString())
print("marked voxel by SimpleITK:", true.round(3), "mm")
for ending, reader, matrix, described in (
    ("mha", vtk.vtkMetaImageReader(), turn.T, "transposed"),
    ("mhd", vtk.vtkMetaImageReader(), turn.T, "transposed"),
    ("nrrd", vtk.vtkNrrdReader(), np.eye(3), "unturned"),
):
    sitk.WriteImage(image, f"image.{ending}")
    again = sitk.ReadImage(f"image.{ending}").TransformIndexToPhysicalPoint(marked)
    assert np.allclose(again, true, atol=1e-6)
    reader.SetFileName(f"image.{ending}")
    reader.Update()
    read = reader.GetOutput()
    assert np.allclose(read.GetOrigin(), image.GetOrigin()) and np.allclose(read.GetSpacing(), image.GetSpacing())
    values = vtk_to_numpy(read.GetPointData().GetScalars())
    place = np.array(read.GetPoint(int(values.argmax())))
    direction = np.array([[read.GetDirectionMatrix().GetElement(i, j) for j in range(3)] for i in range(3)])
    print(f".{ending:4} by VTK: {place.round(3)} mm, {np.linalg.norm(place - true):.1f} mm away; matrix {described}")
    assert np.allclose(direction, matrix, atol=1e-6), direction
    assert np.linalg.norm(place - true) > 5.0
print("As described: three files of one image, two places, both wrong.")
PY
