"""Wires of any stiffness in a half-circle that leaves their axes 3 mm to either side.

Without friction and a field F L^2/EI of a hard wall depends on the shape of what the axis may go
through, and neither on E nor on the radius: all wires have the same peak.
"""

from __future__ import annotations

import numpy as np

import magwire as mw
from magwire.results import Result

L = 0.1
FREE = 3e-3
PEAK = 20.77
"""Of half-circle.csv in data/hard_wall."""

MODULI = (1e6, 30e6, 1e9, 60e9, 200e9)
RADII = (0.1e-3, 0.2e-3, 0.6e-3, 1.2e-3)
"""Diameters of 0.2 and 1.2 mm, and radii of 0.2 and 1.2 mm."""

STEPS = {"1 ms": 1e-3, "10 ms": 10e-3, "100 ms": 100e-3, "quasi-static": None}


def pushed(
    modulus: float,
    radius: float,
    step: float | None,
    *,
    push: float = 0.72,
    nodes: int = 100,
    speed: float = 1e-3,
) -> tuple[Result, float]:
    """A run with the default wall, and its peak of F L^2/EI; no step is quasi-static motion."""
    wire = mw.Wire.uniform(L, radius, modulus, modulus / 2.6, 4000.0, nodes)
    simulation = mw.Simulation(wire, mw.Lumen.half_circle(0.25 * L, FREE + radius))
    feed = mw.Feed(speed, push * L)
    if step is None:
        result = simulation.run(feed, motion="quasi-static")
    else:
        result = simulation.run(feed, time_step=step)
    scale = np.pi / 4.0 * radius**4 * modulus / L**2
    return result, result.max_tip_force / scale
