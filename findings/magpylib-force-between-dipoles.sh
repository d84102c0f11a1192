#!/usr/bin/env bash
# magpylib 6.3.0: getFT says that a Dipole as a target is exact, but its force is a difference quotient.
#
# The gradient in the force m . grad B is taken by central differences over eps = 10 um, a length in
# metres that knows nothing of the distance. Two dipoles d apart attract with 6e-7 m^2/d^4 N; what
# comes is larger by (10/3)(eps/d)^2: 3e-6 at 10 mm, 3e-4 at 1 mm and 3.4 percent at 0.1 mm, which is
# the size of magnetic particles and of the gaps between small magnets. "Exact" is meant of the mesh
# of the target alone. With eps a thousandth of the distance the error is 3e-6 everywhere.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install "magpylib==6.3.0"
cd "$work"
"$work/venv/bin/python" - <<'PY'
import magpylib
import numpy as np

assert "``Dipole``\nand ``Sphere``, which are exact" in magpylib.getFT.__doc__.replace("    ", "")
print("magpylib", magpylib.__version__)
for distance in (1e-2, 1e-3, 1e-4):
    source = magpylib.misc.Dipole(moment=(0.0, 0.0, 1.0))
    target = magpylib.misc.Dipole(moment=(0.0, 0.0, 1.0), position=(0.0, 0.0, distance))
    exact = -6.0 * magpylib.mu_0 / (4.0 * np.pi) / distance**4
    usual = magpylib.getFT(source, target)[0][2] / exact - 1.0
    finer = magpylib.getFT(source, target, eps=1e-3 * distance)[0][2] / exact - 1.0
    print(f"{1e3 * distance:5.1f} mm apart: force off by {usual:.2e}; with eps = distance/1000 {finer:.2e}")
    assert abs(usual / (10.0 / 3.0 * (1e-5 / distance) ** 2) - 1.0) < 0.05
    assert abs(finer) < 1e-5
print("As described: off by (10/3)(eps/d)^2.")
PY
