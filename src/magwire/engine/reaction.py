"""What the guide does to the wire: push and torque at its mouth (P-38)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System

Array = NDArray[np.float64]


def reaction(system: System, held: int, gradient: Array) -> tuple[float, float]:
    """Push along the guide [N] and torque about it [N m], of the guide on the wire in front.

    Parameters
    ----------
    system
        Wire and guide.
    held
        Last node that the guide holds. What it holds of the wire in front is an edge: two nodes,
        one angle.
    gradient
        Gradient of the energy without inertia, scaled, shape (nodes + 1, 4).
    """
    edge = gradient[held - 1 : held + 1]
    push = float(edge[:, :3].sum(axis=0) @ system.guide.direction)
    scales = system.scales
    return push * scales.force, float(edge[0, 3]) * scales.force * scales.length
