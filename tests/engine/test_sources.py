"""Fields that are not linear in space: sampled again until the wire stays where it was sampled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from magwire.engine.feed import Feed
from magwire.engine.statics import Equilibrium
from magwire.errors import ConvergenceError
from magwire.evidence.verify.references.dipole import Dipole
from magwire.field import FieldSource, GradientField, UniformField
from magwire.kernels.hinge import material_frame
from magwire.operate import March
from magwire.wire import Wire, lay_out
from wires import L, free, paper_wire

NEAR = Dipole((0.12, 0.05, 0.01), (0.5, 1.0, -0.25))
FAR = Dipole((0.20, 0.10, 0.02), (10.0, 20.0, -4.0))


def wire() -> Wire:
    magnetization = (20e3, -30e3, 60e3)
    return Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, 60, magnetized_tip=0.03, magnetization=magnetization
    )


def test_the_test_source_is_a_magnetic_field() -> None:
    assert isinstance(NEAR, FieldSource)
    points = np.random.default_rng(0).uniform(-0.03, 0.03, (20, 3))
    _, gradient = NEAR.at(points)
    step = 1e-5
    quotient = [
        (NEAR.at(points + step * axis)[0] - NEAR.at(points - step * axis)[0]) / (2.0 * step)
        for axis in np.eye(3)
    ]
    np.testing.assert_allclose(gradient, np.stack(quotient, axis=-1), rtol=1e-4, atol=1e-6)
    np.testing.assert_allclose(np.trace(gradient, axis1=1, axis2=2), 0.0, atol=1e-12)


def energy(state: Equilibrium, source: FieldSource, shift: np.ndarray) -> float:
    """-m.B(x) over all edges past the mouth, the wire shifted as it is [J]."""
    point, held = state.point, state.point.mouth.held
    moment = lay_out(point.system.wire).moment
    total = 0.0
    for i in range(held, len(point.state.length)):
        t = tuple(point.state.tangent[i])
        m1, m2 = material_frame(tuple(point.state.director[i]), t, point.state.q[i, 3])
        middle = 0.5 * (state.positions[i - 1] + state.positions[i]) + shift
        flux, _ = source.at(middle[None])
        total -= float(moment[i - 1] @ np.array([m1, m2, t]) @ flux[0])
    return total


@pytest.mark.parametrize("source", [NEAR, FAR], ids=["near", "far"])
def test_pull_of_a_magnet_against_its_energy(source: Dipole) -> None:
    """What the guide holds against is the slope of -m.B when the whole wire is shifted."""
    from magwire.kernels.arrays import Motion
    from magwire.kernels.assembly import assemble

    state = free(wire()).equilibrium(0.08, source)
    assert state.stable
    point = state.point
    system, work = point.system, point.system.new_work()
    model = system.new_terms(point.field)
    still = Motion(0.0, work.target)
    assemble(model, point.state, point.mouth, still, work.gradient, work.no_band)
    held = work.gradient[:, :3].sum(axis=0) * system.scales.force  # by the guide
    step = 1e-5
    slope = [
        (energy(state, source, step * axis) - energy(state, source, -step * axis)) / (2.0 * step)
        for axis in np.eye(3)
    ]
    np.testing.assert_allclose(held, slope, rtol=1e-5, atol=1e-5 * np.abs(slope).max())
    free_rows = work.gradient[point.mouth.held + 1 :]
    assert np.abs(free_rows).max() < 1e-6


def test_from_far_away_a_magnet_is_a_linear_field() -> None:
    """The farther away, the better: with the distance squared, at the same field."""
    middle = np.array([[0.065, 0.0, 0.0]])
    errors = []
    for distance in (1.0, 2.0, 4.0):
        moment = 2e3 * distance**3 * np.array([1.0, 2.0, -0.5])
        source = Dipole(distance * np.array([1.0, 0.5, 0.2]), moment)
        flux, gradient = (value[0] for value in source.at(middle))
        linear = GradientField(tuple(flux), tuple(map(tuple, gradient)), tuple(middle[0]))
        sim = free(wire())
        exact, approximate = sim.equilibrium(0.08, source), sim.equilibrium(0.08, linear)
        assert np.linalg.norm(exact.tip - [0.08, 0.0, 0.0]) > 0.02 * L
        errors.append(np.linalg.norm(exact.tip - approximate.tip))
    assert errors[0] < 1e-3 * L
    assert errors[1] < 0.35 * errors[0]
    assert errors[2] < 0.35 * errors[1]


@pytest.mark.parametrize("source", [NEAR, FAR], ids=["near", "far"])
def test_dynamics_arrive_at_the_equilibrium(source: Dipole) -> None:
    """Fed at the paper's speed, then left alone."""
    sim = free(wire(), damping=5.0)
    course = Feed.table([0.0, 2.0, 2.1, 8.0], [0.03, 0.03, 0.0, 0.0])
    march = March(sim.system, source, course, time_step=0.05)
    assert march.advance(10**6), march.plant.message
    reached = march.plant.record()
    state = sim.equilibrium(reached.feed, source)
    np.testing.assert_allclose(reached.position, state.positions, atol=1e-4 * L)
    np.testing.assert_allclose(reached.flux_density, source.at(state.tip[None])[0][0], rtol=1e-3)


def test_an_affine_field_may_pretend_not_to_be() -> None:
    """Sampled once or again and again: the same steps."""

    class Pretending(UniformField):
        @property
        def affine(self) -> bool:
            return False

    field = (1e-3, 4e-3, 2e-3)
    runs = []
    for source in (UniformField(field), Pretending(field)):
        march = March(free(paper_wire()).system, source, Feed(0.01, 0.05), time_step=0.02)
        assert march.advance(10**6)
        runs.append(march.plant.record())
    np.testing.assert_allclose(runs[0].position, runs[1].position, atol=1e-9 * L)
    assert runs[0].totals.steps == runs[1].totals.steps
    assert runs[0].totals.newton_iterations == runs[1].totals.newton_iterations


BENDING = Dipole((0.05, 0.033, 0.002), (4.0, 0.5, -0.3))
"""Bends a wire that is magnetised all along by four tenths of its length."""


def magnet(nodes: int = 60) -> Wire:
    return Wire.uniform(L, 0.4e-3, 3e6, 1e6, 2000.0, nodes, magnetized_tip=L, magnetization=20e3)


def test_sensitivities_near_a_magnet_against_differences() -> None:
    """The stiffness has the second derivatives of the field."""
    state = free(magnet()).equilibrium(L, BENDING)
    assert state.stable
    assert abs(state.tip[1]) > 0.25 * L

    def moved(feed: float = L, uniform: tuple[float, ...] = (0.0, 0.0, 0.0)) -> np.ndarray:
        source = Dipole(BENDING.place, BENDING.moment, uniform)
        return free(magnet()).equilibrium(feed, source, start=state).tip

    by_field, step = state.sensitivity("tip", wrt="field"), 1e-5
    for i, axis in enumerate(np.eye(3)):
        quotient = (moved(uniform=step * axis) - moved(uniform=-step * axis)) / (2.0 * step)
        np.testing.assert_allclose(by_field[:, i], quotient, atol=1e-3 * np.abs(by_field).max())
    by_feed, near = state.sensitivity("tip", wrt="feed"), 0.999 * L
    quotient = (moved(L) - moved(near)) / (L - near)
    np.testing.assert_allclose(by_feed, quotient, atol=5e-3)


def test_stability_near_a_magnet() -> None:
    """A dipole that points away stiffens the wire: affine around its nodes it would be unstable."""
    source = Dipole((0.05, 0.033, 0.0), 0.1 * np.array([0.0, 10.0, 0.0]))
    state = free(magnet()).equilibrium(L, source)
    assert state.stable
    assert not replace(state.point, unsampled=None).stable


def test_a_field_that_varies_too_strongly_is_refused() -> None:
    strong = Dipole((0.09, 0.02, 0.0), (10.0, 20.0, 0.0))
    with pytest.raises(ConvergenceError, match="was not found: "):
        free(wire()).equilibrium(0.08, strong)
