"""Who watches a run: each sees every record, and may end it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.engine.record import Record
from magwire.errors import positive
from magwire.status import RunStatus

Array = NDArray[np.float64]


class Ending(NamedTuple):
    """Why a run ends: the status of its result, and a sentence, "" if all is done."""

    status: str
    message: str = ""


Watcher = Callable[[Record], Ending | None]
"""Called with every record; the run ends with what it returns, if that is an ``Ending``."""

OUTSIDE = (
    "At {:.4g} mm of feed a point between two nodes is {:.3g} um outside the wall: the wire's "
    "edges are too long for the bend there; use more nodes."
)
UNSTABLE = (
    "The equilibrium at {:.4g} mm of feed is unstable: a wire leaves it, and quasi-static motion "
    "does not tell where to; dynamic motion does."
)


def inside(record: Record) -> Ending | None:
    """End where a point of the wire is outside the wall."""
    if not record.clearance_along < 0.0:
        return None
    where = OUTSIDE.format(1e3 * record.feed, -1e6 * record.clearance_along)
    return Ending(RunStatus.NOT_CONVERGED, where)


def stable(record: Record) -> Ending | None:
    """End at an equilibrium that a wire would leave."""
    return None if record.stable else Ending(RunStatus.UNSTABLE, UNSTABLE.format(1e3 * record.feed))


class Until:
    """End where the tip has come so far on its path.

    Parameters
    ----------
    arc
        Arc parameter of the path [m].
    tip_arc
        That of the tip [m], from the positions of the nodes, shape (nodes, 3) [m].
    """

    def __init__(self, arc: float, tip_arc: Callable[[Array], float]) -> None:
        self._arc, self._tip_arc = arc, tip_arc

    def __call__(self, record: Record) -> Ending | None:
        """Look at a record."""
        return Ending(RunStatus.COMPLETE) if self._tip_arc(record.position) >= self._arc else None


class ForceLimit:
    """End a run where the wall presses too hard.

    Parameters
    ----------
    tip
        Largest force of the wall on the tip node [N].
    wall
        Largest sum of the wall's forces over the wire [N].
    push
        Largest push at the guide [N].
    """

    def __init__(
        self, *, tip: float = float("inf"), wall: float = float("inf"), push: float = float("inf")
    ) -> None:
        self._limits = {"tip": tip, "wall": wall, "push": push}
        for name, value in self._limits.items():
            if value != float("inf"):
                positive("ForceLimit", name, value, "N")

    def __call__(self, record: Record) -> Ending | None:
        """Look at a record."""
        forces = {
            "tip": record.tip_force,
            "wall": float(np.linalg.norm(record.contact_force, axis=1).sum()),
            "push": record.push_force,
        }
        for name, force in forces.items():
            if force > self._limits[name]:
                text = f"{1e3 * force:.4g} mN; the limit is {1e3 * self._limits[name]:.4g} mN."
                where = f"At {1e3 * record.feed:.4g} mm of feed the {name} force is {text}"
                return Ending(RunStatus.FORCE_LIMIT, where)
        return None
