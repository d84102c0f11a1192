#!/usr/bin/env bash
# IPC Toolkit 1.6.1: at the same distance a flat wall of triangles pushes once, twice, six or sixty times as hard.
#
# The force of a barrier is thought to be that of the distance, and the mesh of a wall to matter only through its
# shape. As collisions are built by default, each triangle within the barrier's reach pushes by its own
# distance: over the inside of a large triangle one does, over an edge two, over a vertex six, and if edges are a
# sixth of the reach, all of them together 60 times as hard as one. Beside an edge the neighbour's push slants, so a frictionless flat
# wall pushes sideways, by up to 0.24 of the normal force, as much as friction would. A wire's nodes catch on it,
# and clearances, forces and friction are those of the mesh of the vessel, which no finer mesh mends. Remedy: collision_set_type
# OGC, which pushes evenly.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "ipctk==1.6.1" numpy scipy
cd "$work"
"$work/venv/bin/python" - <<'PY'
from importlib.metadata import version

import ipctk
import numpy as np

REACH, GAP = 0.1, 0.05  # mm, of the barrier and of a node over the wall


def push(edge, place, usual=True):
    """Force on a node over a flat wall of triangles with legs of a length [mm], in units of the stiffness."""
    cells = int(np.ceil(0.25 / edge))  # to each side: triangles farther away do not push
    across = edge * np.arange(-cells, cells + 1)
    wall = np.array([[x, y, 0.0] for x in across for y in across])
    a = np.array([i * len(across) + j for i in range(2 * cells) for j in range(2 * cells)])
    b, c, d = a + len(across), a + 1, a + len(across) + 1
    triangles = np.vstack((np.column_stack((a, b, c)), np.column_stack((c, b, d))))
    places = np.vstack((wall, [*place, GAP]))
    mesh = ipctk.CollisionMesh(places, ipctk.edges(triangles), triangles)
    mesh.can_collide = ipctk.make_vertex_patches_filter(np.r_[np.zeros(len(wall), int), 1])  # not with itself
    collisions = ipctk.NormalCollisions()
    if not usual:
        collisions.collision_set_type = ipctk.NormalCollisions.OGC
    collisions.build(mesh, np.asfortranarray(places), REACH)
    return -ipctk.BarrierPotential(REACH, 1.0).gradient(collisions, mesh, places)[-3:]


print("IPC Toolkit", version("ipctk"))
inside = (0.35, 0.35)
one = push(1.0, inside)[2]
for name, edge, place, times in (
    ("inside a triangle of 1 mm", 1.0, inside, 1.0),
    ("over its edge", 1.0, (0.5, 0.0), 2.0),
    ("over its vertex", 1.0, (0.0, 0.0), 6.0),
    ("over triangles of 0.06 mm", 0.0625, (0.02, 0.02), None),
    ("over triangles of 0.03 mm", 0.03125, (0.01, 0.01), None),
    ("over triangles of 0.015 mm", 0.015625, (0.005, 0.005), None),
):
    usual, even = push(edge, place)[2] / one, push(edge, place, usual=False)[2] / one
    print(f"{name:26}: {usual:6.2f} times; by OGC {even:.3f} times")
    assert abs(even - 1.0) < 1e-6
    assert times is None or abs(usual - times) < 1e-6
assert usual > 40.0
beside = np.linspace(0.001, 0.1, 100)
sideways = [push(1.0, (0.5, y)) for y in beside]
slopes = np.array([np.hypot(*force[:2]) / force[2] for force in sideways])
most = int(np.argmax(slopes))
print(f"{beside[most]:.3f} mm beside an edge of 1 mm: {slopes[most]:.2f} of the normal force sideways, without friction")
assert slopes[most] > 0.15
assert all(np.hypot(*push(1.0, (0.5, y), usual=False)[:2]) < 1e-9 for y in beside[::20])
print("As described: a flat wall pushes by its mesh, and sideways.")
PY
