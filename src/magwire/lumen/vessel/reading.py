"""From a file to named tubes: units, lines, ways from the entrance to the ends, and a record."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from magwire.errors import InputError, array, nonnegative, one_of, positive, refuse
from magwire.lumen.branch import Branch
from magwire.lumen.files import Drawing, Line, load
from magwire.lumen.files.drawing import Array, FileFault
from magwire.lumen.files.drawing import refuse as refuse_file
from magwire.lumen.vessel.clean import clean
from magwire.lumen.vessel.network import Network
from magwire.lumen.vessel.smooth import smooth
from magwire.units import DIMENSIONS

SPUR = 1.5  # shortest branch that counts, over the radius where it leaves
CLOSED = 0.5  # part of the smallest radius that has to be left
OWNER = "Lumen.read"
ALREADY = 0.0

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
class Reading:
    """A vessel's file, read.

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

    def target(self, spot: Spot | None) -> str | None:
        """The name of a tube by the name or the number of its end, or by a point near it [m]."""
        return None if spot is None else _chosen("target", spot, {n: self.ends[n] for n in self.tubes}, list(self.ends))


@dataclass(frozen=True)
class Placement:
    """How the numbers of a file become places: scaled, then turned, then moved.

    Parameters
    ----------
    factor
        Metres for one of the file's units, times the scale that was asked for.
    rotation
        Rotation vector, shape (3,) [rad].
    translation
        Shape (3,) [m].
    """

    factor: float
    rotation: ArrayLike = (0.0, 0.0, 0.0)
    translation: ArrayLike = (0.0, 0.0, 0.0)

    def points(self, points: Array) -> Array:
        """Points where they are to be, shape (n, 3) [m]."""
        turn = Rotation.from_rotvec(array(OWNER, "rotation", self.rotation, (3,), "rad"))
        shift = array(OWNER, "translation", self.translation, (3,), "m")
        return np.asarray(turn.apply(self.factor * points) + shift)


def read(
    path: str | Path,
    units: str | None = None,
    *,
    radius: float | str | None = None,
    entrance: Spot | None = None,
    scale: float = 1.0,
    rotation: ArrayLike = (0.0, 0.0, 0.0),
    translation: ArrayLike = (0.0, 0.0, 0.0),
    smoothing: float = 0.5,
) -> Reading:
    """Read a file; see ``Lumen.read``."""
    nonnegative(OWNER, "smoothing", smoothing)
    positive(OWNER, "scale", scale)
    name = radius if isinstance(radius, str) else None
    drawing = load(path, name)
    unit = _unit(path, units, drawing)
    placement = Placement(unit * scale, rotation, translation)
    constant = None if radius is None or name else positive(OWNER, "radius", radius, "m")
    try:
        return _reading(path, drawing, placement, constant, entrance, smoothing)
    except FileFault as fault:
        raise refuse_file(path, str(fault)) from None


def guessed_unit(drawing: Drawing) -> str:
    """The unit in which the numbers of a file would be those of a vessel: "mm", "cm", "m" or "um".

    The size of the whole settles it: people have vessels of some 10 mm to 1 m.
    """
    points = [line.points for line in drawing.lines]
    if drawing.surface is not None:
        points.append(drawing.surface.points)
    every = np.concatenate(points)
    size = float(np.linalg.norm(np.ptp(every, axis=0)))
    radii = [line.radius[np.isfinite(line.radius)] for line in drawing.lines]
    values = np.concatenate(radii) if radii else np.zeros(0)
    sizes = [(size, 0.12, 0.5)]
    if values.size and np.median(values) > 0.0:
        sizes.append((float(np.median(values)), 0.0025, 1.0))
    units = ("um", "mm", "cm", "m")
    factors = DIMENSIONS["length"].units
    off = [
        sum(w * abs(math.log(max(s, 1e-300) * factors[u] / usual)) for s, usual, w in sizes)
        for u in units
    ]
    return units[int(np.argmin(off))]


def _unit(path: str | Path, units: str | None, drawing: Drawing) -> float:
    """Metres in the file's unit."""
    known = DIMENSIONS["length"].units
    if units is not None:
        return known[one_of(OWNER, "units", units, known)]
    if drawing.unit is None or drawing.unit not in known:
        raise InputError(
            f"Input units of {OWNER} must be given for '{path}', which does not state them; its "
            f"numbers look like '{guessed_unit(drawing)}'."
        )
    return known[drawing.unit]


def _reading(
    path: str | Path,
    drawing: Drawing,
    placement: Placement,
    constant: float | None,
    entrance: Spot | None,
    smoothing: float,
) -> Reading:
    drawing, notes = _lines(path, drawing)
    cleaned = [
        clean(_placed(line, placement, constant, drawing.arrays), number)
        for number, line in enumerate(drawing.lines, start=1)
    ]
    dropped = sum(part.dropped for part in cleaned)
    if dropped:
        notes = (*notes, f"{dropped} repeated, stray or radiusless points are left out.")
    network = Network.of([part.line for part in cleaned])
    notes = (*notes, *network.notes)
    places = {name: network.points[end] for name, end in network.ends.items()}
    start, name, network = _start(network, entrance)
    _, before = network.from_entrance(start)
    ways = {
        end: network.way(before, node)
        for end, node in network.ends.items()
        if node != start and before[node] >= 0
    }
    ways, more = _without_spurs(network, ways)
    if not ways:
        raise FileFault("has no open end to go to")
    length = ALREADY if drawing.smooth else smoothing
    tubes, done = {}, {}
    for end, way in ways.items():
        tubes[end], done[end] = _tube(end, network.points[way], network.radius[way], length)
    return Reading(tubes, name, places, done, length, (*notes, *more))


def _lines(path: str | Path, drawing: Drawing) -> tuple[Drawing, tuple[str, ...]]:
    """The drawing with lines; those of a surface are extracted from it."""
    if drawing.lines or drawing.surface is None:
        return drawing, ()
    from magwire.lumen.vessel.extract import extract

    extracted = extract(drawing.surface)
    return drawing._replace(lines=extracted.lines), extracted.notes


def _placed(line: Line, placement: Placement, constant: float | None, arrays: Sequence[str]) -> Line:
    """A line in metres, where it is to be, with the radius that was asked for."""
    radius = line.radius * placement.factor
    if constant is not None:
        radius = np.full(len(radius), constant)
    if np.isnan(radius).all():
        there = ", ".join(repr(name) for name in arrays)
        raise FileFault(
            "has no radius at its points"
            + (f" among its arrays {there}" if there else "")
            + "; name the array that holds it, or give one radius"
        )
    return Line(line.name, placement.points(line.points), radius)


def _start(network: Network, entrance: Spot | None) -> tuple[int, str, Network]:
    """The point to enter at, its name, and what of the network lies past it."""
    if not network.ends:
        raise FileFault("has no open end to enter at")
    if entrance is None:
        name = max(network.ends, key=lambda end: network.radius[network.ends[end]])
        return network.ends[name], name, network
    names = list(network.ends)
    places = {end: network.points[node] for end, node in network.ends.items()}
    if isinstance(entrance, (str, int)):
        name = _chosen("entrance", entrance, places, names)
        return network.ends[name], name, network
    node = network.nearest(array(OWNER, "entrance", entrance, (3,), "m"))
    for name, end in network.ends.items():
        if np.linalg.norm(network.points[end] - network.points[node]) <= network.radius[node]:
            return end, name, network
    return node, "point", network.beyond(node)


def _chosen(what: str, spot: Spot, places: dict[str, Array], order: list[str]) -> str:
    """The name of an end by its name, its number from one in ``order``, or a point near it."""
    if isinstance(spot, str):
        return one_of(OWNER, what, spot, places)
    if isinstance(spot, int):
        if not 1 <= spot <= len(order) or order[spot - 1] not in places:
            numbers = ", ".join(str(order.index(name) + 1) for name in places)
            raise refuse(OWNER, what, f"the number of an end, one of {numbers}", spot)
        return order[spot - 1]
    point = array(OWNER, what, spot, (3,), "m")
    return min(places, key=lambda name: float(np.linalg.norm(places[name] - point)))


def _without_spurs(
    network: Network, ways: dict[str, np.ndarray[tuple[int], np.dtype[np.int64]]]
) -> tuple[dict[str, np.ndarray[tuple[int], np.dtype[np.int64]]], tuple[str, ...]]:
    """Ways that leave all others for more than about a radius."""
    kept, notes = dict(ways), []
    for name in list(ways):
        others = [way for end, way in kept.items() if end != name]
        if not others:
            continue
        taken = np.isin(kept[name], np.concatenate(others))
        last = int(np.flatnonzero(taken)[-1])
        own = network.points[kept[name][last:]]
        length = float(np.linalg.norm(np.diff(own, axis=0), axis=1).sum())
        if length < SPUR * network.radius[kept[name][last]]:
            del kept[name]
            notes.append(f"A spur of {length:.4g} m, '{name}', is left out.")
    return kept, tuple(notes)


def _tube(name: str, points: Array, radius: Array, length: float) -> tuple[Branch, Way]:
    """The smooth tube of a way."""
    if length == ALREADY:
        return Branch(points, radius), Way((0.0, 0.0), 0.0, points[0])
    found = smooth(points, radius, length)
    worst = int(np.argmax(found.narrowed))
    closed = int(np.argmin(found.radius))
    if found.radius[closed] < CLOSED * radius.min():
        x, y, z = found.points[closed]
        raise FileFault(
            f"bends so sharply near ({x:.4g}, {y:.4g}, {z:.4g}) m, on the way to '{name}', that a "
            f"lumen of radius {found.radius[closed]:.3g} m is left of {radius.min():.3g} m; give "
            f"more smoothing than {length:g} radii"
        )
    deviation = float(found.deviation.max()), float(np.sqrt(np.mean(found.deviation**2)))
    way = Way(deviation, float(found.narrowed[worst]), found.points[worst])
    return Branch(found.points, found.radius), way
