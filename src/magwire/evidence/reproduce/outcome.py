"""What is looked at in a run, in the paper's normalised quantities (P-18)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from magwire.results import Result

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Outcome:
    """Numbers of a run; arrays hold one entry for each record.

    Attributes
    ----------
    time
        Shape (t,) [s].
    push
        X, shape (t,).
    tip_force, wall_force
        Force of the wall on the tip node, and sum of the sizes of the forces on all nodes, shape
        (t,) [N].
    peak
        Largest tip force over all steps, recorded or not [N].
    field
        B*, shape (t, 3).
    offset
        Distance of the tip from the centreline, shape (t,) [m].
    unit
        EI / L^2, the force that makes F* = 1 [N].
    pace
        Computing time per simulated time.
    status, message
        How the run ended.
    """

    time: Array
    push: Array
    tip_force: Array
    wall_force: Array
    peak: float
    field: Array
    offset: Array
    unit: float
    pace: float
    status: str = "complete"
    message: str = ""

    @classmethod
    def of(cls, result: Result) -> Outcome:
        """The numbers of a result."""
        simulated = float(result.time[-1]) if result.time.size else 0.0
        return cls(
            time=result.time,
            push=result.normalized_push,
            tip_force=result.tip_force,
            wall_force=np.linalg.norm(result.contact_force, axis=2).sum(axis=1),
            peak=result.max_tip_force,
            field=np.asarray(result.dataset["normalized_field"].values, dtype=np.float64),
            offset=result.tip_offset,
            unit=result.force_scale,
            pace=result.wall_time / simulated if simulated > 0.0 else float("nan"),
            status=result.status,
            message=result.message,
        )

    @property
    def complete(self) -> bool:
        """Whether the run went to its end."""
        return self.status == "complete"

    @property
    def contact_free(self) -> bool:
        """Whether it went to its end without the tip ever feeling the wall."""
        return self.complete and self.peak == 0.0

    @property
    def largest(self) -> float:
        """Largest F*."""
        return self.peak / self.unit

    @property
    def peak_field(self) -> float:
        """Largest B*."""
        return float(np.max(np.linalg.norm(self.field, axis=1), initial=0.0))

    def peak_field_from(self, push: float) -> float:
        """Largest B* from a push on."""
        later = self.field[self.push >= push]
        return float(np.max(np.linalg.norm(later, axis=1), initial=0.0))

    def force_at(self, push: Array | float) -> Array:
        """F* at pushes."""
        return np.asarray(np.interp(push, self.push, self.tip_force) / self.unit)

    def field_at(self, push: Array) -> Array:
        """B* at pushes, shape (n, 3)."""
        return np.stack([np.interp(push, self.push, b) for b in self.field.T], axis=1)

    def largest_from(self, low: float, high: float = np.inf) -> float:
        """Largest recorded F* in a range of pushes."""
        within = (self.push >= low) & (self.push <= high)
        return float(np.max(self.tip_force[within], initial=0.0)) / self.unit

    def contacts(self) -> list[tuple[float, float]]:
        """First and last push of each stage in which the tip touches."""
        touches = np.concatenate([[False], self.tip_force > 0.0, [False]])
        begins, ends = (
            np.flatnonzero(touches[1:] & ~touches[:-1]),
            np.flatnonzero(touches[:-1] & ~touches[1:]),
        )
        return [
            (float(self.push[i]), float(self.push[j - 1]))
            for i, j in zip(begins, ends, strict=True)
        ]

    def until(self, push: float) -> Outcome:
        """The run up to a push; its peak is that of the records."""
        keep = self.push <= push + 1e-9
        return Outcome(
            time=self.time[keep],
            push=self.push[keep],
            tip_force=self.tip_force[keep],
            wall_force=self.wall_force[keep],
            peak=self.peak if keep.all() else float(np.max(self.tip_force[keep], initial=0.0)),
            field=self.field[keep],
            offset=self.offset[keep],
            unit=self.unit,
            pace=self.pace,
            status=self.status,
            message=self.message,
        )
