"""The virtual tube, which holds a navigator's model on the centreline (P-19)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.lumen import Lumen
from magwire.navigate.model import InModel, Model

Array = NDArray[np.float64]

TUBE = 0.01  # radius of the virtual tube, in the lumen's radius (P-19)
RANK = 1e-3  # directions of the field that move the tip by less than this part are left alone


class TubeNavigator:
    """What navigators by the virtual tube's force have in common.

    Parameters
    ----------
    system
        Wire, lumen and wall as the navigator believes them to be.
    path
        The tube that the tip is to follow, of constant radius; that to the lumen's target if left
        out.
    friction
        ``"model"``: the plan is made with the system's friction; ``"none"``: without.

    Attributes
    ----------
    model
        The navigator's own wire, in the virtual tube.

    Raises
    ------
    InputError
        If the wire has no magnetisation.
    """

    def __init__(self, system: System, path: Lumen | None, friction: InModel = "none") -> None:
        tube = system.path if path is None else path
        self.model = Model(system, tube, TUBE * tube.narrowest, friction)

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None if that is not known."""
        return self.model.expected_tip(feed)
