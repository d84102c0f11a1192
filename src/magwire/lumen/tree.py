"""Trees: named tubes joined into the branches and the paths of one lumen (P-10)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import ceil, degrees, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError
from magwire.lumen.branch import Branch
from magwire.lumen.curve import Curve
from magwire.lumen.lazy import Lazy
from magwire.lumen.ridges import without_ridges

if TYPE_CHECKING:
    from scipy.spatial import KDTree

Array = NDArray[np.float64]

BLEND = 0.2  # default width of the blend, over the smallest radius at the junction
JUNCTION = 2.0  # length of a branch that belongs to its junction, over its radius there
SHARED = 0.01  # distance at which two centrelines stop being one, over the radius
WIDER = 1.05  # largest radius of a branch where it leaves, over its parent's
RUN_IN = 1.0  # length over which a branch takes on its radius, at least, over the radius
STEEPNESS = 5.0  # that length over what the radius gains, at least
STEEP = 0.92  # change of a radius over the arc that is too fast
GENTLE = 0.8  # that to which it is brought
ROUNDING = 1.6  # bend radius of a path around the corner of a junction, over the parent's radius
MOUTH = 1.5  # how far from the entrance a branch leaves that has a wall of its own from there on
OFF_AXIS = 0.5  # farthest from its parent's centreline that a branch starts, over the radius
BESIDE = 1.0  # how far an outlet is off the centreline of another tube, at least, over its radius
DENSITY = 8.0  # samples per radius of arc length
AT_ONCE = 64  # samples that are followed along another centreline at first
AROUND = 8.0  # how far around a corner a path is made to see whether it can be, over the radii
SPARSE = 4  # of these samples, how many there are for one that is checked


class Tree(NamedTuple):
    """The wall's branches and the centrelines from the entrance to each outlet, by its name."""

    branches: tuple[Branch, ...]
    paths: Mapping[str, Branch]


@dataclass(frozen=True, eq=False)
class Trace:
    """A named centreline that points are projected on."""

    name: str
    curve: Curve

    @cached_property
    def arcs(self) -> Array:
        """Arc parameters of the samples, shape (n,) [m]."""
        return sampled(self.curve)

    @cached_property
    def _samples(self) -> KDTree:
        from scipy.spatial import KDTree

        return KDTree(self.balls[:, :3])

    @cached_property
    def balls(self) -> Array:
        """Centre and radius at the samples, shape (n, 4) [m]."""
        return self.curve.at(self.arcs)

    def roughly(self, points: Array, within: float) -> tuple[Array, Array]:
        """Distance of points from the nearest piece between samples, and its radius, shapes (n,).

        Infinite, with some radius, where that is more than ``within`` [m].
        """
        distance, nearest = self._samples.query(points, distance_upper_bound=within)
        here = np.minimum(nearest, len(self.balls) - 1)
        for beside in (-1, 1):
            other = np.clip(here + beside, 0, len(self.balls) - 1)
            a, along = self.balls[here, :3], self.balls[other, :3] - self.balls[here, :3]
            t = np.sum((points - a) * along, axis=1)
            t = np.clip(t / np.maximum(np.sum(along * along, axis=1), 1e-300), 0.0, 1.0)
            off = np.linalg.norm(points - a - t[:, None] * along, axis=1)
            distance = np.where(np.isfinite(distance), np.minimum(distance, off), distance)
        return distance, self.balls[here, 3]

    def nearest(self, points: Array) -> tuple[Array, Array, Array]:
        """Distance, arc parameter and radius at the nearest point, shapes (n,) [m]."""
        s = self.arcs[self._samples.query(points)[1]]
        for _ in range(4):  # Newton's method on (c - x).c' = 0
            ball, first, second = (each[:, :3] for each in self.curve.jet(s))
            away = ball - points
            slope = np.sum(first * first, axis=1) + np.sum(away * second, axis=1)
            step = np.sum(away * first, axis=1) / np.maximum(slope, 0.1)
            s = np.minimum(np.maximum(s - step, 0.0), self.curve.length)
        ball = self.curve.at(s)
        return np.linalg.norm(ball[:, :3] - points, axis=1), s, ball[:, 3]


def sampled(curve: Curve) -> Array:
    """Arc parameters of evenly spaced points along a curve, several per radius."""
    radius = float(curve.at(curve.knots())[:, 3].min())
    count = max(ceil(DENSITY * curve.length / radius), len(curve.coefficients))
    return np.linspace(0.0, curve.length, count + 1)


def join(lines: Mapping[str, Branch], width: float | None) -> Tree:
    """The tree of tubes that each start at the entrance or in a tube before them.

    Parameters
    ----------
    lines
        Tubes by the names of their outlets. The first one starts at the entrance; the wall of each
        further one counts from where it leaves those before it.
    width
        Width over which branches blend [m]; if None, by the radius at each junction.
    """
    names = list(lines)
    tubes = _Tubes({name: Trace(name, line.curve) for name, line in lines.items()}, lines, {})
    walls = Walls()
    walls.add(names[0], lines[names[0]])
    tubes.paths[names[0]] = lines[names[0]]
    for name in names[1:]:
        walls.add(name, _attach(name, tubes, walls, width))
    check_courses(walls)
    return Tree(tuple(walls.branches), Lazy({name: partial(tubes.path, name) for name in names}))


class Walls:
    """The walls of a tree so far, to be searched by place."""

    def __init__(self) -> None:
        self.branches: list[Branch] = []
        self.traces: list[Trace] = []
        self._boxes = np.zeros((16, 2, 3))

    def add(self, name: str, wall: Branch) -> None:
        """One more wall."""
        reach = float(wall.radius.max())
        count = len(self.branches)
        if count == len(self._boxes):
            self._boxes = np.concatenate([self._boxes, np.zeros_like(self._boxes)])
        self._boxes[count, 0] = wall.points.min(axis=0) - reach
        self._boxes[count, 1] = wall.points.max(axis=0) + reach
        self.branches.append(wall)
        self.traces.append(Trace(name, wall.curve))

    def near(self, points: Array, reach: float) -> list[Trace]:
        """Those that may be within ``reach`` [m] of points, shape (n, 3)."""
        low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
        boxes = self._boxes[: len(self.branches)]
        touching = np.flatnonzero(((boxes[:, 0] <= high) & (boxes[:, 1] >= low)).all(axis=1))
        return [self.traces[i] for i in touching.tolist()]


@dataclass(frozen=True, eq=False)
class _Tubes:
    """The tubes of a tree as they are given, and the paths to their ends as far as they are made.

    A path is as long as all that it goes through: of many tubes none is made before it is needed.

    Attributes
    ----------
    axes, lines
        Centrelines, and the tubes, by name.
    paths
        Paths by name. It has those of the tubes that start at the entrance from the start.
    leaving
        What each of the others leaves.
    """

    axes: Mapping[str, Trace]
    lines: Mapping[str, Branch]
    paths: dict[str, Branch]
    leaving: dict[str, str] = field(default_factory=dict)

    def path(self, name: str) -> Branch:
        """The path from the entrance to the end of a tube."""
        wanted = [name]
        while wanted[-1] not in self.paths:
            wanted.append(self.leaving[wanted[-1]])
        for made in wanted[-2::-1]:
            parent = self.leaving[made]
            way = Trace(parent, self.paths[parent].curve)
            self.paths[made] = _path(made, self.lines[made], way, None)
        return self.paths[name]


def _attach(name: str, tubes: _Tubes, walls: Walls, width: float | None) -> Branch:
    """The wall of one more branch."""
    line = tubes.lines[name]
    first = walls.branches[0]
    near = SHARED * float(first.radius[0])
    arcs = sampled(line.curve)
    if np.linalg.norm(line.entrance - first.entrance) <= near:
        tubes.paths[name] = line
        start = _leaves(name, line, tubes.axes, walls)
        if start < MOUTH * float(line.radius[0]):  # its cap would stand in the entrance
            return replace(line, blend=BLEND * float(line.radius[0]) if width is None else width)
        arcs = np.append(start, arcs[arcs > start + 0.5 * arcs[1]])
    else:
        way, arc = _parent(name, line.entrance, tubes.axes, walls)
        tubes.leaving[name] = way.name
        around = AROUND * float(line.radius[0] + way.curve.at(np.array([arc]))[0, 3])
        if way.name not in tubes.paths and arc < around:  # the corner may be that of its parent
            way = Trace(way.name, tubes.path(way.name).curve)
        _path(name, line, way, around)
    tangents = line.curve.at(arcs[[0, -1]], 1)[:, :3]
    own = Line(arcs - arcs[0], line.curve.at(arcs), tangents, line.open_end)
    return grown(name, own, walls, width)


class Line(NamedTuple):
    """A tube from where it leaves others.

    Attributes
    ----------
    arcs, balls
        Arc parameter [m] from there, shape (n,), and centre and radius [m], shape (n, 4).
    tangents
        At its begin and end, shape (2, 3).
    open_end
        Whether its end is open.
    """

    arcs: Array
    balls: Array
    tangents: Array
    open_end: bool


def grown(
    name: str, line: Line, walls: Walls, width: float | None, *, widens: bool = False
) -> Branch:
    """The wall of a tube that leaves other walls.

    Parameters
    ----------
    name, line
        Name of the tube, and its centreline.
    walls
        Those before it.
    width
        Width over which it blends into them [m]; if None, by its radius where it leaves.
    widens
        Whether it may be wider than what it leaves, which may be narrow in a sharp bend only.
    """
    arcs, balls = line.arcs, line.balls
    others = walls.near(balls[:1, :3], 0.0) or walls.traces
    if width is None:
        width = BLEND * float(balls[arcs <= JUNCTION * balls[0, 3], 3].min())
    if not widens:
        _check_width(name, float(balls[0, 3]), deepest(balls[0], others)[1])
    radius = _run_in(name, arcs, balls, others, width)
    if widens:
        radius = tapered(radius, arcs)
    begin, end = line.tangents
    branch = Branch(
        balls[:, :3],
        radius,
        begin_tangent=begin,
        end_tangent=end,
        open_begin=False,
        open_end=line.open_end,
        blend=width,
    )
    hidden = arcs[radius < balls[:, 3]]
    return without_ridges(branch, float(hidden[-1]) if len(hidden) > 0 else 0.0)


def _leaves(name: str, line: Branch, axes: Mapping[str, Trace], walls: Walls) -> float:
    """Arc parameter where a tube leaves the ones before it, on which it starts [m].

    It is followed along one of them until it leaves that one, and from there along the next.
    """
    arcs = sampled(line.curve)
    points = line.curve.at(arcs)[:, :3]
    along, here, count = walls.traces[0].name, 0, AT_ONCE
    while here < len(arcs):
        piece = points[here : here + count]
        distance, _, radius = axes[along].nearest(piece)
        away = np.flatnonzero(distance > SHARED * radius)
        if len(away) == 0:
            here, count = here + len(piece), 2 * count
            continue
        here, count = here + int(away[0]), AT_ONCE
        for other in walls.near(points[here : here + 1], 0.0):
            distance, _, radius = axes[other.name].nearest(points[here : here + 1])
            if distance[0] <= SHARED * radius[0]:
                along = other.name
                break
        else:
            return float(arcs[max(here - 1, 0)])
    raise refusal(f"'{name}' runs along '{along}' to its end")


def _path(name: str, line: Branch, way: Trace, around: float | None) -> Branch:
    """Centreline from the entrance into a tube that starts in one before it.

    Around the corner of the junction it leaves both lines, to turn as gently as the parent is
    wide; past the parent's wall it is on the tube's axis again.

    Parameters
    ----------
    name, line, way
        The tube, and the path on which it starts.
    around
        How much of both is wanted past the corner [m]; if None, all.
    """
    parent = way.curve
    off, arc, _ = (float(values[0]) for values in way.nearest(line.entrance[None]))
    centre, ahead = parent.at(np.array([arc]))[0], parent.at(np.array([arc]), 1)[0, :3]
    _check_width(name, float(line.radius[0]), float(centre[3]))
    turn = float(np.arccos(np.clip(ahead @ line.direction / np.linalg.norm(ahead), -1.0, 1.0)))
    wanted = max(ROUNDING * centre[3] * tan(0.5 * min(turn, 2.0)), 2.0 * off)
    cut = min(wanted, centre[3] + line.radius[0], 0.5 * line.length)
    cut = max(cut, 0.5 * sampled(line.curve)[1])
    if cut >= arc:
        raise refusal(f"'{name}' leaves '{way.name}' too close to the entrance")
    before, after = way.arcs, sampled(line.curve)
    before = np.append(before[before < arc - 1.1 * cut], arc - cut)
    after = np.append(cut, after[after > 1.1 * cut])
    if around is not None:
        before, after = before[before > arc - cut - around], after[after < cut + around]
    balls = _turn(parent.at(before), line.curve.at(after), (parent, arc - cut), (line.curve, cut))
    tangents = parent.at(before[:1], 1)[0, :3], line.curve.at(after[-1:], 1)[0, :3]
    try:
        return Branch(balls[:, :3], balls[:, 3], begin_tangent=tangents[0], end_tangent=tangents[1])
    except InputError:
        raise refusal(
            f"'{name}' turns by {degrees(turn):.0f} degrees from '{way.name}', which is too sharp"
        ) from None


def _parent(
    name: str, start: Array, axes: Mapping[str, Trace], walls: Walls
) -> tuple[Trace, float]:
    """The tube on whose centreline another one starts, and the arc parameter there [m].

    Of several whose centrelines are one there it is the first.
    """
    near = [axes[trace.name] for trace in walls.near(start[None], 0.0)]
    for ways in (near, [axes[trace.name] for trace in walls.traces]):
        found = [tuple(float(v[0]) for v in way.nearest(start[None])) for way in ways]
        least = min((distance for distance, _, _ in found), default=np.inf)
        for way, (distance, arc, radius) in zip(ways, found, strict=True):
            if distance <= min(least + SHARED * radius, OFF_AXIS * radius):
                return way, arc
    closest = int(np.argmin([distance for distance, _, _ in found]))
    distance, _, radius = found[closest]
    x, y, z = start
    raise InputError(
        "Input branches of Lumen.tree must start at the entrance or within half a radius of "
        f"the centreline of one before them; received '{name}', which starts at "
        f"({x:.6g}, {y:.6g}, {z:.6g}) m, {distance:.6g} m from the centreline of "
        f"'{ways[closest].name}' with radius {radius:.6g} m."
    )


def _turn(
    before: Array, after: Array, begin: tuple[Curve, float], end: tuple[Curve, float]
) -> Array:
    """Balls of two lines and of a turn from one into the other, shape (n, 4).

    The turn is a polynomial of degree five with the points, tangents and curvatures of both at its
    ends. In the turn the radius is that of the second line.
    """
    from scipy.interpolate import BPoly  # slow to import, and not every lumen has a junction

    ends = [c.at(np.array([s]), k)[0, :3] for c, s in (begin, end) for k in range(3)]
    chord = float(np.linalg.norm(ends[3] - ends[0]))
    ends = [values * chord ** (i % 3) for i, values in enumerate(ends)]
    course = BPoly.from_derivatives([0.0, 1.0], [ends[:3], ends[3:]])
    count = max(ceil(DENSITY * chord / after[0, 3]), 4)
    turn = course(np.linspace(0.0, 1.0, count + 1))[1:-1]
    points = np.concatenate([before[:, :3], turn, after[:1, :3]])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    left = np.cumsum(steps[::-1])[::-1]
    wide = np.append(before[:, 3], np.full(len(turn), before[-1, 3]))
    whole = left[len(before) - 1]
    share = _ramp(1.0 - (left - whole) / max(whole, 2.5 * (before[-1, 3] - after[0, 3])))
    balls = np.column_stack([points[:-1], wide + share * (after[0, 3] - wide)])
    return np.concatenate([balls, after])


def _run_in(name: str, arcs: Array, balls: Array, others: list[Trace], width: float) -> Array:
    """Radius of a branch: at its start so small that the blend does not see it.

    The first ball lies ``width`` inside of a branch before it, and its cap with it. From there the
    radius grows to its own.
    """
    wide = float(balls[0, 3])
    lost = missing(wide, deepest(balls[0], others)[0], width)
    if lost > 0.75 * wide:
        raise InputError(
            "Input blend of Lumen.tree must be smaller than the branches are wide; received "
            f"{width:.6g} m where '{name}' has a radius of {wide:.6g} m."
        )
    return np.asarray(balls[:, 3] - run_in(lost, wide, arcs))


def missing(wide: float, gap: float, width: float) -> float:
    """What a ball that is so deep in other tubes has to lose for a blend not to see it [m]."""
    return max(wide - (gap - 1.001 * width), 0.0)


def run_in(lost: float, wide: float, arcs: Array) -> Array:
    """What the radius has lost at arc parameters from an end of a tube, shape (n,) [m]."""
    return np.asarray(lost * (1.0 - _ramp(arcs / max(RUN_IN * wide, STEEPNESS * lost))))


def tapered(radius: Array, arcs: Array) -> Array:
    """Radii at arc parameters, shape (n,) [m], lowered where they change too fast for balls."""
    if np.all(np.abs(np.diff(radius)) <= STEEP * np.diff(arcs)):
        return radius
    up = np.minimum.accumulate(radius - GENTLE * arcs) + GENTLE * arcs
    down = np.minimum.accumulate((radius + GENTLE * arcs)[::-1])[::-1] - GENTLE * arcs
    return np.asarray(np.minimum(up, down))


def deepest(ball: Array, others: Sequence[Trace]) -> tuple[float, float]:
    """How deep the centre of a ball, shape (4,), is in other tubes, and the radius there [m]."""
    found = [other.nearest(ball[None, :3]) for other in others]
    gaps = [float(radius[0] - distance[0]) for distance, _, radius in found]
    deepest = int(np.argmax(gaps))
    return gaps[deepest], float(found[deepest][2][0])


def _check_width(name: str, wide: float, parent: float) -> None:
    """Refuse a branch that is wider than what it leaves."""
    if wide > WIDER * parent:
        raise refusal(f"'{name}' is wider ({wide:.6g} m) than what it leaves ({parent:.6g} m)")


def _ramp(t: Array) -> Array:
    """From 0 at t = 0 to 1 at t = 1, with continuous second derivative."""
    t = np.clip(t, 0.0, 1.0)
    return np.asarray(t**3 * (10.0 + t * (6.0 * t - 15.0)))


def check_courses(walls: Walls, *, beside: bool = False) -> None:
    """Refuse branches that come back to others, and outlets inside of others.

    Parameters
    ----------
    walls
        The walls.
    beside
        Whether outlets that are about as far along may overlap, as those of a fork cut short do.
    """
    order = {id(trace): i for i, trace in enumerate(walls.traces)}
    for i, trace in enumerate(walls.traces):
        balls = trace.balls[::SPARSE]
        wide = float(balls[:, 3].max())
        free = np.full(len(balls), np.inf)
        for other in walls.near(balls[:, :3], wide):
            if order[id(other)] < i:
                reach = wide + float(other.balls[:, 3].max())
                distance, radius = other.roughly(balls[:, :3], reach)
                free = np.minimum(free, distance - radius - balls[:, 3])
        clear = np.flatnonzero(free > 0.0)
        if len(clear) > 0:
            back = clear[0] + np.flatnonzero(free[clear[0] :] < -balls[clear[0] :, 3])
            if len(back) > 0:
                x, y, z = balls[back[0], :3]
                raise refusal(
                    f"'{trace.name}' comes back to another branch near "
                    f"({x:.6g}, {y:.6g}, {z:.6g}) m"
                )
        end = trace.balls[-1:, :3]
        for other in walls.near(end, 0.0):
            if other is trace:
                continue
            distance, arc, radius = other.nearest(end)
            close = other.curve.length - arc[0] < MOUTH * radius[0]
            if distance[0] < BESIDE * radius[0] and not (beside and close):
                raise refusal(
                    f"the outlet '{trace.name}' lies inside of '{other.name}', {distance[0]:.6g} m "
                    f"from its centreline, with radius {radius[0]:.6g} m there"
                )


def refusal(what: str) -> InputError:
    """Fault of the branches' course."""
    return InputError(
        "Input branches of Lumen.tree must leave those before them, no wider than them, and end "
        f"clear of all others; {what}."
    )
