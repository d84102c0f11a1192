"""The direction of the wire at its very tip, half an edge past where the last edge is seen.

The bending moment vanishes at a free end, so that there the wire has its rest curvature. The tip
points where the last edge does, turned by the rest curvature of the half cell before the tip. What
loads on that half cell bend is of second order in the edge (P-16).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.kernels.arrays import State
from magwire.kernels.hinge import material_frame

Array = NDArray[np.float64]


def tip_direction(system: System, state: State, held: int) -> Array:
    """Unit tangent at the tip, shape (3,); that of the guide while it holds the tip.

    Parameters
    ----------
    system
        What the state is one of.
    state
        Where the wire is.
    held
        The last node that the guide holds.
    """
    edge = state.q[-1, :3] - state.q[-2, :3]
    tangent: Array = edge / np.linalg.norm(edge)
    if held == system.wire.nodes:
        return tangent
    m1, m2 = material_frame(tuple(state.director[-1]), tuple(tangent), state.q[-2, 3])
    first, second = system.mesh.rest_turn[-1]
    angle = np.hypot(first, second)
    aside = first * np.array(m1) + second * np.array(m2)
    result: Array = np.cos(angle) * tangent + np.sinc(angle / np.pi) * aside
    return result


def tip_direction_moves(system: System, state: State, held: int, moved: Array) -> Array:
    """Change of the tip's direction, shape (3, inputs), with that of all unknowns.

    The direction is fixed in the last edge's material frame, so it turns as that does: about the
    edge by its angle, and with the edge by what its ends move across it.

    Parameters
    ----------
    system, state, held
        See ``tip_direction``.
    moved
        Scaled, shape (inputs, nodes + 1, 4).
    """
    edge = state.q[-1, :3] - state.q[-2, :3]
    size = np.linalg.norm(edge)
    tangent = edge / size
    turned = np.cross(tangent, moved[:, -1, :3] - moved[:, -2, :3]) / size
    turned += moved[:, -2, 3, None] * tangent
    result: Array = np.cross(turned, tip_direction(system, state, held)).T
    return result
