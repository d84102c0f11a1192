"""Steering by the root of the virtual tube's force, with exact sensitivities (P-19, P-21).

A virtual tube holds the model's tip on the centreline; the field is changed until the tube has
nothing to do. Two conditions leave one component of the field open: each step is the shortest
there is. What that leads to is not always stable without the tube (P-22).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.errors import positive
from magwire.lumen import Lumen
from magwire.navigate.model import Model
from magwire.navigate.navigator import NavigationError, Observation
from magwire.navigate.schedule import Schedule

Array = NDArray[np.float64]

TUBE = 0.01  # radius of the virtual tube, in the lumen's radius (P-19)
TOLERANCE = 0.05  # force of the tube that counts as none, in EI/L^2
ITERATIONS = 12
RANK = 1e-3  # directions of the field that move the tip by less than this part are left alone


class NewtonNavigator:
    """Keeps the tip on the centreline by Newton's method on the virtual tube's force.

    Parameters
    ----------
    system
        Wire, lumen and wall as the navigator believes them to be.
    path
        The tube that the tip is to follow, of constant radius; that to the lumen's target if left
        out.
    plan_every
        Feed between two planned fields [m]; half a percent of the wire if left out.

    Attributes
    ----------
    model
        The navigator's own wire, in the virtual tube.

    Raises
    ------
    InputError
        If the wire has no magnetisation.
    """

    def __init__(
        self, system: System, *, path: Lumen | None = None, plan_every: float | None = None
    ) -> None:
        tube = system.path if path is None else path
        length = 5e-3 * system.wire.length if plan_every is None else plan_every
        self.plan_every = positive("NewtonNavigator", "plan_every", length, "m")
        self.model = Model(system, tube, TUBE * tube.narrowest)

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        return self.model.plan(until, self.plan_every, self._go_to)

    def expected_tip(self, feed: float) -> Array | None:
        """Where the tip should be at a feed [m], shape (3,) [m]; None if that is not known."""
        return self.model.expected_tip(feed)

    def _go_to(self, feed: float) -> None:
        model = self.model
        where = f"At {feed * 1e3:.4g} mm of feed"
        if not model.feed_to(feed):
            raise NavigationError(f"{where} the model of the wire found no equilibrium.")
        if not model.released:
            return
        small = TOLERANCE * model.system.scales.force
        for _ in range(ITERATIONS):
            force, by_flux = model.hold()
            if float(np.linalg.norm(force)) <= small:
                return
            change = -np.linalg.pinv(by_flux, rcond=RANK) @ force
            while not model.settle(model.flux + change):
                change = 0.5 * change
                if float(np.linalg.norm(change)) < 1e-6 * model.system.scales.flux_density:
                    raise NavigationError(f"{where} no step of the field leads to an equilibrium.")
        raise NavigationError(
            f"{where} the virtual tube still holds the tip with "
            f"{float(np.linalg.norm(force)) * 1e3:.3g} mN after {ITERATIONS} steps of the field."
        )
