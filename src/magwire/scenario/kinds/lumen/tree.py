"""A tree of tubes by their bends."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Annotated, Literal

from magwire.scenario.kind import Faults, kind
from magwire.scenario.kinds.lumen import Points, RoundLumen, unknown_target
from magwire.scenario.measured import Numbers
from magwire.scenario.quantity import Quantity, Row, Rows, at_least_one
from magwire.scenario.table import preset
from magwire.units import show

if TYPE_CHECKING:
    from magwire.lumen import Lumen

Bends = Annotated[
    Numbers,
    Rows(
        Row((Quantity("length", "nonnegative"), Quantity("curvature"), Quantity("curvature"))),
        least=2,
    ),
]


@kind
class TreeLumen(RoundLumen):
    """A tree of tubes that all start at the origin along x, by the names of their outlets.

    Each row of a branch is an arc length s and the curvatures k1, k2 there, linear between rows:
    the centreline is c' = t, t' = k1 m1 + k2 m2, m1' = -k1 t, m2' = -k2 t from c = 0, t = x,
    m1 = y, m2 = z. Branches with the same rows up to some s share their way up to there.
    """

    shape: Literal["tree"]
    target: str
    branches: Annotated[dict[str, Bends], at_least_one("branch")]
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centrelines [m]."""
        rows = [row for branch in self.branches.values() for row in branch]
        sharpest = max(math.hypot(k1, k2) for _, k1, k2 in rows)
        return 1.0 / sharpest if sharpest > 0.0 else math.inf

    def clashes(self) -> Faults:
        """Arc lengths start at zero and grow; the target is one of the outlets."""
        for name, rows in self.branches.items():
            arcs = [row[0] for row in rows]
            if arcs[0] != 0.0 or any(b <= a for a, b in itertools.pairwise(arcs)):
                yield (
                    f"Input lumen.branches.{name} must have arc lengths that start at 0 mm and "
                    f"increase; received {', '.join(show(arc, 'length') for arc in arcs)}."
                )
        yield from unknown_target(self.target, self.branches)

    def without_entry(self) -> Lumen:
        """The lumen as a model, but for its entry."""
        from magwire.lumen import Lumen

        tubes = {
            name: Lumen.bends(rows.values, self.radius, points=self.points)
            for name, rows in self.branches.items()
        }
        return Lumen.tree(tubes, target=self.target)
