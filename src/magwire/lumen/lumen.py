"""The lumen: one or more branches of balls, and the gap of a point to its wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import KDTree

from magwire.errors import InputError, array, nonnegative, positive, whole
from magwire.kernels.gap import LumenArrays, gap_many
from magwire.lumen import shapes
from magwire.lumen.branch import Bend, Branch
from magwire.lumen.grid import build, scaled

Array = NDArray[np.float64]
Indices = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Lumen:
    """The space that the wire may be in: the union of balls along its branches.

    Parameters
    ----------
    branches
        The first one leads from the entrance to the target. None at all is open space.
    blend
        Width over which the walls of two branches are rounded into each other [m].

    Notes
    -----
    (P-8) to (P-10) of the theory pages. The gap of a point is max over S of
    (R(S) - |x - c(S)|), positive inside. It is 1-Lipschitz, exact up to one radius outside of the
    wall, and +inf where there is no wall: past an open end, and farther outside.
    """

    branches: tuple[Branch, ...]
    blend: float = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        branches: object = self.branches
        if isinstance(branches, Branch) or not isinstance(branches, Sequence):
            raise InputError(
                "Input branches of Lumen must be a sequence of Branch; received "
                f"{type(branches).__name__}."
            )
        for branch in branches:
            if not isinstance(branch, Branch):
                raise InputError(
                    "Input branches of Lumen must be a sequence of Branch; received one of "
                    f"{type(branch).__name__}."
                )
        object.__setattr__(self, "branches", tuple(branches))
        object.__setattr__(self, "blend", nonnegative("Lumen", "blend", self.blend, "m"))

    @classmethod
    def straight(cls, length: float, radius: float) -> Lumen:
        """Straight tube along x from the origin.

        Parameters
        ----------
        length, radius
            Length and inner radius of the tube [m].
        """
        shape = shapes.straight(positive("Lumen.straight", "length", length, "m"))
        return cls._formula("straight", shape, radius)

    @classmethod
    def half_circle(cls, centreline_radius: float, radius: float, points: int = 200) -> Lumen:
        """Half a circle in the xy plane, from the origin along x and towards +y.

        Parameters
        ----------
        centreline_radius
            Radius of the half-circle [m].
        radius
            Inner radius of the tube [m].
        points
            Number of points of the centreline.
        """
        owner = "Lumen.half_circle"
        shape = shapes.half_circle(
            positive(owner, "centreline_radius", centreline_radius, "m"),
            whole(owner, "points", points, minimum=5),
        )
        return cls._formula("half_circle", shape, radius)

    @classmethod
    def sinusoid(
        cls, amplitude: float, period: float, length: float, radius: float, points: int = 200
    ) -> Lumen:
        """Cosine in the xy plane: y = amplitude (cos(2 pi x / period) - 1), x in [0, length].

        Parameters
        ----------
        amplitude, period
            Half the height of the wave, and its length along x [m].
        length
            Extent along x [m]; not the arc length.
        radius
            Inner radius of the tube [m].
        points
            Number of points of the centreline.
        """
        owner = "Lumen.sinusoid"
        shape = shapes.sinusoid(
            positive(owner, "amplitude", amplitude, "m"),
            positive(owner, "period", period, "m"),
            positive(owner, "length", length, "m"),
            whole(owner, "points", points, minimum=5),
        )
        return cls._formula("sinusoid", shape, radius)

    @classmethod
    def helix(
        cls, helix_radius: float, pitch: float, length: float, radius: float, points: int = 200
    ) -> Lumen:
        """Helix around an axis parallel to z, from the origin; it climbs by ``pitch`` each turn.

        Parameters
        ----------
        helix_radius, pitch
            Radius of the helix and its rise in one turn [m].
        length
            Arc length [m].
        radius
            Inner radius of the tube [m].
        points
            Number of points of the centreline.
        """
        owner = "Lumen.helix"
        shape = shapes.helix(
            positive(owner, "helix_radius", helix_radius, "m"),
            positive(owner, "pitch", pitch, "m"),
            positive(owner, "length", length, "m"),
            whole(owner, "points", points, minimum=5),
        )
        return cls._formula("helix", shape, radius)

    @classmethod
    def through(cls, points: ArrayLike, radius: ArrayLike) -> Lumen:
        """Tube through points of its centreline.

        Parameters
        ----------
        points
            From the entrance on, shape (q, 3) [m]; at least two.
        radius
            Inner radius [m], one number or one for each point, shape (q,).
        """
        return cls((Branch(np.asarray(points), np.asarray(radius)),))

    @classmethod
    def open_space(cls) -> Lumen:
        """No wall anywhere; the entrance is the origin and the wire enters along x."""
        return cls(())

    @classmethod
    def _formula(cls, name: str, shape: shapes.Shape, radius: float) -> Lumen:
        """A tube of constant radius around a centreline with known tangents."""
        points, begin, end = shape
        size = np.asarray(positive(f"Lumen.{name}", "radius", radius, "m"))
        return cls((Branch(points, size, begin_tangent=begin, end_tangent=end),))

    def with_entry(self, length: float) -> Lumen:
        """The lumen with a straight tube of ``length`` [m] in front of its entrance."""
        if nonnegative("Lumen.with_entry", "length", length, "m") == 0.0 or not self.branches:
            return self
        first = self.branches[0].with_entry(length)
        return replace(self, branches=(first, *self.branches[1:]))

    @property
    def entrance(self) -> Array:
        """Where the wire enters, shape (3,) [m]."""
        return self.branches[0].entrance if self.branches else np.zeros(3)

    @property
    def direction(self) -> Array:
        """Unit vector along which the wire enters, shape (3,)."""
        return self.branches[0].direction if self.branches else np.array([1.0, 0.0, 0.0])

    @property
    def length(self) -> float:
        """Arc length of the first branch [m]; infinite in open space."""
        return self.branches[0].length if self.branches else float("inf")

    @property
    def radius_range(self) -> tuple[float, float]:
        """Smallest and largest radius over all branches [m]; infinite in open space."""
        if not self.branches:
            return float("inf"), float("inf")
        radii = [branch.curve.at(branch.curve.knots())[:, 3] for branch in self.branches]
        return min(float(r.min()) for r in radii), max(float(r.max()) for r in radii)

    @property
    def narrowest(self) -> float:
        """Smallest radius over all branches [m]; infinite in open space."""
        return self.radius_range[0]

    @property
    def planar(self) -> bool:
        """Whether all centrelines lie in one plane parallel to a coordinate plane."""
        if not self.branches:
            return True
        points = np.concatenate([branch.points for branch in self.branches])
        extent = np.ptp(points, axis=0)
        return bool(extent.min() <= 1e-9 * extent.max())

    def bend_radius(self) -> tuple[Bend, ...]:
        """Smallest radius of curvature [m] of each branch, and the arc parameter where it is."""
        return tuple(branch.bend_radius() for branch in self.branches)

    def centreline(self, branch: int = 0, points: int | None = None) -> tuple[Array, Array]:
        """Centreline and radius of a branch, shapes (q, 3) and (q,) [m].

        Parameters
        ----------
        branch
            Which branch.
        points
            How many points at equal arc length; the points it was made from if left out.
        """
        if not self.branches:
            return np.zeros((0, 3)), np.zeros(0)
        return self.branches[branch].centreline(points)

    def gap(self, points: ArrayLike) -> Array:
        """Gap of points to the wall, shape (n,) [m]: positive inside, +inf where there is no wall.

        Parameters
        ----------
        points
            Shape (n, 3) [m].
        """
        return self._query(points)[0]

    def locate(self, points: ArrayLike) -> tuple[Array, Indices]:
        """Arc parameter [m] and branch of the ball that each point is deepest in, shapes (n,).

        Parameters
        ----------
        points
            Shape (n, 3) [m]. Also far outside of the lumen: there it is the nearest ball.
        """
        where = array("Lumen", "points", points, (None, 3), "m")
        _, arc, branch = self._query(where)
        lost = np.flatnonzero(branch < 0)
        if len(lost) > 0 and self.branches:
            tree, samples = self._samples
            nearest = tree.query(where[lost])[1]
            arc[lost], branch[lost] = samples[nearest, 0], samples[nearest, 1].astype(np.int32)
            for index, part in enumerate(self.branches):
                here = lost[branch[lost] == index]
                arc[here] += part.beyond(where[here], arc[here])
        return arc, branch

    def offset(self, points: ArrayLike) -> Array:
        """Distance of points from the centreline, shape (n,) [m]; nan in open space.

        Past an end the centreline goes on straight.

        Parameters
        ----------
        points
            Shape (n, 3) [m].
        """
        where = array("Lumen", "points", points, (None, 3), "m")
        arc, branch = self.locate(where)
        distance = np.full(len(where), np.nan)
        for index, part in enumerate(self.branches):
            here = branch == index
            centre = part.curve.at(arc[here])[:, :3]
            distance[here] = np.linalg.norm(where[here] - centre, axis=1)
        return distance

    def arrays(self, length_scale: float = 1.0) -> LumenArrays:
        """The lumen as the kernels take it, in units of ``length_scale`` [m]."""
        return scaled(self._arrays, positive("Lumen.arrays", "length_scale", length_scale, "m"))

    @cached_property
    def _arrays(self) -> LumenArrays:
        """Arrays in metres, built on first use."""
        return build(self.branches, self.blend)

    @cached_property
    def _samples(self) -> tuple[KDTree, Array]:
        """Points of all centrelines for points that no voxel holds: tree, and arc and branch."""
        points, tags = [], []
        for index, branch in enumerate(self.branches):
            s = np.linspace(0.0, branch.length, 4 * len(branch.curve.coefficients) + 1)
            points.append(branch.curve.at(s)[:, :3])
            tags.append(np.column_stack([s, np.full(len(s), float(index))]))
        return KDTree(np.concatenate(points)), np.concatenate(tags)

    def _query(self, points: ArrayLike) -> tuple[Array, Array, Indices]:
        """Gap, arc parameter and branch of points; nan and -1 where no voxel holds them."""
        where = array("Lumen", "points", points, (None, 3), "m")
        gap, arc = np.empty(len(where)), np.empty(len(where))
        branch = np.empty(len(where), dtype=np.int32)
        gap_many(self._arrays, where, gap, arc, branch)
        return gap, arc, branch
