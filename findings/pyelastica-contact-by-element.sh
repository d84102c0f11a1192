#!/usr/bin/env bash
# PyElastica 1.0.0: the contact spring of a rod is that of each element, so that finer rods meet a harder wall.
#
# RodCylinderContact takes a "contact spring constant" k, and a rod that lies along a cylinder is pushed by k times
# the overlap, or by that for a length, one would think. It is pushed by that for each element, however
# long that is: the same rod with the same overlap by 10 mN with 5 elements and by 80 mN with 40. So a
# finer mesh indents less under the same load, stiffens whatever is in contact and lowers the step that is
# stable with it, while a k that was chosen for an indentation, or fitted to one, holds for one mesh. The damping nu is by the element, too, so
# that the two keep their proportion and nothing looks amiss. Remedy: give k and nu times the length of an
# element, for a stiffness by length.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "pyelastica==1.0.0"
cd "$work"
"$work/venv/bin/python" - <<'PY'
from importlib.metadata import version

import elastica as ea
import numpy as np

LENGTH, THIN, WIDE, OVERLAP = 0.1, 1e-3, 5e-3, 0.1e-3  # m
SPRING, DAMPING, SPEED = 20.0, 0.05, 0.01  # N/m, N s/m, m/s


class Simulator(ea.BaseSystemCollection, ea.Contact):
    pass


def push(elements, spring, damping=0.0):
    """Force on a rod that lies along a cylinder, a little inside of it and moving inwards [N]."""
    along, across = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    rod = ea.CosseratRod.straight_rod(
        elements, np.zeros(3), along, across, LENGTH, THIN, 1000.0, youngs_modulus=1e7, shear_modulus=1e7 / 3.0
    )
    below = np.array([-0.5 * LENGTH, 0.0, OVERLAP - THIN - WIDE])
    cylinder = ea.Cylinder(below, along, across, 2.0 * LENGTH, WIDE, 1000.0)
    simulator = Simulator()
    simulator.append(rod)
    simulator.append(cylinder)
    simulator.detect_contact_between(rod, cylinder).using(ea.RodCylinderContact, k=spring, nu=damping)
    simulator.finalize()
    rod.velocity_collection[2] = -SPEED
    simulator.synchronize(0.0)
    return rod.external_forces[2].sum()


print("PyElastica", version("pyelastica"))
for elements in (5, 10, 20, 40):
    force, more = push(elements, SPRING), push(elements, SPRING, DAMPING) - push(elements, SPRING)
    even = push(elements, SPRING * 5 / elements)
    print(
        f"{elements:2} elements: {1e3 * force:6.2f} mN, {force / (SPRING * OVERLAP):5.2f} times k x overlap;"
        f" damping {more / (DAMPING * SPEED):5.2f} times nu x speed; with k by the length {1e3 * even:6.2f} mN"
    )
    assert abs(force / (elements * SPRING * OVERLAP) - 1.0) < 1e-3
    assert abs(even / (5 * SPRING * OVERLAP) - 1.0) < 1e-3
    assert abs(more / (elements * DAMPING * SPEED) - 1.0) < 0.2
print("As described: one spring for each element.")
PY
