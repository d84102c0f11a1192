"""What those who act see of the way that lies ahead of a tip, and the inputs that they ask for."""

from __future__ import annotations

from math import cos, inf, isfinite, sin, sqrt

from numpy import int64

from magwire.kernels._jit import entry, kernel, part
from magwire.kernels.glance import GLANCE

RADIUS, FRAME, ROW = 3, 4, 13
"""A row of a path's table: point (3), radius of the lumen, tangent and two normals (9)."""


@part
def along(frame, x, y, z, out, at):
    """Components of a vector along the rows of a frame."""
    for k in range(3):
        out[at + k] = x * frame[k, 0] + y * frame[k, 1] + z * frame[k, 2]


@part
def look_up(table, spacing, place, row):
    """A row of a path's table at a place along it; beyond its end, its last one."""
    last = table.shape[0] - 1
    there = min(place / spacing, last - 1e-6)
    below = int(there)
    share = there - below
    for c in range(ROW):
        low = table[below, c]
        row[c] = low + share * (table[below + 1, c] - low)


@kernel
def look_ahead(paths, spacing, goal, ahead, arc, seen, asked, last, limit, row, frames, out):
    """Numbers that are observed of each wire, and the frame of its path at its tip.

    paths: tables, shape (n, rows, 13); ahead: places that are seen (k,); seen: tip, its direction,
    feed and twist (n, 8); asked, last: inputs that were asked for, and the last action; limit: of
    inputs, negative if these are not along the path; row: room; out: shape (n, 11 + 2 m + 4 k).
    """
    inputs = asked.shape[1]
    for i in range(arc.shape[0]):
        frame, to = frames[i], out[i]
        look_up(paths[i], spacing[i], arc[i], row)
        for c in range(9):
            frame[c // 3, c % 3] = row[FRAME + c]
        x, y, z, radius = row[0], row[1], row[2], row[RADIUS]
        # The first of three is written over: how far the tip is along the path is seen elsewhere.
        along(frame, seen[i, 0] - x, seen[i, 1] - y, seen[i, 2] - z, to, 0)
        to[0], to[1] = to[1] / radius, to[2] / radius
        along(frame, seen[i, 3], seen[i, 4], seen[i, 5], to, 2)
        to[5], to[6] = arc[i] / goal[i], seen[i, 6] / goal[i]
        to[7], to[8] = sin(seen[i, 7]), cos(seen[i, 7])
        for c in range(inputs):
            to[9 + c] = asked[i, c]
        if limit > 0.0:
            along(frame, asked[i, 0], asked[i, 1], asked[i, 2], to, 9)
        for c in range(9, 9 + inputs):
            to[c] /= abs(limit)
        for c in range(2 + inputs):
            to[9 + inputs + c] = last[i, c]
        at = 11 + 2 * inputs
        for k in range(ahead.shape[0]):
            look_up(paths[i], spacing[i], arc[i] + ahead[k], row)
            way = 1.0 / ahead[k]
            along(frame, (row[0] - x) * way, (row[1] - y) * way, (row[2] - z) * way, to, at)
            to[at + 3] = row[RADIUS] / radius
            at += 4


@kernel
def read_off(crew, limit, off, arc, goal, told, look):
    """What is told of each wire, and how far it has come on its way.

    crew: what was seen of the wires (n, SEEN) and where their guides are (n, 2), scaled, and their
    units of length and force; limit: force up to which there is no cost; off: of the tip as it is
    seen (n, 3); arc: changed where the tip is on its way; told: tip force, largest force, cost,
    progress, success, branch, filled; look: tip, its direction, feed and twist, filled (n, 8).
    """
    seen, guide, length, force = crew
    at_tip, largest, cost, progress, success, branch = told
    for i in range(arc.shape[0]):
        place, gap = seen[i, GLANCE], seen[i, GLANCE + 1]
        if 0.0 < gap < inf and isfinite(place * length[i]):
            arc[i] = place * length[i]
        arc[i] = max(arc[i], 0.0)
        at_tip[i], largest[i] = seen[i, 6] * force[i], seen[i, 8] * force[i]
        cost[i] = max(largest[i] - limit, 0.0)
        progress[i], success[i] = arc[i] / goal[i], arc[i] >= goal[i]
        branch[i] = int64(seen[i, GLANCE + 2])
        for c in range(3):
            look[i, c], look[i, 3 + c] = seen[i, c] * length[i] + off[i, c], seen[i, 3 + c]
        look[i, 6], look[i, 7] = guide[i, 0] * length[i], guide[i, 1]


@kernel
def within(numbers, bound, out):
    """Numbers (n, m) of which none is larger than a bound."""
    for i in range(numbers.shape[0]):
        for c in range(numbers.shape[1]):
            out[i, c] = min(max(numbers[i, c], -bound), bound)


@entry
def report(crew, limit, off, arc, told, way, mine, row, frames, numbers, bound, out):
    """What is told and what is observed of wires: ``read_off``, ``look_ahead`` and ``within``.

    way: of the latter paths, spacing, goal, ahead; mine: seen, asked, last, limit.
    """
    paths, spacing, goal, ahead = way
    look, asked, last, most = mine
    read_off(crew, limit, off, arc, goal, told, look)
    look_ahead(paths, spacing, goal, ahead, arc, look, asked, last, most, row, frames, numbers)
    within(numbers, bound, out)


@kernel
def ask(share, frames, limit, most, only, asked):
    """Change inputs towards those of actions, as fast as they may.

    share: of the limit, shape (n, m); limit: negative if these are not along the path, whose frames
    are given; most: largest change; only: for which wires; asked: changed, shape (n, m).
    """
    for i in range(share.shape[0]):
        if not only[i]:
            continue
        x, y, z, frame = 0.0, 0.0, 0.0, frames[i]
        if limit > 0.0:
            x, y, z = share[i, 0], share[i, 1], share[i, 2]
            part_of = limit / max(sqrt(x * x + y * y + z * z), 1.0)
            x, y, z = part_of * x, part_of * y, part_of * z
        for c in range(share.shape[1]):
            if limit > 0.0:
                wanted = x * frame[0, c] + y * frame[1, c] + z * frame[2, c]
            else:
                wanted = -limit * share[i, c]
            asked[i, c] += min(max(wanted - asked[i, c], -most), most)


@kernel
def settle(only, failed, taken, actions, before, arc, goal, force, weights, reward, ended):
    """Reward each wire for what it did, and see whether its episode is over.

    taken: actions so far, of as many as ``actions``; force: that counts, in limits; weights: of
    progress, of success, of an episode's length, of force, and the largest force that counts;
    reward, and ended by success or cut off: changed, shape (n,).
    """
    progress, success, haste, pressure, hardest = weights
    terminated, truncated = ended
    for i in range(arc.shape[0]):
        reward[i] = 0.0
        if not only[i]:
            continue
        there = arc[i] >= goal[i]
        terminated[i] = there
        truncated[i] = (failed[i] != 0 or taken[i] >= actions) and not there
        gained = (min(arc[i], goal[i]) - before[i]) / goal[i]
        gain = progress * gained + (success if there else 0.0) - haste / actions
        reward[i] = gain - pressure * min(force[i], hardest)
