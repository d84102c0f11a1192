"""Pushing a wire into a bend without friction takes EI kappa^2/2 (Bigoni and others)."""

from __future__ import annotations

import pytest

from magwire.contact import Barrier
from magwire.engine.statics import Equilibrium
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import assemble
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from tables import critical_load
from wires import L, paper_wire

BEND = 0.25 * L


def simulation() -> Simulation:
    """The paper's wire in a tube so narrow that it follows the circle."""
    tight = Barrier(1e4, 0.02e-3, wall="centreline")
    return Simulation(paper_wire(), Lumen.half_circle(BEND, 0.1e-3), contact=tight)


def energy(state: Equilibrium) -> float:
    """In EI/L."""
    point = state.point
    system, work = point.system, point.system.new_work()
    model = system.new_terms(point.field)
    still = Motion(0.0, work.target)
    return float(assemble(model, point.state, point.mouth, still, work.gradient, work.no_band)[0])


def test_work_of_insertion() -> None:
    sim = simulation()
    first = sim.equilibrium(0.03)
    last = sim.equilibrium(0.06)
    work = (energy(last) - energy(first)) / (last.feed - first.feed) * L  # EI/L^2
    expected = critical_load("frictionless insertion") * (L / BEND) ** 2
    assert work == pytest.approx(expected, rel=0.01)
