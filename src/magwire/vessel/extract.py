"""Centrelines of a surface: the paths through its inside that keep farthest from its wall."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree

from magwire.vessel import vmtk
from magwire.vessel.files.drawing import Array, FileFaultError, Indices, Line, Surface
from magwire.vessel.interior import Interior, fill, to_wall, wall_samples
from magwire.vessel.mesh import End, Shell, shell
from magwire.vessel.words import long, place

FINENESS = 0.25  # edge length of a voxel, over the radius of the narrowest end
SPACING = 0.25  # of the points of the wall, over that radius
SHYNESS = 3.0  # power of the distance from the wall in the cost of a path
PULLS = 40  # steps towards the middle
FIRST_PULL = 0.2  # length of the first one, over the radius
SMALLEST = 1e-3  # radius of an end, over the size of the vessel
ACROSS = 0.6  # of the wall around an end: cosine between its normals and the end's axis, at most
LISTED = 8  # holes that are named one by one
SHORTEST = 3.0  # length of a tube, over its largest radius
NO_TUBE = 1.5  # how far half the surface may be from the balls inside, over their radius
REACHES = 4.0  # length of a branch without a cap, over the radius where it leaves
BLOCKED = 1.5  # radius of a ball that blocks a tube, over its radius
BRANCHES = 60
MOST = 1000  # points of a line
ROUGHLY = 0.3  # part by which the distance in the cost may be off
COARSEST = (
    0.8  # edge length of a voxel that still tells where the narrowest end is, over its radius
)


class Extracted(NamedTuple):
    """Lines from one end to each other one, what to know of them, all ends by name, the wall.

    The wall is the surface without what closes its ends; ``closed`` has its holes closed.
    """

    lines: tuple[Line, ...]
    notes: tuple[str, ...]
    ends: dict[str, Array]
    wall: Surface
    closed: Surface


Choice = Callable[[dict[str, End]], str]
"""Says at which end, of those by name, the vessel is entered."""


def widest(ends: dict[str, End]) -> str:
    """The name of the widest end."""
    return max(ends, key=lambda name: ends[name].radius)


def extract(surface: Surface, choose: Choice = widest) -> Extracted:
    """The centrelines of a vessel's surface, closed or open [m].

    The ends are the open rims or, of a closed surface, its flat caps; if it has none, they are the
    tips of its branches. Where VMTK is installed, and there are rims or caps, the lines are its.
    Otherwise the paths between the ends through the voxels inside are those of the least sum of
    length over distance from the wall to the power of ``SHYNESS``. Each is then pulled to where the
    ball that touches the wall is largest, and that ball's radius is the radius.

    Parameters
    ----------
    surface
        The wall [m].
    choose
        The end that all lines start at. The ends are called ``end-1`` and so on, the widest first.

    Raises
    ------
    FileFaultError
        If the surface is in pieces, has no inside or fewer than two ends, or is no tube.
    """
    hull = shell(surface)
    ends, notes, holes = _without_holes(hull)
    closed = Surface(hull.points, np.concatenate([hull.wall, hull.caps[holes[hull.cap_of]]]))
    rings = _rings(np.concatenate([hull.wall, hull.caps]))
    if rings > 0:
        notes = (
            *notes,
            f"The surface goes round in {rings} loop{'s' if rings > 1 else ''}; paths take the "
            "shorter side of each, and what is on the other one only is left out.",
        )
    if len(ends) > 1 and vmtk.installed():
        named = _named(ends)
        first = choose(named)
        lines = vmtk.centrelines(hull, list(named.values()), list(named).index(first))
        if lines is not None:
            spread = SPACING * min(end.radius for end in ends)
            accuracy = _accuracy(lines, *wall_samples(hull.points, hull.wall, spread))
            notes = (*hull.notes, *notes, "The centrelines are by VMTK.", accuracy)
            return _result(lines, notes, named, hull)._replace(closed=closed)
        notes = (*notes, "VMTK does not find the path to every end; magwire's own extraction does.")
    lines, named, accuracy = _through_voxels(hull, ends, choose)
    return _result(lines, (*hull.notes, *notes, accuracy), named, hull)._replace(closed=closed)


def _named(ends: list[End]) -> dict[str, End]:
    """Ends by name, the widest first."""
    first = max(range(len(ends)), key=lambda k: ends[k].radius)
    order = [ends[first], *ends[:first], *ends[first + 1 :]]
    return {f"end-{k}": end for k, end in enumerate(order, start=1)}


def _result(
    lines: tuple[Line, ...], notes: tuple[str, ...], named: dict[str, End], hull: Shell
) -> Extracted:
    places = {name: end.centre for name, end in named.items()}
    wall = Surface(hull.points, hull.wall)
    return Extracted(lines, notes, places, wall, wall)


def _through_voxels(
    hull: Shell, ends: list[End], choose: Choice
) -> tuple[tuple[Line, ...], dict[str, End], str]:
    """The lines by the voxels inside, all ends, and how accurate the lines are."""
    narrow = min(end.radius for end in ends) if ends else _typical(hull)
    inside = fill(hull.points, np.concatenate([hull.wall, hull.caps]), FINENESS * narrow)
    if inside.cell > COARSEST * narrow:
        raise FileFaultError(
            f"has a surface too large to be filled with voxels that its narrowest end, of radius "
            f"{long(narrow)}, needs"
        )
    samples, spacing = wall_samples(hull.points, hull.wall, SPACING * narrow)
    inside = _largest(inside)
    tree = KDTree(samples)
    distance = to_wall(tree, inside.centres, within=ROUGHLY)[0]
    graph = inside.graph((distance.max() / np.maximum(distance, 0.1 * inside.cell)) ** SHYNESS)
    if not ends:
        loops = _rings(np.concatenate([hull.wall, hull.caps])) > 0
        ends = _tips(inside, distance, loops)
    if len(ends) < 2:
        raise FileFaultError(f"has a surface with {len(ends)} open ends; expected two at least")
    named = _named(ends)
    first = choose(named)
    voxels = KDTree(inside.centres).query(np.array([end.centre for end in named.values()]))[1]
    start = int(voxels[list(named).index(first)])
    before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)[1]
    lines = []
    for name, end, voxel in zip(named, named.values(), voxels.tolist(), strict=True):
        if name != first:
            way = inside.centres[_way(before, voxel)]
            way = np.concatenate([[named[first].centre], way[1:-1], [end.centre]])
            points = _pulled(way, tree, inside.cell, (named[first], end))
            lines.append(Line("", points, to_wall(tree, points, within=0.002)[0]))
    return tuple(lines), named, _accuracy(lines, samples, spacing)


def _rings(triangles: Indices) -> int:
    """How often a closed surface goes round: its genus, from what Euler's formula says."""
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, uses = np.unique(sides, axis=0, return_counts=True)
    if np.any(uses != 2):
        return 0
    return max(1 - (len(np.unique(triangles)) - len(edges) + len(triangles)) // 2, 0)


def _goes_round(centres: Array, graph: Any, way: Indices, distance: Array) -> bool:
    """Whether there is another way between the ends of one, wherever it is blocked."""
    for part in (0.25, 0.5, 0.75):
        block = int(way[int(part * len(way))])
        away = np.linalg.norm(centres - centres[block], axis=1)
        free = away > BLOCKED * distance[block]
        if not free[way[[0, -1]]].all():
            return False
        label = connected_components(graph[free][:, free], directed=False)[1]
        place = np.cumsum(free) - 1
        if label[place[way[0]]] != label[place[way[-1]]]:
            return False
    return True


def _typical(hull: Shell) -> float:
    """About the radius of a closed surface without caps: volume over area, times two."""
    a, b, c = (hull.points[hull.wall[:, k]] - hull.points.mean(axis=0) for k in range(3))
    volume = abs(float(np.sum(a * np.cross(b, c)))) / 6.0
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0
    if not volume > 1e-9 * area**1.5:
        raise FileFaultError("has a surface without an inside")
    return volume / area


def _largest(inside: Interior) -> Interior:
    """The largest connected part of the voxels."""
    if len(inside.centres) < 10:
        raise FileFaultError("has a surface without an inside")
    label = connected_components(inside.graph(np.ones(len(inside.centres))), directed=False)[1]
    kept = label == int(np.argmax(np.bincount(label)))
    number = inside.number.copy()
    there = number >= 0
    fresh = np.where(kept, np.cumsum(kept) - 1, -1).astype(np.int32)
    number[there] = fresh[number[there]]
    return Interior(inside.centres[kept], number, inside.cell)


def _without_holes(hull: Shell) -> tuple[list[End], tuple[str, ...], NDArray[np.bool_]]:
    """The ends that a tube leads to: the wall around them runs along, not across, their axis.

    With what to say of the others, and which of all they are.
    """
    size = float(np.ptp(hull.points, axis=0).max())
    clean = [end.radius > SMALLEST * size and end.across < ACROSS for end in hull.ends]
    kept = [end for end, good in zip(hull.ends, clean, strict=True) if good]
    holes = [end for end, good in zip(hull.ends, clean, strict=True) if not good]
    closed = ~np.array(clean, dtype=bool)
    if not holes:
        return kept, (), closed
    where = [f"at {place(end.centre)} with radius {long(end.radius)}" for end in holes[:LISTED]]
    more = f", and {len(holes) - LISTED} more" if len(holes) > LISTED else ""
    return kept, (f"Holes in the wall: {len(holes)}, closed, {'; '.join(where)}{more}.",), closed


def _tips(inside: Interior, distance: Array, loops: bool) -> list[End]:
    """Ends of a vessel without caps: the tips of its branches, farthest first.

    ``loops``: whether its surface goes round somewhere, if only in a small handle.
    """
    graph = inside.graph(np.ones(len(inside.centres)))
    start = int(np.argmax(distance))
    start = int(np.argmax(dijkstra(graph, directed=False, indices=start)))
    tips, taken = [start], np.array([start])
    while len(tips) < BRANCHES:
        far, before, _ = dijkstra(
            graph, directed=False, indices=taken, return_predecessors=True, min_only=True
        )
        tip = int(np.argmax(far))
        way = _way(before, tip)
        if loops and len(tips) == 1 and _goes_round(inside.centres, graph, way, distance):
            raise FileFaultError(
                "has a closed surface that goes round in a loop; expected the inner wall of a "
                "vessel that is open, or has flat caps, at its ends"
            )
        if far[tip] < REACHES * distance[way[0]] and len(tips) > 1:
            break
        tips.append(tip)
        taken = np.concatenate([taken, way])
    else:
        raise FileFaultError(
            f"has a closed surface of more than {BRANCHES} branches; expected the inner wall of a "
            "vessel, open or with flat caps at its ends"
        )
    return [_tip_end(inside.centres[tip], inside, distance) for tip in tips]


def _tip_end(tip: Array, inside: Interior, distance: Array) -> End:
    """The end at a tip: the middle of the largest ball that reaches it."""
    near = np.flatnonzero(
        np.linalg.norm(inside.centres - tip, axis=1) < 1.5 * distance + inside.cell
    )
    best = near[int(np.argmax(distance[near]))]
    centre = inside.centres[best]
    away = tip - centre
    size = float(np.linalg.norm(away))
    outward = away / size if size > 0.0 else np.array([1.0, 0.0, 0.0])
    return End(centre, outward, float(distance[best]))


def _way(before: Indices, end: int) -> Indices:
    found = [end]
    while before[found[-1]] >= 0:
        found.append(int(before[found[-1]]))
    return np.array(found[::-1], dtype=np.int64)


def _pulled(way: Array, tree: KDTree, cell: float, ends: tuple[End, End]) -> Array:
    """The path, pulled across its direction to where the wall is farthest, and evened out."""
    points = _even(way, cell)
    mean = np.zeros_like(points)
    for step in range(PULLS):
        distance, away = to_wall(tree, points, within=0.02)
        along = np.gradient(points, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
        across = away - np.sum(away * along, axis=1)[:, None] * along
        pull = FIRST_PULL * distance / (1.0 + 0.5 * step)
        points = points + pull[:, None] * across
        points[1:-1] = 0.25 * points[:-2] + 0.5 * points[1:-1] + 0.25 * points[2:]
        if step >= PULLS // 2:
            mean += points / (PULLS - PULLS // 2)
    for i, end in zip((0, -1), ends, strict=True):  # it begins and stops in the ends' planes
        mean[i] -= (mean[i] - end.centre) @ end.outward * end.outward
    return _even(mean, cell)


def _even(points: Array, cell: float) -> Array:
    """Points of a polyline at even distances of about ``cell``."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, arc[-1], min(max(int(arc[-1] / cell), 4), MOST) + 1)
    return np.column_stack([np.interp(at, arc, points[:, k]) for k in range(3)])


def _accuracy(lines: Sequence[Line], samples: Array, spacing: float) -> str:
    """How far the surface is from the tubes of inscribed balls, if these are tubes at all."""
    points = np.concatenate([line.points for line in lines])
    radius = np.concatenate([line.radius for line in lines])
    length = max(float(np.linalg.norm(np.diff(x.points, axis=0), axis=1).sum()) for x in lines)
    some = samples[:: max(1, len(samples) // 20_000)]
    distance, nearest = KDTree(points).query(some, k=min(16, len(points)))
    distance, nearest = distance.reshape(len(some), -1), nearest.reshape(len(some), -1)
    off = np.abs((distance - radius[nearest]).min(axis=1))
    far = float(np.median(off / radius[nearest[:, 0]]))
    if length < SHORTEST * radius.max():
        raise FileFaultError(
            f"has a surface that is no tube: from end to end it is {long(length)} long, with a "
            f"ball of radius {long(radius.max())} in it"
        )
    if far > NO_TUBE:
        raise FileFaultError(
            "has a surface that is no tube: half of it is farther from the balls that fit in "
            f"around its centrelines than {far:.3g} of their radii"
        )
    middle, most = np.percentile(off, [50, 95])
    return (
        f"The radius is that of inscribed balls, within {long(spacing**2 / (2 * radius.min()))}; "
        f"the surface is off their tube by {long(middle)} in the median and {long(most)} at 95 "
        "percent."
    )
