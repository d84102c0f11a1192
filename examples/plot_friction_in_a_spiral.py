r"""
Friction in a spiral
====================

Why pushing becomes hard: a wire is pushed through two turns of a spiral tube, once without friction
and once with a coefficient of 0.3.

The wire presses on the wall with :math:`\kappa F` per length, its curvature times the force in it,
as a rope around a capstan does. So the force at the guide grows as

.. math:: F = F_0 \, e^{\mu \phi},

with the angle :math:`\phi = \int \kappa \, \mathrm{d}s` that the wire has gone round: its
logarithm is a line of slope :math:`\mu`, where the force is large against that of bending,
:math:`EI\kappa^2/2`. As friction acts on the wire's surface, which goes farther round than its
axis, the slope is larger by about the wire's radius over that of the turn. Without friction the
force does not grow at all once the wire follows the spiral.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw
from magwire.evidence.verify.references.sliding import arc_growth

# %%
# The paper's material in a helix of 10 mm that climbs 5 mm a turn.

RADIUS, PITCH, LENGTH, THICK, FRICTION = 10e-3, 5e-3, 158e-3, 0.5e-3, 0.3
lumen = mw.Lumen.helix(RADIUS, PITCH, 1.05 * LENGTH, 2e-3)
wire = mw.Wire.uniform(LENGTH, THICK, 3e6, 1e6, 2000.0, 100)
wall = mw.Barrier(1e6, 5e-5)


def push(friction: mw.Friction | None) -> mw.Result:
    """The wire pushed in to its end."""
    simulation = mw.Simulation(wire, lumen, contact=wall, friction=friction)
    return simulation.run(mw.Feed(10e-3, 0.98 * LENGTH), time_step=0.02, record_every=2e-3)


smooth, rough = push(None), push(mw.Friction(FRICTION))

# %%
# The angle that the wire has gone round, the slope over the last turn, and what friction took.

edges = np.diff(rough.position, axis=1)
edges /= np.linalg.norm(edges, axis=2)[:, :, None]
turns = np.clip((edges[:, 1:] * edges[:, :-1]).sum(axis=2), -1.0, 1.0)
angle = np.arccos(turns).sum(axis=1)
late = angle > angle[-1] - 2.0 * np.pi
slope = float(np.polyfit(angle[late], np.log(rough.push_force[late]), 1)[0])
expected = arc_growth(FRICTION, -THICK / (RADIUS + 2e-3 - THICK))
share = rough.work_of_friction / float(np.trapezoid(rough.push_force, rough.feed))
print(f"slope of ln F over the angle: {slope:.3f}, expected {expected:.3f}")
print(
    f"push at the end: {1e3 * smooth.push_force[-1]:.2f} mN without, "
    f"{1e3 * rough.push_force[-1]:.2f} mN with friction"
)
print(f"friction took {100 * share:.0f} percent of the work of pushing")

# %%
# The force at the guide, and that on the tip: that grows by a third, and then no more.

figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.4), layout="constrained")
for run, name in ((rough, f"friction {FRICTION}"), (smooth, "no friction")):
    (line,) = left.semilogy(angle[5:], 1e3 * run.push_force[5:], label=name)
    right.plot(angle, 1e3 * run.tip_force, color=line.get_color(), label=name)
begin = np.flatnonzero(late)[0]
line = rough.push_force[begin] * np.exp(expected * (angle[late] - angle[begin]))
left.semilogy(angle[late], 1e3 * line, color="0.3", linestyle="--", label=r"$e^{\mu\phi}$")
left.set(xlabel="angle gone round [rad]", ylabel="push at the guide [mN]")
right.set(xlabel="angle gone round [rad]", ylabel="force on the tip [mN]", ylim=(0, None))
left.legend(frameon=False)
plt.show()
