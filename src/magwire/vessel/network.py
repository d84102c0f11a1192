"""Lines that share a trunk or touch, made into one graph with open ends."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array, FileFaultError, Indices, Line

MERGED = 0.1  # distance at which points of two lines are one, over the radius
NEIGHBOURS = 4  # points along a line that count as joined already
BRIDGED = 2.0  # largest gap between a line's end and another line, over the radius
NOTED = 0.5  # gap that is worth a word, over the radius
WIDE = 1.0  # how far apart the two sides of a loop are, at least, over the radius
UNLIKE = 1e4  # largest radius over the smallest
PIECES = 200  # disconnected pieces that are looked at
MOST_LINES = 256  # what is done to branches grows with the square of their number
MOST_PAIRS = 5_000_000  # of points of lines that run along each other


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
    """

    points: Array
    radius: Array
    edges: csr_array
    ends: dict[str, int]
    notes: tuple[str, ...]

    @classmethod
    def of(cls, lines: list[Line]) -> Network:
        """Join lines.

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
                f"has radii from {radius.min():.4g} to {radius.max():.4g} m, too different for one "
                "vessel"
            )
        first = np.concatenate([[0], np.cumsum([len(line.points) for line in lines])])
        owner = np.repeat(np.arange(len(lines)), np.diff(first))
        stand_in, notes = _merged(points, radius, owner)
        pairs = _pairs(stand_in, owner)
        bridges, more = _bridges(points, radius, pairs, stand_in, first)
        pairs = np.concatenate([pairs, bridges])
        kept, pairs = np.unique(pairs, return_inverse=True)
        pairs = pairs.reshape(-1, 2)
        places = np.full(len(points), -1)
        places[kept] = np.arange(len(kept))
        edges = _matrix(points[kept], pairs)
        ends = _ends(lines, first, places[stand_in], edges)
        return cls(points[kept], radius[kept], edges, ends, (*notes, *more))

    def nearest(self, point: Array) -> int:
        """Index of the point nearest to another, shape (3,)."""
        return int(np.argmin(np.linalg.norm(self.points - point, axis=1)))

    def from_entrance(self, start: int) -> Indices:
        """The point before each one on the way from a point, shape (n,); negative if none.

        Raises
        ------
        FileFaultError
            If there are two ways to some point.
        """
        distance, before = dijkstra(
            self.edges, directed=False, indices=start, return_predecessors=True
        )
        ways: Indices = before.astype(np.int64)
        self._check_loops(distance, ways)
        return ways

    def way(self, before: Indices, end: int) -> Indices:
        """Indices of the points on the way to an end."""
        found = [end]
        while before[found[-1]] >= 0:
            found.append(int(before[found[-1]]))
        return np.array(found[::-1], dtype=np.int64)

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
        return Network(self.points, self.radius, kept, ends, self.notes)

    def _check_loops(self, distance: Array, before: Indices) -> None:
        """Refuse two ways to the same point that are apart by more than the radius."""
        table = self.edges.tocoo()
        a, b = table.row, table.col
        beside = (a < b) & (before[a] != b) & (before[b] != a) & np.isfinite(distance[a])
        for u, v in zip(a[beside].tolist(), b[beside].tolist(), strict=True):
            one, other = self.way(before, u)[::-1], self.way(before, v)[::-1]
            shared = set(other.tolist())
            split = next(i for i, n in enumerate(one.tolist()) if n in shared)
            stop = other.tolist().index(int(one[split]))
            if min(split, stop) == 0:
                continue
            sides = self.points[one[: split + 1]], self.points[other[: stop + 1]]
            apart = KDTree(sides[1]).query(sides[0])[0] / self.radius[one[: split + 1]]
            if apart.max() > WIDE:
                length = float(distance[u] + distance[v] - 2.0 * distance[one[split]])
                x, y, z = self.points[one[int(np.argmax(apart))]]
                raise FileFaultError(
                    f"has a loop of length {length:.4g} near ({x:.4g}, {y:.4g}, {z:.4g}); "
                    "expected branches that do not meet again"
                )


def _merged(points: Array, radius: Array, owner: Indices) -> tuple[Indices, list[str]]:
    """For each point the one that stands for it: of an earlier line if one is close."""
    stand_in = np.arange(len(points))
    notes: list[str] = []
    if owner[-1] == 0:
        return stand_in, notes
    late, early, apart = _close_pairs(points, radius)
    narrow = np.minimum(radius[late], radius[early])
    fits = (owner[late] != owner[early]) & (apart <= MERGED * narrow)
    late, early, apart = late[fits], early[fits], apart[fits]
    order = np.lexsort((apart, late))
    late, early = late[order], early[order]
    nearest = np.unique(late, return_index=True)[1]
    for n, m in zip(late[nearest].tolist(), early[nearest].tolist(), strict=True):
        stand_in[n] = stand_in[m]  # m < n has its own by now
    own = stand_in == np.arange(len(points))
    repeated = [i + 1 for i in range(int(owner[-1]) + 1) if not own[owner == i].any()]
    if repeated:
        words = ", ".join(map(str, repeated))
        notes.append(f"Lines that repeat others are left out: {words}.")
    return stand_in, notes


def _close_pairs(points: Array, radius: Array) -> tuple[Indices, Indices, Array]:
    """Pairs that may be closer than ``MERGED``, the later point first, and their distances.

    Points are as dense as their radius is small, so that radii are compared an octave at a time.
    """
    octave = np.floor(np.log2(radius / radius.min())).astype(np.int64)
    parts, count = [], 0
    for k in np.unique(octave):
        these, others = np.flatnonzero(octave == k), np.flatnonzero(octave >= k)
        tree, other = KDTree(points[these]), KDTree(points[others])
        reach = MERGED * 2.0 ** (float(k) + 1.0) * float(radius.min())
        count += int(tree.count_neighbors(other, reach))
        if count > MOST_PAIRS:
            raise FileFaultError(
                "has too many lines that run along each other: more than "
                f"{MOST_PAIRS} pairs of points are within {MERGED:g} radii"
            )
        found = tree.sparse_distance_matrix(other, reach, output_type="ndarray")
        parts.append(np.column_stack([these[found["i"]], others[found["j"]], found["v"]]))
    pairs = np.concatenate(parts)
    a, b = pairs[:, 0].astype(np.int64), pairs[:, 1].astype(np.int64)
    return np.maximum(a, b), np.minimum(a, b), pairs[:, 2]


def _pairs(stand_in: Indices, owner: Indices) -> Indices:
    """Edges between points that follow each other, shape (m, 2)."""
    follow = np.flatnonzero(np.diff(owner) == 0)
    a, b = stand_in[follow], stand_in[follow + 1]
    # Two points on another line are joined by that line.
    taken = (a != follow) & (b != follow + 1) & (owner[a] == owner[b])
    fresh = (a != b) & ~(taken & (np.abs(a - b) <= NEIGHBOURS))
    return np.column_stack([a[fresh], b[fresh]])


def _matrix(points: Array, pairs: Indices) -> csr_array:
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    lengths = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    lengths = np.maximum(lengths, 1e-300)  # an entry of zero would be no edge
    both = np.concatenate([pairs, pairs[:, ::-1]])
    shape = (len(points), len(points))
    return csr_array((np.tile(lengths, 2), (both[:, 0], both[:, 1])), shape=shape)


def _bridges(
    points: Array, radius: Array, pairs: Indices, stand_in: Indices, first: Indices
) -> tuple[Indices, list[str]]:
    """Edges over the gaps between pieces, and what to say of them."""
    found: list[tuple[int, int]] = []
    notes: list[str] = []
    tips = stand_in[np.unique(np.concatenate([first[:-1], first[1:] - 1]))]
    used = np.unique(pairs)
    while True:
        every = np.concatenate([pairs, np.array(found, dtype=np.int64).reshape(-1, 2)])
        label = connected_components(_matrix(points, every), directed=False)[1]
        pieces = np.unique(label[used])
        if len(pieces) < 2:
            return np.array(found, dtype=np.int64).reshape(-1, 2), notes
        if len(pieces) > PIECES:
            raise FileFaultError(f"is in {len(pieces)} disconnected pieces")
        tip, other, gap = _closest(points, radius, label, used, tips)
        wide = max(radius[tip], radius[other])
        x, y, z = points[tip]
        where = f"({x:.4g}, {y:.4g}, {z:.4g})"
        if gap > BRIDGED * wide:
            raise FileFaultError(
                f"is in {len(pieces)} disconnected pieces; the closest ones are {gap:.4g} apart, "
                f"{gap / wide:.3g} times the radius there, near {where}"
            )
        found.append((tip, other))
        if gap > NOTED * wide:
            notes.append(f"A gap of {gap:.4g} near {where} is bridged.")


def _closest(
    points: Array, radius: Array, label: NDArray[np.int32], used: Indices, tips: Indices
) -> tuple[int, int, float]:
    """The end of a line and the point of another piece that are the fewest radii apart."""
    best, found = np.inf, (0, 0, np.inf)
    for piece in np.unique(label[used]):
        others, mine = used[label[used] != piece], tips[label[tips] == piece]
        if len(mine) == 0:
            continue
        gap, nearest = KDTree(points[others]).query(points[mine])
        share = gap / np.maximum(radius[mine], radius[others[nearest]])
        i = int(np.argmin(share))
        if share[i] < best:
            best, found = share[i], (int(mine[i]), int(others[nearest[i]]), float(gap[i]))
    return found


def _ends(lines: list[Line], first: Indices, places: Indices, edges: csr_array) -> dict[str, int]:
    """Points with a single neighbour, by name."""
    degree = np.diff(edges.indptr)
    tips = [[int(places[first[i + 1] - 1]), int(places[first[i]])] for i in range(len(lines))]
    claims = Counter(tip for pair in tips for tip in pair if tip >= 0 and degree[tip] == 1)
    leaves = dict.fromkeys((t for a, b in tips for t in (b, a) if t in claims), "")
    for line, pair in zip(lines, tips, strict=True):
        # A line is named for where it leads: to its last point, or to its first if it runs back.
        own = [tip for tip in pair if claims[tip] == 1]
        if own and line.name not in leaves.values():
            leaves[own[0]] = line.name
    return {name or f"end-{k}": leaf for k, (leaf, name) in enumerate(leaves.items(), start=1)}
