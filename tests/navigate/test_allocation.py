"""Steering in amperes and by a magnet's pose: what is made, what it costs, what is in the way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

import magwire as mw
from actuate.handed import FOLDER, needs_files
from magwire.actuate import (
    MPEM,
    Circuit,
    Coil,
    Helmholtz,
    Input,
    Loops,
    Magnet,
    Pair,
    Pose,
    extremes,
)
from magwire.navigate.allocation import Allocated
from magwire.navigate.least_cost import allocate, binding, lacking

PLACE = np.array([0.004, -0.003, 0.002])


def coils(count: int = 8, limit: float = 20.0) -> Loops:
    """Coils all around, with resistances of their own."""
    rng = np.random.default_rng(2)
    made, currents = [], []
    for k in range(count):
        way = rng.normal(size=3)
        way /= np.linalg.norm(way)
        name = f"I{k}"
        made.append(Coil(name, tuple(0.1 * way), tuple(way), 0.05, 200.0))
        currents.append(Input(name, "A", -limit, limit, resistance=float(rng.uniform(0.5, 2.0))))
    return Loops(coils=tuple(made), currents=tuple(currents))


def platform(limit: float = 40.0, supply: float = 48.0) -> Helmholtz:
    """Three nested pairs around the half-circle."""
    circuit = Circuit(resistance=1.0, inductance=5e-3, supply=supply)
    return Helmholtz(
        pairs=tuple(
            Pair(axis, radius, 200.0, max_current=limit, circuit=circuit)
            for axis, radius in (("x", 0.08), ("y", 0.10), ("z", 0.12))
        ),
        pose=Pose(translation=(0.0125, 0.025, 0.0)),
    )


def half_circle(actuator: Helmholtz) -> mw.Simulation:
    wire = mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=100,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    return mw.Simulation(wire, lumen, actuator=actuator)


STEADY = Allocated(mw.TipNavigator(mw.Demands(stability_margin=10.0), update_every=1e-3))


def test_currents_of_least_power_are_the_weighted_pseudo_inverses() -> None:
    actuator = coils()
    flux = np.array([6e-3, -3e-3, 2e-3])
    by_input = actuator.response(PLACE[None], np.zeros(8))[0][0].T
    weight = np.diag([1.0 / one.resistance for one in actuator.inputs])
    expected = weight @ by_input.T @ np.linalg.solve(by_input @ weight @ by_input.T, flux)
    found = allocate(actuator, PLACE, flux)
    assert found is not None
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    np.testing.assert_allclose(actuator.at(PLACE[None], found)[0][0], flux, atol=1e-9)


def test_a_limit_that_binds_is_kept_and_paid_for_by_the_others() -> None:
    flux = np.array([6e-3, -3e-3, 2e-3])
    free = allocate(coils(), PLACE, flux)
    assert free is not None
    tight = coils(limit=0.9 * float(np.abs(free).max()))
    found = allocate(tight, PLACE, flux)
    assert found is not None
    assert np.abs(found).max() <= 0.9 * np.abs(free).max() * (1.0 + 1e-9)
    np.testing.assert_allclose(tight.at(PLACE[None], found)[0][0], flux, atol=1e-8)
    assert tight.power(found) > coils().power(free)


def test_what_binds_is_named_with_figures() -> None:
    actuator = coils(count=3, limit=1.0)
    flux = np.array([0.05, 0.0, 0.0])
    assert allocate(actuator, PLACE, flux) is None
    by_input = actuator.response(PLACE[None], np.zeros(3))[0][0].T
    needed = np.linalg.solve(by_input, flux)
    worst = int(np.argmax(np.abs(needed)))
    said = binding(actuator, PLACE, flux, np.zeros(3))
    assert said.startswith("the magnet needs 50 mT: input ")
    assert f"input I{worst} is at its limit of 1 A" in said
    assert f"{abs(needed[worst]):.3g} A." in said


def iron_cores() -> MPEM:
    """CardioMag with its saturation, 35 A a coil."""
    read = MPEM.read(
        FOLDER / "cardiomag_2019_calibration.yaml",
        saturation=FOLDER / "cardiomag_2019_saturation.yaml",
    )
    return replace(read, max_currents=(35.0,) * 8, circuits=(Circuit(resistance=1.0),) * 8)


@needs_files
@pytest.mark.parametrize("part", [0.5, 0.9, 0.99])
def test_least_power_of_saturated_cores_is_that_of_a_solver_for_any_function(part: float) -> None:
    """Nearly up to what there is, where most of the currents are at their limits."""
    actuator, place = iron_cores(), np.array([0.0, 0.0, 0.12])
    aim = np.array([0.3, -1.0, 0.2])
    flux = part * extremes(actuator, place, aim[None]).flux_density[0] * aim / np.linalg.norm(aim)
    found = allocate(actuator, place, flux)
    assert found is not None
    other = minimize(
        lambda u: 1e-3 * u @ u,
        found + np.random.default_rng(1).normal(size=8),
        jac=lambda u: 2e-3 * u,
        bounds=[(-35.0, 35.0)] * 8,
        constraints={
            "type": "eq",
            "fun": lambda u: 1e3 * (actuator.at(place[None], u)[0][0] - flux),
            "jac": lambda u: 1e3 * actuator.response(place[None], u)[0][0].T,
        },
        options={"ftol": 1e-12, "maxiter": 500},
    )
    assert found @ found == pytest.approx(1e3 * other.fun, rel=1e-5)
    np.testing.assert_allclose(actuator.at(place[None], found)[0][0], flux, atol=1e-8)


@needs_files
def test_saturated_cores_say_what_there_is_and_which_are_at_their_limits() -> None:
    actuator, place, flux = iron_cores(), np.array([0.0, 0.0, 0.12]), np.array([0.3, 0.0, 0.0])
    assert allocate(actuator, place, flux) is None
    most = 1e3 * extremes(actuator, place, flux[None]).flux_density[0]
    said = binding(actuator, place, flux, actuator.idle)
    assert said.startswith("the magnet needs 300 mT: in its direction there are at most ")
    assert f"{most:.4g} mT, with Coil_" in said
    assert said.endswith((" at 35 A.", " at -35 A."))
    weak = replace(actuator, max_power=100.0)
    assert binding(weak, place, flux, weak.idle).endswith("with the power at 100 W.")


@pytest.mark.parametrize("flux", [(0.0, 5e-3, 0.0), (4e-3, -8e-3, 2e-3), (-0.02, 0.0, 0.0)])
def test_a_magnet_is_put_where_it_makes_the_field(flux: tuple[float, ...]) -> None:
    parked = (0.0, 0.2, 0.0, 0.0, -1.0, 0.0)
    magnet = Magnet(radius=0.025, length=0.05, remanence=1.45, parked=parked)
    found = allocate(magnet, PLACE, flux)
    assert found is not None
    np.testing.assert_allclose(magnet.at(PLACE[None], found)[0][0], flux, atol=2e-4 * 0.02)
    assert magnet.distance(found, PLACE[None])[0] > 0.03


def test_the_half_circle_in_currents_is_free_of_tip_contact() -> None:
    """In the coils' own field, with its gradients, stepped with inertia."""
    simulation = half_circle(platform())
    result = simulation.run(mw.Feed(4e-3, 0.072), STEADY, time_step=0.02, record_every=1e-3)
    assert result.status == "complete", result.message
    assert result.max_tip_force == 0.0
    inputs = result.dataset["inputs"].values
    assert result.dataset.attrs["input_names"] == "Ix Iy Iz"
    assert 10.0 < np.abs(inputs).max() <= 40.0
    tip = result.position[-1, -1]
    made = platform().at(tip[None], inputs[-1])[0][0]
    np.testing.assert_allclose(result.field[-1], made, rtol=1e-9)


def test_the_coil_that_is_too_weak_is_named_with_the_feed() -> None:
    result = half_circle(platform(limit=10.0)).run(mw.Feed(4e-3, 0.072), STEADY, time_step=0.05)
    assert result.status == "no field"
    assert result.message.startswith("At ")
    assert "mm of feed the magnet needs" in result.message
    assert "input Ix is at its limit of 10" in result.message


def test_a_supply_that_does_not_hold_the_current_is_named_with_both() -> None:
    """Not as a rate of change: a current beyond supply over resistance is never reached."""
    simulation = half_circle(platform(limit=100.0, supply=10.0))
    result = simulation.run(mw.Feed(4e-3, 0.072), STEADY, time_step=0.05)
    assert result.status == "no field"
    said = "input Ix is at 9.8 A, as much as its supply of 10 V holds against 1 ohm; it takes "
    assert said in result.message
    assert "would have to change" not in result.message


@pytest.mark.parametrize(
    ("low", "high", "needed", "said"),
    [
        (-20.0, 20.0, -30.0, ("input I is at its limit of 20 A", "30 A")),
        (0.0, 20.0, -3.0, ("input I is at its limit of 0 A", "-3 A")),
        (-100.0, 100.0, 30.0, ("input I is at 20 A, as much as its supply", "30 A")),
        (-20.0, 20.0, 20.004, ("input I is at its limit of 20 A", "20.004 A")),
    ],
)
def test_what_is_lacking_is_told_by_the_side_that_binds(
    low: float, high: float, needed: float, said: tuple[str, str]
) -> None:
    other = Input("I0", "A", -1.0, 1.0)
    one = Input("I", "A", low, high, resistance=4.9, inductance=1e-3, supply=100.0)
    found = lacking((other, one), np.array([0.5, needed]))
    assert found is not None
    assert found[0].startswith(said[0])
    assert found[1] == said[1]
    assert lacking((other, one), np.array([0.5, 0.0])) is None


def test_without_an_actuator_there_are_no_inputs_to_steer_by() -> None:
    plain = mw.Simulation(half_circle(platform()).system.wire, mw.Lumen.straight(0.2, 3e-3))
    with pytest.raises(mw.InputError, match="actuator of Simulation must be given"):
        STEADY.start(plain.system)
