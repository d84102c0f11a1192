"""What to know of a vessel's file, as lines of text."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

from magwire.errors import MagwireError, positive
from magwire.units import DIMENSIONS, parse, show
from magwire.vessel import Source, Vessel, survey
from magwire.vessel.files import Drawing, load
from magwire.vessel.placement import Placement, missing_unit, sizes
from magwire.vessel.reading import called

MM = 1e3
STRAIGHT = 1e3  # radius of a bend over the length, from which it is none


class Inspected(NamedTuple):
    """What is in a vessel's file, a line each, the vessel, and why a run would refuse it, or ""."""

    lines: list[str]
    vessel: Vessel
    refusal: str


def inspect(
    source: Source,
    *,
    units: str | None,
    wire: dict[str, str | None],
    other: Path | None,
    wall: Literal["balls", "surface"] = "balls",
    **options: Any,
) -> Inspected:
    """What to know of a vessel's file.

    Parameters
    ----------
    source
        The file, the folder or the files.
    units
        Its numbers'; if left out, and if the file states none, the likeliest, which a run would not
        take.
    wire
        Texts by name: its ``diameter``, its ``modulus`` and the ``force`` that it may take.
    other
        A file of the same vessel, to compare axes with.
    wall
        As of ``Vessel.lumen``.
    options
        For ``Vessel.read``.
    """
    named = options.get("radius")
    drawing = load(source, named if isinstance(named, str) else None)
    stated = drawing.unit in DIMENSIONS["length"].units
    unit = units or (str(drawing.unit) if stated else sizes(drawing)[0].unit)
    vessel = Vessel.read(source, unit, **options)
    refusal = "" if units or stated else str(missing_unit(called(source), drawing))
    words: tuple[str, ...] = ()
    try:
        vessel.lumen(wall=wall)
        if wall == "surface":
            words = (vessel.fidelity_words,)
        else:
            words = vessel.deviation_words
            vessel.check()
    except MagwireError as error:
        refusal = refusal or str(error)
    lines = [
        f"{'file':12}{_contents(drawing)}",
        f"{'units':12}{_unit_words(drawing, units, stated)}",
        f"{'smoothing':12}{vessel.smoothing:g} radii",
        *(f"{'' if k else 'wall':12}{line}" for k, line in enumerate(words)),
        "",
        *_ends(vessel),
        "",
        *_table(vessel, wire),
        *_warnings(vessel, other, unit, options),
    ]
    return Inspected(lines, vessel, refusal)


def _contents(drawing: Drawing) -> str:
    if drawing.surface is not None:
        count = len(drawing.surface.triangles)
        return f"a surface of {count} triangles; its centrelines are extracted"
    count = sum(len(line.points) for line in drawing.lines)
    lines = "1 centreline" if len(drawing.lines) == 1 else f"{len(drawing.lines)} centrelines"
    return f"{lines} with {count} points"


def _unit_words(drawing: Drawing, units: str | None, stated: bool) -> str:
    if units is not None:
        return units
    if stated:
        return f"{drawing.unit}, as the file states"
    likely = sizes(drawing)
    if len(likely) == 1:
        return f"not stated; the numbers look like {likely[0].unit}, which is taken here"
    words = ", or ".join(f"{size.unit}, {size.words}" for size in likely)
    return f"not stated; the numbers look like {words}; {likely[0].unit} is taken here"


def _ends(vessel: Vessel) -> Iterator[str]:
    rows = [("", "end", "x, y, z [mm]", "")]
    for number, (name, at) in enumerate(vessel.ends.items(), start=1):
        x, y, z = MM * at
        note = "entrance" if name == vessel.entrance else ""
        note = note or ("" if name in vessel.balls else "no way to it")
        rows.append((str(number), name, f"{x:.2f}, {y:.2f}, {z:.2f}", note))
    return _columns(rows, "<<><")


def _table(vessel: Vessel, wire: dict[str, str | None]) -> Iterator[str]:
    """One row for each outlet; with a wire, whether it gets there."""
    asked = wire["diameter"] is not None
    heads = ("outlet", "length", "own", "radius", "narrowest at", "tightest bend", "at")
    rows = [(*heads, "moved by", "narrowed", "reachable" if asked else "")]
    for course in survey.courses(vessel):
        way = vessel.ways[course.name]
        low, high = (MM * radius for radius in course.radii)
        bend = f"{MM * course.bend.radius:.2f}"
        if course.bend.radius > STRAIGHT * course.length:
            bend = "straight"
        rows.append(
            (
                course.name,
                f"{MM * course.length:.1f}",
                f"{MM * course.own:.1f}",
                f"{low:.2f} to {high:.2f}",
                f"{MM * course.narrowest:.1f}",
                bend,
                f"{MM * course.bend.arc:.1f}",
                f"{MM * way.deviation[0]:.2f}",
                f"{MM * way.narrowed:.2f}",
                _verdict(course, wire) if asked else "",
            )
        )
    yield from _columns(rows, "<>>>>>>>><")
    yield "All in mm. Smoothing moved no point by more than 'moved by', and took at most 'narrowed'"
    yield "off the radius where the lumen would have been wider than its bend or tapered too fast."


def _columns(rows: Sequence[Sequence[str]], sides: str) -> Iterator[str]:
    """Rows as lines, with columns as wide as what is in them."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = zip(row, sides, wide, strict=True)
        yield "  ".join(f"{cell:{side}{width}}" for cell, side, width in cells).rstrip()


def _positive(text: str | None, dimension: str, option: str) -> float:
    """A positive quantity of an option."""
    return positive("magwire lumen inspect", option, parse(text, dimension, option))


def _verdict(course: survey.Course, wire: dict[str, str | None]) -> str:
    radius = 0.5 * _positive(wire["diameter"], "diameter", "--wire")
    modulus = wire["modulus"]
    young = 0.0 if modulus is None else _positive(modulus, "pressure", "--youngs-modulus")
    found = survey.reach(course, radius, young * math.pi * radius**4 / 4.0)
    if not found.fits:
        return f"no, {show(course.passable * 2.0, 'length')} wide at the narrowest"
    if modulus is None:
        return "yes"
    needs = f"about {show(found.force, 'force')} to bend it"
    limit = wire["force"]
    if limit is not None and found.force > _positive(limit, "force", "--max-force"):
        return f"no, {needs}"
    return f"yes, {needs}"


def _warnings(
    vessel: Vessel, other: Path | None, unit: str, options: dict[str, Any]
) -> Iterator[str]:
    found = [*vessel.notes, *survey.self_contacts(vessel)]
    if other is not None:
        drawing = load(other)
        own = drawing.unit or unit
        metres = DIMENSIONS["length"].units.get(own, 1.0) * float(options.get("scale", 1.0))
        flip = survey.flipped_axes(vessel, drawing, Placement(metres))
        if flip is not None:
            found.append(f"The axes {flip} of '{other}' point the other way.")
        else:
            found.append(f"The axes of '{other}' are the same, as far as can be seen.")
    if found:
        yield ""
        yield from found
