r"""
A magnetic cantilever
=====================

A clamped wire, magnetised along its axis over its whole length, in a uniform field across it. It is
the hard-magnetic elastica: with the angle :math:`\theta(s)` of the tangent, the moment
:math:`\mathcal M` per unit length and :math:`b = \mathcal M B L^2 / EI`,

.. math:: L^2\,\theta'' + b \cos\theta = 0, \qquad \theta(0) = 0, \quad \theta'(L) = 0 .

Multiplied by :math:`\theta'` and integrated once it gives an equation for the angle
:math:`\theta_1` of the tip,

.. math::

   \int_0^{\theta_1} \frac{\mathrm d\theta}{\sqrt{2 b\,(\sin\theta_1 - \sin\theta)}} = 1 .

For :math:`b = 2` the tip turns by 44.79 degrees.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

import magwire as mw

# %%
# The reference: the integral above, solved for the angle of the tip. The substitution
# :math:`\sin\theta = \sin\theta_1\,(1 - u^2)` takes the singularity out of it.


def tip_angle(b: float) -> float:
    """Angle of the tip [rad] from the first integral of the elastica."""

    def length(angle: float) -> float:
        top = np.sin(angle)
        value, _ = quad(lambda u: 2 * top / np.sqrt(1 - (top * (1 - u**2)) ** 2), 0.0, 1.0)
        return float(value / np.sqrt(2.0 * b * top))

    return float(brentq(lambda angle: length(angle) - 1.0, 1e-6, 0.5 * np.pi - 0.05))


# %%
# The wire is fed completely into open space, so that it is clamped by its end.

wire = mw.Wire.uniform(
    length=0.1,
    radius=0.6e-3,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    density=2000.0,
    nodes=100,
    magnetized_tip=0.1,
    magnetization=128e3,
)
simulation = mw.Simulation(wire, mw.Lumen.open_space())
unit_field = wire.bending_stiffness / (wire.moment_per_length * wire.length**2)  # b = 1 [T]

strengths = np.array([0.25, 0.5, 1.0, 2.0, 4.0, 8.0])
states = [simulation.equilibrium(feed=0.1, field=[0.0, b * unit_field, 0.0]) for b in strengths]

# %%
# The direction of the tip against the closed form; what is left is of second order in the edge
# length.

expected = np.array([tip_angle(b) for b in strengths])
tips = np.array([state.tip_direction for state in states])
found = np.arctan2(tips[:, 1], tips[:, 0])
error = float(np.max(np.abs(found - expected)))

for b, angle, exact in zip(strengths, np.degrees(found), np.degrees(expected), strict=True):
    print(f"b = {b:4.2f}: tip at {angle:6.3f} degrees, elastica {exact:6.3f} degrees")
print(f"largest difference {np.degrees(error):.1e} degrees")
print(f"all stable: {all(state.stable for state in states)}")

# %%
figure, axes = plt.subplots(figsize=(5.0, 4.0))
for b, state in zip(strengths, states, strict=True):
    axes.plot(1e3 * state.positions[:, 0], 1e3 * state.positions[:, 1], label=f"b = {b:g}")
axes.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
axes.legend(frameon=False)
figure.tight_layout()
plt.show()
