"""What a vessel file holds, as read: lines with radii, or a surface, in the file's own units."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.errors import InputError
from magwire.units import DIMENSIONS

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

LARGEST_FILE = 100_000_000
"""Bytes of a file, or of one of its arrays when unpacked, at most."""
MOST_POINTS = 4_000_000
MOST_CELLS = 2_000_000
"""Lines and polygons of a VTK file, at most."""
UNIT = re.compile(r"\s*[\[(]\s*(\w+)\s*[\])]\s*$")
NO_WAY = " "
"""Name of a line that is wall, but no way to an end, in a file of magwire's."""
RADII = ("maximuminscribedsphereradius", "radius", "radii", "r")
"""Names of arrays that hold the radius, the first one found counts; case does not matter."""


class FileFaultError(Exception):
    """What is wrong with a file: the end of a sentence that starts with the file's name."""


class Line(NamedTuple):
    """A polyline with a radius at each point.

    Attributes
    ----------
    name
        As the file has it; empty if it has none.
    points
        Shape (n, 3).
    radius
        Shape (n,), not a number where the file has none.
    """

    name: str
    points: Array
    radius: Array


class Surface(NamedTuple):
    """Triangles: points, shape (n, 3), and their indices, shape (m, 3)."""

    points: Array
    triangles: Indices


class Drawing(NamedTuple):
    """The contents of a file.

    Attributes
    ----------
    lines
        The centrelines; none in a file with a surface.
    surface
        The wall, in a file without lines.
    unit
        Unit of length that the file or its format states; None if it does not.
    arrays
        Names of the arrays that could have been the radius, for messages.
    entrance
        Name of the end at which all lines start but those called ``NO_WAY``, in a file that magwire
        has made: its lines are smooth tubes already. Empty in all others.
    radius_unit
        Unit of the radius, if the file states one for it; that of the points if it does not.
    notes
        What was done to what the file holds, a sentence each.
    """

    lines: tuple[Line, ...] = ()
    surface: Surface | None = None
    unit: str | None = None
    arrays: tuple[str, ...] = ()
    entrance: str = ""
    radius_unit: str | None = None
    notes: tuple[str, ...] = ()


def may_be_radius(name: str, wanted: str | None) -> bool:
    """Whether an array of this name could be picked as the radius."""
    if wanted is not None:
        return plain_name(name) == plain_name(wanted)
    return plain_name(name).lower() in RADII or "radius" in name.lower()


def pick_radius(names: tuple[str, ...], wanted: str | None) -> str | None:
    """The array that holds the radius, of those that are there; None if none does.

    Parameters
    ----------
    names
        Arrays with one number for each point.
    wanted
        The name that was asked for, with or without the unit behind it; if left out any of
        ``RADII``, or the only one in whose name there is a radius.

    Raises
    ------
    FileFaultError
        If there is no array of the name that was asked for.
    """
    if wanted is not None:
        bare = {plain_name(name): name for name in reversed(names)}
        wanted = wanted if wanted in names else bare.get(plain_name(wanted), wanted)
        if wanted not in names:
            there = ", ".join(repr(name) for name in names) or "no array"
            raise FileFaultError(f"has no array {wanted!r} at its points, but {there}")
        return wanted
    by_case = {plain_name(name).lower(): name for name in reversed(names)}
    usual = next((by_case[known] for known in RADII if known in by_case), None)
    named = [name for name in names if "radius" in name.lower()]
    return usual or (named[0] if len(named) == 1 else None)


def plain_name(name: str) -> str:
    """The name of an array without the unit behind it."""
    return UNIT.sub("", name)


def are_ends(names: Sequence[str]) -> bool:
    """Whether no two ends have the same name."""
    ends = [name for name in names if name != NO_WAY]
    return len(ends) > 1 and len(set(ends)) == len(ends)


def unit_of(name: str | None) -> str | None:
    """The unit of length behind the name of an array, as in "Radius [mm]"; None without one."""
    found = UNIT.search(name or "")
    return found[1] if found and found[1] in DIMENSIONS["length"].units else None


def right_handed(points: Array, space: str) -> tuple[Array, tuple[str, ...]]:
    """Points in LPS, as DICOM has them, from a file in a given space, and what was done.

    Parameters
    ----------
    points
        Shape (n, 3).
    space
        "RAS" or "LPS"; empty if the file does not say, and points stay as they are.
    """
    if space.upper() != "RAS":
        return points, ()
    turned = points * np.array([-1.0, -1.0, 1.0])
    return turned, ("The file is in RAS coordinates: x and y are turned round, to LPS.",)


def chains(edges: ArrayLike, count: int) -> list[Indices]:
    """Runs of points, each from one end or fork to the next, of a graph of single edges.

    Parameters
    ----------
    edges
        Pairs of point indices, shape (m, 2).
    count
        Number of points.
    """
    pairs = np.unique(np.sort(np.asarray(edges, dtype=np.int64).reshape(-1, 2), axis=1), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    neighbours: dict[int, list[int]] = {}
    for a, b in pairs.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    walked: set[tuple[int, int]] = set()
    runs = []
    stops = [n for n in neighbours if len(neighbours[n]) != 2]
    for start in [*stops, *neighbours]:  # what the stops do not reach is a ring
        for following in neighbours[start]:
            if (start, following) in walked:
                continue
            run = [start, following]
            walked |= {(start, following), (following, start)}
            while len(neighbours[run[-1]]) == 2 and run[-1] != start:
                a, b = neighbours[run[-1]]
                onward = b if a == run[-2] else a
                walked |= {(run[-1], onward), (onward, run[-1])}
                run.append(onward)
            runs.append(np.array(run, dtype=np.int64))
    return runs


def checked(drawing: Drawing) -> Drawing:
    """The drawing, if its numbers can be used at all.

    Raises
    ------
    FileFaultError
        If it holds nothing, too much, or points that are not finite.
    """
    points = [line.points for line in drawing.lines]
    if drawing.surface is not None:
        points.append(drawing.surface.points)
        _check_triangles(drawing.surface)
    count = sum(len(part) for part in points)
    if count == 0:
        raise FileFaultError("holds neither lines nor triangles")
    if count > MOST_POINTS:
        raise FileFaultError(f"holds {count} points, more than the {MOST_POINTS} that can be used")
    largest = max(float(np.abs(part).max()) for part in points if len(part))
    if not largest < 1e9:  # not a number, too
        raise FileFaultError(
            "holds points that are not finite, or farther than 1e9 from the origin"
        )
    return drawing


def _check_triangles(surface: Surface) -> None:
    low, high = int(surface.triangles.min(initial=0)), int(surface.triangles.max(initial=-1))
    if low < 0 or high >= len(surface.points):
        raise FileFaultError(
            f"has triangles of points {low} to {high}, but {len(surface.points)} points"
        )


def refuse(path: object, what: str) -> InputError:
    """The error for a file that cannot be used, to be raised by the caller."""
    return InputError(f"Vessel file '{path}' {what}.")
