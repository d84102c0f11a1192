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
from magwire.navigate.model import InModel
from magwire.navigate.navigator import NavigationError, Observation
from magwire.navigate.schedule import Schedule
from magwire.navigate.tube import RANK, TubeNavigator

Array = NDArray[np.float64]

TOLERANCE = 0.05  # force of the tube that counts as none, in EI/L^2
ITERATIONS = 12


class NewtonNavigator(TubeNavigator):
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

    def __init__(
        self,
        system: System,
        *,
        path: Lumen | None = None,
        plan_every: float | None = None,
        friction: InModel = "none",
    ) -> None:
        super().__init__(system, path, friction)
        length = 5e-3 * system.wire.length if plan_every is None else plan_every
        self.plan_every = positive("NewtonNavigator", "plan_every", length, "m")

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        return self.model.plan(until, self.plan_every, self._go_to)

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
