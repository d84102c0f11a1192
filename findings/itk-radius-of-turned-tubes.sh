#!/usr/bin/env bash
# ITK 5.4.7: the radius of a tube in space shrinks when the tube is turned, and is below zero after half a turn.
#
# Centrelines of vessels are kept in ITK (TubeTK, .tre) as tubes in an own frame, which is often that of an
# oblique image, and GetRadiusInWorldSpace stands beside GetPositionInWorldSpace. A rotation leaves a radius
# as it is, and a matrix of twice the size doubles it. But the radius is taken for a covariant vector
# (r, r, r), and what comes is the mean of its turned components: a vessel of 2 mm has 1.61 mm
# at 45 degrees, 0.67 mm in a coronal image or at 90 degrees, and -0.67 mm with the signs of x and y changed, as from RAS to
# LPS; a matrix of twice the size halves it. Positions are right throughout, and so is the test for what is
# inside, so that masks look well. Remedy: take GetRadiusInObjectSpace, times the matrix's scale.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "itk-core==5.4.7" "itk-numerics==5.4.7" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
import itk
import numpy as np

RADIUS = 2.0  # mm


def tube(matrix):
    """A tube along x of its own frame, 20 mm long."""
    made = itk.TubeSpatialObject[3].New()
    for along in np.linspace(-10.0, 10.0, 21):
        point = itk.TubeSpatialObjectPoint[3]()
        point.SetPositionInObjectSpace([float(along), 0.0, 0.0])
        point.SetRadiusInObjectSpace(RADIUS)
        made.AddPoint(point)
    frame = itk.AffineTransform[itk.D, 3].New()
    frame.SetMatrix(itk.matrix_from_array(matrix))
    made.SetObjectToParentTransform(frame)
    made.Update()
    return made


def about_z(degrees):
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


print("ITK", itk.Version.GetITKVersion(), f"- a tube of {RADIUS} mm")
wrong = {}
for name, matrix, scale in (
    ("as it is", np.eye(3), 1.0),
    ("30 degrees about z", about_z(30.0), 1.0),
    ("45 degrees about z", about_z(45.0), 1.0),
    ("90 degrees about z", about_z(90.0), 1.0),
    ("a coronal image", np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), 1.0),
    ("RAS to LPS", np.diag([-1.0, -1.0, 1.0]), 1.0),
    ("twice the size", 2.0 * np.eye(3), 2.0),
):
    made = tube(matrix)
    middle, end = made.GetPoint(10), made.GetPoint(20)
    found = middle.GetRadiusInWorldSpace()
    across = matrix @ [0.0, 1.0, 0.0] / scale
    inside = max(r for r in np.arange(0.05, 6.0, 0.1) if made.IsInsideInWorldSpace((r * across).tolist()))
    print(f"{name:20} radius in world space {found:7.4f} mm, should be {scale * RADIUS}; inside up to {inside:.2f} mm")
    assert np.allclose(list(end.GetPositionInWorldSpace()), matrix @ [10.0, 0.0, 0.0])
    assert abs(inside - scale * RADIUS) < 0.1
    assert abs(found - RADIUS * np.mean(np.linalg.inv(matrix).T @ np.ones(3))) < 1e-9
    wrong[name] = found
assert wrong["45 degrees about z"] < 0.81 * RADIUS and wrong["RAS to LPS"] < 0.0
assert wrong["twice the size"] == RADIUS / 2.0
print("As described: the mean of a turned vector's components.")
PY
