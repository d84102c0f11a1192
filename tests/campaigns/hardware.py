"""The paper's cases in a stated Helmholtz set, replayed through hardware with errors of all signs.

``python -m campaigns.hardware MARGIN TOLERANCE OBJECTIVE [CASE ...]`` prints, for a margin of
stability [1/s^2], a gain tolerance and "field" or "power", what docs/lab.md has in its last table.
"""

from __future__ import annotations

import itertools
import sys

import numpy as np

import magwire as mw
from magwire.actuate import Circuit, Hardware, Helmholtz, Pair, Pose
from magwire.navigate.allocation import Objective
from magwire.scenario import inputs_of

CASES = ("half-circle", "sinusoid", "helix", "left-branch", "middle-branch", "right-branch")
CIRCUIT = Circuit(resistance=1.0, inductance=5e-3, supply=48.0)
TIME_STEP = 0.02  # [s]
RADII = {"x": 0.08, "y": 0.10, "z": 0.12}


def platform(way: np.ndarray) -> Helmholtz:
    """Three nested pairs around the middle of a path, shape (n, 3) [m]."""
    middle = 0.5 * (way.min(axis=0) + way.max(axis=0))
    return Helmholtz(
        pairs=tuple(
            Pair(axis, radius, 200.0, max_current=48.0, circuit=CIRCUIT)
            for axis, radius in RADII.items()
        ),
        pose=Pose(translation=tuple(middle.tolist())),
    )


def main(margin: float, tolerance: float, objective: Objective, cases: tuple[str, ...]) -> None:
    """Plan and replay."""
    demands = mw.Demands(stability_margin=margin, gain_tolerance=tolerance)
    steering = mw.Allocated(mw.TipNavigator(demands, update_every=1e-3), objective=objective)
    for case in cases:
        job = mw.load_scenario(case).build()
        system, feed = job.simulation.system, job.feed
        simulation = mw.Simulation(
            system.wire,
            system.lumen,
            contact=system.contact,
            actuator=platform(system.path.centreline()[0]),
        )
        plan = simulation.run(feed, steering, time_step=TIME_STEP)
        peak, power = np.abs(plan.inputs).max(), plan.power.max()
        print(
            f"{case}: {plan.status}, {peak:.1f} A, {power:.0f} W, {1e3 * plan.peak_field:.1f} mT "
            f"{plan.message}",
            flush=True,
        )
        if plan.status != "complete":
            continue
        played = mw.Prescribed(inputs_of(plan))
        for signs in itertools.product((1.0, -1.0), repeat=3):
            errors = tuple(0.03 * sign for sign in signs)
            hardware = Hardware(quantum=0.01, delay=0.05, gain_errors=errors)
            made = simulation.run(feed, played, time_step=TIME_STEP, hardware=hardware)
            clear = 1e3 * float(np.nanmin(made.clearance[:, -1]))
            print(
                f"  {signs}: {made.status}, {made.max_tip_force:.3g} N, {clear:.2f} mm", flush=True
            )


if __name__ == "__main__":
    which: Objective = "power" if sys.argv[3] == "power" else "field"
    main(float(sys.argv[1]), float(sys.argv[2]), which, tuple(sys.argv[4:]) or CASES)
