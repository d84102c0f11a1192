"""A start for an equilibrium that is somewhere else than an equilibrium that is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from magwire.engine.statics import Equilibrium
from magwire.kernels.frames import update_frames
from magwire.kernels.history import copy_state

Array = NDArray[np.float64]


def placed(known: Equilibrium, positions: Array) -> Equilibrium:
    """The known equilibrium with its free nodes elsewhere, as a start.

    Frames are carried along the way, so that no edge turns about itself; positions as the
    equilibrium has them, shape (nodes, 3) [m].
    """
    point = known.point
    state, held = point.system.new_state(), point.mouth.held
    copy_state(point.state, state)
    state.q[held + 1 :, :3] = positions[held:] / point.system.wire.length
    update_frames(point.state, state, held)
    return replace(known, point=replace(point, state=state))
