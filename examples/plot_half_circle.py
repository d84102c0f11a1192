"""
Pushing a wire through a half-circle
====================================

The paper's first case: a wire of 100 mm is pushed without a field through a lumen along half a
circle of radius 25 mm, with a diameter of 0.06 times the wire's length.

There is no closed form. A calculation with an inextensible wire and a hard wall, by nonlinear
programming, gives a peak of the normalised tip force :math:`F^* = F L^2 / EI` of 20.8 for a wire
that is clamped at the entrance, and of 19.7 for a clamp 0.15 wire lengths in front of it.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

import magwire as mw

# %%
# The scenario of the library without its steering, loaded and built. The same can be written down
# in Python, as in the example on an own wire.

job = mw.load_scenario("half-circle", ["navigate.method=none"]).build()
result = job.run()

data = result.dataset
peak = float(data["normalized_tip_force"].max())
clearance = float(np.nanmin(data["clearance"]))
print(f"status: {result.status}")
print(f"largest tip force {1e3 * result.max_tip_force:.3f} mN, normalised {peak:.2f}")
print(f"smallest clearance {1e6 * clearance:.2f} um")

# %%
# The shapes, and the force on the tip over the push.

figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.6))
for push in (0.1, 0.3, 0.5, 0.7):
    index = int(np.argmin(np.abs(data["normalized_push"].values - push)))
    shape = 1e3 * data["position"].isel(time=index)
    left.plot(shape[:, 0], shape[:, 1], label=f"X = {push}")
centreline = 1e3 * data["centreline"]
left.plot(centreline[:, 0], centreline[:, 1], color="0.7", linestyle="--")
left.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal", xlim=(-20, 40))
left.legend(frameon=False)
right.plot(data["normalized_push"], data["normalized_tip_force"])
right.set(xlabel="X = feed / L", ylabel="$F^*$")
figure.tight_layout()
plt.show()
