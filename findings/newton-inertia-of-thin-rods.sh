#!/usr/bin/env bash
# Newton 1.8.0: the segments of thin wires are given 1e-6 kg m^2 of inertia, and bend as many times too slowly.
#
# A rod of radius, Young's modulus and density is thought to swing by its own mass and stiffness. But when the model is
# finalized, a segment with a principal moment below 1e-10 kg m^2 is taken for one without inertia, and 1e-6 is
# added to all three. That is so for wires below some 4 mm, and finer meshes make it worse: a silicone rod of 2 mm
# with segments of 5 mm has 7e-11 and gets 1e-6; its lowest mode of bending, pinned at both ends, is 7 times too slow, that
# of a wire of 0.36 mm 54 times, and damping and magnetic torques are answered as slowly. One warning comes for the whole model: "corrected", without
# numbers, which one reads as good news. Rods of 4 mm and more stay as they are. Remedy: build in
# millimetres and milligrams, or write body_inertia and body_inv_inertia into the finalized model.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "newton==1.8.0" "warp-lang==1.19.0" numpy
cd "$work"
WARP_CACHE_PATH="$work/kernels" "$work/venv/bin/python" - <<'PY'
import warnings

import numpy as np
import warp as wp

wp.config.log_level = wp.LOG_ERROR
import newton

DENSITY, YOUNG = 1000.0, 3e6  # kg/m^3, Pa

print("Newton", newton.__version__)
slower = {}
for diameter, length, segments in ((4e-3, 0.1, 20), (2e-3, 0.1, 20), (1e-3, 0.1, 20), (0.36e-3, 0.1, 33)):
    rod = newton.Rod.create_straight(
        (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), length, segment_count=segments, radius=0.5 * diameter,
        youngs_modulus=YOUNG, poissons_ratio=0.49,
    )  # fmt: skip
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    builder.add_rod(rod=rod, cfg=newton.ModelBuilder.ShapeConfig(density=DENSITY))
    own = np.diag(np.array(builder.body_inertia[3]).reshape(3, 3))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        model = builder.finalize(device="cpu")
    given = np.diag(model.body_inertia.numpy()[3])
    assert np.allclose(model.body_inv_inertia.numpy()[3] @ model.body_inertia.numpy()[3], np.eye(3), atol=1e-3)
    # pinned rod: omega^2 = EI q^4/(m/l + (J/l) q^2), q = pi/L
    per_length, q = segments / length, np.pi / length
    mass = float(model.body_mass.numpy()[3])
    slower[diameter] = np.sqrt((mass + given[0] * q**2) * per_length / ((mass + own[0] * q**2) * per_length))
    print(
        f"{1e3 * diameter:4.2f} mm, segments of {1e3 * length / segments:.0f} mm: {own[0]:.1e} and {own[2]:.1e} kg m^2,"
        f" in the model {given[0]:.1e} and {given[2]:.1e}; lowest mode {slower[diameter]:.1f} times slower;"
        f" said: {[str(one.message) for one in said]}"
    )
    if diameter < 3e-3:
        assert np.all(given > 0.99e-6) and own[0] < 1e-10 and len(said) == 1
    else:
        assert np.allclose(given, own, rtol=1e-5) and not said
assert slower[2e-3] > 5.0 and slower[0.36e-3] > 40.0
print("As described: thin wires are slow.")
PY
