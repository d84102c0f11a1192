"""Natural frequencies of an equilibrium: its tangent stiffness against its lumped mass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from magwire.engine.statics import Equilibrium
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import FIRST, assemble

Array = NDArray[np.float64]


def natural_frequencies(state: Equilibrium, count: int) -> tuple[Array, Array]:
    """Lowest angular frequencies and their modes, without damping.

    Returns
    -------
    frequencies
        Shape (count,) [rad/s]; NaN where the equilibrium is unstable.
    modes
        Shape of each, by node and x, y, z, twist angle; zero on the guide, shape (count, nodes, 4).
    """
    point = state.point
    system, work, held = point.system, point.system.new_work(), point.mouth.held
    model = system.new_terms(point.field)
    assemble(model, point.state, point.mouth, Motion(0.0, work.target), work.gradient, work.band)
    nodes = system.wire.nodes
    size = 4 * (nodes + 1 - held) - 4
    band = work.band[FIRST : FIRST + size]
    dense = np.zeros((size, size))
    for k in range(band.shape[1]):
        column = np.arange(size - k)
        dense[column + k, column] = dense[column, column + k] = band[: size - k, k]
    whole = np.column_stack(
        (np.tile(system.rod.mass[:, None], 3), np.append(system.rod.inertia, 0))
    )
    free = slice(4 * held + 3, 4 * held + 3 + size)
    root = 1.0 / np.sqrt(whole.ravel()[free])
    scaled = root[:, None] * dense * root
    squares, vectors = eigh(scaled, subset_by_index=(0, count - 1))
    modes = np.zeros((count, 4 * (nodes + 1)))
    modes[:, free] = (root[:, None] * vectors).T
    with np.errstate(invalid="ignore"):
        return np.sqrt(squares), modes.reshape(count, nodes + 1, 4)[:, 1:]
