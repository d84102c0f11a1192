"""Paths from one entrance, sharing their first points, joined into one lumen (P-10).

The cost is that of the branches, not of the sum of all paths: what paths share is found by its
points being the same, and the centreline of a path is made when it is asked for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError
from magwire.lumen.branch import Branch
from magwire.lumen.lazy import Lazy
from magwire.lumen.ridges import without_ridges
from magwire.lumen.spline import spline
from magwire.lumen.tree import (
    BLEND,
    MOUTH,
    SHARED,
    Line,
    Trace,
    Tree,
    Walls,
    check_courses,
    deepest,
    grown,
    missing,
    refusal,
    run_in,
    tapered,
)

Array = NDArray[np.float64]

LEAD = 6  # points before a path leaves, so that its curve does not begin there
RUN_IN = 16  # points of a path behind where it leaves, about four radii
BURIED = 0.5  # part of the radius by which an end of a trunk may stick out of other walls
AT_ONCE = 8  # points that are looked at together


def join_ways(ways: Mapping[str, Array], trunks: Sequence[Array], width: float | None) -> Tree:
    """The tree of paths from one entrance.

    Parameters
    ----------
    ways
        Balls of each path from the entrance on, by the name of its outlet, shape (n, 4) [m]: centre
        and radius.
    trunks
        Balls of tubes that are wall, but lead nowhere, shape (n, 4) [m].
    width
        Width over which branches blend [m]; if None, by the radius at each junction.
    """
    walls, seen = Walls(), dict[bytes, int]()
    for name, balls in ways.items():
        balls = np.ascontiguousarray(balls)
        shared = _shared(balls, seen)
        if shared == len(balls):
            raise refusal(f"'{name}' runs along another one to its end")
        walls.add(name, _wall(name, balls, shared, walls, width))
        seen.update((balls[i].tobytes(), i) for i in range(shared, len(balls)))
    check_courses(walls, beside=True)
    for number, balls in enumerate(trunks, start=1):
        walls.add(f"trunk {number}", _trunk(balls, walls, width))
    return Tree(tuple(walls.branches), Lazy({n: partial(_tube, b) for n, b in ways.items()}))


def _shared(balls: Array, seen: Mapping[bytes, int]) -> int:
    """How many points a path shares with those before it: all before the first that is new."""
    low, high = 0, len(balls)
    while low < high:
        middle = (low + high) // 2
        if seen.get(balls[middle].tobytes()) == middle:
            low = middle + 1
        else:
            high = middle
    return low


def _wall(name: str, balls: Array, shared: int, walls: Walls, width: float | None) -> Branch:
    """The wall of a path from where it leaves those before it; all of it for the first one."""
    if not walls.branches:
        return without_ridges(_tube(balls), float(balls[0, 3]))
    if np.linalg.norm(balls[0, :3] - walls.branches[0].entrance) > 0.0:
        raise InputError(
            f"Input balls of Lumen.ways must all start at one entrance; '{name}' starts at "
            f"{balls[0, :3].tolist()} m."
        )
    start = _leaves(name, balls, max(shared - 1, 0), walls)
    if (
        np.linalg.norm(balls[start, :3] - balls[0, :3]) < MOUTH * balls[0, 3]
    ):  # its cap would stand in the entrance
        blend = BLEND * float(balls[0, 3]) if width is None else width
        return Branch(balls[:, :3], balls[:, 3], blend=blend)
    first = max(start - LEAD, 0)  # the curve shall not begin where the wall does
    part = balls[first:]
    steps = np.linalg.norm(np.diff(part[:, :3], axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    course = spline(knots, part)
    own = knots[start - first :]
    near = own[:RUN_IN]  # closer together where the wall takes on its radius
    arcs = np.sort(np.concatenate([own, 0.5 * (near[1:] + near[:-1])]))
    tangents = course(own[[0, -1]], 1)[:, :3]
    return grown(name, Line(arcs - own[0], course(arcs), tangents, True), walls, width, widens=True)


def _trunk(balls: Array, walls: Walls, width: float | None) -> Branch:
    """The wall of a tube whose ends lie in other walls, where they are not felt, or are open."""
    steps = np.linalg.norm(np.diff(balls[:, :3], axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    closer = (knots[1:] < knots[-1:] / 2.0) & (np.arange(len(steps)) < RUN_IN)
    closer |= closer[::-1]
    arcs = np.sort(np.concatenate([knots, 0.5 * (knots[1:] + knots[:-1])[closer]]))
    made = spline(knots, balls)(arcs)
    others = walls.near(made[:, :3], float(made[:, 3].max()))
    width = BLEND * _narrowest(made, others) if width is None else width
    radius, is_open = made[:, 3].copy(), [False, False]
    for end, (at, along) in enumerate(((0, arcs), (-1, arcs[-1] - arcs))):
        lost = missing(float(made[at, 3]), deepest(made[at], others)[0], width)
        is_open[end] = lost > BURIED * made[at, 3]
        if not is_open[end]:
            radius -= run_in(lost, made[at, 3], along)
    radius = tapered(radius, arcs)
    return Branch(made[:, :3], radius, open_begin=is_open[0], open_end=is_open[1], blend=width)


def _narrowest(balls: Array, others: Sequence[Trace]) -> float:
    """The smallest radius of other tubes where their centrelines are in this one [m]."""
    from scipy.spatial import KDTree

    tree, least = KDTree(balls[:, :3]), float(balls[:, 3].min())
    for other in others:
        distance, nearest = tree.query(other.balls[:, :3])
        inside = distance < balls[nearest, 3]
        least = min(least, float(other.balls[inside, 3].min(initial=np.inf)))
    return least


def _leaves(name: str, balls: Array, start: int, walls: Walls) -> int:
    """The last point of a path that lies on the centreline of another one's wall."""
    while start < len(balls):
        stop = min(start + AT_ONCE, len(balls))
        points, reach = balls[start:stop, :3], float(balls[start:stop, 3].max())
        apart = np.full(len(points), np.inf)
        for trace in walls.near(points, 0.0):
            distance, radius = trace.roughly(points, reach)
            apart = np.minimum(apart, distance / radius)
        away = np.flatnonzero(apart > SHARED)
        if len(away) > 0:
            return max(start + int(away[0]) - 1, 0)
        start = stop
    raise refusal(f"'{name}' runs along another one to its end")


def _tube(balls: Array) -> Branch:
    return Branch(balls[:, :3], balls[:, 3])
