"""Group 3: twisted wires, where they buckle, and frames that keep count of their turns."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from magwire.evidence.verify.evidence import NODES, Curve, Line, Series
from magwire.evidence.verify.references import twisted
from magwire.evidence.verify.rig import STRETCH, Rig
from magwire.evidence.verify.wires import CLOSE, L, crossing, free, magnet, order

Array = NDArray[np.float64]

GROUP = "twist"
LOAD = 1e-2
EXACT = 1e-9  # rad, or part of an energy: what round-off leaves
TWISTING = 2.0 / 3.0  # GJ/EI
FINE_TWIST = 0.2
"""Largest twist of a hinge [rad]: bending is softer by the square of it over four (P-3)."""
RIGID = 7  # ways in which a ring moves at no cost: three, three, and about its own centreline
TURNS = 20

MICHELL = "Michell 1889; Zajac 1962"
COYNE = "Coyne 1990"


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; all of them if ``full``."""
    yield from _ring(full)
    yield from _clamped(full)
    yield from _localised(full)
    yield from _writhe(full)
    yield from _frames()
    yield from _guide()


def ring(nodes: int, turn: float, twisting: float) -> float:
    """Smallest stiffness of a closed ring against all that is not a rigid motion."""
    rig = Rig(nodes, ring=True, twisting=twisting)
    q = rig.state.q.copy()
    q[:, 3] = turn * np.arange(len(q)) / nodes
    rig.move(q)
    return rig.smallest(RIGID)


def ring_turn(nodes: int, twisting: float, expected: float) -> float:
    """Total twist at which the ring leaves its plane [rad]."""
    return crossing(lambda turn: ring(nodes, turn, twisting), expected)


def _ring(full: bool) -> Iterator[Line]:
    for twisting in (TWISTING, 1.0) if full else (TWISTING,):
        exact = twisted.ring_turn(twisting)
        sizes = (25, 50, NODES)
        found = [ring_turn(nodes, twisting, exact) for nodes in sizes]
        slope = order(1.0 / np.array(sizes), np.abs(np.array(found) - exact))
        case = f"closed ring, GJ/EI = {twisting:.3g}, {sizes[0]} to {sizes[-1]} nodes"
        yield Line(GROUP, case, "total twist at which it leaves its plane", "rad", exact, MICHELL,
                   found[-1], LOAD, relative=True, order=slope, expected_order=2.0)  # fmt: skip


def straight(nodes: int, moment: float, tension: float) -> float:
    """Smallest stiffness of a straight wire between clamps that is twisted and pulled."""
    rig = Rig(nodes, twisting=TWISTING)
    rig.hold("clamped", "clamped")
    rig.pull(tension)
    q = rig.state.q.copy()
    q[1:-1, 0] *= 1.0 + tension / STRETCH
    q[-1, 0] = q[-2, 0] + rig.edge
    hinges = np.concatenate([[0.5], np.ones(nodes - 2), [0.5]])
    q[1:-1, 3] = moment / TWISTING * rig.edge * np.cumsum(hinges)
    rig.move(q)
    return rig.smallest()


def clamped_moment(nodes: int, tension: float, expected: float) -> float:
    """Moment at which a straight wire between clamps buckles."""
    return crossing(lambda moment: straight(nodes, moment, tension), expected)


def _clamped(full: bool) -> Iterator[Line | Curve]:
    """The rotation of the end is M L/GJ up to there; with it, the mesh gets finer."""
    source = "characteristic equation"
    tensions = (-30.0, -20.0, 0.0, 20.0, 100.0, 400.0) if full else (0.0, 100.0)
    for tension in tensions:
        exact = twisted.clamped_moment(tension)
        finest = max(NODES, 1 + int(np.ceil(exact / TWISTING / FINE_TWIST)))
        sizes = np.array([(finest + 1) // 2, finest])
        found = np.array([clamped_moment(int(nodes), tension, exact) for nodes in sizes])
        slope = order(1.0 / (sizes - 1.0), np.abs(found - exact))
        case = f"end turned between clamps, tension {tension:g} EI/L^2, {finest} nodes"
        yield Line(GROUP, case, "critical moment", "EI/L", exact, source, found[-1], LOAD,
                   relative=True, order=slope, expected_order=2.0)  # fmt: skip
    fine = np.linspace(-39.0, 100.0, 80)
    line = np.array([twisted.clamped_moment(tension) for tension in fine])
    few = np.array([-35.0, -20.0, 0.0, 30.0, 60.0, 100.0])
    points = [clamped_moment(NODES, t, twisted.clamped_moment(t)) for t in few]
    yield Curve("A twisted wire between clamps buckles", "T L²/EI", "M L/EI",
                {"theory": (fine, line, "line"),
                 f"magwire, {NODES} nodes": (few, np.array(points), "points")})  # fmt: skip


def helix(nodes: int, moment: float, tension: float) -> Rig:
    """A long clamped wire with a localised helix, its end turned as Coyne has it for this moment.

    It starts from Coyne's shape and is brought to the equilibrium nearby. Turning the helix about
    the axis costs nothing: the middle may not move along z.
    """
    start = twisted.localised(moment, tension, nodes)
    turn = moment / TWISTING + start.turn
    rig = Rig(nodes, twisting=TWISTING)
    rig.hold("clamped", "clamped")
    rig.pull(tension)
    rig.fix((nodes // 2, 2))
    q = rig.state.q.copy()
    q[1:-1, :3] = start.place
    q[0, :3], q[-1, :3] = q[1, :3] - (rig.edge, 0, 0), q[-2, :3] + (rig.edge, 0, 0)
    rig.move(q)
    hinges = np.concatenate([[0.5], np.ones(nodes - 2), [0.5]])
    q[1:-1, 3] = np.cumsum(moment / TWISTING * rig.edge * hinges - rig.state.twist[1:-1])
    q[-2, 3] = turn
    rig.move(q)
    rig.settle()
    return rig


def _localised(full: bool) -> Iterator[Line | Curve]:
    tension, sizes = 900.0, (300, 600)
    for m in (1.4, 1.6, 1.7) if full else (1.7,):
        moment = m * np.sqrt(tension)
        exact = twisted.localised(moment, tension, sizes[-1])
        rigs = [helix(nodes, moment, tension) for nodes in sizes]
        found = np.array([_measures(rig, tension) for rig in rigs])
        case = (
            f"localised helix in a long wire, M^2/(4 EI T) = {0.25 * m**2:.3g}, {sizes[-1]} nodes"
        )
        expected = (exact.shortening, exact.tilt, exact.turn, moment)
        for k, (quantity, unit) in enumerate(
            (
                ("shortening", "L"),
                ("largest angle to the axis", "rad"),
                ("end rotation less twist", "rad"),
                ("moment at this end rotation", "EI/L"),
            )
        ):
            slope = order(1.0 / np.array(sizes), np.abs(found[:, k] - expected[k]))
            yield Line(GROUP, case, quantity, unit, expected[k], COYNE, float(found[-1, k]), LOAD,
                       relative=True, order=slope, expected_order=2.0)  # fmt: skip
        if m == 1.7:
            yield _drawn(rigs[-1], exact, f"Localised helix, M²/(4 EI T) = {0.25 * m**2:.3g}")


def _measures(rig: Rig, tension: float) -> tuple[float, float, float, float]:
    """Shortening, largest tilt, end rotation less twist, moment."""
    q = rig.state.q
    twist = _twist(rig)
    shortening = 1.0 - float(q[-2, 0] - q[1, 0]) / (1.0 + tension / STRETCH)
    tilt = _peak(np.arccos(rig.state.tangent[1:-1, 0]))
    moment = TWISTING * float(twist[1:-1].mean()) / rig.edge
    return shortening, tilt, float(q[-2, 3] - twist.sum()), moment


def _drawn(rig: Rig, exact: twisted.Localised, title: str) -> Curve:
    """Sideways places along the wire, counted from its middle."""
    middle, s = rig.nodes // 2, np.linspace(0.0, 1.0, rig.nodes)
    place = rig.state.q[1:-1, :3] - rig.state.q[1 + middle, :3]
    expected = exact.place - exact.place[middle]
    near = slice(rig.nodes // 3, 2 * rig.nodes // 3)
    few = slice(near.start, near.stop, 3)
    series: dict[str, Series] = {}
    for name, k in (("y", 1), ("z", 2)):
        series[name] = (s[near], expected[near, k], "line")
        series[f"magwire, {name}"] = (s[few], place[few, k], "points")
    return Curve(title, "s / L", "place, from the middle / L", series)


def _peak(values: Array) -> float:
    """Largest value of a smooth curve, by a parabola through the three largest."""
    k = int(np.argmax(values))
    before, here, after = values[k - 1 : k + 2]
    return float(here - 0.125 * (after - before) ** 2 / (after - 2.0 * here + before))


def _eight(t: Array, height: float) -> tuple[Array, Array]:
    """A figure of eight whose crossing is pulled apart, and its derivative."""
    curve = np.column_stack([np.cos(t), 0.5 * np.sin(2.0 * t), height * np.sin(t)])
    return curve, np.column_stack([-np.sin(t), np.cos(2.0 * t), height * np.cos(t)])


def _writhe(full: bool) -> Iterator[Line]:
    """A ring bent into a closed curve, its material frames turning with the reference frames.

    The link of the frames with the centreline stays what it was: twist + writhe = 0.
    """
    exact_at = np.linspace(0.0, 2.0 * np.pi, 500, endpoint=False)
    for height in (0.2, 0.5, 0.8) if full else (0.5,):
        exact = twisted.writhe(*_eight(exact_at, height))
        sizes = (26, 50, NODES)
        found = [bent_ring(nodes, height) for nodes in sizes]
        errors = np.abs(np.array(found) - exact)
        slope = order(1.0 / np.array(sizes), errors)
        case = f"ring bent to an eight that is {2 * height:g} high, {sizes[0]} to {sizes[-1]} nodes"
        yield Line(GROUP, case, "writhe, less the turns of twist", "turns", exact,
                   "Fuller 1971, Gauss's integral", found[-1], CLOSE,
                   order=slope, expected_order=2.0)  # fmt: skip


def bent_ring(nodes: int, height: float) -> float:
    """Writhe of the eight by the twist that the frames take up on the way there from a circle."""
    rig = Rig(nodes, ring=True)
    t = 2.0 * np.pi * np.arange(nodes + 2) / nodes
    circle = np.column_stack([np.cos(t), np.sin(t), 0.0 * t])
    bent = _eight(t, height)[0]
    for part in np.linspace(0.0, 1.0, 41):
        q = rig.state.q.copy()
        q[:, :3] = circle + part * (bent - circle)
        rig.move(q)
    return -float(rig.state.twist[1:-1].sum()) / (2.0 * np.pi)


def _frames() -> Iterator[Line]:
    angle, steps = 1.2, 90
    exact = TURNS * twisted.cone_area(angle, steps)
    yield Line(GROUP, f"half of a wire led around a cone, {TURNS} turns",
               "twist that the frames have counted", "rad", exact,
               "area of a spherical polygon", led_around(angle, steps),
               EXACT * exact)  # fmt: skip
    rig = helix(300, 51.0, 900.0)
    energy, twist = rig.energy(), _twist(rig)
    turn_as_a_whole(rig, np.array([0.36, -0.48, 0.8]), np.radians(20.0), 18 * TURNS + 7)
    case = f"localised helix, turned as a whole {TURNS} times and by 140 degrees"
    yield Line(GROUP, case, "energy, as part of what it was", "", 1.0, "frame indifference",
               rig.energy() / energy, EXACT)  # fmt: skip
    yield Line(GROUP, case, "largest change of a hinge's twist", "rad", 0.0, "frame indifference",
               float(np.abs(_twist(rig) - twist).max()), EXACT)  # fmt: skip


def _twist(rig: Rig) -> Array:
    """Of every hinge [rad]."""
    result: Array = np.diff(rig.state.q[:-1, 3]) + rig.state.twist[1:-1]
    return result


def led_around(angle: float, steps: int) -> float:
    """Twist [rad] after the front half of a wire went around a cone about the half behind."""
    rig = Rig(6)
    base = rig.state.q.copy()
    for k in range(TURNS * steps + 1):
        around = 2.0 * np.pi * k / steps
        along = [np.cos(angle), np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around)]
        q = base.copy()
        q[4:, :3] = q[3, :3] + (q[4:, :1] - q[3, 0]) * along
        rig.move(q)
        if k == 0:
            start = float(rig.state.twist.sum())
    return float(rig.state.twist.sum()) - start


def turn_as_a_whole(rig: Rig, axis: Array, angle: float, steps: int) -> None:
    """Turn a wire, its material frames and its loads about an axis, step by step.

    The reference frames do not turn along: they are carried without spin. The angles make up for
    it.
    """
    step = Rotation.from_rotvec(axis * angle)
    for _ in range(steps):
        wanted = step.apply(rig.state.director)
        q = rig.state.q.copy()
        q[:, :3] = step.apply(q[:, :3])
        rig.move(q)
        carried, tangent = rig.state.director, rig.state.tangent
        sine = np.sum(np.cross(carried, wanted) * tangent, axis=1)
        rig.state.q[:-1, 3] += np.arctan2(sine, np.sum(carried * wanted, axis=1))
        rig.rod.weight[:] = step.apply(rig.rod.weight)


def _guide() -> Iterator[Line]:
    """A curved wire in open space is carried round by its guide."""
    sim = free(magnet(40, 0.0, rest_curvature=(15.0, 0.0)))
    state = sim.equilibrium(L)
    begin = np.arctan2(state.tip[2], state.tip[1])
    counted = [0.0]
    turns = np.linspace(0.0, 2.0 * np.pi * 10.3, 63)
    for turn in turns[1:]:
        state = sim.equilibrium(L, start=state, twist=float(turn))
        counted.append(float(np.arctan2(state.tip[2], state.tip[1]) - begin))
    found = np.unwrap(counted)[-1]
    yield Line(GROUP, "curved wire whose guide is turned 10.3 times", "turn of the tip", "rad",
               float(turns[-1]), "a rigid rotation", float(found), 1e-6)  # fmt: skip
