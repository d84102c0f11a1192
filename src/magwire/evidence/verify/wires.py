"""Wires of the cases, how they are loaded, and how a load or an order is found."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.evidence import NODES, Line
from magwire.evidence.verify.references.pendulum import Bent
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import assemble
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]

L = 0.1
"""Length of all wires [m]."""
STUFF: dict[str, Any] = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "density": 2000.0}
CLOSE = 1e-3
"""How near angles [rad] and places [L] must come to their references."""
PRECISION = 1e-5
"""To which a critical load is found, as part of it."""


def magnet(nodes: int = NODES, part: float = 1.0, **options: Any) -> Wire:
    """A wire of which the distal part is magnetised."""
    settings = {"magnetized_tip": part * L, "magnetization": 20e3, "radius": 0.4e-3, **options}
    return Wire.uniform(length=L, nodes=nodes, **STUFF, **settings)


def flux(wire: Wire, b: float, degrees: float = 0.0) -> Array:
    """Flux density [T] of b = M B L^2/EI at an angle to the guide, in the xy plane."""
    size = b * wire.bending_stiffness / (wire.moment_per_length * wire.length**2)
    angle = np.radians(degrees)
    return size * np.array([np.cos(angle), np.sin(angle), 0.0])


def free(wire: Wire, **options: Any) -> Simulation:
    """The wire in open space."""
    return Simulation(wire, Lumen.open_space(), **options)


def pulled(wire: Wire, force: ArrayLike, *, start: Equilibrium | None = None) -> Equilibrium:
    """The wire in open space under a dead force on its tip, shape (2,) or (3,) [EI/L^2]."""
    load = np.zeros(3)
    load[: np.size(force)] = force
    load *= wire.bending_stiffness / wire.length**2
    return free(wire, tip_load=load).equilibrium(wire.length, start=start)


def tip(state: Equilibrium) -> tuple[float, float, float]:
    """Angle [rad] and place [L] of the tip of a wire in the xy plane."""
    along, across, _ = state.tip_direction
    length = state.point.system.wire.length
    x, y, _ = state.tip / length
    return float(np.arctan2(across, along)), float(x), float(y)


def critical(stable: Callable[[float], bool], expected: float) -> float:
    """Where stability ends, between 10 percent below and above what is expected; NaN if not."""
    low, high = 0.9 * expected, 1.1 * expected
    if not stable(low) or stable(high):
        return float("nan")
    while high - low > PRECISION * expected:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return 0.5 * (low + high)


def crossing(stiffness: Callable[[float], float], expected: float) -> float:
    """Load at which a stiffness falls to zero, near the expected one; NaN if it does not."""
    low, high = 0.9 * expected, 1.1 * expected
    if not stiffness(low) > 0.0 > stiffness(high):
        return float("nan")
    return float(brentq(stiffness, low, high, xtol=PRECISION * expected))


def order(sizes: ArrayLike, errors: ArrayLike) -> float:
    """Slope of log(error) over log(size), the order of convergence; NaN if an error is none."""
    if not np.all(np.isfinite(errors) & (np.asarray(errors) > 0.0)):
        return float("nan")
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def compare(group: str, case: str, state: Equilibrium, exact: Bent, source: str) -> Iterator[Line]:
    """Tip of a wire in the xy plane, next to the reference: angle and place."""
    angle, x, y = tip(state)
    for quantity, unit, reference, value in (
        ("tip angle", "rad", exact.angle, angle),
        ("tip x", "L", exact.x, x),
        ("tip y", "L", exact.y, y),
    ):
        yield Line(group, case, quantity, unit, reference, source, value, CLOSE)


def guide_load(state: Equilibrium) -> tuple[Array, Array]:
    """Force of the guide on the wire [EI/L^2], and its torque about the origin [EI/L]."""
    point = state.point
    system, work = point.system, point.system.new_work()
    model = system.new_terms(point.field)
    still = Motion(0.0, work.target)
    assemble(model, point.state, point.mouth, still, work.gradient, work.no_band)
    first = point.mouth.held - 1  # the guide holds an edge: two nodes, one angle
    held = work.gradient[first : first + 2]
    torque = np.cross(point.state.q[first : first + 2, :3], held[:, :3]).sum(axis=0)
    torque += held[0, 3] * point.state.tangent[first]  # turning an edge turns its frame along
    return held[:, :3].sum(axis=0), torque
