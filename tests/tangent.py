"""The tangent stiffness and the lumped mass of an equilibrium, for tests that need them whole."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.statics import Equilibrium
from magwire.kernels.arrays import Motion, State
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.history import copy_state

Array = NDArray[np.float64]


def free_rows(state: Equilibrium) -> slice:
    """Which of the flat unknowns (4 for each node, ghost first) are free."""
    held, count = state.point.mouth.held, len(state.point.state.q)
    return slice(4 * (held - 1) + FIRST, 4 * count - 1)


def stiffness(state: Equilibrium) -> Array:
    """Dense tangent stiffness of the free unknowns, scaled."""
    point = state.point
    system, work = point.system, point.system.new_work()
    model = system.new_terms(point.field)
    still = Motion(0.0, work.target)
    assemble(model, point.state, point.mouth, still, work.gradient, work.band)
    rows = free_rows(state)
    size = rows.stop - rows.start
    band = work.band[FIRST : FIRST + size]
    dense = np.zeros((size, size))
    for k in range(band.shape[1]):
        column = np.arange(size - k)
        dense[column + k, column] = dense[column, column + k] = band[: size - k, k]
    return dense


def mass(state: Equilibrium) -> Array:
    """Lumped mass of the free unknowns, scaled, so that stiffness over mass is in 1/s^2."""
    rod = state.point.system.rod
    whole = np.zeros((len(rod.station), 4))
    whole[:, :3] = rod.mass[:, None]
    whole[:-1, 3] = rod.inertia
    return np.asarray(whole.ravel()[free_rows(state)])


def copy(state: Equilibrium) -> State:
    """A state that a test may change."""
    fresh = state.point.system.new_state()
    copy_state(state.point.state, fresh)
    return fresh
