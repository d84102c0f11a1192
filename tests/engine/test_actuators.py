"""Wires in the fields of actuators: coils with currents, magnets that move."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from kernels.rods import Case, derivatives, difference_quotients, random_case
from magwire.actuate import Coil, Helmholtz, Loops, Magnet, Pair, UniformGradient
from magwire.evidence.verify.references.dipole import Dipole
from magwire.kernels.sources.steer import steer
from magwire.kernels.sources.table import new_strength

L = 0.05


def wire(nodes: int = 31) -> mw.Wire:
    return mw.Wire.uniform(
        length=L,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=nodes,
        magnetized_tip=10e-3,
        magnetization=128e3,
    )


def platform(current: float = 10.0) -> Helmholtz:
    """Three nested pairs, whose constants are about 1 mT/A at the centre."""
    radii = {"x": 0.08, "y": 0.10, "z": 0.12}
    return Helmholtz(
        pairs=tuple(
            Pair(axis, radius, 1e-3 * radius / 8.99e-7, max_current=current)
            for axis, radius in radii.items()
        )
    )


@pytest.mark.parametrize("seed", range(2))
def test_gradient_and_hessian_in_the_field_of_coils_and_a_magnet(seed: int) -> None:
    """Torque, gradient force and second derivatives against differences of the energy."""
    plain = random_case(seed, "field")
    rng = np.random.default_rng(seed)
    ring = Coil("a", (0.3, 0.2, 0.9), (0.0, 0.0, 1.0), 0.7, 2e6)
    table = Loops(coils=(ring, Coil("b", (1.2, 0.1, -0.8), (0.0, 1.0, 0.0), 0.5, 1e6))).arrays()
    strength = new_strength(table)
    steer((table,), rng.normal(size=2), strength)
    field = plain.model.field
    there = field._replace(sources=(table,), strength=strength)  # type: ignore[attr-defined]
    case = Case(
        plain.system, plain.model._replace(field=there), plain.state, plain.mouth, plain.motion
    )
    _, gradient, hessian = derivatives(case)
    slope, raw = difference_quotients(case, 2e-4)
    assert np.abs(gradient - slope).max() < 1e-7 * np.abs(slope).max()
    symmetric = 0.5 * (raw + raw.T)
    assert np.abs(hessian - symmetric).max() < 1e-7 * np.abs(symmetric).max()


def test_a_magnet_as_an_actuator_is_the_source_that_is_sampled() -> None:
    """The compiled field of a posed sphere against the same dipole asked from Python."""
    moment, place = 6.0, np.array([0.05, 0.06, 0.01])
    radius = 0.01
    remanence = moment / (4.0 / 3.0 * np.pi * radius**3) * 4e-7 * np.pi
    magnet = Magnet(radius=radius, remanence=remanence)
    inputs = [*place, 0.0, -1.0, 0.5]
    aim = np.array(inputs[3:]) / np.linalg.norm(inputs[3:])
    coil = mw.Simulation(wire(), mw.Lumen.open_space(), actuator=magnet)
    sampled = mw.Simulation(wire(), mw.Lumen.open_space(), field=Dipole(place, moment * aim))
    here, there = coil.equilibrium(L, inputs=inputs), sampled.equilibrium(L)
    assert here.stable
    assert np.linalg.norm(here.tip - [L, 0.0, 0.0]) > 2e-3
    np.testing.assert_allclose(here.positions, there.positions, atol=1e-7 * L)


def test_sensitivity_to_currents_and_to_a_magnets_pose() -> None:
    for actuator, inputs, step in (
        (platform(), np.array([2.0, -3.0, 1.0]), 1e-3),
        (Magnet(radius=0.01, remanence=1.3), np.array([0.05, 0.07, 0.01, 0.2, -1.0, 0.1]), 1e-5),
    ):
        simulation = mw.Simulation(wire(), mw.Lumen.open_space(), actuator=actuator)
        here = simulation.equilibrium(L, inputs=inputs)
        found = here.sensitivity("tip", wrt="inputs")
        assert found.shape == (3, len(inputs))
        for k in range(len(inputs)):
            ends = []
            for sign in (1.0, -1.0):
                moved = inputs.copy()
                moved[k] += sign * step
                ends.append(simulation.equilibrium(L, inputs=moved, start=here).tip)
            expected = (ends[0] - ends[1]) / (2.0 * step)
            np.testing.assert_allclose(found[:, k], expected, atol=2e-4 * np.abs(found).max())


def test_currents_bend_as_the_uniform_field_at_the_centre_does() -> None:
    """Pushed through the half-circle inside of the coils, by currents that rise with time."""
    lumen = mw.Lumen.half_circle(centreline_radius=0.012, radius=3e-3)
    coils = platform()
    flux, _ = coils.at(np.zeros((1, 3)), [4.0, 8.0, 0.0])
    tips = []
    for actuator, inputs in ((coils, [4.0, 8.0, 0.0]), (None, flux[0])):
        simulation = mw.Simulation(wire(), lumen, actuator=actuator)
        with simulation.session(time_step=0.05, record_every=1.0) as robot:
            robot.step(feed_speed=4e-3, inputs=inputs, duration=5.0)
            tips.append(robot.observe().tip)
        data = robot.result.dataset
        np.testing.assert_allclose(data["inputs"].values[-1], inputs)
        np.testing.assert_allclose(data["field"].values[-1], flux[0], rtol=0.02, atol=2e-4)
    assert data.attrs["input_names"] == "Bx By Bz"
    np.testing.assert_allclose(tips[0], tips[1], atol=0.01 * L)


def test_a_gradient_pulls_a_wire_along() -> None:
    """Force M G l along the tip: what the guide has to hold."""
    simulation = mw.Simulation(wire(), mw.Lumen.open_space(), actuator=UniformGradient())
    pull = 2.0  # T/m along x
    names = [one.name for one in UniformGradient().inputs]
    inputs = np.zeros(8)
    inputs[names.index("Gxx")] = pull
    still = simulation.equilibrium(L, inputs=inputs)
    moment = 128e3 * np.pi * 0.6e-3**2 * 10e-3
    assert still.push_force == pytest.approx(-moment * pull, rel=1e-6)


def test_wrong_numbers_of_inputs_are_refused() -> None:
    simulation = mw.Simulation(wire(), mw.Lumen.open_space(), actuator=platform())
    with pytest.raises(mw.InputError, match="inputs"):
        simulation.equilibrium(L, inputs=[1.0, 2.0])
    tube = mw.Simulation(wire(), mw.Lumen.straight(0.1, 3e-3), actuator=platform())
    with pytest.raises(mw.InputError, match="steers by a uniform field"):
        mw.StableNavigator(tube.system)
