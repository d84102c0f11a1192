"""A vessel read from a file: its tubes, and a record of what was done to get them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from magwire.errors import InputError, array, one_of
from magwire.lumen.branch import Branch
from magwire.lumen.lazy import Lazy
from magwire.vessel.balls import Original
from magwire.vessel.deviation import LIMIT, Deviation, deviation
from magwire.vessel.files import Surface
from magwire.vessel.files.drawing import NO_WAY, Array
from magwire.vessel.placement import OWNER
from magwire.vessel.reading import SMOOTHING, Found, Options, Source, Spot, chosen, found
from magwire.vessel.ways import Tube
from magwire.vessel.words import long

SAME = 0.1  # how much closer to a point a tube has to be to be the one that is meant, in radii

if TYPE_CHECKING:
    from magwire.lumen.lumen import Lumen


class Way(NamedTuple):
    """What was done to one path from the entrance to an end.

    Attributes
    ----------
    deviation
        Largest and root mean square distance of the file's points from the path [m].
    narrowed
        Most that was taken off the radius [m], because the path bends or tapers sharply there.
    where
        Where that is, shape (3,) [m].
    """

    deviation: tuple[float, float]
    narrowed: float
    where: Array


@dataclass(frozen=True, eq=False)
class Vessel:
    """The tubes of a vessel, read from a file, and what was done to get them.

    Attributes
    ----------
    balls
        Points of the smooth path from the entrance to each other open end, and the radius there, by
        the name of the end, shape (n, 4) [m].
    entrance
        Name of the end that is the entrance, or "point".
    ends
        Places of all open ends by name, in the order of the file [m].
    ways
        What smoothing did, by the name of the tube.
    smoothing
        Its length, in radii.
    notes
        What else was done to what the file holds, a sentence each.
    original
        The vessel as the file has it; None for one that magwire has made.
    surface
        The file's triangles, if it has any [m].
    wall
        The same, open at the vessel's ends and nowhere else [m].
    trunks
        Balls of trunks that are wall though no path runs straight through them, shape (n, 4) [m].
    """

    balls: Mapping[str, Array]
    entrance: str
    ends: Mapping[str, Array]
    ways: Mapping[str, Way] = field(default_factory=dict)
    smoothing: float = 0.0
    notes: tuple[str, ...] = ()
    original: Original | None = None
    surface: Surface | None = None
    wall: Surface | None = None
    trunks: tuple[Array, ...] = ()

    @classmethod
    def read(
        cls,
        path: Source,
        units: str | None = None,
        *,
        entrance: Spot | None = None,
        radius: float | str | None = None,
        scale: float = 1.0,
        rotation: ArrayLike = (0.0, 0.0, 0.0),
        translation: ArrayLike = (0.0, 0.0, 0.0),
        smoothing: float = SMOOTHING,
        extend: float = 0.0,
        cut: Sequence[ArrayLike] = (),
    ) -> Vessel:
        """Read a file of centrelines, or of a surface, whose centrelines are extracted.

        Parameters
        ----------
        path
            The end of its name says which format it is in: VTK (.vtp, .vtk), tables (.csv, .tsv,
            .dat, .txt), SWC (.swc), SimVascular (.pth), TubeTK (.tre), 3D Slicer (.mrk.json), or a
            surface (.vtp, .vtk, .stl, .ply, .obj). A folder, or several files, of one branch each
            are one vessel.
        units
            Unit of its numbers, such as "mm"; needed unless the file states it.
        entrance
            Open end to enter at: its name, its number from one, or a point [m]. A point inside
            cuts off what is behind it. The widest end if left out.
        radius
            Name of the array that holds it, if that is none of the usual ones, or one radius for
            all points [m].
        scale
            Factor on all lengths.
        rotation, translation
            Rotation vector [rad] about the origin, and what is added then [m], shapes (3,).
        smoothing
            Length in radii of the lumen; waves shorter than 2 pi times it are taken out. It is
            raised, up to fourfold, around bends that are too sharp for the lumen's width.
        extend
            By how many radii lines are made longer at their open ends, up to 100.
        cut
            Points at which loops are opened, shape (n, 3) [m]; a loop without one is opened where
            it is farthest from the entrance.

        Raises
        ------
        InputError
            If the file cannot be used: in one sentence, why.
        """
        options = Options(
            entrance, radius, scale, rotation, translation, smoothing, extend, tuple(cut)
        )
        return _vessel(found(path, units, options), options)

    @cached_property
    def tubes(self) -> Mapping[str, Branch]:
        """Smooth tubes from the entrance to each other open end, by the name of the end."""
        return Lazy({name: partial(self._tube, name) for name in self.balls})

    @cached_property
    def deviation(self) -> Deviation | None:
        """How far the walls of the tubes are from those of the file; None without one."""
        if self.original is None:
            return None
        return deviation([*self.balls.values(), *self.trunks], self.original)

    @property
    def deviation_words(self) -> tuple[str, ...]:
        """How far the walls are from those of the file, a sentence each; none without a file."""
        if self.deviation is None:
            return ()
        file = "surface" if self.surface is not None else "balls around its points"
        return (
            f"outside of the file's {file} by {self.deviation.outside.words}",
            f"inside of it by {self.deviation.inside.words}",
        )

    def record(self, wall: Literal["balls", "surface"] = "balls") -> tuple[str, ...]:
        """All that was done to the file, and how far the wall is from the file's, a sentence each.

        Parameters
        ----------
        wall
            As of ``lumen``.

        Raises
        ------
        InputError
            As of ``check``, and of ``lumen`` if the wall is to be the surface.
        """
        if wall == "surface":
            return (*self.notes, f"The wall lies {self.fidelity_words}.")
        self.check()
        return (*self.notes, *(f"The wall lies {text}." for text in self.deviation_words))

    @property
    def fidelity_words(self) -> str:
        """How far a wall of the file's triangles lies inside of them, part of a sentence."""
        mean, most, worst = self.lumen(wall="surface").fidelity
        return (
            f"inside of the file's surface by {long(mean)} in the mean, {long(most)} at 95 "
            f"percent, {long(worst)} at most, and nowhere outside of it"
        )

    def check(self) -> None:
        """Refuse a vessel whose wall is not that of the file.

        Raises
        ------
        InputError
            If more than a twentieth of it is farther outside than ``deviation.LIMIT`` radii.
        """
        if self.deviation is not None and self.deviation.outside.radii[1] > LIMIT:
            raise InputError(
                "Input smoothing of Lumen.read must leave the wall within "
                f"{LIMIT:g} radii of the file's; received {self.smoothing:g}, which moves it "
                f"outside by {self.deviation.outside.words}."
            )

    def lumen(
        self,
        target: Spot | None = None,
        *,
        blend: float | None = None,
        wall: Literal["balls", "surface"] = "balls",
    ) -> Lumen:
        """The tubes joined into one lumen.

        Parameters
        ----------
        target
            Outlet to go to: its name, its number from one among ``ends``, or a point [m]; the
            first one if left out.
        blend
            As in ``Lumen.tree`` [m].
        wall
            What a wire feels: "balls" around the paths, or the triangles of the file's "surface".

        Raises
        ------
        InputError
            If there is no such outlet, the tubes cannot be joined, or the file has no surface.
        """
        from magwire.lumen.lumen import Lumen

        one_of(OWNER, "wall", wall, ("balls", "surface"))
        if wall == "surface" and self.wall is None:
            raise InputError(
                f"Input wall of {OWNER} must be 'balls' for a file without a surface; received "
                "'surface'."
            )
        lumen = Lumen.ways(self.balls, trunks=self.trunks, target=self.outlet(target), blend=blend)
        if wall == "balls" or self.wall is None:
            return lumen
        return lumen.with_surface(self.wall.points, self.wall.triangles)

    def outlet(self, target: Spot | None) -> str | None:
        """The name of the outlet meant by a name, a number or a point; None if left out."""
        if target is None:
            return None
        if isinstance(target, (str, int)):
            return chosen("target", target, tuple(self.balls), tuple(self.ends))
        point = array(OWNER, "target", target, (3,), "m")
        off = {n: np.linalg.norm(b[:, :3] - point, axis=1) for n, b in self.balls.items()}
        least = min(float(distance.min()) for distance in off.values())
        near = {  # a point on a trunk is on the path to several outlets: the closest one is meant
            name: len(distance) - int(np.argmin(distance))
            for name, distance in off.items()
            if distance.min() <= least + SAME * self.balls[name][int(np.argmin(distance)), 3]
        }
        return min(near, key=lambda name: near[name])

    def _tube(self, name: str) -> Branch:
        balls = self.balls[name]
        return Branch(balls[:, :3], balls[:, 3])


def _vessel(read: Found, options: Options) -> Vessel:
    """The vessel that a file makes."""
    if read.ways is None:
        still = {x.name: Way((0.0, 0.0), 0.0, x.points[0]) for x in read.lines}
        rows = [(x.name, np.column_stack([x.points, x.radius])) for x in read.lines]
        made = {name: balls for name, balls in rows if name != NO_WAY}
        stay = tuple(balls for name, balls in rows if name == NO_WAY)
        return Vessel(made, read.entrance, read.ends, still, notes=read.notes, trunks=stay)
    tubes = read.ways.tubes
    return Vessel(
        Lazy({name: partial(_balls, tube) for name, tube in tubes.items()}),
        read.entrance,
        read.ends,
        Lazy({name: partial(_way, tube) for name, tube in tubes.items()}),
        options.smoothing,
        read.notes,
        read.original,
        read.surface,
        read.wall,
        read.ways.trunks,
    )


def _balls(tube: Tube) -> Array:
    return np.column_stack([tube.whole("points"), tube.whole("radius")])


def _way(tube: Tube) -> Way:
    """What was done to a path, from the entrance on."""
    off, narrowed = tube.deviations(), tube.whole("narrowed")
    worst = int(np.argmax(narrowed))
    deviated = float(off.max(initial=0.0)), float(np.sqrt(np.mean(off**2))) if len(off) else 0.0
    return Way(deviated, float(narrowed[worst]), tube.whole("points")[worst])
