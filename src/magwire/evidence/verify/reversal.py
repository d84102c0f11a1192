"""The energy of a wire that is read from its other end (group 7)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.arrays import Field, Motion, Mouth, Rod, State
from magwire.kernels.assembly import assemble
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Section, Wire

Array = NDArray[np.float64]
L = 0.1
FLIPPED = np.array([1.0, -1.0, -1.0])  # m1 stays; m2 and the tangent change their sign


def reversed_differences() -> tuple[float, float]:
    """Relative difference of energy, and of the forces on the nodes to the largest one.

    A bent and twisted wire in a uniform field. Its last edge carries no magnet, as the ghost edge
    in front of the first one carries none; no edge stretches.
    """
    stuff: dict[str, Any] = {
        "youngs_modulus": 3e6,
        "shear_modulus": 1e6,
        "density": 2000.0,
        "radius": 0.6e-3,
    }
    sections = (
        Section(0.05, **stuff, rest_curvature=(8.0, -5.0)),
        Section(0.04, **stuff, magnetization=(10e3, -15e3, 40e3)),
        Section(0.01, **{**stuff, "radius": 0.5e-3}),
    )
    sim = Simulation(Wire(sections, 60), Lumen.open_space())
    point = sim.equilibrium(L, [1e-3, 6e-3, 4e-3], twist=2.0).point
    system, state = point.system, point.state
    rod = system.rod._replace(stretch=0.0 * system.rod.stretch)
    back = rod._replace(
        bend=rod.bend[::-1].copy(),
        twist=rod.twist[::-1].copy(),
        rest_curvature=rod.rest_curvature[::-1] * FLIPPED[:2],
        moment=rod.moment[::-1] * FLIPPED,
        rest=rod.rest[::-1].copy(),
    )
    other = system.new_state()
    other.q[:] = state.q[::-1]
    other.q[:-1, 3] = -state.q[-2::-1, 3]
    other.tangent[:], other.length[:] = -state.tangent[::-1], state.length[::-1]
    other.director[:] = state.director[::-1]
    other.twist[1:-1] = state.twist[-2:0:-1]
    work, answers = system.new_work(), []
    for which, where in ((rod, state), (back, other)):
        answers.append(_derivatives(sim, which, point.field, where, work.target))
    (energy, force), (same, turned) = answers
    largest = float(np.abs(force).max())
    return abs(same / energy - 1.0), float(np.abs(turned[::-1] - force).max()) / largest


def _derivatives(
    sim: Simulation, rod: Rod, field: Field, state: State, target: Array
) -> tuple[float, Array]:
    """Energy and forces of the whole wire, ghost node and all."""
    system, work = sim.system, sim.system.new_work()
    model = system.new_terms(field, rod=rod)
    still = Motion(0.0, target)
    energy, _ = assemble(model, state, Mouth(1, 1.0), still, work.gradient, work.no_band)
    return float(energy), work.gradient[:, :3].copy()
