"""An equilibrium as the kernels hold it, and the gradient of its energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.kernels.arrays import Field, Motion, Mouth, Rod, State, Work
from magwire.kernels.assembly import assemble

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Point:
    """An equilibrium as the kernels hold it."""

    system: System
    field: Field
    state: State
    mouth: Mouth

    def gradient(
        self,
        work: Work,
        *,
        rod: Rod | None = None,
        field: Field | None = None,
        mouth: Mouth | None = None,
    ) -> Array:
        """Gradient of the energy, scaled, shape (nodes + 1, 4), with its own inputs or others."""
        return self.energy(work, rod=rod, field=field, mouth=mouth)[1]

    def energy(
        self,
        work: Work,
        *,
        rod: Rod | None = None,
        field: Field | None = None,
        mouth: Mouth | None = None,
    ) -> tuple[float, Array]:
        """Energy and its gradient, scaled."""
        system = self.system
        model = (rod or system.rod, field or self.field, system.new_wall(), system.walls)
        still = Motion(0.0, work.target)
        where = mouth or self.mouth
        energy, _ = assemble(model, self.state, where, still, work.gradient, work.no_band)
        return float(energy), work.gradient.copy()
