#!/usr/bin/env bash
# Newton 1.8.0: a rod weighs more the finer it is divided, twice its weight and more with segments as long as the radius.
#
# Stiffness is derived of a rod's section and of the length between joints, so that it does not depend on the mesh, and
# one expects mass to be density, section and length as well. It is that of capsules: each segment
# has a half-ball beyond both of its ends, inside of its neighbours, that is 4 r/(3 l) more. With segments ten times
# as long as the radius the rod is 13 percent too heavy, with twice as long 67 percent, and equally long, as
# contact in tight bends wants them, 133 percent. It sags and swings accordingly: a finer mesh goes away from the answer. Remedy: give
# a density divided by 1 + 4 r/(3 l).
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "newton==1.8.0" "warp-lang==1.19.0" numpy
cd "$work"
WARP_CACHE_PATH="$work/kernels" "$work/venv/bin/python" - <<'PY'
import numpy as np
import warp as wp

wp.config.log_level = wp.LOG_ERROR
import newton

LENGTH, RADIUS, DENSITY, YOUNG = 0.1, 1e-3, 1000.0, 3e6
section = np.pi * RADIUS**2

print("Newton", newton.__version__)
for segments in (10, 20, 50, 100):
    rod = newton.Rod.create_straight(
        (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), LENGTH, segment_count=segments, radius=RADIUS,
        youngs_modulus=YOUNG, poissons_ratio=0.49,
    )  # fmt: skip
    builder = newton.ModelBuilder()
    _, joints = builder.add_rod(rod=rod, cfg=newton.ModelBuilder.ShapeConfig(density=DENSITY))
    ratio = sum(builder.body_mass) / (DENSITY * section * LENGTH)
    l = LENGTH / segments
    bend = [k for k in builder.joint_target_ke if abs(k / (YOUNG * np.pi * RADIUS**4 / (4.0 * l)) - 1.0) < 1e-3]
    print(
        f"{segments:3} segments of {l / RADIUS:4.1f} radii: {ratio:.3f} of density x section x length"
        f" (1 + 4 r/(3 l) = {1.0 + 4.0 * RADIUS / (3.0 * l):.3f}); joints stiff by EI/l: {len(bend) > 0}"
    )
    assert abs(ratio - 1.0 - 4.0 * RADIUS / (3.0 * l)) < 1e-3
    assert len(bend) > 0 and len(bend) % (segments - 1) == 0
print("As described: stiffness is that of the rod, mass that of the capsules.")
PY
