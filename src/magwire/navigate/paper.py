r"""The paper's optimiser, literally: the baseline (P-19, P-20).

At every observation the field is changed until the virtual tube's force on the model's tip is below
a tolerance: dB_{n+1} = J \ F and B_{n+1} = B_n - beta1 dB_n - beta2 dB_{n+1}, with J by forward
differences and the least-squares solution of least norm, since J has rank two.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.errors import positive, whole
from magwire.lumen import Lumen
from magwire.navigate.model import InModel
from magwire.navigate.navigator import NavigationError, Observation
from magwire.navigate.schedule import Schedule
from magwire.navigate.tube import RANK, TubeNavigator

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Optimiser:
    """The optimiser's numbers; the defaults are the paper's, where it gives them.

    Parameters
    ----------
    difference
        Step of the forward differences [T].
    beta1, beta2
        Momentum coefficients.
    tolerance
        Force of the tube that counts as none, in EI/L^2 (not given in the paper).
    iterations
        At most, for one field (not given in the paper).
    """

    difference: float = 1e-4
    beta1: float = 0.9
    beta2: float = 1e-4
    tolerance: float = 0.05
    iterations: int = 200

    def __post_init__(self) -> None:
        positive("Optimiser", "difference", self.difference, "T")
        positive("Optimiser", "beta1", self.beta1)
        positive("Optimiser", "beta2", self.beta2)
        positive("Optimiser", "tolerance", self.tolerance)
        whole("Optimiser", "iterations", self.iterations, minimum=1)


class PaperNavigator(TubeNavigator):
    """The paper's Algorithm 1; its field stays as it is from one observation to the next.

    Parameters
    ----------
    system
        Wire, lumen and wall as the navigator believes them to be.
    path
        The tube that the tip is to follow, of constant radius; that to the lumen's target if left
        out.
    optimiser
        Its numbers.
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
        optimiser: Optimiser | None = None,
        friction: InModel = "none",
    ) -> None:
        super().__init__(system, path, friction)
        self.optimiser = Optimiser() if optimiser is None else optimiser

    def plan(self, observation: Observation, until: float) -> Schedule:
        """The field from the observed feed on; see ``Navigator.plan``."""
        if not self.model.feed_to(until):
            raise NavigationError(
                f"At {until * 1e3:.4g} mm of feed the model of the wire found no equilibrium."
            )
        if self.model.released:
            self._optimise(until)
        return Schedule(np.array([until]), self.model.flux[None])

    def _optimise(self, feed: float) -> None:
        """Algorithm 1, lines 3 to 13."""
        model, numbers = self.model, self.optimiser
        small = numbers.tolerance * model.system.scales.force
        last = np.zeros(3)
        force = model.tube_force()
        for _ in range(numbers.iterations):
            if float(np.linalg.norm(force)) <= small:
                return
            change = np.linalg.lstsq(self._jacobian(force), force, rcond=RANK)[0]
            if not model.settle(model.flux - numbers.beta1 * last - numbers.beta2 * change):
                raise NavigationError(
                    f"At {feed * 1e3:.4g} mm of feed the optimiser's next field has no equilibrium."
                )
            last[:] = change
            force = model.tube_force()
        if float(np.linalg.norm(force)) > small:
            raise NavigationError(
                f"At {feed * 1e3:.4g} mm of feed the optimiser stalls: after "
                f"{numbers.iterations} iterations the virtual tube still holds the tip with "
                f"{float(np.linalg.norm(force)) * 1e3:.3g} mN; {small * 1e3:.3g} mN is the limit."
            )

    def _jacobian(self, force: Array) -> Array:
        """Forward differences of the tube's force by the field, shape (3, 3) [N/T]."""
        model, step = self.model, self.optimiser.difference
        here = model.remember()
        columns = []
        for axis in np.eye(3):
            if not model.settle(here.inputs + step * axis):
                raise NavigationError(
                    f"At {model.feed * 1e3:.4g} mm of feed a difference of the field by "
                    f"{step * 1e3:.3g} mT has no equilibrium."
                )
            columns.append((model.tube_force() - force) / step)
            model.return_to(here)
        return np.stack(columns, axis=1)
