"""Group 4: vibrations of a clamped magnetic wire, and the balances of its time steps (P-14).

The wire is magnetised along its whole length, b = M B L^2/EI is positive in a field along it.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import NODES, Curve, Line
from magwire.evidence.verify.references import chain, vibration
from magwire.evidence.verify.swing import Swing, let_go
from magwire.evidence.verify.tangent import natural_frequencies
from magwire.field import FieldSource, GradientField, UniformField
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]
GROUP = "dynamics"
L, RADIUS = 0.1, 0.4e-3
YOUNG, SHEAR = 3e6, 1e6
WIRE = Wire.uniform(L, RADIUS, YOUNG, SHEAR, 2000.0, NODES, magnetized_tip=L, magnetization=20e3)
UNIT = L**2 * sqrt(WIRE.body.density * WIRE.body.area / WIRE.bending_stiffness)
"""Of time, L^2 sqrt(rho A/EI) [s]."""
GRADIENT = ((2e-3, 3e-3, 1e-3), (3e-3, -4e-3, 2e-3), (1e-3, 2e-3, 2e-3))
BEAM = "beam equation of a magnet in a field along it, characteristic equation"


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; more fields and a finer mesh of times if ``full``."""
    fields = (-2.4, -2.0, -1.0, 0.0, 1.0, 5.0, 20.0, 100.0) if full else (-2.0, 0.0, 5.0)
    for b in fields:
        yield from _frequencies(b)
    yield from _waves()
    for b in fields if full else (-2.0, 0.0, 5.0):
        yield from _swinging(b)
    yield from _damping()
    yield from _order_in_time()
    if full:
        yield from _large_swing()
    yield from _energy()
    yield from _momentum()


def _flux(b: float, degrees: float = 0.0) -> tuple[float, float, float]:
    size = b * WIRE.bending_stiffness / (WIRE.moment_per_length * L**2)
    angle = np.radians(degrees)
    return (float(size * np.cos(angle)), float(size * np.sin(angle)), 0.0)


def _bent(b: float, across: float, damping: float = 0.0) -> Equilibrium:
    """The wire in a field b along it and a little across it."""
    sim = Simulation(WIRE, Lumen.open_space(), damping=damping)
    return sim.equilibrium(L, np.add(_flux(b), _flux(across, 90.0)))


def _case(b: float) -> str:
    if b == 0.0:
        return "no field"
    return f"field {'along' if b > 0.0 else 'against'} the magnet, |b| = {abs(b):g}"


def _frequencies(b: float) -> Iterator[Line]:
    """Each bending frequency comes twice, once for either plane."""
    found, _ = natural_frequencies(_bent(b, 0.0), 6)
    for k, expected in enumerate(vibration.frequencies(b, 3)):
        value = float(found[2 * k]) * UNIT
        yield Line(
            GROUP, _case(b), f"natural frequency {k + 1}", "(EI/ρA)^½/L²", float(expected), BEAM,
            value, 0.01, relative=True,
        )  # fmt: skip


def _waves() -> Iterator[Line]:
    """The lowest modes of twist and of stretch, clamped and free: a quarter of a wave."""
    body = WIRE.body
    frequencies, modes = natural_frequencies(_bent(0.0, 0.0), 4 * NODES - 8)
    own = np.abs(modes).max(axis=1)  # by x, y, z, twist angle
    for name, column, modulus in (
        ("twist", 3, SHEAR),
        ("stretch", 0, YOUNG),
    ):
        others = np.delete(own, column, axis=1).max(axis=1)
        lowest = frequencies[own[:, column] > 1e3 * others].min()
        speed = sqrt(modulus / body.density)
        yield Line(
            GROUP, f"wave of {name}", "natural frequency 1", "(modulus/ρ)^½/L", 0.5 * pi,
            "wave equation, one end clamped and one free", float(lowest) * L / speed, 0.01,
            relative=True,
        )  # fmt: skip


def _rate(swing: Swing, skip: int) -> tuple[float, float]:
    """Frequency and rate of decay of the tip [1/s] in its slowest mode.

    Two modes obey a recursion of four terms (Prony); the others have died out.
    """
    y = swing.positions[skip:, -1, 1]
    before = np.column_stack([y[3 - k : len(y) - 1 - k] for k in range(4)])
    terms = np.linalg.lstsq(before, y[4:], rcond=None)[0]
    roots = np.roots(np.concatenate(([1.0], -terms))).astype(complex)
    rate = np.log(roots[np.argmax(np.abs(roots))]) / swing.time[1]
    return float(abs(rate.imag)), float(-rate.real)


def _swing(b: float, parts: int, periods: int, damping: float = 0.0) -> Swing:
    """Let a slightly bent wire go; ``parts`` steps a period."""
    period = 2.0 * pi / float(vibration.frequencies(b, 1)[0]) * UNIT
    compliance = float(vibration.tip_after_release(0.0, b, 0.0))
    start = _bent(b, 0.003 / compliance, damping)  # near buckling, a weak field bends it far
    return let_go(start, UniformField(_flux(b)), period / parts, periods * parts)


def _swinging(b: float) -> Iterator[Line | Curve]:
    """Time steps of a hundredth of the period: frequency, and the decay that the steps cost."""
    parts, expected = 100, float(vibration.frequencies(b, 1)[0])
    swing = _swing(b, parts, 4)
    frequency, decay = _rate(swing, parts)
    _, euler = vibration.implicit_euler(expected, 0.0, 2.0 * pi / expected / parts)
    case = f"{_case(b)}, let go, dt = T/{parts}"
    yield Line(
        GROUP, case, "frequency of the swing", "(EI/ρA)^½/L²", expected, BEAM, frequency * UNIT,
        0.01, relative=True,
    )  # fmt: skip
    yield Line(
        GROUP, case, "decay by implicit Euler", "(EI/ρA)^½/L²", euler,
        "the method's factor for an oscillator, in closed form", decay * UNIT, 0.01, relative=True,
    )  # fmt: skip


def _damping() -> Iterator[Line | Curve]:
    mu, parts = 1.0, np.array([100, 200, 400])
    rates = [_rate(_swing(0.0, int(n), 3, mu), int(n))[1] for n in parts]
    order = float(np.log2((rates[0] - rates[1]) / (rates[1] - rates[2])))
    yield Line(
        GROUP, f"damping μ = {mu:g}/s, dt → 0 from T/100, T/200, T/400", "rate of decay", "1/s",
        0.5 * mu, "damped oscillator: exp(-μt/2)", 2.0 * rates[2] - rates[1], 0.01, relative=True,
        order=order, expected_order=1.0,
    )  # fmt: skip


def _order_in_time() -> Iterator[Line | Curve]:
    """The tip after half a period, of a wire that a field across it held before."""
    b, mu, across = 2.0, 1.0, 0.01
    period = 2.0 * pi / float(vibration.frequencies(b, 1)[0]) * UNIT
    parts = np.array([200, 400, 800, 1600])
    start = _bent(b, across, mu)
    swings = [let_go(start, UniformField(_flux(b)), period / n, n // 2) for n in parts]
    tips = np.array([swing.positions[-1, -1, 1] for swing in swings]) / (across * L)
    exact = float(vibration.tip_after_release(0.5 * period / UNIT, b, mu * UNIT))
    order = -float(np.polyfit(np.log(parts), np.log(np.abs(tips - exact)), 1)[0])
    source = "sum over six modes of the beam equation"
    yield Line(
        GROUP, "small swing, b = 2, dt → 0 from T/1600", "tip after half a period", "ML³/EI B",
        exact, source, 2.0 * tips[-1] - tips[-2], 1e-3, relative=True, order=order,
        expected_order=1.0,
    )  # fmt: skip
    time = np.linspace(0.0, 0.5 * period, 200)
    yield Curve(
        "Small swing, dt = T/1600",
        "t / T",
        "tip over field across",
        {
            "modes": (
                time / period,
                vibration.tip_after_release(time / UNIT, b, mu * UNIT),
                "line",
            ),
            "magwire": (
                swings[-1].time[::25] / period,
                swings[-1].positions[::25, -1, 1] / (across * L),
                "points",
            ),
        },
    )


def _large_swing() -> Iterator[Line]:
    """From a field at 90 degrees into one at -45, against a chain of rigid links."""
    mu, time = 1.0, 0.6 * UNIT
    angle = np.radians(-45.0)
    fields = np.array([0.0, 3.0]), np.array([np.cos(angle), np.sin(angle)])
    links = (10, 20)
    coarse, fine = (chain.swing(*fields, mu * UNIT, time / UNIT, n)[1] for n in links)
    expected = (4.0 * fine - coarse) / 3.0
    sim = Simulation(WIRE, Lumen.open_space(), damping=mu)
    start = sim.equilibrium(L, _flux(3.0, 90.0))
    steps = np.array([400, 800, 1600])
    source = UniformField(_flux(1.0, -45.0))
    tips = np.array([let_go(start, source, time / n, n).positions[-1, -1, :2] for n in steps]) / L
    value = 2.0 * tips[2] - tips[1]
    moved = [float(np.linalg.norm(tips[i + 1] - tips[i])) for i in (0, 1)]
    order = float(np.log2(moved[0] / moved[1]))
    for axis, name in enumerate("xy"):
        yield Line(
            GROUP, f"large swing, dt → 0 from t/{steps[-1]}", f"tip {name}", "L",
            float(expected[axis]), "chains of 10 and 20 rigid links, extrapolated (LSODA)",
            float(value[axis]), 1e-3, order=order, expected_order=1.0,
        )  # fmt: skip


def _energy() -> Iterator[Line]:
    """In a field that does not change, without damping, time steps may only lose energy."""
    cases: dict[str, tuple[Wire, tuple[float, float, float], int]] = {
        "swing in a plane": (WIRE, _flux(1.0, -45.0), 400),
        "swing in space, twisting": (_mixed(), (0.4e-3, 0.5e-3, -0.6e-3), 400),
        "the same, dt = T/10": (_mixed(), (0.4e-3, 0.5e-3, -0.6e-3), 30),
    }
    period = 2.0 * pi / 3.516 * UNIT
    for name, (wire, flux, steps) in cases.items():
        sim = Simulation(wire, Lumen.open_space(), damping=0.0)
        start = sim.equilibrium(L, _flux(3.0, 90.0))
        energy = let_go(start, UniformField(flux), 3.0 * period / steps, steps).energy
        growth = max(0.0, float(np.diff(energy).max())) / float(np.ptp(energy))
        yield Line(
            GROUP, name, "largest growth of energy in a step, of all that is lost", "", 0.0,
            "energy does not grow without work from outside", growth, 1e-9,
        )  # fmt: skip


def _mixed() -> Wire:
    """Magnetised along and across, so that it twists."""
    magnet = (8e3, -6e3, 20e3)
    return Wire.uniform(L, RADIUS, 3e6, 1e6, 2000.0, NODES, magnetized_tip=L, magnetization=magnet)


def _momentum() -> Iterator[Line]:
    """Change of momentum against the impulse of guide, weight, field gradient and damping."""
    mu, gravity = 2.0, np.array([0.3, -0.2, -0.5])
    gradient = np.array(GRADIENT)
    field: FieldSource = GradientField((1e-4, 2e-4, 1e-4), GRADIENT)
    sim = Simulation(WIRE, Lumen.open_space(), damping=mu, gravity=gravity)
    swing = let_go(sim.equilibrium(L, _flux(3.0, 90.0)), field, UNIT / 200.0, 400)
    step, held = float(swing.time[1]), swing.held
    mass = sim.system.mesh.mass[held:]
    momentum = np.einsum("n,tnc->tc", mass, swing.velocities[:, held:])
    edges = np.diff(swing.positions, axis=1)
    tangents = edges / np.linalg.norm(edges, axis=2, keepdims=True)
    moments = WIRE.moment_per_length * np.diff(sim.system.mesh.station)[:, None] * tangents
    pull = (moments @ gradient)[:, held - 1 :].sum(axis=1)
    impulse = swing.guide_force + mass.sum() * gravity + pull - mu * momentum
    change = np.diff(momentum, axis=0)
    total = step * np.cumsum(impulse[1:], axis=0)
    worst = float(np.abs(np.cumsum(change, axis=0) - total).max() / np.abs(momentum).max())
    yield Line(
        GROUP, "swing under weight and field gradient", "momentum not accounted for", "", 0.0,
        "Newton's second law for the whole wire", worst, 1e-6,
    )  # fmt: skip
