r"""
Buckling in an antiparallel field
=================================

A field along the wire's magnetisation stiffens the wire, a field against it softens it. At the
critical strength the straight wire buckles. For a clamped wire that is magnetised over its whole
length, the linearised equation :math:`L^2\,\theta'' + b\,\theta = 0` with
:math:`\theta(0) = \theta'(L) = 0` has a solution first at

.. math:: b_{\mathrm{crit}} = \frac{\mathcal M B L^2}{EI} = \frac{\pi^2}{4} = 2.4674 .

The straight wire is an equilibrium at every strength. What changes is its stability, which is what
the certificate of an equilibrium says.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw


def clamped(nodes: int) -> tuple[mw.Simulation, float]:
    """A wire fed completely into open space, and the field for which b = 1 [T]."""
    wire = mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=nodes,
        magnetized_tip=0.1,
        magnetization=128e3,
    )
    unit_field = wire.bending_stiffness / (wire.moment_per_length * wire.length**2)
    return mw.Simulation(wire, mw.Lumen.open_space()), unit_field


# %%
# Bisection on the stability of the straight wire, for finer and finer meshes.


def critical_strength(nodes: int) -> float:
    """Strength b at which the straight wire loses its stability."""
    simulation, unit_field = clamped(nodes)
    low, high = 2.0, 3.0
    while high - low > 1e-7:
        b = 0.5 * (low + high)
        state = simulation.equilibrium(feed=0.1, field=[-b * unit_field, 0.0, 0.0])
        low, high = (b, high) if state.stable else (low, b)
    return 0.5 * (low + high)


exact = 0.25 * np.pi**2
meshes = np.array([11, 21, 41, 81])
errors = np.array([abs(critical_strength(int(n)) - exact) for n in meshes])
order = float(-np.polyfit(np.log(meshes - 1), np.log(errors), 1)[0])

for nodes, difference in zip(meshes, errors, strict=True):
    print(f"{nodes:3d} nodes: off by {difference:.2e}")
print(f"order of convergence {order:.2f}")

# %%
# Past the critical strength the wire bends to one side. A field that is off by 1 degree decides
# to which.

simulation, unit_field = clamped(81)
direction = np.array([-np.cos(np.radians(1.0)), np.sin(np.radians(1.0)), 0.0])
strengths = np.linspace(0.5, 6.0, 45)
angles = []
state = None
for b in strengths:
    state = simulation.equilibrium(feed=0.1, field=b * unit_field * direction, start=state)
    angles.append(float(np.degrees(np.arctan2(state.tip_direction[1], state.tip_direction[0]))))

figure, axes = plt.subplots(figsize=(5.0, 3.5))
axes.plot(strengths, angles)
axes.axvline(exact, color="0.5", linestyle=":", label="$\\pi^2/4$")
axes.set(xlabel="$b = \\mathcal{M} B L^2 / EI$", ylabel="angle of the tip [degrees]")
axes.legend(frameon=False)
figure.tight_layout()
plt.show()
