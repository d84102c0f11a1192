"""The smooth paths from the entrance to the ends of a network; they share what they have in common.

A path is smoothed from a few radii before it leaves the paths before it: further up it is theirs,
point by point. So the cost is that of the vessel, not of the sum of all paths, and a path that is
too sharp moves no other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.spatial import KDTree

from magwire.vessel.balls import Original, wall
from magwire.vessel.files.drawing import Array, Indices
from magwire.vessel.network import Network
from magwire.vessel.smooth import STEP, Smoothed, smooth
from magwire.vessel.trunks import trunks
from magwire.vessel.words import long, place

SPUR = 1.5  # shortest branch that counts, over the radius where it leaves
TOLD = 0.5  # part of the radius that is lost, from which that is told
LISTED = 8  # paths that are named one by one
OUTLET = 2.0  # length of a path that belongs to its outlet, over the radius
LEAD = 32.0  # how far before it leaves a path is smoothed, over radius and length of smoothing


@dataclass(frozen=True, eq=False)
class Tube:
    """A smooth path: that of another one up to some point, and its own from there on.

    Attributes
    ----------
    parent
        The other one; None for the first.
    shared
        How many of its points are shared.
    points, radius, narrowed
        Its own ones, shapes (n, 3), (n,) and (n,) [m]; what was taken off the radius counts where
        no other path is as wide.
    paces, deviation
        How far each of the file's points is along the path, in radii, and from it [m], (m,).
    """

    parent: Tube | None
    shared: int
    points: Array
    radius: Array
    narrowed: Array
    paces: Array
    deviation: Array

    def whole(self, what: str) -> Array:
        """One of ``points``, ``radius`` and ``narrowed`` from the entrance on."""
        parts = [getattr(self, what)]
        tube, stop = self, self.shared
        while tube.parent is not None:
            tube, before = tube.parent, stop
            parts.append(getattr(tube, what)[: max(before - tube.shared, 0)])
            stop = min(before, tube.shared)
        return np.concatenate(parts[::-1])

    def deviations(self) -> Array:
        """How far the file's points are from the path, from the entrance on [m]."""
        parts, tube, stop = [self.deviation], self, STEP * self.shared
        while tube.parent is not None:
            tube = tube.parent
            parts.append(tube.deviation[tube.paces < stop])
            stop = min(stop, STEP * tube.shared)
        return np.concatenate(parts[::-1])


class Ways(NamedTuple):
    """The paths by the names of their ends, and what was left out, a sentence each.

    With the balls of the trunks that are wall, but no path, shape (n, 4) [m] each.
    """

    tubes: dict[str, Tube]
    notes: tuple[str, ...]
    trunks: tuple[Array, ...] = ()


def ways(
    network: Network, start: int, before: Indices, smoothing: float, original: Original
) -> Ways:
    """The smooth paths from a point of a network to its ends.

    Parameters
    ----------
    network
        The network [m].
    start, before
        The entrance, and the point before each one on the path from it.
    smoothing
        Length in radii.
    original
        The vessel as the file has it.
    """
    ends = {n: end for n, end in network.ends.items() if end != start and before[end] >= 0}
    last = np.maximum(before, 0)  # the entrance has none before it, and its step is not used
    steps = np.linalg.norm(network.points - network.points[last], axis=1)
    ends, notes = _without_spurs(network, start, (before, steps), ends)
    owner: dict[int, Tube] = {}
    paces = np.zeros(len(network.points))
    step = 0.5 * steps * (1.0 / network.radius + 1.0 / network.radius[last])
    tubes: dict[str, Tube] = {}
    for name, end in ends.items():
        nodes = _own(end, before, owner)
        paces[nodes[1:]] = paces[nodes[0]] + np.cumsum(step[nodes[1:]])
        made = _tube(network, before, nodes, paces, (smoothing, original, owner.get(nodes[0])))
        if not made[0].whole:
            notes.append(f"The path to '{name}' is left out: it {_why(made[0])}.")
            continue
        if made[0].raised > 1.0:
            over = made[0].raised * smoothing
            notes.append(
                f"The path to '{name}' is smoothed over {over:.2g} radii where its bends are too "
                f"sharp for {smoothing:g}."
            )
        tubes[name] = made[1]
        owner.update((node, made[1]) for node in nodes if node not in owner)
    led = [ends[name] for name in tubes]
    stay = trunks(network, (before, step), led, list(_balls(tubes)), (smoothing, original))
    tubes = _together(tubes, stay.balls, original)
    return Ways(tubes, (*notes, *stay.notes, *_narrowed(tubes)), stay.balls)


def _own(end: int, before: Indices, owner: dict[int, Tube]) -> list[int]:
    """Points of a path from the last one that another path has."""
    nodes = [end]
    while nodes[-1] not in owner and before[nodes[-1]] >= 0:
        nodes.append(int(before[nodes[-1]]))
    return nodes[::-1]


def _tube(
    network: Network,
    before: Indices,
    nodes: list[int],
    paces: Array,
    means: tuple[float, Original, Tube | None],
) -> tuple[Smoothed, Tube]:
    """What smoothing makes of a path's own part and the lead before it, and the tube."""
    smoothing, original, parent = means
    split, factor = float(paces[nodes[0]]), 1.0
    while True:
        lead = LEAD * smoothing * factor
        first = max(int((split - lead) / STEP), 0) if parent is not None else 0
        led = [nodes[0]]
        while before[led[-1]] >= 0 and paces[led[-1]] > STEP * first:
            led.append(int(before[led[-1]]))
        every = np.array(led[::-1] + nodes[1:])
        at = paces[every]
        points, radius = network.points[every], network.radius[every]
        if first > 0 and parent is not None:  # it goes on from where the other one is
            keep = at > STEP * first
            here = parent.whole("points")[first], parent.whole("radius")[first]
            points = np.concatenate([here[0][None], points[keep]])
            radius = np.append(here[1], radius[keep])
            at = np.append(STEP * first, at[keep])
        found = smooth(points, radius, smoothing, original, at)
        if parent is None or first == 0 or found.raised <= factor:
            break
        factor = found.raised
    skip = 0 if parent is None else min(int(0.5 * lead / STEP), int(split / STEP) - first)
    skip = max(skip, 0) if first > 0 else 0
    shared = first + skip
    parent = parent if shared > 0 else None
    mine = at >= STEP * shared
    return found, Tube(
        parent,
        shared,
        found.points[skip:],
        found.radius[skip:],
        found.narrowed[skip:],
        at[mine],
        found.deviation[mine],
    )


def _together(
    tubes: dict[str, Tube], stay: tuple[Array, ...], original: Original
) -> dict[str, Tube]:
    """The paths with what the vessel loses to them: in a wide trunk a narrow way loses nothing."""
    if not tubes:
        return tubes
    every = wall([*_balls(tubes), *stay])
    made: dict[Tube, Tube] = {}
    for tube in tubes.values():
        lost = tube.narrowed.copy()
        some = lost > 0.0
        if some.any():
            points = tube.points[some]
            wide = np.minimum(tube.radius[some] + lost[some], original.depth(points))
            lost[some] = np.clip(wide - every.depth(points), 0.0, lost[some])
        parent = None if tube.parent is None else made[tube.parent]
        made[tube] = replace(tube, parent=parent, narrowed=lost)
    return {name: made[tube] for name, tube in tubes.items()}


def _balls(tubes: dict[str, Tube]) -> Iterator[Array]:
    """Balls of what each path has of its own, shape (n, 4) [m]."""
    for tube in tubes.values():
        yield np.column_stack([tube.points, tube.radius])


def _narrowed(tubes: dict[str, Tube]) -> list[str]:
    """Which paths are much narrower than the vessel somewhere, a sentence."""
    told = []
    for name, tube in tubes.items():
        wide = tube.radius + tube.narrowed
        worst = int(np.argmax(tube.narrowed / wide))
        if tube.narrowed[worst] > TOLD * wide[worst]:
            where = place(tube.points[worst])
            told.append(f"'{name}' by {long(tube.narrowed[worst])} near {where}")
    if not told:
        return []
    more = f", and {len(told) - LISTED} more" if len(told) > LISTED else ""
    return [
        "Paths are narrower than the vessel where they bend or taper too sharply for it: "
        f"{', '.join(told[:LISTED])}{more}. The walls of trunks stay."
    ]


def _why(found: Smoothed) -> str:
    """Why a path is left out."""
    closed = int(np.argmin(found.radius))
    return (
        f"bends so sharply near {place(found.points[closed])} that a lumen of radius "
        f"{long(found.radius[closed])} is left of "
        f"{long(found.radius[closed] + found.narrowed[closed])}"
    )


class _Crowd(NamedTuple):
    """The points on paths, among which an end may lie.

    Attributes
    ----------
    network, nodes
        The network, and the points.
    tree
        For looking for them.
    reach, ends
        Distance of each from the two nearest ends, and these, shape (n, 2).
    """

    network: Network
    nodes: Indices
    tree: KDTree
    reach: Array
    ends: Indices

    @classmethod
    def of(cls, network: Network, nodes: Indices, ends: list[int]) -> _Crowd:
        places = network.points[nodes]
        some = np.array(ends, dtype=np.int64)
        reach, which = KDTree(network.points[some]).query(places, k=[1, 2])
        return cls(network, nodes, KDTree(places), reach, np.append(some, -1)[which])

    def holds(self, end: int, own: list[int]) -> bool:
        """Whether an end lies inside of a tube that is not its own, and that does not end there."""
        points, radius = self.network.points, self.network.radius
        near = np.array(self.tree.query_ball_point(points[end], radius.max()), dtype=np.int64)
        nodes = self.nodes[near]
        other = np.where(self.ends[near, 0] == end, self.reach[near, 1], self.reach[near, 0])
        inside = radius[nodes] > np.linalg.norm(points[nodes] - points[end], axis=1)
        inside &= (other > OUTLET * radius[nodes]) & ~np.isin(nodes, own)
        return bool(inside.any())


def _without_spurs(
    network: Network, start: int, course: tuple[Indices, Array], ends: dict[str, int]
) -> tuple[dict[str, int], list[str]]:
    """Ends whose paths leave all others for more than about a radius, and what to say of others."""
    before, steps = course
    users: dict[int, int] = {}
    for end in ends.values():
        for node in _up(end, before):
            users[node] = users.get(node, 0) + 1
            if users[node] > 1:
                break
    kept, notes = dict(ends), []
    crowd = _Crowd.of(network, np.fromiter(users, dtype=np.int64), list(ends.values()))
    for name, end in ends.items():
        own = [end]
        while users[own[-1]] == 1 and own[-1] != start:
            own.append(int(before[own[-1]]))
        length, last = float(steps[own[:-1]].sum()), own[-1]
        if last == start and users[last] == 1:
            continue  # no other path
        if length < SPUR * network.radius[last]:
            del kept[name]
            notes.append(f"A spur of {long(length)}, '{name}', is left out.")
            users[last] -= 1
            continue
        if crowd.holds(end, own):
            del kept[name]
            notes.append(f"The path to '{name}' is left out: it ends inside of another one's tube.")
            users[last] -= 1
    return kept, notes


def _up(node: int, before: Indices) -> Iterator[int]:
    """A point and those before it, up to the entrance."""
    while node >= 0:
        yield node
        node = int(before[node])
