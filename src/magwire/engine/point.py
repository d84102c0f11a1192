"""An equilibrium as the kernels hold it, and the gradient of its energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.kernels.arrays import Field, Motion, Mouth, Rod, State, Wall, Work
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import WIDTH, factor

Array = NDArray[np.float64]


def free_rows(nodes: int, held: int, *, far_held: bool) -> int:
    """The row past the last free one; what holds the far end holds the last edge (P-1)."""
    return 4 * (nodes - held - 1) if far_held else 4 * (nodes - held + 1) - 1


def cut_off(band: Array, last: int) -> None:
    """Take the rows from ``last`` on out of a band's columns, as the factorisation expects it."""
    for k in range(1, WIDTH):
        band[last - k : last, k] = 0.0


@dataclass(frozen=True)
class Point:
    """An equilibrium as the kernels hold it.

    ``unsampled`` is what second derivatives of the field add to the stiffness, by the middle of
    each edge, shape (edges, 3, 3), scaled; nothing in an affine field. ``far_held``: whether the
    last edge is held, too.
    """

    system: System
    field: Field
    state: State
    mouth: Mouth
    unsampled: Array | None = None
    far_held: bool = False

    @property
    def last(self) -> int:
        """The row past the last free one."""
        return free_rows(len(self.state.q), self.mouth.held, far_held=self.far_held)

    def gradient(
        self,
        work: Work,
        *,
        rod: Rod | None = None,
        field: Field | None = None,
        mouth: Mouth | None = None,
        wall: Wall | None = None,
    ) -> Array:
        """Gradient of the energy, scaled, shape (nodes + 1, 4), with its own inputs or others."""
        return self.energy(work, rod=rod, field=field, mouth=mouth, wall=wall)[1]

    def energy(
        self,
        work: Work,
        *,
        rod: Rod | None = None,
        field: Field | None = None,
        mouth: Mouth | None = None,
        wall: Wall | None = None,
    ) -> tuple[float, Array]:
        """Energy and its gradient, scaled."""
        system = self.system
        model = system.new_terms(field or self.field, rod=rod, wall=wall)
        still = Motion(0.0, work.target)
        where = mouth or self.mouth
        energy, _ = assemble(model, self.state, where, still, work.gradient, work.no_band)
        return float(energy), work.gradient.copy()

    def stiffness(self, work: Work) -> Array:
        """Tangent stiffness, scaled, in the layout of ``work.band``."""
        system = self.system
        model = system.new_terms(self.field)
        still = Motion(0.0, work.target)
        assemble(model, self.state, self.mouth, still, work.gradient, work.band)
        if self.unsampled is not None:
            self._add(self.unsampled, work.band)
        if self.far_held:
            cut_off(work.band, self.last)
        return work.band

    def _add(self, unsampled: Array, band: Array) -> None:
        """The middle of an edge moves by half of what either node does."""
        edges = np.arange(self.mouth.held, len(unsampled))
        near = 4 * (edges - self.mouth.held + 1)
        for c, d in np.ndindex(3, 3):
            quarter = 0.25 * unsampled[edges, c, d]
            band[near + d, 4 + c - d] += quarter
            if c >= d:
                band[near + d, c - d] += quarter
                band[near + 4 + d, c - d] += quarter

    @property
    def stable(self) -> bool:
        """Whether the tangent stiffness is positive definite."""
        return bool(factor(self.stiffness(self.system.new_work()), FIRST, self.last) < 0)
