"""Group 1: wires bent by forces, by their weight and by their make, without a field."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import NODES, Curve, Line, Series
from magwire.evidence.verify.references import columns, pendulum, planar
from magwire.evidence.verify.rig import STRETCH, End, Rig
from magwire.evidence.verify.wires import (
    CLOSE,
    STUFF,
    L,
    compare,
    critical,
    crossing,
    free,
    magnet,
    order,
    pulled,
)
from magwire.wire import Section, Wire

GROUP = "elastica"
THIN = 0.1e-3  # m: L = 1000 r, so that stretching is out of sight
FINE = 200
"""Nodes where a column turns by more than half a circle from end to end."""
MESHES = (26, 51, 101, 201)
POINTS = 2 * NODES - 1
"""Of a reference: the nodes and the middles between them."""
LOAD = 1e-2

BISSHOPP = "Bisshopp & Drucker 1945"
EULER = "Timoshenko & Gere 1961"
BVP = "planar elastica, solve_bvp"


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; all of them if ``full``."""
    yield from _tip_force(full)
    yield from _euler(full)
    yield from _postbuckled(full)
    yield from _pinned_postbuckled(full)
    yield from _rest_curvature(full)
    yield from _sections(full)
    yield from _weight(full)


def wire(nodes: int = NODES) -> Wire:
    """Thin and not magnetic."""
    return magnet(nodes, 0.0, radius=THIN)


def _aside(size: float, degrees: float) -> tuple[float, float]:
    angle = np.radians(degrees)
    return size * float(np.cos(angle)), size * float(np.sin(angle))


def _tip_force(full: bool) -> Iterator[Line | Curve]:
    loads = (0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 20.0) if full else (1.0, 5.0, 10.0)
    for degrees in (45.0, 90.0, 135.0) if full else (90.0,):
        for load in loads:
            case = f"tip force {load:g} EI/L^2 at {degrees:g} degrees"
            exact = pendulum.under_force(load, np.radians(degrees))
            yield from compare(GROUP, case, pulled(wire(), _aside(load, degrees)), exact, BISSHOPP)
    exact = pendulum.under_force(5.0, np.pi / 2.0)
    tips = [pulled(magnet(n, 0.0, radius=0.5 * THIN), (0.0, 5.0)).tip[:2] / L for n in MESHES]
    errors = [float(np.hypot(x - exact.x, y - exact.y)) for x, y in tips]
    case = f"tip force 5 EI/L^2, {MESHES[0]} to {MESHES[-1]} nodes"
    slope = order([1.0 / (n - 1) for n in MESHES], errors)
    yield Line(GROUP, case, "tip's distance from its place, finest mesh", "L", 0.0, BISSHOPP,
               errors[-1], CLOSE, order=slope, expected_order=2.0)  # fmt: skip
    fine = np.linspace(0.05, 10.0, 60)
    line = np.array([pendulum.under_force(p, np.pi / 2.0) for p in fine]).T
    points = np.array([0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0])
    found = np.array([pulled(wire(), (0.0, p)).tip[:2] / L for p in points]).T
    yield Curve(
        "Cantilever under a tip force",
        "P L²/EI",
        "tip's place / L",
        {
            "along the clamp": (fine, line[1], "line"),
            "across": (fine, line[2], "line"),
            "magwire, along": (points, found[0], "points"),
            "magwire, across": (points, found[1], "points"),
        },
    )


def column(nodes: int, near: End, far: End, load: float) -> float:
    """Smallest stiffness of a straight column that is pushed at its far end."""
    rig = Rig(nodes)
    rig.hold(near, far)
    rig.pull(-load)
    q = rig.state.q.copy()
    q[1:-1, 0] *= 1.0 - load / STRETCH
    q[-1, 0] = q[-2, 0] + rig.edge
    rig.move(q)
    return rig.smallest()


def column_load(nodes: int, ends: tuple[End, End], expected: float) -> float:
    """Load at which a straight column buckles."""
    return crossing(lambda load: column(nodes, *ends, load), expected)


def _euler(full: bool) -> Iterator[Line]:
    found = critical(lambda p: pulled(wire(), (-p, 0.0)).stable, columns.euler("clamped-free"))
    yield _load("column, clamped-free", columns.euler("clamped-free"), found, EULER)
    pairs: tuple[tuple[End, End], ...] = (
        ("pinned", "pinned"),
        ("clamped", "pinned"),
        ("clamped", "clamped"),
    )
    for ends in pairs if full else pairs[:1]:
        exact = columns.euler("-".join(ends))
        sizes = (26, 51, NODES) if full else (26, 51)
        loads = [column_load(nodes, ends, exact) for nodes in sizes]
        slope = order([1.0 / (n - 1) for n in sizes], np.abs(np.array(loads) - exact))
        case = f"column, {'-'.join(ends)}, {sizes[0]} to {sizes[-1]} nodes"
        yield _load(case, exact, loads[-1], EULER, slope)
    exact = columns.own_weight()
    body = wire().body
    unit = wire().bending_stiffness / (body.density * body.area * L**3)

    def stands(q: float) -> bool:
        return free(wire(), gravity=(-q * unit, 0.0, 0.0)).equilibrium(L).stable

    source = "Greenhill 1881"
    yield _load("column under its own weight, q L^3/EI", exact, critical(stands, exact), source)


def _load(case: str, exact: float, found: float, source: str, slope: float | None = None) -> Line:
    return Line(GROUP, case, "critical load", "EI/L^2", exact, source, found, LOAD, relative=True,
                order=slope, expected_order=None if slope is None else 2.0)  # fmt: skip


def buckled(load: float, wire: Wire) -> Equilibrium:
    """A wire pushed at its tip beyond the critical load; from one pushed slightly aside."""
    start = pulled(wire, _aside(load, 178.0))
    return pulled(wire, (-load, 0.0), start=start)


def _postbuckled(full: bool) -> Iterator[Line | Curve]:
    first = columns.euler("clamped-free")
    parts = (1.02, 1.05, 1.1, 1.2, 1.5, 2.0, 3.0, 5.0) if full else (1.05, 1.5, 3.0)
    angles = []
    for part in parts:
        exact = pendulum.under_force(part * first, np.pi)
        state = buckled(part * first, wire())
        angles.append(np.degrees(np.arctan2(*state.tip_direction[1::-1])))
        case = f"column, clamped-free, {part:g} times the critical load"
        yield from compare(GROUP, case, state, exact, "Euler 1744, elliptic integrals")
    fine = np.linspace(1.0005, parts[-1], 100)
    branch = np.degrees([pendulum.under_force(part * first, np.pi).angle for part in fine])
    yield Curve(
        "Clamped-free column beyond its critical load",
        "P / critical load",
        "tip angle [degrees]",
        {
            "theory": (fine, branch, "line"),
            "magwire": (np.array(parts), np.array(angles), "points"),
        },
    )


def _pinned_postbuckled(full: bool) -> Iterator[Line]:
    """Its half, from the middle on, is a clamped-free column of half the length."""
    for part in (1.1, 1.5, 2.0) if full else (1.5,):
        load = part * columns.euler("pinned-pinned")
        exact = pendulum.under_force(0.25 * load, np.pi)
        nodes = NODES if exact.angle < 0.5 * np.pi else FINE
        rig = Rig(nodes)
        rig.hold("pinned", "pinned")
        rig.fix((slice(None), 2), (slice(None), 3))
        rig.pull(-load)
        s = np.linspace(0.0, 1.0, nodes)
        q = rig.state.q.copy()
        q[1:-1, 0], q[1:-1, 1] = s * exact.x, 0.5 * exact.y * np.sin(np.pi * s)
        q[-1, 0] = q[-2, 0] + rig.edge
        rig.move(q)
        rig.settle()
        case = f"column, pinned-pinned, {part:g} times the critical load, {nodes} nodes"
        ends = rig.state.q[1:-1, :2]
        edge = ends[1] - ends[0]
        middle = 0.5 * float(ends[nodes // 2, 1] + ends[nodes // 2 - 1, 1])
        source = "Euler 1744, elliptic integrals"
        for quantity, unit, reference, value in (
            ("distance of the ends", "L", exact.x, float(ends[-1, 0])),
            ("deflection of the middle", "L", 0.5 * exact.y, middle),
            ("angle of the end", "rad", exact.angle, float(np.arctan2(edge[1], edge[0]))),
        ):
            yield Line(GROUP, case, quantity, unit, reference, source, value, CLOSE)


def _shape(
    case: str, state: Equilibrium, exact: planar.Shape, source: str, roll: float = 0.0
) -> Iterator[Line]:
    """Angle of the tip, and all nodes; ``exact`` is at the nodes and the middles between.

    ``roll`` is the angle by which the wire's plane is turned about x.
    """
    along, y, z = state.tip_direction
    across = y * np.cos(roll) + z * np.sin(roll)
    x, y, z = state.positions.T / L
    away = np.linalg.norm(
        [x - exact.x[::2], y - np.cos(roll) * exact.y[::2], z - np.sin(roll) * exact.y[::2]], axis=0
    )
    angle = float(np.unwrap([exact.angle[-1], np.arctan2(across, along)])[1])
    yield Line(GROUP, case, "tip angle", "rad", float(exact.angle[-1]), source, angle, CLOSE)
    yield Line(GROUP, case, "largest distance of a node from its place", "L", 0.0, source,
               float(away.max()), CLOSE)  # fmt: skip


def _rest_curvature(full: bool) -> Iterator[Line]:
    """m1, towards which the wire is curved, is a director of the guide: here z."""
    for turn in (0.5, 1.5, 3.0, 6.0) if full else (0.5, 3.0):
        curved = magnet(NODES, 0.0, radius=THIN, rest_curvature=(turn / L, 0.0))
        case = f"rest curvature {turn:g}/L, no load"
        exact = planar.arc(turn, POINTS)
        state = free(curved).equilibrium(L)
        yield from _shape(case, state, exact, "arc of a circle", 0.5 * np.pi)
    for turn, load in ((1.5, -2.0), (1.5, 3.0), (3.0, -1.0)) if full else ((1.5, -2.0),):
        curved = magnet(NODES, 0.0, radius=THIN, rest_curvature=(turn / L, 0.0))
        exact = planar.elastica(rest_curvature=turn, force=(0.0, load), points=POINTS)
        case = f"rest curvature {turn:g}/L, tip force {load:g} EI/L^2 across the clamp"
        yield from _shape(case, pulled(curved, (0.0, 0.0, load)), exact, BVP, 0.5 * np.pi)


def tapered(ratio: float, nodes: int) -> Wire:
    """A wire whose radius falls linearly to a part of it."""
    return Wire((Section(L, radius=THIN, end_radius=ratio * THIN, **STUFF),), nodes)


def stepped(at: float, soft: float, nodes: int) -> Wire:
    """A wire whose bending stiffness falls to a part of it."""
    radius = THIN * soft**0.25
    front = Section(at * L, radius=THIN, **STUFF)
    return Wire((front, Section((1.0 - at) * L, radius=radius, **STUFF)), nodes)


def _taper(ratio: float) -> planar.Along:
    return lambda s: (1.0 - (1.0 - ratio) * s) ** 4


def _step(at: float, soft: float) -> planar.Along:
    return lambda s: np.where(s < at, 1.0, soft)


def _sections(full: bool) -> Iterator[Line]:
    root = 0.25 * np.pi * STUFF["youngs_modulus"] * THIN**4  # EI at the clamp

    def bent(robot: Wire, load: float) -> Equilibrium:
        return pulled(robot, (0.0, load * root / robot.bending_stiffness))

    for ratio in (0.3, 0.5, 0.8) if full else (0.5,):
        load = 3.0 * ratio
        exact = planar.elastica(stiffness=_taper(ratio), force=(0.0, load), points=POINTS)
        case = f"radius falling to {ratio:g}, tip force {load:g} EI/L^2 with EI at the clamp"
        yield from _shape(case, bent(tapered(ratio, NODES), load), exact, BVP)
    for at, soft in ((0.5, 0.1), (0.37, 0.3), (0.8, 0.02)) if full else ((0.37, 0.1),):
        exact = planar.elastica(
            stiffness=_step(at, soft), force=(0.0, 1.0), joints=(at,), points=POINTS
        )
        case = f"EI falling to {soft:g} at {at:g} L, tip force 1 EI/L^2 with EI at the clamp"
        yield from _shape(case, bent(stepped(at, soft, NODES), 1.0), exact, BVP)


def _weight(full: bool) -> Iterator[Line | Curve]:
    robot = wire()
    unit = robot.bending_stiffness / (robot.body.density * robot.body.area * L**3)
    cases = ((1.0, 90.0), (5.0, 90.0), (20.0, 90.0), (20.0, 45.0), (20.0, 150.0))
    series: dict[str, Series] = {}
    for q, degrees in cases if full else cases[1:3]:
        pull = -np.array(_aside(q, degrees))
        state = free(robot, gravity=(*(pull * unit), 0.0)).equilibrium(L)
        exact = planar.elastica(weight=pull, points=POINTS)
        case = f"weight {q:g} EI/L^3, {degrees:g} degrees between the clamp and upwards"
        yield from _shape(case, state, exact, BVP)
        if degrees == 90.0:
            series[f"q = {q:g}"] = (exact.x, exact.y, "line")
            x, y, _ = state.positions[::6].T / L
            series[f"magwire, q = {q:g}"] = (x, y, "points")
    yield Curve("Horizontal wire under its weight", "x / L", "y / L", series, equal=True)
