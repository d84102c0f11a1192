r"""
An own wire in an own lumen
===========================

A wire of two sections, a stiff shaft and a soft tip that is bent at rest, in a tapered lumen
through given points. The clamp is in the lumen's entrance, and there is no field.

There is no closed form for the run, but one check: with no wall in reach, an unloaded wire takes
its rest shape. A tip with the rest curvature :math:`\bar\kappa` over a length :math:`l` then turns
by :math:`\bar\kappa\, l`; with 20 1/m over 20 mm that is 0.4, or 22.9 degrees.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw

shaft = mw.Section(
    length=0.1, youngs_modulus=20e6, shear_modulus=7e6, radius=0.5e-3, density=1200.0
)
tip = mw.Section(
    length=0.02,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    radius=0.5e-3,
    density=2000.0,
    magnetization=(0.0, 0.0, 100e3),
    rest_curvature=(0.0, 20.0),
)
wire = mw.Wire((shaft, tip), nodes=121)

# %%
# The check, in open space.

free = mw.Simulation(wire, mw.Lumen.open_space()).equilibrium(feed=wire.length)
turned = float(np.arccos(free.tip_direction[0]))
expected = 20.0 * tip.length
print(f"tip turned by {np.degrees(turned):.2f} degrees, rest shape {np.degrees(expected):.2f}")

# %%
# The lumen: points along its centreline and a radius at each, entrance first.

points = 1e-3 * np.array(
    [[0, 0, 0], [20, 0, 0], [40, 4, 2], [60, 14, 6], [78, 28, 10], [92, 46, 12], [100, 66, 12]]
)
radii = 1e-3 * np.array([4.0, 4.0, 3.6, 3.2, 2.9, 2.7, 2.6])
lumen = mw.Lumen.through(points, radii)

simulation = mw.Simulation(wire, lumen, contact=mw.Barrier(wall="surface"))
result = simulation.run(mw.Feed(speed=2e-3, distance=0.1), time_step=0.02)
data = result.dataset
print(f"status: {result.status}")
print(f"first contact at a feed of {1e3 * result.first_contact:.1f} mm")
print(f"largest tip force {1e3 * result.max_tip_force:.3f} mN")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.4))
shape = 1e3 * data["position"].isel(time=-1)
left.plot(1e3 * data["centreline"][:, 0], 1e3 * data["centreline"][:, 1], color="0.7", ls="--")
left.plot(shape[:, 0], shape[:, 1])
left.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
right.plot(1e3 * data["feed"], 1e3 * data["tip_force"])
right.set(xlabel="feed [mm]", ylabel="force on the tip [mN]")
figure.tight_layout()
plt.show()
