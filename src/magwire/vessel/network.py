"""Lines that share a trunk or touch, made into one graph with open ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree

from magwire.vessel import joining
from magwire.vessel.balls import Balls
from magwire.vessel.files.drawing import Array, FileFaultError, Indices, Line
from magwire.vessel.words import long, place

WIDE = 1.0  # how far apart the two sides of a loop are, at least, over the radius
UNLIKE = 1e4  # largest radius over the smallest
CUT = 1.2  # how far from where a loop is cut its two sides end, over the radius
SHARP = -0.5  # cosine of a turn that smoothing does not get a lumen around: 120 degrees
TURN = 3.0  # over how much path a turn is looked at, on each side of it, over the radius
LOOPS = 32  # that are opened; the arteries of a brain have fewer
BETWEEN = 2  # balls between two points of a line, which are a tenth of a radius apart
MOST_LINES = 3000  # of a real vessel there are some hundreds


@dataclass(frozen=True, eq=False)
class Network:
    """Points of all lines, joined by edges.

    Attributes
    ----------
    points, radius
        Shapes (n, 3) and (n,).
    edges
        Symmetric matrix of the lengths of the edges, shape (n, n).
    ends
        Open ends by name, in the order of the file: the index of the point.
    notes
        What was done to join the lines, a sentence each.
    touching
        For each end, how many lines begin or stop there, and whether the first one begins there.
    """

    points: Array
    radius: Array
    edges: csr_array
    ends: dict[str, int]
    notes: tuple[str, ...]
    touching: dict[str, tuple[int, bool]]

    @classmethod
    def of(cls, lines: list[Line], named: Mapping[str, Array] | None = None) -> Network:
        """Join lines.

        Parameters
        ----------
        lines
            Cleaned, in metres.
        named
            Places of the ends by their names, where they are known [m].

        Raises
        ------
        FileFaultError
            If they are in pieces that do not touch.
        """
        if len(lines) > MOST_LINES:
            raise FileFaultError(
                f"has {len(lines)} lines from fork to fork; expected at most {MOST_LINES}"
            )
        points = np.concatenate([line.points for line in lines])
        radius = np.concatenate([line.radius for line in lines])
        if radius.max() > UNLIKE * radius.min():
            raise FileFaultError(
                f"has radii from {long(radius.min())} to {long(radius.max())}, too different for "
                "one vessel"
            )
        first = np.concatenate([[0], np.cumsum([len(line.points) for line in lines])])
        owner = np.repeat(np.arange(len(lines)), np.diff(first))
        stand_in, notes = joining.merged(points, radius, owner)
        radius = joining.widest(radius, stand_in)
        pairs = joining.pairs(stand_in, owner)
        bridges, more = joining.bridges(points, radius, pairs, stand_in, first)
        pairs = np.concatenate([pairs, bridges])
        facing, still_more = joining.facing(points, radius, pairs, stand_in, first)
        pairs = np.concatenate([pairs, facing])
        landing = joining.landing(points, radius, pairs, stand_in, first)
        pairs = np.concatenate([pairs, landing])
        kept, pairs = np.unique(pairs, return_inverse=True)
        pairs = pairs.reshape(-1, 2)
        places = np.full(len(points), -1)
        places[kept] = np.arange(len(kept))
        edges = joining.matrix(points[kept], pairs)
        ends = joining.ends(lines, first, places[stand_in], edges)
        if not ends:
            raise FileFaultError("is a ring, without an open end to enter at")
        if named:
            leaves = list(ends.values())
            tree = KDTree(points[kept][leaves])
            ends = {name: leaves[int(tree.query(place)[1])] for name, place in named.items()}
        tips = places[stand_in][np.column_stack([first[:-1], first[1:] - 1])]
        touching = {
            name: (int((tips == end).any(axis=1).sum()), bool(tips[0, 0] == end))
            for name, end in ends.items()
        }
        said = (*notes, *more, *still_more)
        return cls(points[kept], radius[kept], edges, ends, said, touching)

    def balls(self) -> Balls:
        """The union of balls along all edges."""
        table = self.edges.tocoo()
        once = table.row < table.col
        a, b = table.row[once], table.col[once]
        share = np.arange(1, BETWEEN + 1)[:, None, None] / (BETWEEN + 1.0)
        every = np.column_stack([self.points, self.radius])
        more = (every[a] + share * (every[b] - every[a])).reshape(-1, 4)
        return Balls(self.points, self.radius, Balls(more[:, :3], more[:, 3]))

    def extended(self, radii: float) -> Network:
        """The network with each open end made longer, by so many of its radii."""
        points, radius = [self.points], [self.radius]
        table = self.edges.tocoo()
        pairs, ends, count = [np.column_stack([table.row, table.col])], {}, len(self.points)
        for name, end in self.ends.items():
            behind, last = end, end
            for _ in range(joining.POINTING):
                onward = [n for n in self._beside(last) if n != behind]
                if len(onward) != 1:
                    break
                behind, last = last, onward[0]
            ahead = self.points[end] - self.points[last]
            ahead /= max(float(np.linalg.norm(ahead)), 1e-300)
            steps = np.linspace(0.0, radii, max(int(np.ceil(radii / joining.MERGED)), 1) + 1)[1:]
            points.append(self.points[end] + self.radius[end] * steps[:, None] * ahead)
            radius.append(np.full(len(steps), self.radius[end]))
            run = np.concatenate([[end], count + np.arange(len(steps))])
            pairs.append(np.column_stack([run[:-1], run[1:]]))
            count += len(steps)
            ends[name] = count - 1
        places = np.concatenate(points)
        edges = joining.matrix(places, np.concatenate(pairs))
        return replace(self, points=places, radius=np.concatenate(radius), edges=edges, ends=ends)

    def nearest(self, point: Array) -> int:
        """Index of the point nearest to another, shape (3,)."""
        return int(np.argmin(np.linalg.norm(self.points - point, axis=1)))

    def from_entrance(self, start: int) -> tuple[Network, Indices]:
        """The network with its loops opened, and the point before each on the path from a point.

        A loop is opened where it is farthest from that point, where two paths to it are as long;
        or, where one of them turns back at a fork before it, at that fork. The points before are of
        shape (n,), negative where there is none.

        Raises
        ------
        FileFaultError
            If there are more than ``LOOPS``.
        """
        network, before = self, self._before(start)
        loops = list(islice(self._loops(before), LOOPS + 1))
        if len(loops) > LOOPS:
            raise FileFaultError(f"has more than {LOOPS} loops; expected a tree with a few at most")
        for u, v in loops:
            network = network._opened(u, v, before)
        return network, before if network is self else network._before(start)

    def cut(self, point: Array) -> Network:
        """The network cut at a point, shape (3,), where a loop is to be opened."""
        node = self.nearest(point)
        beside = self._beside(node)
        if len(beside) != 2:
            raise FileFaultError(
                f"cannot be cut near {place(point)}, which is at an end or at a junction"
            )
        if np.linalg.norm(self.points[node] - point) > CUT * self.radius[node]:
            raise FileFaultError(f"cannot be cut near {place(point)}, which is not in the vessel")
        return self._apart(node, beside[0])

    def beyond(self, cut: int) -> Network:
        """What is on the longer side of a point, which becomes an end."""
        rest = self.edges.tolil()
        rest[[cut], :] = 0.0
        rest[:, [cut]] = 0.0
        rest = csr_array(rest.tocsr())
        rest.eliminate_zeros()
        _, label = connected_components(rest, directed=False)
        lengths = np.bincount(label, weights=np.asarray(rest.sum(axis=1)).ravel())
        longest = label == int(np.argmax(lengths))
        gone = ~longest
        gone[cut] = False
        edges = self.edges.tolil()
        edges[np.flatnonzero(gone), :] = 0.0
        edges[:, np.flatnonzero(gone)] = 0.0
        kept = csr_array(edges.tocsr())
        kept.eliminate_zeros()
        ends = {name: end for name, end in self.ends.items() if longest[end]}
        return replace(self, edges=kept, ends=ends)

    def _before(self, start: int) -> Indices:
        """The point before each one on the shortest path from a point, shape (n,)."""
        before = dijkstra(self.edges, directed=False, indices=start, return_predecessors=True)[1]
        ways: Indices = before.astype(np.int64)
        return ways

    def _loops(self, before: Indices) -> Iterator[tuple[int, int]]:
        """Edges where the two sides of a loop meet that are apart by more than the radius."""
        table = self.edges.tocoo()
        a, b = table.row, table.col
        reached = (before[a] >= 0) & (before[b] >= 0)  # what touches the entrance is no loop
        beside = (a < b) & (before[a] != b) & (before[b] != a) & reached
        for u, v in zip(a[beside].tolist(), b[beside].tolist(), strict=True):
            one, other = _sides(before, u, v)
            if min(len(one), len(other)) > 1 and self._width(one, other) > WIDE:
                yield u, v

    def _width(self, one: Indices, other: Indices) -> float:
        """How far apart the two sides of a loop are, in radii."""
        apart = KDTree(self.points[other]).query(self.points[one])[0]
        return float((apart / self.radius[one]).max())

    def _opened(self, u: int, v: int, before: Indices) -> Network:
        """The network without the edge where a loop closes, and a note of it."""
        one, other = _sides(before, u, v)
        ring = self.points[np.concatenate([one, other[::-1]])]
        length = float(np.linalg.norm(np.diff(ring, axis=0, append=ring[:1]), axis=1).sum())
        where = "where it is farthest from the entrance"
        for path in (np.append(one, v), np.append(other, u)):
            fork = self._turn_back(path, before)
            if fork is not None:
                u, v = int(path[fork]), int(path[fork + 1])
                where = "at a fork, since the way on turns back there"
                break
        opened = self._apart(u, v)
        words = (
            f"A loop of {long(length)} is opened near {place(self.points[u])}, {where}; "
            "'cut' opens it elsewhere."
        )
        return replace(opened, notes=(*opened.notes, words))

    def _turn_back(self, path: Indices, before: Indices) -> int | None:
        """Where on a side of a loop the first fork is that a lumen cannot turn back at."""
        start = int(before[path[0]])
        points = self.points[path] if start < 0 else self.points[np.append(start, path)]
        skip = len(points) - len(path)
        along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        for k, node in enumerate(path[:-1].tolist()):
            if len(self._beside(node)) < 3:
                continue
            here, reach = along[k + skip], TURN * self.radius[node]
            stops = np.searchsorted(along, [here - reach, here + reach])
            back, ahead = np.clip(stops, 0, len(points) - 1)
            came, goes = points[k + skip] - points[back], points[ahead] - points[k + skip]
            size = float(np.linalg.norm(came) * np.linalg.norm(goes))
            if came @ goes < SHARP * size:
                return k
        return None

    def _beside(self, node: int) -> list[int]:
        """The points that a point is joined to."""
        table = self.edges
        found: list[int] = table.indices[table.indptr[node] : table.indptr[node + 1]].tolist()
        return found

    def _apart(self, u: int, v: int) -> Network:
        """The network cut between two neighbours: both sides stop short of it, as ends."""
        sides = self._back(u, v), self._back(v, u)
        gone = np.array([node for side in sides for node in side[:-1]], dtype=np.int64)
        edges = self.edges.tolil()
        edges[u, v] = edges[v, u] = 0.0
        edges[gone, :] = 0.0
        edges[:, gone] = 0.0
        kept = csr_array(edges.tocsr())
        kept.eliminate_zeros()
        ends, taken = dict(self.ends), set(self.ends.values())
        for side in sides:
            alone = kept.indptr[side[-1] + 1] - kept.indptr[side[-1]] == 1
            if alone and side[-1] not in taken:
                number = 1 + sum(name.startswith("cut-") for name in ends)
                ends[f"cut-{number}"] = side[-1]
        ends = {name: end for name, end in ends.items() if end not in gone}
        return replace(self, edges=kept, ends=ends)

    def _back(self, node: int, ahead: int) -> list[int]:
        """Points from one away from its neighbour: half a cut's width and clear of other lines."""
        arm, length = self._arm(node, ahead), 0.0
        others = np.ones(len(self.points), dtype=bool)
        others[[*arm, *self._arm(ahead, node)]] = False
        tree = KDTree(self.points[others])
        for k, at in enumerate(arm):
            if k > 0:
                length += float(np.linalg.norm(self.points[at] - self.points[arm[k - 1]]))
            if length >= CUT * self.radius[node]:
                off, nearest = tree.query(self.points[at])
                if off >= CUT * self.radius[others][nearest]:
                    return arm[: k + 1]
        return arm

    def _arm(self, node: int, ahead: int) -> list[int]:
        """Points from one away from its neighbour, up to the last one before a fork."""
        found = [node]
        while True:
            onward = [n for n in self._beside(found[-1]) if n not in (ahead, *found[-2:])]
            if len(onward) != 1 or onward[0] == node:
                return found if len(found) < 2 or not onward else found[:-1]
            found.append(onward[0])


def _sides(before: Indices, u: int, v: int) -> tuple[Indices, Indices]:
    """The paths to two points from the last one that they share, which is left out."""
    one, seen = [u], {u: 0}
    while before[one[-1]] >= 0:
        one.append(int(before[one[-1]]))
        seen[one[-1]] = len(one) - 1
    other = [v]
    while other[-1] not in seen:
        other.append(int(before[other[-1]]))
    stop = seen[other[-1]]
    return (
        np.array(one[:stop][::-1], dtype=np.int64),
        np.array(other[:-1][::-1], dtype=np.int64),
    )
