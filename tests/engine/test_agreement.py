"""Two ways to the same number."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.field import GradientField, UniformField
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Section, Wire
from wires import L, lumen, paper_wire, passive


@pytest.mark.parametrize("name", ["half-circle", "helix"])
def test_quasi_static_march_and_slow_dynamics(name: str) -> None:
    dynamic = passive(name)
    static = passive(name, time_step=0.1, inertia=False)
    assert static.status == "CONVERGED"
    np.testing.assert_allclose(static.positions, dynamic.positions, atol=1e-5 * L)
    np.testing.assert_allclose(static.F, dynamic.F, atol=1e-3 * dynamic.peak)


@pytest.mark.parametrize("push", [0.2, 0.3, 0.5, 0.7])
def test_equilibrium_and_slow_dynamics(push: float) -> None:
    run = passive("half-circle")
    sim = Simulation(paper_wire(), lumen("half-circle"), contact=Barrier(1e3, 1e-4, wall="centreline"))
    i = int(np.abs(run.X - push).argmin())
    state = sim.equilibrium(run.X[i] * L)
    assert state.stable
    np.testing.assert_allclose(state.positions, run.positions[i], atol=1e-5 * L)
    assert state.tip_force / sim.system.scales.force == pytest.approx(run.F[i], rel=1e-4)


@pytest.mark.parametrize("push", [0.3, 0.5])
def test_surface_of_a_wide_tube_and_centreline_of_a_narrow_one(push: float) -> None:
    """The wall keeps off the surface by R, or the axis by R - r (P-12)."""
    states = []
    for radius, wall in ((3e-3, "surface"), (2.4e-3, "centreline")):
        barrier = Barrier(1e3, 1e-4, wall=wall)  # type: ignore[arg-type]
        sim = Simulation(paper_wire(), Lumen.half_circle(0.025, radius), contact=barrier)
        states.append(sim.equilibrium(push * L, [0.0, 4e-3, 2e-3]))
    first, second = states
    assert first.tip_force > 0.0
    np.testing.assert_allclose(first.positions, second.positions, atol=1e-9 * L)
    size = np.abs(second.wall_force).max()
    np.testing.assert_allclose(first.wall_force, second.wall_force, atol=1e-8 * size)
    np.testing.assert_allclose(first.clearance, second.clearance, atol=1e-12)


def test_two_runs_are_the_same_to_the_last_bit() -> None:
    def run() -> dict[str, np.ndarray]:
        sim = Simulation(paper_wire(), lumen("helix"), field=UniformField((1e-3, 2e-3, 3e-3)))
        data = sim.run(Feed(1e-3, 0.03), time_step=0.05).dataset
        return {name: data[name].to_numpy() for name in data if name != "wall_time"}

    first, second = run(), run()
    assert len(first["time"] if "time" in first else first["feed"]) > 100
    for name, values in first.items():
        np.testing.assert_array_equal(values, second[name], err_msg=name)


def test_one_section_or_the_same_in_three() -> None:
    whole = paper_wire()
    body, tip = whole.sections

    def part(section: Section, length: float) -> Section:
        return Section(
            length,
            section.youngs_modulus,
            section.shear_modulus,
            section.radius,
            section.density,
            magnetization=section.magnetization,
        )

    pieces = (part(body, 0.0333), part(body, 0.0617), part(tip, 0.003), part(tip, 0.002))
    split = Wire(pieces, whole.nodes)
    field = [1e-3, 5e-3, 2e-3]
    states = [
        Simulation(wire, lumen("half-circle")).equilibrium(0.05, field) for wire in (whole, split)
    ]
    np.testing.assert_allclose(states[0].positions, states[1].positions, atol=1e-8 * L)


def test_uniform_field_and_gradient_field_without_gradient() -> None:
    flux = (1e-3, 5e-3, 2e-3)
    none = GradientField(flux, ((0.0,) * 3,) * 3)
    sim = Simulation(paper_wire(), lumen("half-circle"))
    np.testing.assert_array_equal(
        sim.equilibrium(0.05, UniformField(flux)).positions, sim.equilibrium(0.05, none).positions
    )
    np.testing.assert_array_equal(
        sim.equilibrium(0.05, UniformField(flux)).positions, sim.equilibrium(0.05, flux).positions
    )


def test_origin_of_a_gradient_field_is_only_a_choice() -> None:
    matrix = np.array([[0.2, 0.3, 0.1], [0.3, -0.4, 0.2], [0.1, 0.2, 0.2]])
    rows = tuple(map(tuple, matrix))
    moved = np.array([0.02, -0.01, 0.03])
    flux = np.array([1e-3, 5e-3, 2e-3])
    sim = Simulation(paper_wire(), lumen("half-circle"))
    here = sim.equilibrium(0.05, GradientField(tuple(flux), rows))
    there = sim.equilibrium(0.05, GradientField(tuple(flux + matrix @ moved), rows, tuple(moved)))
    np.testing.assert_allclose(here.positions, there.positions, atol=1e-9 * L)


@pytest.mark.parametrize("scale", [0.01, 100.0])
def test_similar_wires_do_the_same(scale: float) -> None:
    """All lengths times a factor, the wall's stiffness as E: the paper's numbers stay (P-17)."""
    results = []
    for s in (1.0, scale):
        wire = Wire.uniform(
            s * L, s * 0.6e-3, 3e6, 1e6, 2000.0, 100, magnetized_tip=s * 5e-3, magnetization=128e3
        )
        tube = Lumen.half_circle(0.25 * s * L, 0.03 * s * L)
        barrier = Barrier(1e3, s * 0.1e-3, wall="centreline")
        sim = Simulation(wire, tube, contact=barrier)
        state = sim.equilibrium(0.5 * s * L, 10.0 * sim.system.scales.flux_density * np.eye(3)[1])
        results.append((state.tip / (s * L), state.tip_force / sim.system.scales.force))
    np.testing.assert_allclose(results[0][0], results[1][0], atol=1e-7)
    assert results[0][1] == pytest.approx(results[1][1], rel=1e-6)
