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


class _Tree(NamedTuple):
    """A network as paths from its entrance see it.

    Attributes
    ----------
    network
        The network [m].
    before, after
        The point before each one, shape (n,), negative where there is none, and those after it.
    paces
        Arc length from the entrance in radii, shape (n,).
    used
        The points on paths that are there; the others are on stumps.
    """

    network: Network
    before: Indices
    after: dict[int, list[int]]
    paces: Array
    used: set[int]

    def up(self, fork: int, reach: float) -> list[int]:
        """Points from a fork towards the entrance, over some radii."""
        nodes = [int(self.before[fork])]
        while self.before[nodes[-1]] >= 0 and self.paces[fork] - self.paces[nodes[-1]] <= reach:
            nodes.append(int(self.before[nodes[-1]]))
        return nodes

    def down(self, fork: int, child: int, reach: float) -> list[int]:
        """Points from a fork on, over some radii; at further forks along the widest way."""
        nodes = [child]
        while nodes[-1] in self.after and self.paces[nodes[-1]] - self.paces[fork] <= reach:
            nodes.append(max(self.after[nodes[-1]], key=self._rank))
        return nodes

    def _rank(self, node: int) -> tuple[bool, float]:
        return node in self.used, float(self.network.radius[node])

    def radius(self, fork: int, nodes: list[int]) -> float:
        """The radius of an arm, some way along it [m]."""
        along = np.abs(self.paces[nodes] - self.paces[fork])
        some = (along >= FROM) & (along <= TO)
        radius = self.network.radius[nodes]
        return float(np.median(radius[some])) if some.any() else float(radius[-1])

    def left_out(self, fork: int) -> list[list[int]]:
        """The ways from a fork's widest arm into each other one that no path takes, as points."""
        others = list(self.after[fork])
        wide = {child: self.radius(fork, self.down(fork, child, TO)) for child in others}
        widest, came = (
            max(others, key=lambda child: wide[child]),
            self.radius(fork, self.up(fork, TO)),
        )
        if came >= AS_WIDE * wide[widest]:  # from there all others are paths, but for stumps
            first, width = self.up(fork, REACH), came
            others = [child for child in others if child not in self.used]
        else:
            first, width = self._arm(fork, widest), wide[widest]
            others.remove(widest)
        paths = self.used.issuperset([*others, first[0]])
        return [
            [*first[::-1], fork, *self._arm(fork, child)]
            for child in others
            if paths or wide[child] >= AS_WIDE * width
        ]

    def _arm(self, fork: int, child: int) -> list[int]:
        """An arm as far as it counts: a stump, which no path follows, to its end."""
        return self.down(fork, child, REACH if child in self.used else np.inf)


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
    tree = _Tree(network, before, after, _paces(after, steps), used)
    forks = sorted(node for node in after if len(after[node]) > 1 and before[node] >= 0)
    tried = [(fork, nodes) for fork in forks for nodes in tree.left_out(fork)]
    walls = [wall(paths)] if tried else []
    kept: list[Array] = []
    notes: list[str] = []
    for fork, nodes in tried:
        found = smooth(network.points[nodes], network.radius[nodes], smoothing, original)
        balls = np.column_stack([found.points, found.radius])
        near = [wall([part]) for part in kept if _meet(part, balls)]
        part = _added(balls, [*walls, *near]) if found.whole else None
        if part is not None:
            kept.append(part)
            notes.append(
                f"The trunk of radius {long(float(part[:, 3].max()))} near "
                f"{place(network.points[fork])} stays, although no path runs straight through it."
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
