"""Edges between the points of lines: where they are one, and over the gaps between them."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array, FileFaultError, Indices, Line
from magwire.vessel.words import long, place

MERGED = 0.1  # distance at which points of two lines are one, over the radius
WIDER = 1.05  # radius of a point over that of one which stands for it, from which it counts
NEIGHBOURS = 4  # points along a line that count as joined already
BRIDGED = 2.0  # largest gap between a line's end and another line, over the radius
NOTED = 0.5  # gap that is worth a word, over the radius
POINTING = 8  # points by which an end of a line points
LANDED = 0.5  # how far an end is from the line in whose tube it is, at most, over the radius
ESCAPED = 2.0  # how far its own line goes from there, at least, over the radius
ACROSS = 0.9  # largest cosine of the angle between the two
PIECES = 200  # disconnected pieces that are looked at
MOST_PAIRS = 5_000_000  # of points of lines that run along each other


def merged(points: Array, radius: Array, owner: Indices) -> tuple[Indices, list[str]]:
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


def widest(radius: Array, stand_in: Indices) -> Array:
    """Radii where a point that stands for one that is clearly wider is as wide as that, shape (n,).

    So is a side branch that begins on the line of its trunk. Of lines that say about the same of a
    trunk that they share the first counts, since the largest of noisy radii is too large.
    """
    most = radius.copy()
    np.maximum.at(most, stand_in, radius)
    return np.where(most > WIDER * radius, most, radius)


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


def pairs(stand_in: Indices, owner: Indices) -> Indices:
    """Edges between points that follow each other, shape (m, 2)."""
    follow = np.flatnonzero(np.diff(owner) == 0)
    a, b = stand_in[follow], stand_in[follow + 1]
    # Two points on another line are joined by that line.
    taken = (a != follow) & (b != follow + 1) & (owner[a] == owner[b])
    fresh = (a != b) & ~(taken & (np.abs(a - b) <= NEIGHBOURS))
    return np.column_stack([a[fresh], b[fresh]])


def matrix(points: Array, pairs: Indices) -> csr_array:
    """Lengths of the edges between pairs of points, both ways round, shape (n, n)."""
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    lengths = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    lengths = np.maximum(lengths, 1e-300)  # an entry of zero would be no edge
    both = np.concatenate([pairs, pairs[:, ::-1]])
    shape = (len(points), len(points))
    return csr_array((np.tile(lengths, 2), (both[:, 0], both[:, 1])), shape=shape)


def bridges(
    points: Array, radius: Array, pairs: Indices, stand_in: Indices, first: Indices
) -> tuple[Indices, list[str]]:
    """Edges over the gaps between pieces, and what to say of them."""
    found: list[tuple[int, int]] = []
    notes: list[str] = []
    tips = stand_in[np.unique(np.concatenate([first[:-1], first[1:] - 1]))]
    used = np.unique(pairs)
    while True:
        every = np.concatenate([pairs, np.array(found, dtype=np.int64).reshape(-1, 2)])
        label = connected_components(matrix(points, every), directed=False)[1]
        pieces = np.unique(label[used])
        if len(pieces) < 2:
            return np.array(found, dtype=np.int64).reshape(-1, 2), notes
        if len(pieces) > PIECES:
            raise FileFaultError(f"is in {len(pieces)} disconnected pieces")
        tip, other, gap = _closest(points, radius, label, used, tips)
        wide = max(radius[tip], radius[other])
        where = place(points[tip])
        if gap > BRIDGED * wide:
            raise FileFaultError(
                f"is in {len(pieces)} disconnected pieces; the closest ones are {long(gap)} apart, "
                f"{gap / wide:.3g} times the radius there, near {where}"
            )
        found.append((tip, other))
        if gap > NOTED * wide:
            notes.append(f"A gap of {long(gap)} near {where} is bridged.")


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


def facing(
    points: Array, radius: Array, pairs: Indices, stand_in: Indices, first: Indices
) -> tuple[Indices, list[str]]:
    """Edges from open ends to ends of other lines that they point at: these close loops."""
    tips = np.column_stack([first[:-1], first[1:] - 1])
    degree = np.bincount(np.unique(np.sort(pairs, axis=1), axis=0).ravel(), minlength=len(points))
    places = stand_in[tips]
    tree = KDTree(points[places.ravel()])
    found, notes = [], []
    for line, (a, b) in enumerate(tips.tolist()):
        back = min(POINTING, b - a)
        for tip, behind in ((a, a + back), (b, b - back)):
            if stand_in[tip] != tip or degree[tip] != 1:
                continue
            ahead = points[tip] - points[behind]
            for k in tree.query_ball_point(points[tip], BRIDGED * radius[tip]):
                other = int(places.ravel()[k])
                away = points[other] - points[tip]
                gap = float(np.linalg.norm(away))
                straight = ahead @ away > 0.5 * gap * np.linalg.norm(ahead)
                if k // 2 != line and other != tip and straight:
                    found.append((tip, other))
                    notes.append(f"A gap of {long(gap)} near {place(points[tip])} is bridged.")
                    break
    return np.array(found, dtype=np.int64).reshape(-1, 2), notes


def landing(
    points: Array, radius: Array, pairs: Indices, stand_in: Indices, first: Indices
) -> Indices:
    """Edges from open ends that lie inside of another line's tube, to that line, shape (m, 2).

    So end the lines of a loop that do not quite touch. The line has to come from outside, across
    the other one.
    """
    degree = np.bincount(np.unique(np.sort(pairs, axis=1), axis=0).ravel(), minlength=len(points))
    tree, widest, found = KDTree(points), float(radius.max()), []
    owner = np.repeat(np.arange(len(first) - 1), np.diff(first))
    for line, (a, b) in enumerate(zip(first[:-1].tolist(), (first[1:] - 1).tolist(), strict=True)):
        own = points[a : b + 1]
        for tip, behind in ((a, min(a + POINTING, b)), (b, max(b - POINTING, a))):
            if stand_in[tip] != tip or degree[tip] != 1:
                continue
            near = np.array(tree.query_ball_point(points[tip], widest), dtype=np.int64)
            near = near[owner[near] != line]
            share = np.linalg.norm(points[near] - points[tip], axis=1) / radius[near]
            if len(near) == 0 or share.min() > LANDED:
                continue
            other = int(near[np.argmin(share)])
            start, stop = int(first[owner[other]]), int(first[owner[other] + 1]) - 1
            ends = np.linalg.norm(points[[start, stop]] - points[other], axis=1)
            away = float(np.linalg.norm(own - points[other], axis=1).max())
            if ends.min() < radius[other] or away < ESCAPED * radius[other]:
                continue
            ahead = points[tip] - points[behind]
            along = points[min(other + 1, stop)] - points[max(other - 1, start)]
            size = float(np.linalg.norm(ahead) * np.linalg.norm(along))
            if abs(ahead @ along) < ACROSS * size:
                found.append((tip, int(stand_in[other])))
    return np.array(found, dtype=np.int64).reshape(-1, 2)


def ends(lines: list[Line], first: Indices, places: Indices, edges: csr_array) -> dict[str, int]:
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
