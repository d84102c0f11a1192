"""The lumen: one or more branches of balls, and the gap of a point to its wall."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError, array, instance, nonnegative, numbers, positive, whole
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import gap_many
from magwire.lumen import shapes
from magwire.lumen.branch import Bend, Branch
from magwire.lumen.bulge import Bulge, bulges, largest, sheet_bulge
from magwire.lumen.distance import Wall as SheetWall
from magwire.lumen.distance import build, scaled_sheet
from magwire.lumen.forks import join_ways
from magwire.lumen.grid import scaled
from magwire.lumen.lazy import Lazy
from magwire.lumen.names import meant
from magwire.lumen.search import Search
from magwire.lumen.sheet import Sheet
from magwire.lumen.tree import join
from magwire.lumen.words import tree_words, tube_words

if TYPE_CHECKING:
    from magwire.vessel import Spot

Array = NDArray[np.float64]
Indices = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Lumen:
    """The space that the wire may be in: the union of balls along its branches.

    Parameters
    ----------
    branches
        The first one starts at the entrance. None at all is open space.
    paths
        The centrelines of a tree from the entrance to its outlets by their names. ``Lumen.tree``
        makes branches and paths.
    target
        The outlet to go to; the first one if left out.
    sheet
        The wall, if that is of triangles and not of balls; ``with_surface`` makes it.

    Notes
    -----
    (P-8) to (P-10) of the theory pages. The gap of a point is max over S of
    (R(S) - |x - c(S)|), positive inside. It is 1-Lipschitz, exact up to one radius outside of the
    wall, and +inf where there is no wall: past an open end, and farther outside.
    """

    branches: tuple[Branch, ...]
    paths: Mapping[str, Branch] = field(default_factory=dict, kw_only=True)
    target: str | None = field(default=None, kw_only=True)
    sheet: Sheet | None = field(default=None, kw_only=True)

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
        instance("Lumen", "paths", self.paths, Mapping)
        paths = self.paths if isinstance(self.paths, Lazy) else MappingProxyType(dict(self.paths))
        object.__setattr__(self, "paths", paths)
        if self.target is None and self.paths:
            object.__setattr__(self, "target", self.outlets[0])
        if self.target is not None:
            object.__setattr__(self, "target", self._known("target", self.target))
        instance("Lumen", "sheet", self.sheet, Sheet, or_none=True)
        if self.sheet is not None and not self.branches:
            raise InputError(
                "Input sheet of Lumen must come with branches that run inside of it; received none."
            )

    def __repr__(self) -> str:
        if not self.branches:
            return "<Lumen: open space, no wall>"
        count, radii = len(self.branches), self.radius_range
        if self.paths:
            return tree_words(count, radii, self.outlets, self.target)
        return tube_words(count, self.length, radii)

    def __getstate__(self) -> dict[str, Any]:
        """For pickle, which knows no read-only mappings."""
        paths = self.paths if isinstance(self.paths, Lazy) else dict(self.paths)
        return self.__dict__ | {"paths": paths}

    def __setstate__(self, state: dict[str, Any]) -> None:
        paths = state["paths"]
        paths = paths if isinstance(paths, Lazy) else MappingProxyType(paths)
        self.__dict__.update(state | {"paths": paths})

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
        line = array("Lumen.through", "points", points, (None, 3), "m")
        return cls((Branch(line, numbers("Lumen.through", "radius", radius)),))

    @classmethod
    def bends(cls, table: ArrayLike, radius: float, points: int = 200) -> Lumen:
        """Tube from the origin along x, that bends as a table says.

        Parameters
        ----------
        table
            Rows of arc length [m] and two curvatures [1/m], linear between them, shape (rows, 3);
            the first row is at 0. A positive first curvature turns from x towards y, a positive
            second one from x towards z; these two directions go along with the tube untwisted.
        radius
            Inner radius of the tube [m].
        points
            Number of points of the centreline.
        """
        owner = "Lumen.bends"
        rows = array(owner, "table", table, (None, 3))
        if len(rows) < 2 or rows[0, 0] != 0.0 or np.any(np.diff(rows[:, 0]) <= 0.0):
            raise InputError(
                "Input table of Lumen.bends must have two rows at least, with arc lengths that "
                f"start at 0 m and increase; received {rows[:, 0].tolist()} m."
            )
        shape = shapes.bends(rows, whole(owner, "points", points, minimum=5))
        return cls._formula("bends", shape, radius)

    @classmethod
    def tree(
        cls,
        branches: Mapping[str, Lumen],
        *,
        target: str | None = None,
        blend: float | None = None,
    ) -> Lumen:
        """Tree of tubes, each with the name of its outlet.

        Parameters
        ----------
        branches
            Tubes by name. Each one starts at the entrance and shares the first part of its path
            with those before it, or starts on the centreline of one before it.
        target
            Name of the outlet to go to; the first one if left out. It does not change the wall.
        blend
            Width over which branches are rounded into each other [m]; at each junction a fifth of
            the smallest radius there if left out.

        Raises
        ------
        InputError
            If a branch is not connected, is wider than what it leaves, never leaves it or comes
            back to another one, or if there is no such target.

        Examples
        --------
        >>> import magwire as mw
        >>> ahead = mw.Lumen.straight(length=0.08, radius=3e-3)
        >>> aside = mw.Lumen.through([[0.02, 0, 0], [0.04, 0.02, 0], [0.05, 0.05, 0]], 2e-3)
        >>> lumen = mw.Lumen.tree({"ahead": ahead, "aside": aside}, target="aside")
        >>> lumen.outlets
        ('ahead', 'aside')
        >>> round(lumen.path("ahead").length, 9)
        0.08

        Notes
        -----
        (P-10) of the theory pages.
        """
        lines = _lines(branches)
        if blend is not None:
            nonnegative("Lumen.tree", "blend", blend, "m")
        walls, paths = join(lines, blend)
        return cls(walls, paths=paths, target=target)

    @classmethod
    def read(
        cls,
        path: str | Path,
        units: str | None = None,
        *,
        target: Spot | None = None,
        wall: Literal["balls", "surface"] = "balls",
        **options: Any,
    ) -> Lumen:
        """Vessel from a file of centrelines, or of a surface, whose centrelines are extracted.

        Parameters
        ----------
        path, units
            The file, and the unit of its numbers, such as "mm"; needed unless the file states it.
        target
            Outlet to go to: its name, the number of its end from one, or a point [m]; the first
            one if left out.
        wall
            What a wire feels: balls around the centrelines, or the triangles of the file's surface.
        options
            The others of ``Vessel.read``: ``entrance``, ``radius``, ``scale``, ``rotation``,
            ``translation``, ``smoothing``, ``extend`` and ``cut``.

        Raises
        ------
        InputError
            If the file cannot be used: in one sentence, why.
        """
        from magwire.vessel import Vessel

        return Vessel.read(path, units, **options).lumen(target, wall=wall)

    @classmethod
    def ways(
        cls,
        balls: Mapping[str, ArrayLike],
        *,
        trunks: Sequence[ArrayLike] = (),
        target: str | None = None,
        blend: float | None = None,
    ) -> Lumen:
        """Tree of paths from one entrance, each as points of its centreline with radii.

        It is made in a time that grows with the branches, not with the sum of all paths, as far as
        paths have the same points where they are one.

        Parameters
        ----------
        balls
            Points and radii of each path by the name of its outlet, shape (n, 4) [m].
        trunks
            Those of tubes that are wall and no path, shape (n, 4) [m] each: trunks that no path
            runs straight through. An end that lies inside of the paths' walls is closed, and not
            felt; any other is open.
        target, blend
            As of ``Lumen.tree``.

        Raises
        ------
        InputError
            If the paths do not start at one place, or as of ``Lumen.tree``.
        """
        owner = "Lumen.ways"
        if blend is not None:
            nonnegative(owner, "blend", blend, "m")
        instance(owner, "balls", balls, Mapping)
        given = {name: array(owner, "balls", rows, (None, 4), "m") for name, rows in balls.items()}
        if not given:
            raise InputError(
                "Input balls of Lumen.ways must have one entry at least; received none."
            )
        instance(owner, "trunks", trunks, Sequence)
        more = [array(owner, "trunks", rows, (None, 4), "m") for rows in trunks]
        walls, paths = join_ways(given, more, blend)
        return cls(walls, paths=paths, target=target)

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

    def with_surface(self, points: ArrayLike, triangles: ArrayLike) -> Lumen:
        """The lumen with triangles for a wall, in place of the balls along its branches.

        Parameters
        ----------
        points
            Corners of the triangles, shape (n, 3) [m].
        triangles
            Their indices, shape (m, 3). The surface is in one piece, has rims where the lumen is
            open and nowhere else, and the branches run inside of it.

        Raises
        ------
        InputError
            If these are no such triangles.

        Notes
        -----
        (P-41) of the theory pages. The wall that a wire feels is smooth, and nowhere outside of the
        triangles; ``fidelity`` says how far inside it is.
        """
        made = replace(self, sheet=Sheet(np.asarray(points), np.asarray(triangles)))
        return made

    @property
    def fidelity(self) -> tuple[float, float, float]:
        """How far a wall of triangles lies inside of them: mean, 95 percent and largest [m].

        Zero for a wall of balls, which is what it is.
        """
        if self._wall is None:
            return 0.0, 0.0, 0.0
        off = self._wall.off
        return float(off.mean()), float(np.percentile(off, 95.0)), float(off.max())

    def with_entry(self, length: float) -> Lumen:
        """The lumen with a straight tube of ``length`` [m] in front of its entrance."""
        if nonnegative("Lumen.with_entry", "length", length, "m") == 0.0 or not self.branches:
            return self
        first = self.branches[0].with_entry(length)
        paths = Lazy({name: partial(_entered, self.paths, name, length) for name in self.paths})
        return replace(self, branches=(first, *self.branches[1:]), paths=paths)

    @property
    def outlets(self) -> tuple[str, ...]:
        """Names of a tree's outlets, in the order of its branches; empty for a single tube."""
        return tuple(self.paths)

    @property
    def trunks(self) -> tuple[Branch, ...]:
        """Branches that are wall, but no way to an outlet: those after the outlets' own."""
        return self.branches[len(self.paths) :] if self.paths else ()

    def towards(self, target: str) -> Lumen:
        """The same lumen with another outlet to go to; what was made for this one is shared.

        Parameters
        ----------
        target
            Name of the outlet.

        Raises
        ------
        InputError
            If there is no such outlet.
        """
        other = replace(self, target=self._known("target", target))
        for made in ("_search", "_wall", "_ways"):
            other.__dict__[made] = getattr(self, made)
        return other

    def path(self, target: str | None = None) -> Lumen:
        """The path from the entrance to an outlet as a lumen of one branch.

        Its centreline is twice continuously differentiable, also where it goes from one branch
        into the next. Its wall is not that of the tree, which is wider at a junction.

        Parameters
        ----------
        target
            Name of the outlet; the lumen's own target if left out.
        """
        if not self.paths and target is None:
            return self if self.sheet is None else replace(self, sheet=None)
        name = self.target if target is None else self._known("target", target)
        return self._ways[str(name)]

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
        """Arc length from the entrance to the target [m]; infinite in open space."""
        if self.target is not None:
            return self.paths[self.target].length
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
        found = array("Lumen", "points", points, (None, 3), "m")
        if self.sheet is None:
            return self._search.near(found)[0]
        gap, arc = np.empty((2, len(found)))
        gap_many(self.arrays(), found, gap, arc, np.empty(len(found), dtype=np.int32))
        return gap

    def locate(self, points: ArrayLike) -> tuple[Array, Indices]:
        """Arc parameter [m] and branch of the ball that each point is deepest in, shapes (n,).

        Parameters
        ----------
        points
            Shape (n, 3) [m]. Also far outside of the lumen: there it is the nearest ball.
        """
        return self._search.anywhere(array("Lumen", "points", points, (None, 3), "m"))

    def offset(self, points: ArrayLike) -> Array:
        """Distance of points from the centreline, shape (n,) [m]; nan in open space.

        Past an end the centreline goes on straight.

        Parameters
        ----------
        points
            Shape (n, 3) [m].
        """
        return self._search.offset(array("Lumen", "points", points, (None, 3), "m"))

    def bulge(self, inset: float) -> float:
        """Largest curvature with which the wall bulges inward, ``inset`` [m] off it [1/m].

        A chord between two points comes nearer to the wall than they are by at most an eighth of
        this times its length squared.
        """
        if self._wall is not None:
            return sheet_bulge(self.arrays(), self._wall, inset)
        return largest(self.bulges(inset), self.branches)

    def bulges(self, inset: float) -> list[Bulge]:
        """The same along each branch: the largest where the ball is that a point is deepest in."""
        return bulges(self._search.arrays, self.branches, inset)

    def arrays(self, length_scale: float = 1.0) -> LumenArrays:
        """The lumen as the kernels take it, in units of ``length_scale`` [m]."""
        scale = positive("Lumen.arrays", "length_scale", length_scale, "m")
        balls = scaled(self._search.arrays, scale)
        if self._wall is None:
            return balls
        return balls._replace(sheet=(scaled_sheet(self._wall.arrays, scale),))

    @cached_property
    def _wall(self) -> SheetWall | None:
        """The wall of triangles, if that is the wall; made when first asked for."""
        return None if self.sheet is None else build(self.sheet, self.branches)

    @cached_property
    def _ways(self) -> Mapping[str, Lumen]:
        """Every path as a lumen."""
        return Lazy({name: partial(_alone, self.paths, name) for name in self.paths})

    def _known(self, name: str, outlet: str) -> str:
        """The name of an outlet, checked."""
        instance("Lumen", name, outlet, str)
        outlet = meant(outlet, tuple(self.paths))
        if outlet in self.paths:
            return outlet
        words = ", ".join(f"'{known}'" for known in self.paths)
        expected = (
            f"one of the outlets {words}" if words else "left out for a lumen without outlets"
        )
        raise InputError(f"Input {name} of Lumen must be {expected}; received {outlet!r}.")

    @cached_property
    def _search(self) -> Search:
        """Where points are, in all branches."""
        return Search(self.branches)


def _entered(paths: Mapping[str, Branch], name: str, length: float) -> Branch:
    return paths[name].with_entry(length)


def _alone(paths: Mapping[str, Branch], name: str) -> Lumen:
    return Lumen((paths[name],))


def _lines(branches: Mapping[str, Lumen]) -> dict[str, Branch]:
    """The tubes of a tree by name, checked."""
    given: object = branches
    if not isinstance(given, Mapping) or not given:
        raise InputError(
            "Input branches of Lumen.tree must be a mapping of names to lumens with at least one "
            f"entry; received {type(given).__name__ if given else 'none'}."
        )
    lines = {}
    for name, tube in given.items():
        if not isinstance(name, str) or not isinstance(tube, Lumen) or len(tube.branches) != 1:
            count = f"with {len(tube.branches)} branches" if isinstance(tube, Lumen) else ""
            raise InputError(
                "Input branches of Lumen.tree must map names to lumens of one branch; received "
                f"{type(tube).__name__} {count}".rstrip()
                + f" for {name!r}."
            )
        lines[name] = tube.branches[0]
    return lines
