"""From a file to named tubes: units, lines, ways from the entrance to the ends, and a record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from magwire.errors import array, nonnegative, one_of, positive, refuse
from magwire.lumen.branch import Branch
from magwire.vessel.clean import clean
from magwire.vessel.files import Drawing, Line, load
from magwire.vessel.files.drawing import Array, FileFaultError, Indices
from magwire.vessel.files.drawing import refuse as refuse_file
from magwire.vessel.network import Network
from magwire.vessel.placement import OWNER, Placement, unit_factor
from magwire.vessel.smooth import smooth

SPUR = 1.5  # shortest branch that counts, over the radius where it leaves
SAME = 0.1  # how much closer to a point a tube has to be to be the one that is meant, in radii
CLOSED = 0.5  # part of the smallest radius that has to be left
SMOOTHING = 0.5  # in radii
RAISED = (1.0, 1.5, 2.0, 3.0, 4.0)  # factors on it that are tried, where bends are too sharp

if TYPE_CHECKING:
    from magwire.lumen.lumen import Lumen

Spot = str | int | Sequence[float]
"""An open end by its name or number, or a point [m]."""


class Way(NamedTuple):
    """What was done to one way from the entrance to an end.

    Attributes
    ----------
    deviation
        Largest and root mean square distance of the file's points from the way [m].
    narrowed
        Most that was taken off the radius [m], because the way bends or tapers sharply there.
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
    tubes
        Smooth tubes from the entrance to each other open end, by the name of the end.
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
    """

    tubes: dict[str, Branch]
    entrance: str
    ends: dict[str, Array]
    ways: dict[str, Way] = field(default_factory=dict)
    smoothing: float = 0.0
    notes: tuple[str, ...] = ()

    @classmethod
    def read(
        cls,
        path: str | Path,
        units: str | None = None,
        *,
        entrance: Spot | None = None,
        radius: float | str | None = None,
        scale: float = 1.0,
        rotation: ArrayLike = (0.0, 0.0, 0.0),
        translation: ArrayLike = (0.0, 0.0, 0.0),
        smoothing: float = SMOOTHING,
    ) -> Vessel:
        """Read a file of centrelines, or of a surface, whose centrelines are extracted.

        Parameters
        ----------
        path
            The end of its name says which format it is in: VTK (.vtp, .vtk), tables (.csv, .tsv,
            .dat, .txt), SWC (.swc), SimVascular (.pth), TubeTK (.tre), 3D Slicer (.mrk.json), or a
            surface (.vtp, .vtk, .stl, .ply, .obj).
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
            raised, up to fourfold, where bends are too sharp for the lumen's width.

        Raises
        ------
        InputError
            If the file cannot be used: in one sentence, why.
        """
        nonnegative(OWNER, "smoothing", smoothing)
        positive(OWNER, "scale", scale)
        name = radius if isinstance(radius, str) else None
        drawing = load(path, name)
        factor = scale * unit_factor(path, units, drawing)
        constant = None if radius is None or name else positive(OWNER, "radius", radius, "m")
        placement = Placement(factor, rotation, translation)
        wide = None if constant is None else constant * scale
        try:
            with np.errstate(all="ignore"):  # numbers of a broken file end in a refusal
                drawing, notes = _extracted(drawing)
                lines = [_placed(line, placement, wide, drawing.arrays) for line in drawing.lines]
                known = entrance is None or isinstance(entrance, str)
                if drawing.entrance and known and entrance in (None, drawing.entrance):
                    return _finished(lines, drawing.entrance)
                return _made(lines, entrance, smoothing, notes)
        except FileFaultError as fault:
            raise refuse_file(path, str(fault)) from None

    def lumen(self, target: Spot | None = None, *, blend: float | None = None) -> Lumen:
        """The tubes joined into one lumen.

        Parameters
        ----------
        target
            Outlet to go to: its name, its number from one among ``ends``, or a point [m]; the
            first one if left out.
        blend
            As in ``Lumen.tree`` [m].

        Raises
        ------
        InputError
            If there is no such outlet, or the tubes cannot be joined.
        """
        from magwire.lumen.lumen import Lumen

        tubes = {name: Lumen((tube,)) for name, tube in self.tubes.items()}
        return Lumen.tree(tubes, target=self.outlet(target), blend=blend)

    def outlet(self, target: Spot | None) -> str | None:
        """The name of the outlet meant by a name, a number or a point; None if left out."""
        if target is None:
            return None
        if isinstance(target, (str, int)):
            return _chosen("target", target, tuple(self.tubes), tuple(self.ends))
        point = array(OWNER, "target", target, (3,), "m")
        off = {n: np.linalg.norm(t.points - point, axis=1) for n, t in self.tubes.items()}
        least = min(float(distance.min()) for distance in off.values())
        near = {  # a point on a trunk is on the way to several outlets: the closest one is meant
            name: self.tubes[name].length * (1.0 - float(np.argmin(distance)) / len(distance))
            for name, distance in off.items()
            if distance.min() <= least + SAME * self.tubes[name].radius[int(np.argmin(distance))]
        }
        return min(near, key=lambda name: near[name])


def _finished(lines: list[Line], entrance: str) -> Vessel:
    """The tubes of a file that magwire has made, as they are."""
    ends = {entrance: lines[0].points[0], **{line.name: line.points[-1] for line in lines}}
    tubes = {line.name: Branch(line.points, line.radius) for line in lines}
    still = {name: Way((0.0, 0.0), 0.0, tube.entrance) for name, tube in tubes.items()}
    return Vessel(tubes, entrance, ends, still)


def _made(
    lines: list[Line], entrance: Spot | None, smoothing: float, notes: tuple[str, ...]
) -> Vessel:
    """The tubes that lines make, once they are cleaned, joined and smoothed."""
    cleaned = [clean(line, number) for number, line in enumerate(lines, start=1)]
    dropped = sum(part.dropped for part in cleaned)
    if dropped:
        notes = (*notes, f"Points that are repeated, stray or without radius: {dropped}, left out.")
    network = Network.of([part.line for part in cleaned])
    places = {name: network.points[end] for name, end in network.ends.items()}
    start, name, network = _start(network, entrance)
    before = network.from_entrance(start)
    ways = {
        end: network.way(before, node)
        for end, node in network.ends.items()
        if node != start and before[node] >= 0
    }
    ways, spurs = _without_spurs(network, ways)
    if not ways:
        raise FileFaultError("has no open end to go to")
    tubes, done, used = _tubes(network, ways, smoothing)
    notes = (*notes, *network.notes, *spurs)
    if used > smoothing:
        notes = (*notes, f"Bends are too sharp for {smoothing:g} radii of smoothing: {used:g}.")
    return Vessel(tubes, name, places, done, used, notes)


def _tubes(
    network: Network, ways: dict[str, Indices], smoothing: float
) -> tuple[dict[str, Branch], dict[str, Way], float]:
    """The tubes along all ways, what was done to them, and by how much smoothing.

    It is the least of ``RAISED`` times what was asked for that leaves all of them open, and the
    same for all, so that they stay one in their trunk.
    """
    for factor in RAISED:
        try:
            made = {
                end: _tube(end, network.points[way], network.radius[way], factor * smoothing)
                for end, way in ways.items()
            }
        except FileFaultError:
            if factor == RAISED[-1]:
                raise
        else:
            break
    tubes, done = ({end: pair[k] for end, pair in made.items()} for k in (0, 1))
    return tubes, done, factor * smoothing  # type: ignore[return-value]


def _extracted(drawing: Drawing) -> tuple[Drawing, tuple[str, ...]]:
    """The drawing with the centrelines of its surface, if it has no lines, and what was done."""
    if drawing.lines or drawing.surface is None:
        return drawing, ()
    from magwire.vessel.extract import extract

    found = extract(drawing.surface)
    return drawing._replace(lines=found.lines), found.notes


def _placed(
    line: Line, placement: Placement, constant: float | None, arrays: Sequence[str]
) -> Line:
    """A line in metres, where it is to be, with the radius that was asked for."""
    radius = line.radius * placement.factor
    if constant is not None:
        radius = np.full(len(radius), constant)
    if np.isnan(radius).all():
        there = ", ".join(repr(name) for name in arrays)
        raise FileFaultError(
            "has no radius at its points"
            + (f" among its arrays {there}" if there else "")
            + "; name the array that holds it, or give one radius"
        )
    return Line(line.name, placement.points(line.points), radius)


def _start(network: Network, entrance: Spot | None) -> tuple[int, str, Network]:
    """The point to enter at, its name, and what of the network lies past it."""
    if not network.ends:
        raise FileFaultError("has no open end to enter at")
    if entrance is None:
        name = max(network.ends, key=lambda end: network.radius[network.ends[end]])
        return network.ends[name], name, network
    if isinstance(entrance, (str, int)):
        names = tuple(network.ends)
        name = _chosen("entrance", entrance, names, names)
        return network.ends[name], name, network
    node = network.nearest(array(OWNER, "entrance", entrance, (3,), "m"))
    for name, end in network.ends.items():
        if np.linalg.norm(network.points[end] - network.points[node]) <= network.radius[node]:
            return end, name, network
    return node, "point", network.beyond(node)


def _chosen(what: str, spot: str | int, names: Sequence[str], order: Sequence[str]) -> str:
    """The name of an end by its name, or by its number from one in ``order``."""
    if isinstance(spot, str):
        return one_of(OWNER, what, spot, names)
    if not 1 <= spot <= len(order) or order[spot - 1] not in names:
        numbers = ", ".join(str(order.index(name) + 1) for name in names)
        raise refuse(OWNER, what, f"the number of an end, one of {numbers}", spot)
    return order[spot - 1]


def _without_spurs(
    network: Network, ways: dict[str, Indices]
) -> tuple[dict[str, Indices], tuple[str, ...]]:
    """Ways that leave all others for more than about a radius."""
    kept, notes = dict(ways), []
    walked = np.bincount(np.concatenate([*ways.values(), np.zeros(0, dtype=np.int64)]))
    for name in list(ways):
        if len(kept) == 1:
            continue
        taken = walked[kept[name]] > 1  # by another way, too
        last = int(np.flatnonzero(taken)[-1])
        own = network.points[kept[name][last:]]
        length = float(np.linalg.norm(np.diff(own, axis=0), axis=1).sum())
        if length < SPUR * network.radius[kept[name][last]]:
            walked[kept[name]] -= 1
            del kept[name]
            notes.append(f"A spur of {length:.4g} m, '{name}', is left out.")
    return kept, tuple(notes)


def _tube(name: str, points: Array, radius: Array, length: float) -> tuple[Branch, Way]:
    """The smooth tube of a way."""
    found = smooth(points, radius, length)
    worst = int(np.argmax(found.narrowed))
    closed = int(np.argmin(found.radius))
    if found.radius[closed] < CLOSED * radius.min():
        x, y, z = found.points[closed]
        raise FileFaultError(
            f"bends so sharply near ({x:.4g}, {y:.4g}, {z:.4g}) m, on the way to '{name}', that a "
            f"lumen of radius {found.radius[closed]:.3g} m is left of {radius.min():.3g} m; even "
            f"with a smoothing of {length:g} radii"
        )
    deviation = float(found.deviation.max()), float(np.sqrt(np.mean(found.deviation**2)))
    way = Way(deviation, float(found.narrowed[worst]), found.points[worst])
    return Branch(found.points, found.radius), way
