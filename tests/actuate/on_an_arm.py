"""How a run kept a magnet on an arm off the vessel, and how fast it was moved."""

from __future__ import annotations

import numpy as np

from magwire import Result
from magwire.actuate import Magnet
from magwire.scenario import Scenario


def nearest(scenario: Scenario, result: Result) -> float:
    """Smallest distance of the magnet from the vessel [m]."""
    assert scenario.actuator is not None
    magnet = scenario.actuator.build()
    assert isinstance(magnet, Magnet)
    lumen = np.column_stack([result.dataset["centreline"].values, result.dataset["lumen_radius"]])
    return min(float((magnet.distance(u, lumen[:, :3]) - lumen[:, 3]).min()) for u in result.inputs)


def fastest(result: Result) -> float:
    """Largest speed of the magnet along x, y or z between two records [m/s]."""
    steps = np.abs(np.diff(result.inputs[:, :3], axis=0)) / np.diff(result.time)[:, None]
    return float(steps.max())
