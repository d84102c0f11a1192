r"""
A patient's coronary arteries
=============================

The left coronary tree of one patient: five centrelines that VMTK has found in a CT angiogram, each
from the aortic root to the end of one artery, with the radius of the inscribed ball at each point.
They share their first part; magwire joins them into one tree, takes the noise out, and says how far
that moved them.

The data are from `multimoda-rs <https://github.com/yungselm/multimoda-rs>`_, under the MIT licence
that lies next to the file.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt

import magwire as mw
from magwire.plot import vessels

try:
    here = Path(__file__).parent
except NameError:  # in the gallery
    here = Path.cwd()
file = here / "data" / "coronary_lca_centerlines_multimoda.vtp"

# %%
# The file does not say in which unit it is. The entrance is a point where the left main artery
# leaves the aorta: what lies behind it is cut off.

vessel = mw.Vessel.read(file, "mm", entrance=(19.2e-3, -188.6e-3, 1751.9e-3))
for name, tube in vessel.tubes.items():
    way = vessel.ways[name]
    print(
        f"{name}: {1e3 * tube.length:5.1f} mm, radius {1e3 * tube.radius.min():.2f} to "
        f"{1e3 * tube.radius.max():.2f} mm, bends of {1e3 * tube.bend_radius().radius:.1f} mm, "
        f"smoothing moved it by {1e3 * way.deviation[1]:.2f} mm (rms)"
    )

# %%
# The tree and, per artery, the radius along the path. A wire of 0.6 mm diameter fits all of it.

wire_radius = 0.3e-3
figure = plt.figure(figsize=(8.6, 4.4))
vessels.draw_into(figure, {n: t.centreline() for n, t in vessel.tubes.items()}, wire_radius)
plt.show()

# %%
# A soft wire pushed 30 mm towards the end of the circumflex artery, without a field: the wall bends
# it.

lumen = vessel.lumen(target="end-5")
wire = mw.Wire.uniform(
    length=0.06,
    radius=wire_radius,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    density=2000.0,
    nodes=121,
    magnetized_tip=3e-3,
    magnetization=128e3,
)
simulation = mw.Simulation(wire, lumen, contact=mw.Barrier(activation_gap=0.05e-3))
result = simulation.run(mw.Feed(speed=5e-3, distance=0.03), time_step=0.02)
print(f"status: {result.status}")
print(f"first contact at a feed of {1e3 * result.first_contact:.1f} mm")
print(f"largest tip force {1e6 * result.max_tip_force:.1f} uN")
print(f"smallest clearance {1e6 * result.smallest_clearance:.1f} um")
