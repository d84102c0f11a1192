#!/usr/bin/env bash
# trimesh 5.2.0: thickness of a round tube comes as anything between nothing and its diameter.
#
# proximity.thickness measures by the largest ball inside that is tangent at a point, unless told
# otherwise, and in a round tube that ball has the tube's radius everywhere. In the tube's triangles it has
# not: of n facets around, a neighbour stops the ball at a distance e from their edge at a radius of
# e/tan(pi/n), which is the tube's on the middle line of a facet alone. Over the wall the thickness is
# spread evenly from 0 to the diameter, with half the diameter for a mean; finer meshes give just the
# same, so that no study of convergence shows it. Remedy: method="ray", right to a facet's sagitta.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "trimesh==5.2.0" scipy rtree
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import trimesh
from trimesh.proximity import thickness

print("trimesh", trimesh.__version__)
for sections in (16, 32, 64):
    tube = trimesh.creation.cylinder(radius=1.0, height=10.0, sections=sections)
    points, faces = trimesh.sample.sample_surface(tube, 2000, seed=0)
    normals = tube.face_normals[faces]
    wall = (np.abs(normals[:, 2]) < 0.5) & (np.abs(points[:, 2]) < 3.0)
    balls = thickness(tube, points[wall], normals=normals[wall])
    rays = thickness(tube, points[wall], normals=normals[wall], method="ray")
    quarters = np.percentile(balls, (25, 50, 75))
    print(f"{sections} facets: by balls mean {balls.mean():.2f}, quarters {quarters.round(2)};"
          f" by rays {rays.min():.3f} to {rays.max():.3f}; the diameter is 2")
    assert np.abs(quarters - (0.5, 1.0, 1.5)).max() < 0.15
    assert np.abs(rays - 2.0).max() < 0.05
print("As described: half the diameter in the mean, at every mesh.")
PY
