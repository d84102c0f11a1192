"""Trunks that no path runs straight through: the wall is theirs, and leads to no outlet.

Paths all come from the entrance. Where that is at the end of a narrow side branch, every path turns
out of it into the trunk, sharply, and is narrow there; the trunk itself goes straight on.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from magwire.vessel.balls import Balls, Original, wall
from magwire.vessel.files.drawing import Array, Indices
from magwire.vessel.network import Network
from magwire.vessel.smooth import STEP, smooth
from magwire.vessel.words import long, place

GAIN = 0.1  # part of the radius that a trunk adds to the wall of the paths, at least
COVERED = 0.01  # part of it that does not count: there the wall is that of a path
OVERLAP = 6  # points that a trunk has in common with such walls, one and a half radii
REACH = 16.0  # how far from the fork a trunk is followed, over the radius
FROM, TO = 1.0, 3.0  # where an arm's width is taken, over the radius
AS_WIDE = 0.9  # radius of an arm over that of the widest one, from which it is about as wide


class Trunks(NamedTuple):
    """Balls of each trunk, shape (n, 4) [m]: centre and radius; and what to say of them."""

    balls: tuple[Array, ...]
    notes: tuple[str, ...]


class _Arm(NamedTuple):
    """A way out of a fork: its points, the radius some way along it [m], and whether it is a stump.

    A stump has an end to which no path leads.
    """

    nodes: list[int]
    radius: float
    stump: bool


def trunks(
    network: Network,
    course: tuple[Indices, Array],
    ends: Iterable[int],
    paths: list[Array],
    means: tuple[float, Original],
) -> Trunks:
    """The trunks of a network that paths from its entrance leave out.

    At each fork the widest arm goes on into each other one. Those that no path does are smoothed as
    paths are, and kept where they add to the wall.

    Parameters
    ----------
    network
        The network [m].
    course
        The point before each one on the path from the entrance, and how far that is, in radii.
    ends
        The points that paths lead to.
    paths
        Balls of the paths, shape (n, 4) [m] each.
    means
        Length of smoothing in radii, and the vessel as the file has it.
    """
    before, steps = course
    smoothing, original = means
    used = _used(before, ends)
    after: dict[int, list[int]] = {}
    for node in sorted(_used(before, network.ends.values())):
        if before[node] >= 0:
            after.setdefault(int(before[node]), []).append(node)
    paces = _paces(after, steps)
    every, kept, notes = wall(paths), list[Array](), list[str]()
    for fork in sorted(node for node in after if len(after[node]) > 1):
        for nodes in _left_out(network, fork, (before, after, paces), used):
            found = smooth(network.points[nodes], network.radius[nodes], smoothing, original)
            balls = np.column_stack([found.points, found.radius])
            near = [wall([part]) for part in kept if _meet(part, balls)]
            part = _added(balls, [every, *near]) if found.whole else None
            if part is not None:
                kept.append(part)
                notes.append(
                    f"The trunk of radius {long(float(part[:, 3].max()))} near "
                    f"{place(network.points[fork])} stays, although no path runs straight "
                    "through it."
                )
    return Trunks(tuple(kept), tuple(notes))


def _used(before: Indices, ends: Iterable[int]) -> set[int]:
    """The points on the paths to ends."""
    used: set[int] = set()
    for end in ends:
        node = int(end)
        if before[node] < 0:
            continue
        while node >= 0 and node not in used:
            used.add(node)
            node = int(before[node])
    return used


def _paces(after: dict[int, list[int]], steps: Array) -> Array:
    """Arc length from the entrance in radii, shape (n,)."""
    paces = np.zeros(len(steps))
    last = {node for nodes in after.values() for node in nodes}
    ahead = [node for node in after if node not in last]
    while ahead:
        node = ahead.pop()
        for following in after.get(node, []):
            paces[following] = paces[node] + steps[following]
            ahead.append(following)
    return paces


def _left_out(
    network: Network,
    fork: int,
    tree: tuple[Indices, dict[int, list[int]], Array],
    used: set[int],
) -> list[list[int]]:
    """The ways from a fork's widest arm into each other one that no path takes, as points."""
    before, after, paces = tree
    arms = [_down(network, fork, child, (after, paces), used) for child in after[fork]]
    if before[fork] >= 0:
        arms.insert(0, _up(network, fork, before, paces))
    widest = max(arms, key=lambda arm: arm.radius)
    if arms[0].radius >= AS_WIDE * widest.radius:
        widest = arms[0]  # from there all others are paths, but for stumps
    found = []
    for arm in arms:
        path = widest is arms[0] and before[fork] >= 0 and not arm.stump
        thin = (arm.stump or widest.stump) and arm.radius < AS_WIDE * widest.radius
        if arm is not widest and not path and not thin:
            found.append([*widest.nodes[::-1], fork, *arm.nodes])
    return found


def _up(network: Network, fork: int, before: Indices, paces: Array) -> _Arm:
    """The arm towards the entrance."""
    nodes: list[int] = []
    node = int(before[fork])
    while node >= 0:
        nodes.append(node)
        if paces[fork] - paces[node] > REACH:
            break
        node = int(before[node])
    return _Arm(nodes, _radius(network, fork, nodes, paces), False)


def _down(
    network: Network,
    fork: int,
    child: int,
    tree: tuple[dict[int, list[int]], Array],
    used: set[int],
) -> _Arm:
    """An arm away from the entrance; at further forks it follows the widest way."""
    after, paces = tree
    nodes = [child]
    while paces[nodes[-1]] - paces[fork] <= REACH:
        onward = after.get(nodes[-1], [])
        if not onward:
            break
        nodes.append(max(onward, key=lambda node: (node in used, network.radius[node])))
    return _Arm(nodes, _radius(network, fork, nodes, paces), child not in used)


def _radius(network: Network, fork: int, nodes: list[int], paces: Array) -> float:
    """The radius of an arm, some way along it [m]."""
    along = np.abs(paces[nodes] - paces[fork])
    some = (along >= FROM) & (along <= TO)
    radius = network.radius[nodes]
    return float(np.median(radius[some])) if some.any() else float(radius[-1])


def _meet(one: Array, other: Array) -> bool:
    """Whether balls, shape (n, 4) [m] each, may overlap."""
    low, high = ((one[:, :3] + s * one[:, 3:]) for s in (-1.0, 1.0))
    return bool(np.all(low.min(axis=0) <= other[:, :3].max(axis=0))) and bool(
        np.all(high.max(axis=0) >= other[:, :3].min(axis=0))
    )


def _added(balls: Array, walls: list[Balls]) -> Array | None:
    """The part of a trunk that adds to walls, and some more on both sides; None if none does."""
    gain = 1.0 - np.max([each.depth(balls[:, :3]) for each in walls], axis=0) / balls[:, 3]
    if gain.max() < GAIN:
        return None
    here = np.flatnonzero(gain > COVERED)
    part = balls[max(here[0] - OVERLAP, 0) : here[-1] + OVERLAP + 1]
    return part if len(part) * STEP > 1.0 else None
