"""What the guide does to the wire: push and torque at its mouth, and what a hand feels (P-38)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.kernels.arrays import Mouth, State

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


def squeeze(system: System, state: State, mouth: Mouth) -> float:
    """Force with which the bend at the guide's mouth squeezes the wire out of the guide [N].

    It is minus the derivative of the energy by the part of the mouth's hinge that is past the
    entrance, per length of it; none where the wire is released node by node (P-15).
    """
    held, part, rod = mouth.held, mouth.fraction, system.rod
    if held >= len(state.tangent) or system.release == "node":
        return 0.0
    (te, d_e), (tf, d_f) = ((state.tangent[j], state.director[j]) for j in (held - 1, held))
    binormal = 2.0 * np.cross(te, tf) / (1.0 + te @ tf)
    first = np.zeros(3)
    second = np.zeros(3)
    for t, d, angle in ((te, d_e, state.q[held - 1, 3]), (tf, d_f, state.q[held, 3])):
        across = np.cross(t, d)
        first += 0.5 * (np.cos(angle) * d + np.sin(angle) * across)
        second += 0.5 * (np.cos(angle) * across - np.sin(angle) * d)
    rest = rod.rest_curvature[held]
    bend = np.array([second @ binormal, -first @ binormal]) / part
    twist = (state.q[held, 3] - state.q[held - 1, 3] + state.twist[held]) / part
    density = 0.5 * rod.bend[held] * (bend @ bend - rest @ rest) + 0.5 * rod.twist[held] * twist**2
    return float(density / rod.cell[held]) * system.scales.force
