"""The lumen tables of a scenario, one for each shape."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field

from magwire.scenario.quantity import (
    Length,
    LengthOrZero,
    OneOrEach,
    Quantity,
    Row,
    Rows,
    Whole,
    at_least_one,
)
from magwire.scenario.table import Table, preset

if TYPE_CHECKING:
    from magwire.lumen import Lumen

Points = Annotated[int, Whole(5, 1_000_000)]
Polyline = Annotated[
    tuple[tuple[float, float, float], ...], Rows(Row((Quantity("length"),) * 3), least=2)
]
Bends = Annotated[
    tuple[tuple[float, float, float], ...],
    Rows(
        Row((Quantity("length", "nonnegative"), Quantity("curvature"), Quantity("curvature"))),
        least=2,
    ),
]
Radii = Annotated[tuple[float, ...], OneOrEach(Quantity("length", "positive"))]


class LumenTable(Table):
    """What all shapes have in common."""

    entry: LengthOrZero = preset("0 mm")

    @property
    def narrowest(self) -> float:
        """Smallest radius [m]."""
        raise NotImplementedError

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        raise NotImplementedError

    def build(self) -> Lumen:
        """The lumen as a model."""
        lumen = self.shape_model()
        return lumen.with_entry(self.entry) if self.entry > 0.0 else lumen


class RoundLumen(LumenTable):
    """A lumen of one radius along a curve with a formula."""

    radius: Length

    @property
    def narrowest(self) -> float:
        """Smallest radius [m]."""
        return self.radius

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        raise NotImplementedError


class StraightLumen(RoundLumen):
    """A straight tube along the x axis."""

    shape: Literal["straight"]
    length: Length

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return math.inf

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        from magwire.lumen import Lumen

        return Lumen.straight(self.length, self.radius)


class HalfCircleLumen(RoundLumen):
    """Half a circle in the xy plane."""

    shape: Literal["half-circle"]
    centreline_radius: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return self.centreline_radius

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        from magwire.lumen import Lumen

        return Lumen.half_circle(self.centreline_radius, self.radius, points=self.points)


class SinusoidLumen(RoundLumen):
    """A cosine in the xy plane that starts along the x axis; ``length`` is its extent in x."""

    shape: Literal["sinusoid"]
    amplitude: Length
    period: Length
    length: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        return 1.0 / (self.amplitude * (2.0 * math.pi / self.period) ** 2)

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        from magwire.lumen import Lumen

        return Lumen.sinusoid(
            self.amplitude, self.period, self.length, self.radius, points=self.points
        )


class HelixLumen(RoundLumen):
    """A helix; ``length`` is its arc length."""

    shape: Literal["helix"]
    helix_radius: Length
    pitch: Length
    length: Length
    points: Points = preset(200)

    @property
    def tightest_bend(self) -> float:
        """Smallest bend radius of the centreline [m]."""
        rise = self.pitch / (2.0 * math.pi)
        return (self.helix_radius**2 + rise**2) / self.helix_radius

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        from magwire.lumen import Lumen

        return Lumen.helix(
            self.helix_radius, self.pitch, self.length, self.radius, points=self.points
        )


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

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        return self._model

    @cached_property
    def _model(self) -> Lumen:
        from magwire.lumen import Lumen

        tubes = {
            name: Lumen.bends(rows, self.radius, points=self.points)
            for name, rows in self.branches.items()
        }
        return Lumen.tree(tubes, target=self.target)


class PointsLumen(LumenTable):
    """A smooth curve through given points, entrance first.

    ``file`` and ``units`` stand for ``points`` and ``radius`` in the file that a user writes; they
    are replaced by the numbers they stand for before the table is checked.
    """

    shape: Literal["points"]
    points: Polyline
    radius: Radii
    file: str | None = Field(
        default=None,
        description="CSV file with columns x, y, z and radius, in place of points and radius; "
        "relative to the scenario's folder",
    )
    units: str | None = Field(
        default=None, description="unit of the numbers in the file, such as 'mm'"
    )

    @property
    def radii(self) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Radius at every point, shape (n,) [m]."""
        return np.broadcast_to(np.array(self.radius), (len(self.points),)).copy()

    @property
    def narrowest(self) -> float:
        """Smallest radius [m]."""
        return min(self.radius)

    def shape_model(self) -> Lumen:
        """The lumen as a model, without its entry."""
        from magwire.lumen import Lumen

        return Lumen.through(np.array(self.points), self.radii)
