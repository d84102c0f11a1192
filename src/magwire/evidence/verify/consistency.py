"""Group 8: two ways to the same number."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.sensitivity import Input
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import NODES, Line
from magwire.evidence.verify.reversal import reversed_differences
from magwire.field import FieldSource, GradientField, UniformField
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Section, Wire

Array = NDArray[np.float64]
GROUP = "consistency"
L, BEND, RADIUS = 0.1, 0.025, 3e-3
STUFF: dict[str, Any] = {
    "youngs_modulus": 3e6,
    "shear_modulus": 1e6,
    "density": 2000.0,
    "radius": 0.6e-3,
}
WIRE = Wire(
    (Section(0.07, **STUFF), Section(0.03, magnetization=(10e3, -15e3, 40e3), **STUFF)), NODES
)
FLUX = (1e-3, 6e-3, 4e-3)
GRADIENT = ((0.02, 0.03, 0.01), (0.03, -0.04, 0.02), (0.01, 0.02, 0.02))
FEED = 0.0404


def evidence(full: bool) -> Iterator[Line]:
    """Lines of the group; more meshes, the helix and twist in contact if ``full``."""
    yield from _marches(full)
    yield from _sensitivities("open space", 1e-5)
    yield from _sensitivities("half-circle", 1e-5)
    yield from _rigid_motion()
    yield from _units()
    yield from _reversal()
    yield from _meshes(full)
    yield from _paths()
    yield from _tree()
    yield from _conventions()


def _half_circle(radius: float = RADIUS) -> Lumen:
    return Lumen.half_circle(BEND, radius)


def _simulation(lumen: Lumen, wire: Wire = WIRE, wall: str = "surface") -> Simulation:
    return Simulation(wire, lumen, contact=Barrier(1e3, 1e-4, wall=wall))  # type: ignore[arg-type]


def _same(case: str, quantity: str, difference: float, tolerance: float, unit: str = "L") -> Line:
    """A line that says that two ways differ by nothing."""
    source = "the same by another way"
    return Line(GROUP, case, quantity, unit, 0.0, source, float(difference), tolerance)


def _apart(a: Array, b: Array) -> float:
    """Largest distance of nodes, in wire lengths."""
    return float(np.linalg.norm(a - b, axis=1).max()) / L


def _forces(case: str, a: Equilibrium, b: Equilibrium, tolerance: float) -> Line:
    size = float(np.abs(b.wall_force).max())
    difference = float(np.abs(a.wall_force - b.wall_force).max()) / size
    return _same(
        case, "largest difference of a wall force", difference, tolerance, "of the largest"
    )


def _marches(full: bool) -> Iterator[Line]:
    """Pushing with inertia at 1 mm/s, by equilibria, and an equilibrium found at once."""
    lumens = {"half-circle": _half_circle()}
    if full:
        lumens["helix"] = Lumen.helix(0.1 * L, 0.1 * L, 0.9 * L, RADIUS)
    for name, lumen in lumens.items():
        sim = _simulation(lumen)
        ends, forces = [], []
        for inertia in (True, False):
            march = March(
                sim.system, UniformField(FLUX), Feed(1e-3, 0.045), time_step=0.05, inertia=inertia
            )
            march.advance(march.steps)
            record = march.plant.record()
            ends.append(record.position)
            forces.append(record.tip_force)
        case = f"{name}, pushed 0.45 L"
        yield _same(case, "slow dynamics and quasi-static march", _apart(*ends), 1e-5)
        yield _same(
            case, "the same, force on the tip", abs(forces[0] / forces[1] - 1.0), 1e-4, "relative"
        )
        if name == "half-circle":  # in the helix there are other equilibria
            state = sim.equilibrium(0.045, FLUX)
            yield _same(
                case,
                "quasi-static march and one equilibrium",
                _apart(ends[1], state.positions),
                1e-6,
            )


@dataclass(frozen=True)
class _Setting:
    """Everything that an equilibrium depends on."""

    lumen: Lumen
    sections: tuple[Section, ...] = WIRE.sections
    flux: tuple[float, ...] = FLUX
    gradient: tuple[tuple[float, ...], ...] = GRADIENT
    feed: float = FEED
    twist: float = 0.2

    def equilibrium(self, start: Equilibrium | None = None) -> Equilibrium:
        sim = _simulation(self.lumen, Wire(self.sections, NODES))
        source: FieldSource = _Affine(np.array(self.flux), np.array(self.gradient))
        return sim.equilibrium(self.feed, source, start=start, twist=self.twist)

    def moved(self, wrt: Input, index: tuple[int, ...], step: float) -> _Setting:
        """With one input changed."""
        change: dict[str, Any]
        if wrt in ("feed", "twist"):
            change = {wrt: getattr(self, wrt) + step}
            return replace(self, **change)
        if wrt in ("field", "gradient"):
            name = "flux" if wrt == "field" else "gradient"
            value = np.array(getattr(self, name))
            value[index] += step
            change = {name: value}
            return replace(self, **change)
        sections = list(self.sections)
        own = np.array(getattr(sections[index[0]], wrt), dtype=np.float64)
        own[index[1:]] += step
        change = {wrt: tuple(own.tolist()) if own.ndim else float(own)}
        sections[index[0]] = replace(sections[index[0]], **change)
        return replace(self, sections=tuple(sections))


@dataclass(frozen=True)
class _Affine:
    """Any affine field; a change of one component need not be one that a magnet could make."""

    flux_density: Array
    gradient: Array
    affine: bool = True

    def at(self, points: Array) -> tuple[Array, Array]:
        gradient = np.tile(self.gradient, (len(points), 1, 1))
        return self.flux_density + points @ self.gradient.T, gradient


STEPS: dict[Input, float] = {
    "field": 2e-6,
    "gradient": 2e-4,
    "feed": 1e-6,
    "twist": 1e-3,
    "youngs_modulus": 30.0,
    "magnetization": 1.0,
    "radius": 2e-9,
}


def _sensitivities(where: str, tolerance: float) -> Iterator[Line]:
    lumen = Lumen.open_space() if where == "open space" else _half_circle()
    setting = _Setting(lumen)
    state = setting.equilibrium()
    for wrt, step in STEPS.items():
        derivative = state.sensitivity("positions", wrt=wrt)
        inputs = derivative.shape[2:]
        worst = 0.0
        for index in np.ndindex(*inputs):
            ends = [
                setting.moved(wrt, index, side * step).equilibrium(state).positions
                for side in (1.0, -1.0)
            ]
            quotient = (ends[0] - ends[1]) / (2.0 * step)
            worst = max(worst, float(np.abs(derivative[(..., *index)] - quotient).max()))
        yield _same(
            f"sensitivities, {where}", f"by {wrt} and differences",
            worst / float(np.abs(derivative).max()), tolerance, "of the largest",
        )  # fmt: skip


def _rigid_motion() -> Iterator[Line]:
    """Lumen, field and gravity turned and shifted together."""
    turn, shift = Rotation.from_rotvec([0.4, -1.1, 0.7]), np.array([0.03, -0.05, 0.02])
    w = np.linspace(0.0, np.pi, 200)
    line = BEND * np.column_stack((np.sin(w), 1.0 - np.cos(w), 0.1 * np.sin(w) ** 2))
    pull = np.array([2.0, -5.0, -7.0])
    matrix = np.array(GRADIENT)
    states = []
    for about, by in ((Rotation.identity(), 0.0 * shift), (turn, shift)):
        m = about.as_matrix()
        rows = (m @ matrix @ m.T).tolist()
        rows = [[0.5 * (rows[i][j] + rows[j][i]) for j in range(3)] for i in range(3)]
        source = GradientField(tuple(m @ FLUX), rows, tuple(by))  # type: ignore[arg-type]
        lumen = Lumen.through(about.apply(line) + by, RADIUS)
        sim = Simulation(_axial(), lumen, gravity=m @ pull)
        state = sim.equilibrium(FEED, source)
        back = about.inv()
        states.append(
            replace(
                state,
                positions=back.apply(state.positions - by),
                wall_force=back.apply(state.wall_force),
            )
        )
    yield _same("turned and shifted", "positions", _apart(*(s.positions for s in states)), 1e-8)
    yield _forces("turned and shifted", states[1], states[0], 1e-6)


def _axial() -> Wire:
    """Round and magnetised along its axis, so that it does not matter how the guide turns it."""
    magnet = Section(0.03, magnetization=(0.0, 0.0, 40e3), **STUFF)
    return Wire((Section(0.07, **STUFF), magnet), NODES)


def _units() -> Iterator[Line]:
    """All lengths times a factor, the wall's stiffness as E: the paper's numbers stay (P-17)."""
    results = []
    for s in (1.0, 10.0, 0.01):
        parts = tuple(
            replace(part, length=s * part.length, radius=s * part.radius) for part in WIRE.sections
        )
        barrier = Barrier(1e3, s * 0.1e-3)
        sim = Simulation(
            Wire(parts, NODES), Lumen.half_circle(s * BEND, s * RADIUS), contact=barrier
        )
        state = sim.equilibrium(s * FEED, FLUX)
        results.append(
            replace(state, positions=state.positions / s, wall_force=state.wall_force / s**2)
        )
    for name, state in (("1 m", results[1]), ("1 mm", results[2])):
        case = f"wire of 100 mm and of {name}"
        yield _same(case, "positions", _apart(state.positions, results[0].positions), 1e-8)
        yield _forces(case, state, results[0], 1e-6)


def _reversal() -> Iterator[Line]:
    energy, force = reversed_differences()
    case = "bent and twisted wire read from its other end"
    yield _same(case, "energy", energy, 1e-12, "relative")
    yield _same(case, "forces on the nodes", force, 1e-10, "of the largest")


def _meshes(full: bool) -> Iterator[Line]:
    """Order in space, and the limit from coarse meshes against that from fine ones (Richardson)."""
    edges = np.array([50, 100, 200, 400, 800] if full else [50, 100, 200, 400])
    source = GradientField(FLUX, tuple(map(tuple, GRADIENT)))  # type: ignore[arg-type]
    tips, forces = [], []
    for n in edges:
        wire = replace(WIRE, nodes=int(n) + 1)
        tips.append(_simulation(Lumen.open_space(), wire).equilibrium(L, source).tip / L)
        barrier = Barrier(1e3, 0.1e-3)
        sim = Simulation(wire, _half_circle(), contact=barrier)
        forces.append(float(np.linalg.norm(sim.equilibrium(0.04, FLUX).wall_force, axis=1).sum()))
    limits = [(4.0 * fine - coarse) / 3.0 for coarse, fine in pairwise(tips)]
    steps = [float(np.linalg.norm(fine - coarse)) for coarse, fine in pairwise(tips)]
    order = -float(np.polyfit(np.log(edges[:-1]), np.log(steps), 1)[0])
    for i, axis in enumerate("xyz"):
        yield Line(
            GROUP, f"open space, N → ∞ from {edges[0]} and {edges[1]} edges", f"tip {axis}", "L",
            float(limits[-1][i]), f"the same from {edges[-2]} and {edges[-1]} edges",
            float(limits[0][i]), 1e-4, order=order, expected_order=2.0,
        )  # fmt: skip
    yield Line(
        GROUP, "half-circle, 100 edges", "sum of wall forces", "N", forces[-1],
        f"the same with {edges[-1]} edges", forces[1], 0.01, relative=True,
    )  # fmt: skip


def _paths() -> Iterator[Line]:
    """The field put on at once or in fifty steps; the wire laid in or fed in fifty steps."""
    for name, lumen, feed in (("open space", Lumen.open_space(), L), ("half-circle", None, FEED)):
        sim = _simulation(_half_circle() if lumen is None else lumen)
        once = sim.equilibrium(feed, FLUX)
        state = sim.equilibrium(feed)
        for part in np.linspace(0.0, 1.0, 51)[1:]:
            state = sim.equilibrium(feed, part * np.array(FLUX), start=state)
        yield _same(
            name, "field in one step and in fifty", _apart(once.positions, state.positions), 1e-8
        )
        state = sim.equilibrium(0.1 * feed, FLUX)
        for part in np.linspace(0.1, 1.0, 51)[1:]:
            state = sim.equilibrium(part * feed, FLUX, start=state)
        yield _same(name, "fed at once and in fifty", _apart(once.positions, state.positions), 1e-8)


def _tree() -> Iterator[Line]:
    tube = _half_circle()
    states = [_simulation(x).equilibrium(FEED, FLUX) for x in (tube, Lumen.tree({"only": tube}))]
    case = "tree with one branch and tube"
    yield _same(case, "positions", _apart(*(s.positions for s in states)), 1e-10)
    yield _forces(case, states[0], states[1], 1e-8)


def _conventions() -> Iterator[Line]:
    """The wall keeps off the surface by R, or the axis by R - r (P-12)."""
    narrower = RADIUS - WIRE.radius
    states = [
        _simulation(_half_circle(radius), wall=wall).equilibrium(FEED, FLUX)
        for radius, wall in ((RADIUS, "surface"), (narrower, "centreline"))
    ]
    case = "surface in R and axis in R - r"
    yield _same(case, "positions", _apart(*(s.positions for s in states)), 1e-8)
    yield _forces(case, states[0], states[1], 1e-6)
