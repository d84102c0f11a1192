"""Feeding at a speed that is given at times."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Annotated

import numpy as np

from magwire.scenario.kind import Faults, kind
from magwire.scenario.kinds.feed import FeedTable
from magwire.scenario.measured import Numbers
from magwire.scenario.quantity import SLACK, Quantity, Row, Rows
from magwire.units import show

if TYPE_CHECKING:
    from magwire.engine.feed import Feed

SpeedTable = Annotated[
    Numbers,
    Rows(Row((Quantity("time", "nonnegative"), Quantity("speed"))), least=2),
]
TwistTable = Annotated[
    Numbers,
    Rows(Row((Quantity("time", "nonnegative"), Quantity("angle"))), least=2),
]


@kind
class TabledFeed(FeedTable):
    """Feeding at a speed that is given at times, and linear between them."""

    ruled_by = ("table", "twist_table")
    length_key = "table"
    table: SpeedTable
    twist_table: TwistTable | None = None

    @property
    def farthest(self) -> float:
        """Largest fed length [m]."""
        return self.extremes[1]

    @property
    def duration(self) -> float:
        """How long feeding takes [s]."""
        return self.table[-1][0]

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest fed length [m]; between rows the speed is linear in time."""
        fed, seen = 0.0, [0.0]
        for (t0, v0), (t1, v1) in itertools.pairwise(self.table):
            if v0 * v1 < 0.0:
                seen.append(fed + 0.5 * v0 * (t1 - t0) * v0 / (v0 - v1))
            fed += 0.5 * (v0 + v1) * (t1 - t0)
            seen.append(fed)
        return min(seen), max(seen)

    def faults(self) -> Faults:
        """Times start at zero and grow, and the wire is not drawn out of the lumen."""
        in_order = True
        for name, rows in (("table", self.table), ("twist_table", self.twist_table)):
            times = [row[0] for row in rows] if rows else [0.0]
            if times[0] != 0.0 or any(b <= a for a, b in itertools.pairwise(times)):
                in_order = False
                yield (
                    f"Input feed.{name} must have times that start at 0 s and increase; "
                    f"received {', '.join(show(time, 'time') for time in times)}."
                )
        if in_order:
            lowest, highest = self.extremes
            if lowest < -SLACK * max(highest, 1.0):
                yield (
                    "Input feed.table must not retract more wire than it has fed; "
                    f"received a feed of {show(lowest, 'length')}."
                )
            if highest <= 0.0:
                yield "Input feed.table must feed some wire; received a feed of 0 mm."

    def create(self) -> Feed:
        """The feed as a model; both tables are brought to the same times."""
        from magwire.engine.feed import Feed

        times, speeds = zip(*self.table, strict=True)
        if self.twist_table is None:
            return Feed.table(times, speeds)
        twist_times, twists = zip(*self.twist_table, strict=True)
        both = sorted({*times, *(t for t in twist_times if t <= times[-1])})
        return Feed.table(
            both,
            np.interp(both, times, speeds).tolist(),
            np.interp(both, twist_times, twists).tolist(),
        )
