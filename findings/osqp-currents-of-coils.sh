#!/usr/bin/env bash
# OSQP 1.1.3: "solved" means nothing for coil currents whose field is in tesla, and "infeasible" has currents.
#
# The currents of a coil system that come nearest to a wanted field within their limits, min |A i - B|^2,
# are a quadratic programme of eight unknowns, and a solver that says "solved" is thought to be right to
# some digits. A has entries of mT/A, so the gradient is below OSQP's tolerance of 1e-3 almost at once: for
# 20 mT wanted it stops, solved, with 0.1 mT. scipy's SLSQP stops with no current at all: "Optimization
# terminated successfully". Both tolerances are absolute and both know nothing of units; DAQP and Clarabel
# find the field. If the field is asked for as a constraint and cannot be reached, OSQP's x is not empty
# and not NaN but currents of giga-amperes, and only the status tells. Remedy: work in mT and in parts of
# the limits, and look at the field that comes out, not at the status.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check --quiet install \
  "osqp==1.1.3" "daqp==0.11.0" "clarabel==0.11.1" "scipy==1.17.1" numpy
cd "$work"
"$work/venv/bin/python" - <<'PY'
from ctypes import c_int
from importlib.metadata import version

import clarabel
import daqp
import numpy as np
import osqp
from scipy import sparse
from scipy.optimize import minimize

LIMIT, MOMENT, DISTANCE = 20.0, 25.0, 0.12  # A; A m^2 for each ampere, with an iron core; m
around = np.arange(4) * np.pi / 2.0
places = np.vstack((
    np.column_stack((np.cos(around), np.sin(around), 0.0 * around)),
    np.column_stack((np.cos(around + np.pi / 4.0), np.sin(around + np.pi / 4.0), 0.0 * around + 1.0)) / [[2**0.5, 2**0.5, 2**0.5]],
))  # fmt: skip
places /= np.linalg.norm(places, axis=1, keepdims=True)
unit = -1e-7 * 2.0 * MOMENT / DISTANCE**3 * places.T  # flux density in the middle [T/A], dipoles that point there
wanted = np.array([0.0, 0.0, 0.02])
hessian, gradient = unit.T @ unit, -unit.T @ wanted


def by_osqp(p, q, a, low, high):
    solver = osqp.OSQP()
    solver.setup(sparse.csc_matrix(p), q, sparse.csc_matrix(a), low, high, verbose=False)
    return solver.solve()


one, box = np.eye(8), np.full(8, LIMIT)
nearest = by_osqp(hessian, gradient, one, -box, box)
slsqp = minimize(lambda i: np.sum((unit @ i - wanted) ** 2), np.zeros(8), bounds=[(-LIMIT, LIMIT)] * 8, method="SLSQP")
exact, _, flag, _ = daqp.solve(hessian, gradient, np.zeros((0, 8)), box, -box, np.zeros(8, dtype=c_int))
settings = clarabel.DefaultSettings()
settings.verbose = False
inner = clarabel.DefaultSolver(
    sparse.triu(sparse.csc_matrix(hessian)).tocsc(), gradient, sparse.csc_matrix(np.vstack((one, -one))),
    np.concatenate((box, box)), [clarabel.NonnegativeConeT(16)], settings,
).solve()  # fmt: skip
print("wanted", 1e3 * wanted, "mT, with at most", LIMIT, "A")
for name, said, currents in (
    (f"OSQP {version('osqp')}", nearest.info.status, nearest.x),
    (f"SLSQP of scipy {version('scipy')}", slsqp.message, slsqp.x),
    (f"DAQP {version('daqp')}", f"flag {flag}", exact),
    (f"Clarabel {version('clarabel')}", inner.status, np.array(inner.x)),
):
    print(f"  {name:22} {said!s:38} field {np.round(1e3 * unit @ currents, 4)} mT, up to {np.abs(currents).max():.4f} A")
assert nearest.info.status == "solved" and np.linalg.norm(unit @ nearest.x) < 0.02 * np.linalg.norm(wanted)
assert slsqp.success and np.linalg.norm(unit @ slsqp.x) < 0.02 * np.linalg.norm(wanted)
for right in (exact, np.array(inner.x)):
    assert np.linalg.norm(unit @ right - wanted) < 1e-3 * np.linalg.norm(wanted)

scaled = by_osqp(1e6 * hessian * LIMIT**2, 1e6 * gradient * LIMIT, one, -np.ones(8), np.ones(8))
print(f"  OSQP in mT and parts of the limit: {scaled.info.status}, field {np.round(1e3 * unit @ scaled.x * LIMIT, 3)} mT")
assert np.linalg.norm(unit @ scaled.x * LIMIT - wanted) < 1e-2 * np.linalg.norm(wanted)

far = np.array([0.0, 0.0, 0.5])
never = by_osqp(one, np.zeros(8), np.vstack((unit, one)), np.r_[far, -box], np.r_[far, box])
print(f"wanted {1e3 * far} mT as a constraint: OSQP says {never.info.status}, and x is {never.x[:3]} ... A")
assert "infeasible" in never.info.status and np.all(np.isfinite(never.x)) and np.abs(never.x).max() > 1e3 * LIMIT
print("As described: solved, with a hundredth of the field; infeasible, with currents.")
PY
