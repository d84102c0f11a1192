"""From a file to named tubes: units, lines, paths from the entrance to the ends, and a record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from magwire.errors import array, nonnegative, one_of, positive, refuse, within
from magwire.lumen.names import meant
from magwire.units import DIMENSIONS
from magwire.vessel.balls import Original
from magwire.vessel.clean import clean
from magwire.vessel.files import Drawing, Line, Surface, load
from magwire.vessel.files.drawing import NO_WAY, Array, FileFaultError
from magwire.vessel.files.drawing import refuse as refuse_file
from magwire.vessel.mesh import End
from magwire.vessel.network import Network
from magwire.vessel.placement import OWNER, Placement, unit_factor, unlike
from magwire.vessel.skin import Skin
from magwire.vessel.vmtk import hints
from magwire.vessel.ways import Ways, ways
from magwire.vessel.words import place

SMOOTHING = 0.5  # in radii
LONGEST = 100.0  # radii by which lines are made longer at most
NEARLY = 0.9  # radius of an end that may be the entrance as well, over that of the widest one

Spot = str | int | Sequence[float]
"""An open end by its name or number, or a point [m]."""
Source = str | Path | Sequence[str | Path]
"""A file, a folder of files or several files of one vessel."""


class Options(NamedTuple):
    """How a file is to be read; what each is, is said in ``Vessel.read``."""

    entrance: Spot | None = None
    radius: float | str | None = None
    scale: float = 1.0
    rotation: ArrayLike = (0.0, 0.0, 0.0)
    translation: ArrayLike = (0.0, 0.0, 0.0)
    smoothing: float = SMOOTHING
    extend: float = 0.0
    cut: Sequence[ArrayLike] = ()


class Found(NamedTuple):
    """What a file makes.

    Attributes
    ----------
    ways
        The paths to the ends; None for tubes that magwire has made and that stay as they are.
    lines
        The lines [m].
    entrance, ends
        The name of the entrance, and the places of all ends by name [m].
    original
        The vessel as the file has it; None for tubes that stay as they are.
    notes
        What was done, a sentence each.
    surface
        The file's surface, if it has one [m].
    wall
        The same, open at its ends and nowhere else [m].
    """

    ways: Ways | None
    lines: list[Line]
    entrance: str
    ends: dict[str, Array]
    original: Original | None
    notes: tuple[str, ...]
    surface: Surface | None
    wall: Surface | None = None


def found(source: Source, units: str | None, options: Options) -> Found:
    """Read a file, a folder or several files.

    Raises
    ------
    InputError
        If it cannot be used: in one sentence, why.
    """
    nonnegative(OWNER, "smoothing", options.smoothing)
    within(OWNER, "extend", options.extend, low=0.0, high=LONGEST)
    scale = positive(OWNER, "scale", options.scale)
    name = options.radius if isinstance(options.radius, str) else None
    constant = None
    if options.radius is not None and name is None:
        constant = scale * positive(OWNER, "radius", options.radius, "m")
    drawing = load(source, name)
    factor = scale * unit_factor(called(source), units, drawing)
    placement = Placement(factor, options.rotation, options.translation)
    stated = DIMENSIONS["length"].units.get(drawing.radius_unit or "")
    if units is not None and drawing.radius_unit == drawing.unit:
        stated = None  # what overrules the unit of the places overrules the same one of the radii
    wide = factor if stated is None else scale * stated
    try:
        with np.errstate(all="ignore"):  # numbers of a broken file end in a refusal
            return _placed(drawing, placement, (wide, constant), options)
    except FileFaultError as fault:
        raise refuse_file(called(source), str(fault)) from None


def called(source: Source) -> str:
    """What messages call a file, or several."""
    return str(source) if isinstance(source, (str, Path)) else ", ".join(map(str, source))


def _placed(
    drawing: Drawing, placement: Placement, sizes: tuple[float, float | None], options: Options
) -> Found:
    """What a drawing makes where it is to be.

    Parameters
    ----------
    drawing, placement
        What the file holds, and where that is to be.
    sizes
        Metres for the unit of the radius, and one radius for all points [m], if asked for.
    options
        How it is to be read.
    """
    notes, named, surface, skin = drawing.notes, None, drawing.surface, None
    closed = None
    lines = [
        Line(line.name, placement.points(line.points), _radius(line, sizes, drawing))
        for line in drawing.lines
    ]
    if not lines and surface is not None:
        from magwire.vessel.extract import extract

        surface = Surface(placement.points(surface.points), surface.triangles)
        extracted = extract(surface, lambda ends: _entered(ends, options.entrance))
        lines, named = list(extracted.lines), extracted.ends
        skin, closed = extracted.wall, extracted.closed
        notes = (*notes, *extracted.notes)
    notes = (*notes, *unlike(lines, surface))
    known = options.entrance is None or isinstance(options.entrance, str)
    if drawing.entrance and known and options.entrance in (None, drawing.entrance):
        ends = {x.name: x.points[-1] for x in lines if x.name != NO_WAY}
        ends = {drawing.entrance: lines[0].points[0], **ends}
        return Found(None, lines, drawing.entrance, ends, None, notes, None)
    if not drawing.entrance and surface is None:
        notes = (*notes, *hints(drawing.arrays, lines, options.extend))
    made = _made(lines, options, notes, named, skin)
    return made._replace(surface=surface, wall=closed)


def _radius(line: Line, sizes: tuple[float, float | None], drawing: Drawing) -> Array:
    """The radius at each point of a line [m]."""
    factor, constant = sizes
    if constant is not None:
        return np.full(len(line.radius), constant)
    if np.isnan(line.radius).all():
        there = ", ".join(repr(name) for name in drawing.arrays)
        raise FileFaultError(
            "has no radius at its points"
            + (f" among its arrays {there}" if there else "")
            + "; name the array that holds it, or give one radius"
        )
    return np.asarray(factor * line.radius)


def _made(
    lines: list[Line],
    options: Options,
    notes: tuple[str, ...],
    named: Mapping[str, Array] | None,
    wall: Surface | None,
) -> Found:
    """The paths that lines make, once they are cleaned, joined and smoothed."""
    cleaned = [clean(line, number) for number, line in enumerate(lines, start=1)]
    dropped = sum(part.dropped for part in cleaned)
    if dropped:
        notes = (*notes, f"Points that are repeated, stray or without radius: {dropped}, left out.")
    network = Network.of([part.line for part in cleaned], named)
    if options.extend > 0.0:
        network = network.extended(options.extend)
    for point in options.cut:
        network = network.cut(array(OWNER, "cut", point, (3,), "m"))
    start, name, network, said = _start(network, options.entrance)
    network, before = network.from_entrance(start)
    original: Original = network.balls()
    if wall is not None:
        original = Skin(wall.points, wall.triangles, network.points[::7])
    made = ways(network, start, before, options.smoothing, original)
    notes = (*notes, *network.notes, *said, *made.notes)
    if not made.tubes:
        why = f": {made.notes[0][:1].lower()}{made.notes[0][1:-1]}" if made.notes else ""
        raise FileFaultError(f"has no open end to go to{why}")
    places = {end: network.points[node] for end, node in network.ends.items()}
    return Found(made, lines, name, places, original, notes, None)


def _entered(ends: dict[str, End], entrance: Spot | None) -> str:
    """The end of a surface that is entered at; the widest if a point is not at any of them."""
    names = tuple(ends)
    if isinstance(entrance, (str, int)):
        return chosen("entrance", entrance, names, names)
    if entrance is not None:
        point = array(OWNER, "entrance", entrance, (3,), "m")
        near = min(ends, key=lambda name: float(np.linalg.norm(ends[name].centre - point)))
        if np.linalg.norm(ends[near].centre - point) <= ends[near].radius:
            return near
    return names[0]


def _start(network: Network, entrance: Spot | None) -> tuple[int, str, Network, tuple[str, ...]]:
    """The point to enter at, its name, what of the network lies past it, and what to say."""
    if not network.ends:
        raise FileFaultError("has no open end to enter at")
    if entrance is None:
        name, notes = _widest(network)
        return network.ends[name], name, network, notes
    if isinstance(entrance, (str, int)):
        names = tuple(network.ends)
        name = chosen("entrance", entrance, names, names)
        return network.ends[name], name, network, ()
    node = network.nearest(array(OWNER, "entrance", entrance, (3,), "m"))
    for name, end in network.ends.items():
        if np.linalg.norm(network.points[end] - network.points[node]) <= network.radius[node]:
            return end, name, network, ()
    return node, "point", network.beyond(node), ()


def _widest(network: Network) -> tuple[str, tuple[str, ...]]:
    """The widest end; of about equal ones that where most lines meet, or the first one begins."""
    radius = {name: float(network.radius[end]) for name, end in network.ends.items()}
    most = max(radius.values())
    close = [name for name in radius if radius[name] >= NEARLY * most]
    name = max(close, key=lambda end: (*network.touching.get(end, (0, False)), radius[end]))
    if len(close) == 1:
        return name, ()
    others = ", ".join(f"'{end}'" for end in close if end != name)
    return name, (
        f"The entrance is taken to be '{name}' at {place(network.points[network.ends[name]])}; "
        f"{others} is about as wide.",
    )


def chosen(what: str, spot: str | int, names: Sequence[str], order: Sequence[str]) -> str:
    """The name of an end by its name, or by its number from one in ``order``."""
    if isinstance(spot, str):
        return one_of(OWNER, what, meant(spot, names), names)
    if not 1 <= spot <= len(order) or order[spot - 1] not in names:
        numbers = ", ".join(str(order.index(name) + 1) for name in names)
        raise refuse(OWNER, what, f"the number of an end, one of {numbers}", spot)
    return order[spot - 1]
