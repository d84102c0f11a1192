#!/usr/bin/env bash
# trimesh 5.2.0: a wire that touches the wall is told to be 0.2 mm away from it if the vessel's mesh is in metres.
#
# A distance to a mesh is thought to scale with the mesh. But whether the nearest place of a triangle lies inside of
# it or on an edge is told from products of four lengths, compared with 2e-14 whatever the unit. In metres they are
# below that for all triangles with edges under 0.4 mm, as vessels have them, and for parts of those with 1 mm: the
# nearest place is then sought on the edges. Of a channel of 2 mm with edges of 0.4 mm, places 0.01 mm from the flat
# wall are told 0.06 mm in the mean and up to 0.2 mm by closest_point and signed_distance alike, those at 0.12 mm up
# to 0.24 mm; the very same mesh in mm is right within a nanometre. It is a bias that hides contact, at just the clearances
# that count for a wire, and finer meshes make it smaller, so that it passes for one of facets. Remedy: vessels in
# millimetres.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "trimesh==5.2.0" numpy scipy rtree
cd "$work"
"$work/venv/bin/python" - <<'PY'
import numpy as np
import trimesh

WIDTH, LENGTH = 2.0, 8.0  # mm


def channel(longest, unit):
    """A closed straight channel of a square section, its walls cut into triangles with edges up to a length [mm]."""
    box = trimesh.creation.box((WIDTH, WIDTH, LENGTH))
    places, triangles = trimesh.remesh.subdivide_to_size(box.vertices, box.faces, longest)
    found = trimesh.Trimesh(places / unit, triangles)
    assert found.is_watertight and found.volume > 0.0
    return found


def told(mesh, points, unit):
    """Clearances of places in the channel [mm]."""
    signed = unit * mesh.nearest.signed_distance(points / unit)
    _, distance, _ = trimesh.proximity.closest_point(mesh, points / unit)
    assert np.allclose(unit * distance, signed, atol=1e-9)
    return signed


print("trimesh", trimesh.__version__)
random, most = np.random.default_rng(0), {}
for longest in (1.5, 0.75, 0.375):
    in_mm, in_m = channel(longest, 1.0), channel(longest, 1000.0)
    print(f"edges of {in_mm.edges_unique_length.mean():.2f} mm in the mean")
    for clearance in (0.01, 0.05, 0.12, 0.3):
        across, along = random.uniform(-0.5, 0.5, 1000), random.uniform(-2.0, 2.0, 1000)
        points = np.column_stack((np.full(1000, 0.5 * WIDTH - clearance), across, along))
        right, wrong = told(in_mm, points, 1.0), told(in_m, points, 1000.0)
        most[longest, clearance] = wrong.max()
        print(f"  {clearance:.2f} mm from the wall: in mm {right.min():.4f} to {right.max():.4f} mm;"
              f" in m {wrong.min():.4f} to {wrong.max():.4f} mm, {wrong.mean():.4f} mm in the mean")
        assert np.abs(right - clearance).max() < 1e-6
assert most[0.75, 0.01] > 0.15 and most[0.75, 0.12] > 0.2 and most[0.375, 0.01] > 0.08
print("As described: in metres, farther than it is.")
PY
