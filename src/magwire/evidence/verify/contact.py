"""Group 5: contact with the wall (P-8, P-11 to P-13), in a bend and in a straight tube."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify import tubes
from magwire.evidence.verify.evidence import NODES, Curve, Line
from magwire.evidence.verify.references import hard_contact, pushed
from magwire.field import FieldSource, GradientField, UniformField
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]
GROUP = "contact"
L, EDGE = 0.1, 0.1 / (NODES - 1)
WIRE = Wire.uniform(
    L, 0.6e-3, 3e6, 1e6, 2000.0, NODES, magnetized_tip=5 * EDGE, magnetization=128e3
)
FORCE = WIRE.bending_stiffness / L**2
HARD = "least energy of a chain of rigid links between hard walls (SLSQP)"
SPACE = "inextensible rod of links of L/100 in a hard wall, Newton's method (KKT)"


@dataclass(frozen=True)
class _Bend:
    """A half-circle of centreline radius and inner radius, in wire lengths."""

    bend: float
    width: float

    @property
    def lumen(self) -> Lumen:
        return Lumen.half_circle(self.bend * L, self.width * L)

    def simulation(self, barrier: Barrier) -> Simulation:
        return Simulation(WIRE, self.lumen, contact=barrier)

    def __str__(self) -> str:
        return f"half-circle {self.bend:g} L, R = {self.width:g} L"


PAPER, NARROW, SHARP = _Bend(0.25, 0.03), _Bend(0.25, 0.01), _Bend(0.2, 0.01)


def _barrier(gap: float, stiffness: float = 1e3) -> Barrier:
    """Keeps off the axis, as the hard walls do."""
    return Barrier(stiffness, gap, wall="centreline")


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; more bends and whole pushes if ``full``."""
    yield from tubes.evidence(full)
    cases = [(PAPER, 30, 40.0), (NARROW, 50, 0.0)]
    if full:
        cases += [(PAPER, 20, 0.0), (PAPER, 50, 0.0), (SHARP, 40, 0.0), (SHARP, 60, 0.0)]
    for bend, links, b in cases:
        yield from _forces(bend, links, b)
    yield from _rate(1.0)
    yield from _rate(0.0)
    if full:
        yield from _peaks()
    yield from _balance()
    yield from _work()
    yield from _insertion()
    yield from _penetration(PAPER, 0.1e-3)
    yield from _penetration(SHARP, 0.02e-3)
    if full:
        yield from _penetration(SHARP, 0.005e-3)


def _hard(bend: _Bend, links: int, b: float) -> hard_contact.Pressed:
    """In the field b = M B L^2/EI across the entrance."""
    magnet = np.zeros((links, 2))
    magnet[-5:, 1] = b * EDGE / L
    return hard_contact.press(links, EDGE / L, bend.bend, bend.width, field=magnet)


def _pressed(bend: _Bend, links: int, b: float, barrier: Barrier) -> Equilibrium:
    flux = b * WIRE.bending_stiffness / (WIRE.moment_per_length * L**2)
    return bend.simulation(barrier).equilibrium(links * EDGE, [0.0, flux, 0.0])


def _forces(bend: _Bend, links: int, b: float) -> Iterator[Line | Curve]:
    hard = _hard(bend, links, b)
    soft = _pressed(bend, links, b, _barrier(0.02e-3))
    field = f", B* = {b:g}" if b else ""
    case = f"{bend}, pushed {links / (NODES - 1):.3f} L{field}, dhat = 0.02 mm"
    for name, expected, value in (
        ("force on the tip", _sizes(hard.wall_force)[-1], soft.tip_force / FORCE),
        (
            "sum of wall forces",
            _sizes(hard.wall_force).sum(),
            _sizes(soft.wall_force).sum() / FORCE,
        ),
    ):
        yield Line(
            GROUP, case, name, "EI/L²", float(expected), HARD, float(value), 0.05, relative=True
        )  # fmt: skip
    free = soft.positions[NODES - links :, :2] / L
    yield Line(
        GROUP, case, "largest distance of a node", "L", 0.0, HARD,
        float(np.linalg.norm(free - hard.joints, axis=1).max()), 1e-3,
    )  # fmt: skip
    if bend is NARROW:
        s = np.arange(1.0, links + 1.0) * (EDGE / L)
        yield Curve(
            f"Wall forces, {bend}",
            "s / L",
            "force per length [EI/L³]",
            {
                "hard walls": (s, _sizes(hard.wall_force) * L / EDGE, "line"),
                "magwire": (s, _sizes(soft.wall_force)[-links:] / FORCE * L / EDGE, "points"),
            },
        )


def _sizes(vectors: Array) -> Array:
    sizes: Array = np.sqrt((vectors**2).sum(axis=1))
    return sizes


def _rate(power: float) -> Iterator[Line]:
    """Towards hard contact; the barrier's stiffness goes like dhat^-power.

    The layer that carries a force F is d thick with K h b'(d) = F. If K dhat stays, so does
    d/dhat; if K stays, d goes like K h dhat^2/F.
    """
    gaps = np.array([0.08, 0.04, 0.02]) * 1e-3
    links = 20
    found = []
    for gap in gaps:
        stiffness = 1e3 * (0.1e-3 / gap) ** power
        found.append(_pressed(PAPER, links, 0.0, _barrier(gap, stiffness)).tip_force / FORCE)
    drops = np.diff(found)
    order = float(np.log2(drops[0] / drops[1]))
    theory = 2.0 - power
    limit = found[2] + drops[1] / (2.0**theory - 1.0)
    stays = "K dhat" if power else "K"
    yield Line(
        GROUP, f"{PAPER}, dhat → 0 from 0.08, 0.04, 0.02 mm, {stays} fixed", "force on the tip",
        "EI/L²", float(_sizes(_hard(PAPER, links, 0.0).wall_force)[-1]), HARD, float(limit), 0.01,
        relative=True, order=order, expected_order=theory,
    )  # fmt: skip


def _peaks() -> Iterator[Line]:
    """Whole quasi-static pushes with the paper's barrier.

    Half-circles against the chain between hard walls, pushed link by link about where it peaks;
    the others against a rod in space.
    """
    for width, least in ((0.02, 17), (0.03, 22), (0.04, 26)):
        bend = _Bend(0.25, width)
        pressed = [_hard(bend, links, 0.0) for links in range(least, least + 4)]
        expected = max(float(_sizes(hard.wall_force)[-1]) for hard in pressed)
        yield _peak(f"half-circle, 2R/L = {2.0 * width:g}", bend.lumen, expected, HARD)
    for case, name, lumen in (
        ("sinusoid", "sinusoid, 2R/L = 0.06", Lumen.sinusoid(0.15 * L, 0.8 * L, 0.8 * L, 0.03 * L)),
        ("helix", "helix, 2R/L = 0.06", Lumen.helix(0.1 * L, 0.1 * L, 0.9 * L, 0.03 * L)),
        ("cone", "half-circle, R/L from 0.04 to 0.02", _cone()),
    ):
        yield _peak(name, lumen, float(pushed.curve(case, 100)[:, 1].max()), SPACE)


def _cone() -> Lumen:
    """The half-circle, its radius falling from 0.04 to 0.02 L."""
    passage = pushed.CASES["cone"]
    w = np.linspace(0.0, passage.end, 200)
    return Lumen.through(passage.curve(w)[0] * L, (passage.radius + passage.taper * w) * L)


def _peak(name: str, lumen: Lumen, expected: float, source: str) -> Line:
    march = _push(Simulation(WIRE, lumen, contact=_barrier(0.1e-3)), 0.72)
    march.advance(march.steps)
    return Line(
        GROUP, f"{name}, pushed 0.72 L", "largest force on the tip", "EI/L²", expected, source,
        march.plant.totals.max_tip_force / FORCE, 0.01, relative=True,
    )  # fmt: skip


def _push(sim: Simulation, distance: float) -> March:
    """Equilibrium after equilibrium, every 0.1 mm."""
    feed = Feed(1e-3, distance * L)
    return March(sim.system, UniformField(), feed, time_step=0.1, inertia=False)


GRADIENT = GradientField(
    (2e-3, 9e-3, 1e-3), ((0.2, 0.3, 0.1), (0.3, -0.4, 0.2), (0.1, 0.2, 0.2)), (0.01, 0.0, 0.0)
)


def _loaded() -> tuple[Simulation, Equilibrium, float]:
    """A wire in contact in a field with a gradient."""
    sim, feed = PAPER.simulation(_barrier(0.1e-3)), 0.4137 * L
    return sim, sim.equilibrium(feed, GRADIENT), feed


def _guide(state: Equilibrium) -> Array:
    """Force of the guide on the wire past it [N]."""
    system = state.point.system
    _, gradient = state.point.energy(system.new_work())
    return np.asarray(gradient[: state.point.mouth.held + 1, :3].sum(axis=0) * system.scales.force)


def _balance() -> Iterator[Line]:
    """The wall's forces against the guide's and the pull of the field on the magnet."""
    sim, state, _ = _loaded()
    edges = np.diff(state.positions, axis=0)
    tangents = edges / np.linalg.norm(edges, axis=1)[:, None]
    moments = sim.system.mesh.moment[:, 2:] * tangents
    pull = (moments @ np.array(GRADIENT.gradient)).sum(axis=0)
    wall, guide = state.wall_force.sum(axis=0), _guide(state)
    for i, axis in enumerate("xyz"):
        yield Line(
            GROUP, "half-circle, field with a gradient", f"force of the walls along {axis}",
            "EI/L²", -float(guide[i] + pull[i]) / FORCE,
            "minus guide's force and the pull of the gradient on the magnet",
            float(wall[i]) / FORCE, 1e-6,
        )  # fmt: skip


def _work() -> Iterator[Line]:
    """Without friction the push does the work that the energy takes up.

    The mouth of the guide adds a force of its own: the wire that bends as it leaves pushes back
    with EI k^2/2 (Bigoni and others), k the curvature just past the mouth.
    """
    for name, source in (("no field", UniformField()), ("field with a gradient", GRADIENT)):
        sim, feed, step = PAPER.simulation(_barrier(0.1e-3)), 0.4137 * L, 1e-6
        state = sim.equilibrium(feed, source)
        energies = [_energy(sim, source, feed + side * step, state) for side in (-1.0, 1.0)]
        mouth = state.point.mouth
        edge = state.positions[mouth.held] - state.positions[mouth.held - 1]
        cosine = edge[0] / float(np.linalg.norm(edge))
        bend = 2.0 * np.sqrt((1.0 - cosine) / (1.0 + cosine)) / (mouth.fraction * EDGE)
        push = float(_guide(state)[0]) - 0.5 * WIRE.bending_stiffness * bend**2
        yield Line(
            GROUP, f"half-circle, {name}", "push force", "EI/L²",
            (energies[1] - energies[0]) / (2.0 * step * FORCE), "dE/dX, differences of energy",
            push / FORCE, 1e-4,
        )  # fmt: skip


def _energy(sim: Simulation, source: FieldSource, feed: float, start: Equilibrium) -> float:
    state = sim.equilibrium(feed, source, start=start)
    energy, _ = state.point.energy(sim.system.new_work())
    return energy * FORCE * L


def _insertion() -> Iterator[Line]:
    """A wire that follows a circle takes up EI k^2/2 for each length that is pushed in."""
    tight = _Bend(0.25, 0.001)
    sim = tight.simulation(_barrier(0.02e-3, 1e4))
    ends = (0.03, 0.06)
    states = [sim.equilibrium(feed) for feed in ends]
    energies = [s.point.energy(sim.system.new_work())[0] for s in states]
    work = (energies[1] - energies[0]) * L / (ends[1] - ends[0])
    yield Line(
        GROUP, "tube so narrow that the wire follows its bend", "work of pushing in", "EI/L²",
        0.5 / tight.bend**2, "EI k²/2, k the bend's curvature", work, 0.01, relative=True,
    )  # fmt: skip


def _penetration(bend: _Bend, gap: float) -> Iterator[Line]:
    """Deepest point over a push: at the nodes, and between them on a fine resampling.

    Contact acts at the nodes. Along the inner wall a chord between two of them cuts into the bend
    by at most h^2/8 over the wall's radius, and a curve that bends with the wall by less. The
    barrier's layer hides that, unless it is as thin.
    """
    sim = bend.simulation(_barrier(gap))
    march = _push(sim, 0.7 if bend is PAPER else 0.6)
    depths = np.zeros(3)
    for record in march.records(50):
        free = record.position[np.isfinite(record.clearance)]
        if len(free) < 2:
            continue
        held = record.position[len(record.position) - len(free) - 1]
        depths = np.maximum(depths, _depths(sim.system.lumen, np.vstack((held, free))))
    sagitta = (EDGE / L) ** 2 / 8.0 / (bend.bend - bend.width)
    case, bound = f"{bend}, a whole push, dhat = {gap * 1e3:g} mm", "a wall cannot be crossed"
    between = f"{bound}, but for h²/8ρ between nodes"
    for name, source, depth, tolerance in zip(
        ("nodes", "chords between them", "spline through them"),
        (bound, between, between),
        depths / L,
        (0.0, sagitta, sagitta),
        strict=True,
    ):
        yield Line(
            GROUP, case, f"penetration, {name}", "L", 0.0, source, float(depth), tolerance
        )  # fmt: skip


def _depths(lumen: Lumen, nodes: Array) -> Array:
    """Of the nodes, of chords, of a spline; the first point is on the guide."""
    at = np.arange(len(nodes), dtype=np.float64)
    fine = np.linspace(0.0, at[-1], 20 * len(nodes))
    chords = np.column_stack([np.interp(fine, at, column) for column in nodes.T])
    curves = (nodes[1:], chords, CubicSpline(at, nodes)(fine))
    return np.array([max(0.0, -float(lumen.gap(points).min())) for points in curves])
