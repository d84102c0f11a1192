"""Group 2: wires in magnetic fields that are uniform, and that are not."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import NODES, Curve, Line, Series
from magwire.evidence.verify.references import kirchhoff, pendulum
from magwire.evidence.verify.references.dipole import Dipole
from magwire.evidence.verify.wires import (
    CLOSE,
    STUFF,
    L,
    compare,
    critical,
    flux,
    free,
    guide_load,
    magnet,
    order,
)
from magwire.field import FieldSource, GradientField, UniformField
from magwire.kernels.hinge import material_frame
from magwire.wire import Section, Wire

Array = NDArray[np.float64]

GROUP = "magnetic"
LOAD = 1e-2
LOADS = 1e-3  # forces and torques of a field, as part of the whole force or torque
STEEP = 150
"""Nodes where a field that is nearly against the wire bends it within L/10 of the clamp, or turns
a magnet of L/50, which would have two edges, by more than 90 degrees."""
MESHES = (26, 51, 101, 201)

ELASTICA = "Wang et al. 2020, elliptic integrals"
KIRCHHOFF = "Kirchhoff rod, solve_bvp"
CHARGES = "charges -M, +M at the ends"


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; all of them if ``full``."""
    yield from _uniform(full)
    yield from _orders()
    yield from _parts(full)
    yield from _critical(full)
    yield from _buckled(full)
    yield from _rigid_tip(full)
    yield from _space(full)
    yield from _charges(full)


def _at(wire: Wire, b: float, degrees: float) -> Equilibrium:
    return free(wire).equilibrium(L, flux(wire, b, degrees))


def _nodes(angle: float, *, b: float = 0.0, part: float = 1.0) -> int:
    """By the angle of the tip [rad]; below a right angle all wires have the same."""
    turned = np.degrees(angle)
    steep = (turned > 90.0 and part < 0.03) or (turned > 150.0 and b > 50.0)
    return STEEP if steep else NODES


def _uniform(full: bool) -> Iterator[Line | Curve]:
    if full:
        angles = (30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 150.0, 165.0, 175.0, 179.0)
        cases = [(d, b) for d in angles for b in (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)]
    else:
        cases = [(30.0, 1.0), (90.0, 3.0), (135.0, 10.0), (135.0, 100.0), (179.0, 100.0)]
    for degrees, b in cases:
        exact = pendulum.under_force(b, np.radians(degrees))
        nodes = _nodes(exact.angle, b=b)
        case = f"field at {degrees:g} degrees, b = {b:g}, {nodes} nodes"
        yield from compare(GROUP, case, _at(magnet(nodes), b, degrees), exact, ELASTICA)
    fine, few = np.geomspace(0.1, 100.0, 60), np.geomspace(0.1, 100.0, 10)
    series: dict[str, Series] = {}
    for degrees in (45.0, 90.0, 135.0):
        line = np.degrees([pendulum.under_force(b, np.radians(degrees)).angle for b in fine])
        states = [_at(magnet(), b, degrees) for b in few]
        found = np.degrees([np.arctan2(*state.tip_direction[1::-1]) for state in states])
        series[f"{degrees:g}°"] = (np.log10(fine), line, "line")
        series[f"magwire, {degrees:g}°"] = (np.log10(few), found, "points")
    title = "Wire magnetised all along, in a uniform field"
    yield Curve(title, "log10 of b = M B L²/EI", "tip angle [degrees]", series)


def _orders() -> Iterator[Line]:
    exact = pendulum.under_force(3.0, 0.75 * np.pi)
    tips = [_at(magnet(n), 3.0, 135.0).tip[:2] / L for n in MESHES]
    errors = [float(np.hypot(x - exact.x, y - exact.y)) for x, y in tips]
    slope = order([1.0 / (n - 1) for n in MESHES], errors)
    case = f"field at 135 degrees, b = 3, {MESHES[0]} to {MESHES[-1]} nodes"
    yield Line(GROUP, case, "tip's distance from its place, finest mesh", "L", 0.0, ELASTICA,
               errors[-1], CLOSE, order=slope, expected_order=2.0)  # fmt: skip


def _joint(state: Equilibrium, part: float) -> float:
    """Angle of the tangent where the magnet begins, between the middles of the edges."""
    edges = np.diff(state.positions, axis=0)
    middles = (np.arange(len(edges)) + 0.5) / len(edges)
    return float(np.interp(1.0 - part, middles, np.arctan2(edges[:, 1], edges[:, 0])))


SHOWN = ((0.02, 2.0, 90.0), (0.25, 6.0, 90.0), (0.5, 2.0, 150.0))


def _parts(full: bool) -> Iterator[Line | Curve]:
    """``strength`` is m B L/EI, with the moment m of the whole magnet."""
    if full:
        parts = (0.02, 0.05, 0.1, 0.25, 0.5, 0.75)
        cases = [(p, s, d) for p in parts for s in (0.5, 2.0, 6.0) for d in (60.0, 90.0, 150.0)]
    else:
        cases = list(SHOWN)
    series: dict[str, Series] = {}
    for part, strength, degrees in cases:
        b = strength / part
        exact = pendulum.magnetised_tip(b, np.radians(degrees), part)
        nodes = _nodes(exact.angle, part=part)
        state = _at(magnet(nodes, part), b, degrees)
        case = (
            f"distal {part:g} L magnetised, field at {degrees:g} degrees, "
            f"m B L/EI = {strength:g}, {nodes} nodes"
        )
        yield from compare(GROUP, case, state, exact, ELASTICA)
        yield Line(GROUP, case, "joint angle", "rad", exact.joint, ELASTICA, _joint(state, part),
                   CLOSE)  # fmt: skip
        if (part, strength, degrees) in SHOWN:
            name = f"{part:g} L at {degrees:g}°"
            x, y = pendulum.shape(b, exact, np.radians(degrees), part)
            series[name] = (x, y, "line")
            x, y, _ = state.positions[::6].T / L
            series[f"magwire, {name}"] = (x, y, "points")
    yield Curve("Wires magnetised in part", "x / L", "y / L", series, equal=True)


def _critical(full: bool) -> Iterator[Line]:
    parts = (0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75, 0.9, 1.0) if full else (0.1, 1.0)
    for part in parts:
        exact = pendulum.critical_antiparallel(part)
        wire = magnet(NODES, part)
        found = critical(lambda b, wire=wire: _at(wire, b, 180.0).stable, exact)  # type: ignore[misc]
        case = f"antiparallel field, distal {part:g} L magnetised"
        yield Line(GROUP, case, "critical b", "", exact, "characteristic equation", found, LOAD,
                   relative=True)  # fmt: skip


def _buckled(full: bool) -> Iterator[Line | Curve]:
    """From an equilibrium in a field that is slightly from the side."""
    loads = (2.5, 2.6, 3.0, 4.0, 5.0, 10.0, 20.0, 50.0, 100.0) if full else (3.0, 10.0)
    angles = []
    for b in loads:
        exact = pendulum.under_force(b, np.pi)
        wire = magnet(_nodes(exact.angle, b=b))
        sim = free(wire)
        start = sim.equilibrium(L, flux(wire, b, 177.0))
        state = sim.equilibrium(L, flux(wire, b, 180.0), start=start)
        angles.append(np.degrees(np.arctan2(*state.tip_direction[1::-1])))
        case = f"buckled in the antiparallel field, b = {b:g}, {wire.nodes} nodes"
        yield from compare(GROUP, case, state, exact, ELASTICA)
    first = pendulum.critical_antiparallel(1.0)
    fine = np.linspace(1.0005 * first, 10.0, 60)
    branch = np.degrees([pendulum.under_force(b, np.pi).angle for b in fine])
    shown = np.array(loads) <= 10.0
    yield Curve(
        "Buckling in the antiparallel field",
        "b = M B L²/EI",
        "tip angle [degrees]",
        {
            "theory": (fine, branch, "line"),
            "magwire": (np.array(loads)[shown], np.array(angles)[shown], "points"),
        },
    )


def _rigid_tip(full: bool) -> Iterator[Line]:
    rigid, radius = 0.02, 0.4e-3
    stiff = {**STUFF, "youngs_modulus": 3e10, "shear_modulus": 1e10}
    body = Section((1.0 - rigid) * L, radius=radius, **STUFF)
    tip = Section(rigid * L, radius=radius, magnetization=(0.0, 0.0, 200e3), **stiff)
    wire = Wire((body, tip), NODES)
    for strength, degrees in ((0.5, 90.0), (2.0, 90.0), (2.0, 150.0)) if full else ((2.0, 90.0),):
        exact = pendulum.dipole(strength, np.radians(degrees), rigid)
        state = _at(wire, strength / rigid, degrees)
        case = f"rigid tip of {rigid:g} L, field at {degrees:g} degrees, m B L/EI = {strength:g}"
        yield from compare(GROUP, case, state, exact, "arc of a circle")


MIXED = ((0.0, 1.0, 0.0), (0.6, 0.0, 0.8), (0.0, -0.8, 0.6), (0.5, 0.7, 0.51))
FIELDS = ((1.0, 2.0, 1.5), (-1.0, 3.0, 2.0), (2.0, -4.0, 3.0))
TWISTING = 2.0 / 3.0  # GJ/EI of STUFF


def _mixed(m: tuple[float, float, float], **options: Any) -> Wire:
    """Magnetised along m of (m1, m2, t), with the same size for all."""
    return magnet(magnetization=tuple(20e3 * np.array(m) / np.linalg.norm(m)), **options)


def _space(full: bool) -> Iterator[Line | Curve]:
    """Three components of magnetisation: the wire bends in space and twists."""
    unit = free(magnet()).system.scales.flux_density
    cases = [(m, b) for m in MIXED for b in FIELDS] if full else [(MIXED[3], FIELDS[0])]
    for number, (m, b) in enumerate(cases):
        case = f"magnetised along {m} of (m1, m2, t), b = {b}"
        field = UniformField((b[0] * unit, b[1] * unit, b[2] * unit))
        yield from _compare_in_space(case, _mixed(m), field, show=number == len(cases) - 1)
    uneven = _uneven()
    for name, source in uneven.items() if full else ():
        yield from _compare_in_space(name, magnet(), source)
    name, source = list(uneven.items())[-1]
    case = f"magnetised along {MIXED[3]} of (m1, m2, t)"
    yield from _compare_in_space(f"{case}, {name}", _mixed(MIXED[3]), source)
    if full:
        curved = _mixed(MIXED[3], rest_curvature=(0.8 / L, -0.5 / L))
        case += ", rest curvature 0.8/L towards m1, -0.5/L towards m2, gradient field"
        yield from _compare_in_space(case, curved, uneven["gradient field"])


def _uneven() -> dict[str, FieldSource]:
    """Fields that differ along the wire: a gradient, and dipoles that push and pull."""
    unit = free(magnet()).system.scales.flux_density
    slope = unit / L * np.array([[1.0, 2.0, -1.5], [2.0, 1.5, 1.0], [-1.5, 1.0, -2.5]])
    rows = tuple(tuple(row) for row in slope.tolist())
    size = 1e7 * unit * L**3  # mu_0/(4 pi) is 1e-7
    axis = size * np.array([0.3, -1.0, 0.6])
    fields: dict[str, FieldSource] = {
        "gradient field": GradientField((0.5 * unit, unit, 0.0), rows),  # type: ignore[arg-type]
        "point dipole at (0.5, 0.33, 0) L that bends the wire by L/3": Dipole(
            np.array([0.5, 0.33, 0.0]) * L, size * np.array([0.4, 0.0, 0.0])
        ),
    }
    for x, y, z, part in ((0.7, 0.6, -0.4, 0.4), (1.0, 0.6, 0.4, 0.2)):
        name = f"point dipole at ({x:g}, {y:g}, {z:g}) L"
        fields[name] = Dipole(np.array([x, y, z]) * L, part * axis)
    return fields


def _compare_in_space(
    case: str, wire: Wire, source: FieldSource, *, show: bool = False
) -> Iterator[Line | Curve]:
    sim = free(wire)
    state = sim.equilibrium(L, source)
    scale = sim.system.scales.flux_density

    def field(places: Array) -> tuple[Array, Array]:
        b, gradient = source.at(places * L)
        return b / scale, gradient * L / scale

    guide = sim.system.guide
    frame = np.column_stack(
        [guide.director, np.cross(guide.direction, guide.director), guide.direction]
    )
    points = 2 * wire.nodes - 1
    exact = kirchhoff.clamped(
        frame,
        np.array(wire.body.moment_per_length) / wire.moment_per_length,
        field,
        twisting=TWISTING,
        rest=_darboux(wire),
        points=points,
    )
    away = np.linalg.norm(state.positions / L - exact.place[::2], axis=1)
    yield Line(GROUP, case, "largest distance of a node from its place", "L", 0.0, KIRCHHOFF,
               float(away.max()), CLOSE)  # fmt: skip
    point = state.point
    last = tuple(point.state.tangent[-1])
    m1, m2 = material_frame(tuple(point.state.director[-1]), last, point.state.q[-2, 3])
    found = np.column_stack([m1, m2, last])
    turn = 0.5 * (np.trace(found.T @ exact.directors[-2]) - 1.0)
    yield Line(GROUP, case, "angle of the tip's frame to its direction", "rad", 0.0, KIRCHHOFF,
               float(np.arccos(np.clip(turn, -1.0, 1.0))), CLOSE)  # fmt: skip
    if show:
        series: dict[str, Series] = {}
        for name, k in (("x", 0), ("y", 1), ("z", 2)):
            s = np.linspace(0.0, 1.0, points)
            series[name] = (s, exact.place[:, k], "line")
            series[f"magwire, {name}"] = (s[::12], state.positions[::6, k] / L, "points")
        yield Curve("Bent and twisted in space, the last b of those", "s / L", "place / L", series)


def _darboux(wire: Wire) -> Array:
    """Rest curvature as a rotation: towards m1 is about m2, towards m2 about -m1."""
    first, second = wire.body.rest_curvature
    return L * np.array([-second, first, 0.0])


def _charges(full: bool) -> Iterator[Line]:
    """All forces of the field on a wire magnetised along its tangent act at its ends."""
    wire = magnet()
    for name, source in list(_uneven().items())[0 if full else 1 :]:
        state = free(wire).equilibrium(L, source)
        ends = state.positions[[0, -1]]
        b, _ = source.at(ends)
        charge = wire.moment_per_length
        force = charge * (b[1] - b[0])
        torque = charge * (np.cross(ends[1], b[1]) - np.cross(ends[0], b[0]))
        scale = free(wire).system.scales
        pairs = zip(
            ("force", "torque"),
            (force / scale.force, torque / (scale.force * L)),
            (-load for load in guide_load(state)),
            ("EI/L^2", "EI/L"),
            strict=True,
        )
        for quantity, exact, found, unit in pairs:
            size = float(np.linalg.norm(exact))
            for axis, e, f in zip("xyz", exact, found, strict=True):
                yield Line(GROUP, f"field on the whole wire, {name}", f"{quantity}, {axis}", unit,
                           float(e), CHARGES, float(f), LOADS * size)  # fmt: skip
