"""
Friction in a spiral
====================

Why pushing becomes hard: a wire is pushed through two and a half turns of a narrow tube, once
without friction and once with a coefficient of 0.2.

The wire presses on the wall with :math:`\\kappa F` per length, its curvature times the force in it,
as a rope around a capstan does. So the force at the guide grows as

.. math:: F = F_0 \\, e^{\\mu \\phi},

with the angle :math:`\\phi = \\int \\kappa \\, \\mathrm{d}s` that the wire has gone round and the
force :math:`F_0` at its tip: its logarithm is a line of slope :math:`\\mu`. Without friction the
force does not grow at all once the wire follows the spiral.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw

# %%
# A nitinol wire of 0.4 mm in a helix that climbs 4 mm a turn.

RADIUS, PITCH, TURNS = 12e-3, 4e-3, 2.5
PER_TURN = float(np.hypot(2.0 * np.pi * RADIUS, PITCH))
LENGTH = TURNS * PER_TURN
FRICTION = 0.2

lumen = mw.Lumen.helix(RADIUS, PITCH, 1.05 * LENGTH, 0.6e-3)
wire = mw.Wire.uniform(LENGTH, 0.2e-3, 50e9, 19e9, 6500.0, 95)


def push(friction: mw.Friction | None) -> mw.Result:
    """The wire pushed in to its end, by equilibria: what it takes does not depend on the speed."""
    simulation = mw.Simulation(wire, lumen, friction=friction)
    return simulation.run(mw.Feed(5e-3, 0.98 * LENGTH), motion="quasi-static", record_every=2e-3)


smooth, rough = push(None), push(mw.Friction(FRICTION))

# %%
# The slope over the last turn, and what friction took of the guide's work.

curvature = RADIUS / (RADIUS**2 + (PITCH / (2.0 * np.pi)) ** 2)
angle = curvature * rough.feed
late = (angle > 2.0 * np.pi) & (angle < 0.95 * angle[-1])
slope = float(np.polyfit(angle[late], np.log(rough.push_force[late]), 1)[0])
work = float(np.trapezoid(rough.push_force, rough.feed))
share = rough.work_of_friction / work
print(f"slope of ln F over the angle: {slope:.3f}, coefficient of friction {FRICTION}")
print(f"push at the end: {smooth.push_force[-1]:.3f} N without, {rough.push_force[-1]:.3f} N with")
print(f"friction took {100 * share:.0f} percent of the work of pushing")

# %%
# The force at the guide and on the tip.

figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.4))
for run, name in ((rough, f"friction {FRICTION}"), (smooth, "no friction")):
    (line,) = left.semilogy(angle[1:], run.push_force[1 : len(angle)], label=name)
    right.plot(angle, run.tip_force[: len(angle)], color=line.get_color(), label=name)
begin = np.flatnonzero(late)[0]
expected = rough.push_force[begin] * np.exp(FRICTION * (angle[late] - angle[begin]))
left.semilogy(angle[late], expected, color="0.4", linestyle="--", label=r"$e^{\mu\phi}$")
left.set(xlabel="angle gone round [rad]", ylabel="push at the guide [N]")
right.set(xlabel="angle gone round [rad]", ylabel="force on the tip [N]", ylim=(0, None))
left.legend(frameon=False)
figure.tight_layout()
plt.show()
