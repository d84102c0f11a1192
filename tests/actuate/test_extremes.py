"""The set of fields that the hardware can make, against linear programmes written here."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import linprog, minimize

from magwire.actuate import MPEM, Circuit, Held, Helmholtz, Magnet, Pair, Together, Uniform
from magwire.actuate.extremes import extremes, spread
from magwire.errors import InputError

from .handed import FOLDER, needs_files

POINT = np.array([0.002, -0.003, 0.001])
AIMS = spread(50)


def largest(columns: np.ndarray, aim: np.ndarray, most: np.ndarray) -> float:
    """Largest field along ``aim`` with no component across it, |u_k| at most ``most``."""
    across = np.linalg.svd(aim[None])[2][1:]
    found = linprog(
        -(aim @ columns),
        A_eq=across @ columns,
        b_eq=np.zeros(2),
        bounds=[(-m, m) for m in most],
    )
    return float(-found.fun)


@needs_files
def test_octomag_under_current_limits() -> None:
    calibration = MPEM.read(FOLDER / "octomag_calibration.yaml").calibration
    system = MPEM(calibration=calibration, max_currents=(20.0,) * 8)
    columns = np.stack([system.at([POINT], u)[0][0] for u in np.eye(8)], axis=1)
    found = extremes(system, POINT, AIMS)
    for aim, value, u in zip(AIMS, found.flux_density, found.inputs, strict=True):
        assert value == pytest.approx(largest(columns, aim, np.full(8, 20.0)), rel=1e-3)
        np.testing.assert_allclose(system.at([POINT], u)[0][0], value * aim, atol=1e-9 * value)


@needs_files
def test_navion_has_its_known_reach() -> None:
    system = MPEM.read(FOLDER / "navion_2_calibration.yaml", limits=FOLDER / "navion_2_limits.yaml")
    found = extremes(system, [0.0, 0.0, 0.0])
    assert found.worst == pytest.approx(17.7e-3, rel=0.02)
    assert found.worst < found.median < found.best
    ends = np.array([[a, b, c] for a in (-35, 35) for b in (-35, 35) for c in (-35, 35)])
    fields = np.array([system.at([[0.0, 0.0, 0.0]], u)[0][0] for u in ends])
    most = np.linalg.norm(fields, axis=1)
    best = extremes(system, [0.0, 0.0, 0.0], fields).best
    assert best == pytest.approx(most.max(), rel=1e-6)
    assert 0.9 * best < found.best <= best


@needs_files
def test_saturation_bounds_the_field() -> None:
    names = ("cardiomag_2019_calibration.yaml", "cardiomag_2019_saturation.yaml")
    iron = MPEM.read(FOLDER / names[0], saturation=FOLDER / names[1])
    point = np.array([0.0, 0.0, 0.1])
    columns = np.stack([MPEM(calibration=iron.calibration).at([point], u)[0][0] for u in np.eye(8)])
    assert iron.saturation is not None
    most = np.array([curve.at(34.0) for curve in iron.saturation])
    system = MPEM(
        calibration=iron.calibration, saturation=iron.saturation, max_currents=(34.0,) * 8
    )
    found = extremes(system, point, AIMS[:10])
    for aim, value, u in zip(found.directions, found.flux_density, found.inputs, strict=True):
        assert value == pytest.approx(largest(columns.T, aim, most), rel=1e-3)
        np.testing.assert_allclose(system.at([point], u)[0][0], value * aim, atol=1e-6 * value)


def coils(max_power: float = math.inf, max_current: float = math.inf) -> Helmholtz:
    rows = (("x", 0.12, 3.0), ("y", 0.10, 2.0), ("z", 0.08, 1.0))
    return Helmholtz(
        pairs=tuple(
            Pair(axis, radius, 100.0, max_current=max_current, circuit=Circuit(resistance=r))
            for axis, radius, r in rows
        ),
        max_power=max_power,
    )


def test_three_currents_and_power_have_a_closed_form() -> None:
    system = coils(max_power=50.0)
    columns = np.stack([system.at([POINT], u)[0][0] for u in np.eye(3)], axis=1)
    found = extremes(system, POINT, AIMS)
    for aim, value in zip(AIMS, found.flux_density, strict=True):
        u = np.linalg.solve(columns, aim)
        expected = math.sqrt(50.0 / float(np.array([3.0, 2.0, 1.0]) @ (u * u)))
        assert value == pytest.approx(expected, rel=1e-3)


@needs_files
def test_power_of_more_coils_than_needed() -> None:
    calibration = MPEM.read(FOLDER / "octomag_calibration.yaml").calibration
    resistance = np.linspace(0.5, 2.0, 8)
    system = MPEM(
        calibration=calibration,
        max_currents=(20.0,) * 8,
        circuits=tuple(Circuit(resistance=float(r)) for r in resistance),
        max_power=500.0,
    )
    columns = np.stack([system.at([POINT], u)[0][0] for u in np.eye(8)], axis=1)
    found = extremes(system, POINT, AIMS[:8])
    for aim, value, u in zip(found.directions, found.flux_density, found.inputs, strict=True):
        assert system.power(u) <= 500.0 * (1.0 + 1e-3)
        across = np.linalg.svd(aim[None])[2][1:]
        best = minimize(
            lambda v, a=aim: -float(a @ columns @ v) * 1e3,
            np.zeros(8),
            method="SLSQP",
            bounds=[(-20.0, 20.0)] * 8,
            constraints=[
                {"type": "eq", "fun": lambda v, n=across: n @ columns @ v * 1e3},
                {"type": "ineq", "fun": lambda v: 500.0 - resistance @ (v * v)},
            ],
            options={"maxiter": 500, "ftol": 1e-10},
        )
        assert best.success
        assert value == pytest.approx(-1e-3 * best.fun, rel=1e-3)


def test_a_background_helps_one_way_and_hinders_the_other() -> None:
    field = Uniform(max_component=0.01)
    earth = Held(actuator=Uniform(), values=(0.002, 0.0, 0.0))
    found = extremes(Together(parts=(field, earth)), POINT, [[1.0, 0.0, 0.0], [-2.0, 0.0, 0.0]])
    np.testing.assert_allclose(found.flux_density, [0.012, 0.008], rtol=1e-9)


def test_no_limit_is_no_bound() -> None:
    assert math.isinf(extremes(Uniform(), POINT).worst)


def test_directions_are_spread_evenly() -> None:
    aims = spread(200)
    np.testing.assert_allclose(np.linalg.norm(aims, axis=1), 1.0, rtol=1e-14)
    np.testing.assert_allclose(aims.T @ aims / 200, np.eye(3) / 3.0, atol=2e-3)


def test_faults() -> None:
    with pytest.raises(InputError, match="received a magnet that moves"):
        extremes(Magnet(radius=0.1, remanence=1.0), POINT)
    with pytest.raises(InputError, match="must have a length"):
        extremes(Uniform(), POINT, [[0.0, 0.0, 0.0]])
