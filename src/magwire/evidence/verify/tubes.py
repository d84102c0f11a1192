"""A thin wire pushed along a straight tube until it buckles: snaking, then winding (group 5).

The load is dead: the pull of a field gradient on a short magnet at the tip. A test rig: field and
weight have the size that buckles a thin wire within ten centimetres, whatever could make them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import Curve, Line
from magwire.evidence.verify.placed import placed
from magwire.evidence.verify.references import tube
from magwire.field import GradientField
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]
GROUP = "contact"
L, RADIUS, MAGNET = 0.1, 0.05e-3, 2e-3
NODES = 400
WIRE = Wire.uniform(L, RADIUS, 3e6, 1e6, 2000.0, NODES, magnetized_tip=MAGNET, magnetization=800e3)
STIFFNESS = WIRE.bending_stiffness


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Loads of snaking and of winding, and the shape of the helix."""
    yield from _snaking(60.0, 3.0)
    yield from _snaking(30.0, 0.0)
    if full:
        yield from _snaking(30.0, 3.0)
    yield from _weightless_helix()
    yield from _heavy_helix()


@dataclass(frozen=True)
class _Rig:
    """A wire of which the axis may go off a straight tube's by ``offset``, bearing ``weight``."""

    offset: float
    weight: float
    thickness: float  # of the barrier's layer, with the weight carried near its middle
    entry: float = 0.0  # length over which the tube opens above a flat bottom
    upright: float = 0.0  # flux density along the tube at the tip

    @property
    def barrier(self) -> Barrier:
        return Barrier(self.weight / self.thickness, self.thickness)

    @property
    def clearance(self) -> float:
        """Where the wire lies at rest under its weight [m]."""
        stiffness = self.weight / self.thickness
        return tube.barrier_clearance(self.weight, stiffness, self.thickness)

    def tube_radius(self, x: Array) -> Array:
        """Grows from a tight fit at the entrance, so that the wire need not climb down."""
        narrow = RADIUS + self.thickness
        wide = RADIUS + self.clearance + self.offset
        if self.entry == 0.0:
            return np.full_like(x, wide)
        u = np.clip(x / self.entry, 0.0, 1.0)
        return np.asarray(narrow + (wide - narrow) * u**3 * (10.0 - 15.0 * u + 6.0 * u**2))

    def simulation(self, weight: float) -> Simulation:
        x = np.linspace(0.0, 1.1 * L, 400)
        radius = self.tube_radius(x)
        axis = np.column_stack((x, 0.0 * x, radius - radius[0]))  # the bottom stays flat
        body = WIRE.body
        fall = (0.0, 0.0, -weight / (body.density * body.area))
        return Simulation(WIRE, Lumen.through(axis, radius), contact=self.barrier, gravity=fall)

    def field(self, load: float, place: float) -> GradientField:
        """Pulls the magnet back; apart from ``upright``, it does not turn one at ``place``."""
        slope = -load / (WIRE.moment_per_length * MAGNET)
        gradient = ((slope, 0.0, 0.0), (0.0, -0.5 * slope, 0.0), (0.0, 0.0, -0.5 * slope))
        return GradientField((self.upright, 0.0, 0.0), gradient, (place, 0.0, 0.0))


def _snaking(ratio: float, upright: float) -> Iterator[Line]:
    """The load at which the wire leaves the bottom line; L is so many (EI r/w)^(1/4).

    ``upright``: flux density at the tip [T], which keeps its direction; without it the tip is free.
    """
    offset = 0.2e-3
    length = L / ratio
    weight = STIFFNESS * offset / length**4
    rig = _Rig(offset, weight, 2e-6, entry=8.0 * length, upright=upright)
    sim = rig.simulation(weight)
    long = tube.sinusoidal_load(STIFFNESS, weight, offset)

    def straight(load: float, start: Equilibrium | None) -> Equilibrium | None:
        """The wire along the bottom, if it stays there."""
        state = sim.equilibrium(L, rig.field(load, L - 0.5 * MAGNET), start=start)
        stays = state.stable and float(np.abs(state.positions[:, 1]).max()) < 1e-2 * offset
        return state if stays else None

    low, high = 0.1 * long, 1.6 * long
    state = straight(low, None)
    while high - low > 1e-4 * long:
        middle = 0.5 * (low + high)
        trial = straight(middle, state)
        if trial is None:
            high = middle
        else:
            low, state = middle, trial
    tip = "tip kept along it" if upright else "free tip"
    case = f"wire on the bottom of a tube, {tip}, L = {ratio:g} (EI r/w)^¼, {NODES} nodes"
    unit = "(EI w/r)^½"
    expected = _beam_on_the_bottom(rig, weight)
    yield Line(
        GROUP, case, "load of snaking", unit, 2.0 * expected / long,
        "beam on the foundation w/r, its ends as in the rig (Hermite elements)",
        (low + high) / long, 0.01, relative=True,
    )  # fmt: skip
    if ratio >= 60.0:
        yield Line(
            GROUP, case, "load of snaking of a long wire", unit, 2.0,
            "2 (EI w/r)^½ (Dawson and Paslay 1984), L → ∞", (low + high) / long, 0.01,
            relative=True,
        )  # fmt: skip


def _beam_on_the_bottom(rig: _Rig, weight: float) -> float:
    """The load by the beam equation, with what magnet and gradient do to second order."""
    begin = L - MAGNET
    upright = WIRE.moment_per_length * rig.upright

    def carried(s: Array) -> Array:
        """Of the load: all of it up to the magnet; the field's change along the magnet turns it."""
        torque = np.where(s > begin, (s - begin) / MAGNET - 0.5, 0.0)
        return np.clip((L - s) / MAGNET, 0.0, 1.0) + torque

    return tube.least_load(
        L,
        STIFFNESS,
        lambda s: weight / (rig.tube_radius(s) - RADIUS - rig.clearance),
        carried,
        lambda s: np.where(s > begin, upright, 0.0),
        ends=tube.Ends(),
        # div B = 0: off the axis the gradient pushes the magnet's two poles sideways.
        push_at={L * (1.0 - 1e-12): -0.5 / MAGNET, begin: 0.5 / MAGNET},
        elements=120,
    )


def _coil(turn: float, offset: float) -> Array:
    """Nodes of a wire that leaves the axis within half a turn and winds up from there on."""
    s = np.linspace(0.0, L, NODES)
    u = np.clip(s * turn / np.pi, 0.0, 1.0)
    radius = 0.98 * offset * u * u * (3.0 - 2.0 * u)
    y, z = radius * np.sin(turn * s), -radius * np.cos(turn * s)
    across = np.hypot(np.diff(y), np.diff(z))
    x = np.append(0.0, np.cumsum(np.sqrt(np.diff(s) ** 2 - across**2)))
    return np.column_stack((x, y, z))


@dataclass(frozen=True)
class _Coiled:
    """A wire that winds along the tube's wall, and the load that it feels."""

    state: Equilibrium
    load: float

    @classmethod
    def find(
        cls, rig: _Rig, sim: Simulation, load: float, start: Equilibrium | None, turn: float
    ) -> _Coiled:
        """The field is free of torque where the magnet turns out to be."""
        if start is None:
            start = placed(sim.equilibrium(L), _coil(turn, rig.offset))
        state, magnet = start, int(NODES * MAGNET / L) + 1
        for _ in range(3):
            place = float(state.positions[-magnet:, 0].mean())
            field = rig.field(load, place)
            state = sim.equilibrium(L, field, start=state)
        edges = np.diff(state.positions, axis=0)
        along = edges[:, 0] / np.linalg.norm(edges, axis=1)
        moments = sim.system.mesh.moment[:, 2]
        return cls(state, -float((moments * along).sum()) * field.gradient[0][0])

    @property
    def angle(self) -> Array:
        """Around the tube's axis from the bottom, along the wire."""
        y, z = self.state.positions[:, 1], self.state.positions[:, 2]
        return np.unwrap(np.arctan2(y, -z))

    @property
    def offset(self) -> float:
        """Mean distance from the tube's axis in the middle third of the wire."""
        away = np.linalg.norm(self.state.positions[:, 1:], axis=1)
        return float(away[NODES // 3 : 2 * NODES // 3].mean())

    def energy(self, weight: float) -> float:
        """Mean over whole turns in the middle half, over that at the bottom [J/m]."""
        p, h = self.state.positions, L / (NODES - 1)
        edges = np.diff(p, axis=0)
        length = np.linalg.norm(edges, axis=1)
        tangent = edges / length[:, None]
        cosine = np.sum(tangent[1:] * tangent[:-1], axis=1)
        curvature = 2.0 * np.sqrt((1.0 - cosine) / (1.0 + cosine)) / h
        density = np.zeros(NODES)
        density[1:-1] = 0.5 * STIFFNESS * curvature**2 + weight * (p[1:-1, 2] + self.offset)
        total = np.append(0.0, np.cumsum(0.5 * h * (density[1:] + density[:-1])))
        total[1:] -= self.load * np.cumsum(length - edges[:, 0])
        s, angle, turn = np.linspace(0.0, L, NODES), self.angle, 2.0 * np.pi
        first = np.ceil(angle[NODES // 4] / turn) * turn
        last = np.floor(angle[3 * NODES // 4] / turn) * turn
        ends = np.interp([first, last], angle, s)
        return float(np.diff(np.interp(ends, s, total))[0] / np.diff(ends)[0])


def _weightless_helix() -> Iterator[Line | Curve]:
    turns, slope = 10, 0.1
    turn = 2.0 * np.pi * turns / L
    offset = slope / turn
    load = 2.0 * STIFFNESS * turn**2
    rig = _Rig(offset, 0.25 * load**2 * offset / STIFFNESS, 2e-6)
    coiled = _Coiled.find(rig, rig.simulation(0.0), load, None, turn)
    middle = slice(NODES // 3, 2 * NODES // 3)
    s = np.linspace(0.0, L, NODES)
    expected, force = tube.helix(STIFFNESS, coiled.load, coiled.offset)
    wall = np.linalg.norm(coiled.state.wall_force, axis=1)[middle].mean() * (NODES - 1) / L
    case = f"weightless wire wound up in a tube, {turns} turns, {NODES} nodes"
    scale = float(np.sqrt(STIFFNESS / coiled.load))
    yield Line(
        GROUP, case, "turn per length k", "(F/EI)^½", expected * scale,
        "k² = F/2EI (Lubinski and others 1962), with the helix's slope",
        float(np.polyfit(s[middle], coiled.angle[middle], 1)[0] * scale),
        0.01, relative=True,
    )  # fmt: skip
    unit = coiled.load**2 * coiled.offset / STIFFNESS
    yield Line(
        GROUP, case, "wall force per length", "F²r/EI", force / unit,
        "F²r/4EI (Mitchell 1988), with the helix's slope", float(wall) / unit, 0.01, relative=True,
    )  # fmt: skip
    straight = expected * (s - s[middle].mean()) + coiled.angle[middle].mean()
    yield Curve(
        "Weightless wire wound up in a tube",
        "s / L",
        "turns around the tube",
        {
            "k² = F/2EI": (s / L, straight / (2.0 * np.pi), "line"),
            "magwire": (s[8::8] / L, coiled.angle[8::8] / (2.0 * np.pi), "points"),
        },
    )


def _heavy_helix() -> Iterator[Line]:
    """The load at which winding up costs as much as lying straight."""
    turn, slope = 2.0 * np.pi * 10 / L, 0.05
    offset, critical = slope / turn, tube.helical_load()
    weight = STIFFNESS * offset * (turn**2 / (0.5 * critical)) ** 2
    rig = _Rig(offset, weight, 1e-6)
    sim = rig.simulation(weight)
    found, start = [], None
    for part in (1.0, 1.02, 1.04):
        load = part * critical * np.sqrt(STIFFNESS * weight / offset)
        coiled = _Coiled.find(rig, sim, load, start, turn)
        start = coiled.state
        unit = weight * coiled.offset
        scale = np.sqrt(STIFFNESS * weight / coiled.offset)
        found.append((coiled.load / scale, coiled.energy(weight) / unit))
    loads, energies = np.array(found).T
    fit = np.polyfit(energies, loads, 1)
    yield Line(
        GROUP, f"heavy wire wound up in a tube, {NODES} nodes",
        "load of equal energy, wound and straight", "(EI w/r)^½", critical,
        "least energy of a helix of any course of pitch; 2√2 with a constant one (Chen and others)",
        float(fit[1]), 0.01, relative=True,
    )  # fmt: skip
