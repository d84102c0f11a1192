#!/usr/bin/env bash
# PyElastica 1.0.0: the largest time step of a slender rod is set by its radius, not by its elements.
#
# An explicit step is thought to be limited by the time a wave takes through an element, dx/c with
# c = sqrt(E/rho), and coarser elements to allow longer steps. For a Cosserat rod they do not: each
# element's frame rocks against its tangent on the shear stiffness, with 2 sqrt(27 G/(28 rho))/r whatever
# its length, and the step must stay below r/sqrt(27 G/(28 rho)). With dx = 20 r, a usual mesh of a
# catheter, that is an eleventh of dx/c, and for a guidewire of r = 0.18 mm, with elements of 10 mm, a
# thirtieth. Beyond it no error and no NaN comes: frames spin, numbers stay finite, and a rod that
# should bend by a thousandth of its length ends anywhere. So: choose the step by the radius, and look
# at shear strains before believing a coarse rod.
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

LENGTH, YOUNG, DENSITY = 1.0, 1e6, 1000.0
SHEAR = YOUNG / 3.0
WAVE, SHEAR_WAVE = np.sqrt(YOUNG / DENSITY), np.sqrt(27.0 / 28.0 * SHEAR / DENSITY)


class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing):
    pass


def farthest(radius, elements, step, count=2000):
    """Farthest from its axis that a clamped rod is under a small force at its tip [m]."""
    rod = ea.CosseratRod.straight_rod(
        elements, np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]),
        LENGTH, radius, DENSITY, youngs_modulus=YOUNG, shear_modulus=SHEAR,
    )  # fmt: skip
    simulator = Simulator()
    simulator.append(rod)
    simulator.constrain(rod).using(
        ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    force = 3e-3 * YOUNG * np.pi * radius**4 / (4.0 * LENGTH**2)  # bends it by a thousandth of L
    simulator.add_forcing_to(rod).using(
        ea.EndpointForces, np.zeros(3), np.array([0.0, force, 0.0]), ramp_up_time=1e-9
    )
    simulator.finalize()
    stepper, time = ea.PositionVerlet(), 0.0
    for _ in range(count):
        time = stepper.step(simulator, time, step)
    return float(np.abs(rod.position_collection[1]).max())


print("PyElastica", version("pyelastica"))
np.seterr(all="ignore")
limits = {}
for radius, elements in ((0.01, 20), (0.01, 10), (0.01, 5), (0.005, 5)):
    low, high = 0.1 * radius / SHEAR_WAVE, 2.0 * LENGTH / elements / WAVE
    for _ in range(12):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if farthest(radius, elements, middle) < 0.01 else (low, middle)
    limits[radius, elements] = low
    print(f"r = {1e3 * radius:4.1f} mm, {elements:2} elements: steps up to {1e3 * low:.3f} ms;"
          f" r/sqrt(27 G/(28 rho)) = {1e3 * radius / SHEAR_WAVE:.3f} ms,"
          f" dx/c = {1e3 * LENGTH / elements / WAVE:.3f} ms")
    assert 0.88 < low / (radius / SHEAR_WAVE) < 1.01
    assert low < 0.35 * LENGTH / elements / WAVE
lost = farthest(0.01, 5, 0.2 * LENGTH / 5 / WAVE)
print(f"5 elements, a step of 0.2 dx/c: the rod is {lost:.3g} m from its axis, and should be near 0.001 m")
assert np.isfinite(lost) and lost > 0.1
print("As described: the radius sets the step, and beyond it the numbers stay finite.")
PY
