"""Delay, quanta, gains, tilts and ramps between commands and fields."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from magwire.actuate import (
    Circuit,
    Coil,
    FieldGrid,
    Hardware,
    Held,
    Helmholtz,
    Input,
    Loops,
    Magnet,
    Map,
    Misaligned,
    Omnimagnet,
    Pair,
    Pose,
    Together,
    Uniform,
    UniformGradient,
)
from magwire.actuate.actuator import Actuator
from magwire.errors import InputError

DT = 0.01
POINTS = np.array([[0.01, -0.02, 0.015], [0.0, 0.03, -0.01]])


def coil(resistance: float = 2.0, inductance: float = 0.1, supply: float = 40.0) -> Helmholtz:
    circuit = Circuit(resistance=resistance, inductance=inductance, supply=supply)
    return Helmholtz(pairs=(Pair("x", 0.1, 200.0, circuit=circuit),))


def test_nothing_in_between_is_nothing() -> None:
    commands = np.random.default_rng(0).normal(size=(20, 3))
    line = Hardware().line(Uniform(), DT, np.zeros(3))
    np.testing.assert_array_equal(line.made(commands), commands)


@pytest.mark.parametrize("delay", [0.03, 0.025, 0.004])
def test_a_delay_is_one_of_time_whatever_the_step(delay: float) -> None:
    time = DT * np.arange(1, 41)
    commands = np.stack([3.0 * time, -time, 0.0 * time], axis=1)
    line = Hardware(delay=delay).line(Uniform(), DT, np.zeros(3))
    made = np.vstack([line.made(commands[:7]), line.made(commands[7:])])  # in two parts
    late = np.maximum(time - delay, 0.0)
    np.testing.assert_allclose(made[:, 0], 3.0 * late, atol=1e-12)
    np.testing.assert_allclose(made[:, 1], -late, atol=1e-12)


def test_quanta_and_gains() -> None:
    commands = np.random.default_rng(1).normal(size=(50, 3))
    hardware = Hardware(quantum=0.01, gain_errors=(0.03, -0.03, 0.0))
    made = hardware.line(Uniform(), DT, np.zeros(3)).made(commands)
    set_to = made / [1.03, 0.97, 1.0]
    assert np.abs(set_to - commands).max() <= 0.005 + 1e-12
    np.testing.assert_allclose(set_to / 0.01, np.round(set_to / 0.01), atol=1e-9)
    for_all = Hardware(gain_errors=(0.1,)).line(Uniform(), DT, np.zeros(3)).made(commands)
    np.testing.assert_allclose(for_all, 1.1 * commands)


@pytest.mark.parametrize("resistance", [2.0, 0.0])
def test_a_ramp_is_that_of_the_circuit_at_its_supply(resistance: float) -> None:
    """From 0 towards 15 A against L di/dt = V - R i, integrated; then back."""
    actuator = coil(resistance=resistance)
    made = Hardware().line(actuator, DT, [0.0]).made(np.array([[15.0]] * 12 + [[-15.0]] * 12))

    def slope(_: float, i: np.ndarray) -> np.ndarray:
        return (40.0 - resistance * i) / 0.1

    time = DT * np.arange(1, 13)
    there = solve_ivp(slope, (0.0, 0.12), [0.0], t_eval=time, rtol=1e-10, atol=1e-12).y[0]
    np.testing.assert_allclose(made[:12, 0], np.minimum(there, 15.0), rtol=1e-8)
    back = solve_ivp(
        lambda t, i: (-40.0 - resistance * i) / 0.1,
        (0.0, 0.12),
        [15.0],
        t_eval=time,
        rtol=1e-10,
        atol=1e-12,
    ).y[0]
    np.testing.assert_allclose(made[12:, 0], np.maximum(back, -15.0), rtol=1e-7)
    jump = Hardware(ramps=False).line(actuator, DT, [0.0]).made(np.array([[15.0]]))
    assert jump[0, 0] == 15.0


def test_slew_of_a_field() -> None:
    made = Hardware().line(Uniform(slew=0.5), DT, np.zeros(3)).made(np.full((4, 3), 0.012))
    np.testing.assert_allclose(made[:, 0], [0.005, 0.010, 0.012, 0.012])


LOOPS = Loops(
    coils=(
        Coil("a", (0.0, 0.0, 0.08), (0.0, 0.0, 1.0), 0.05, 100.0),
        Coil("b", (0.1, 0.0, 0.0), (1.0, 0.0, 0.0), 0.05, 100.0),
    ),
    currents=(Input("a", "A", -10.0, 10.0), Input("b", "A")),
)
STANDING = Pose.turned([0.0, 1.0, 1.0], 0.4, (0.01, 0.0, -0.02))
CASES: list[Actuator] = [
    Helmholtz(pairs=(Pair("x", 0.08, 100.0), Pair("z", 0.1, 90.0)), pose=STANDING),
    LOOPS,
    Omnimagnet(moments=(40.0, 50.0, 60.0), position=(0.0, 0.2, 0.0), pose=STANDING),
    UniformGradient(pose=STANDING),
]


@pytest.mark.parametrize("actuator", CASES, ids=lambda a: type(a).__name__)
def test_tilts_turn_the_field_of_each_input_about_the_origin(actuator: Actuator) -> None:
    """Against B' = R B(R^T x) in the actuator's frame, input by input."""
    rng = np.random.default_rng(3)
    count = len(actuator.inputs)
    tilts = 0.05 * rng.normal(size=(count, 3))
    u = rng.normal(size=count)
    hardware = Hardware(tilts=tuple(map(tuple, tilts.tolist())))
    flux, gradient = hardware.built(actuator).at(POINTS, u)
    expected, slope = np.zeros_like(flux), np.zeros_like(gradient)
    for k in range(count):
        turn = Pose.turned(tilts[k], float(np.linalg.norm(tilts[k]))).matrix
        frame = actuator.pose.matrix
        whole = frame @ turn @ frame.T  # the same turn in space, about where the actuator stands
        shift = actuator.pose.shift
        there = (POINTS - shift) @ whole + shift
        b, g = actuator.at(there, u[k] * np.eye(count)[k])
        expected += b @ whole.T
        slope += whole @ g @ whole.T
    np.testing.assert_allclose(flux, expected, rtol=1e-12, atol=1e-18)
    np.testing.assert_allclose(gradient, slope, rtol=1e-11, atol=1e-17)
    straight = actuator.at(POINTS, u)[0]
    assert np.abs(flux - straight).max() > 1e-3 * np.abs(straight).max()


def test_a_background_is_not_tilted_and_parts_are() -> None:
    earth = Held(actuator=Uniform(), values=(0.0, 0.0, -5e-5))
    both = Together(parts=(earth, coil()))
    tilted = Misaligned(actuator=both, tilts=((0.0, 0.0, 0.1),))
    np.testing.assert_allclose(tilted.at(POINTS, [0.0])[0], earth.at(POINTS, [])[0], rtol=1e-15)
    made = tilted.at([[0.0, 0.0, 0.0]], [1.0])[0] - earth.at([[0.0, 0.0, 0.0]], [])[0]
    one = coil().at([[0.0, 0.0, 0.0]], [1.0])[0][0, 0]
    np.testing.assert_allclose(made, one * np.array([[math.cos(0.1), math.sin(0.1), 0.0]]))


def test_maps_are_tilted_alike_or_not_at_all() -> None:
    grid = FieldGrid(np.full(3, -0.05), np.full(3, 0.02), np.ones((6, 6, 6, 3)))
    maps = Map(fields=(grid, grid), controls=(Input("I", "A"), Input("J", "A")))
    turn = (0.0, 0.0, 0.1)
    made = Misaligned(actuator=maps, tilts=(turn, turn)).at([[0.0, 0.0, 0.0]], [1.0, 0.0])[0]
    whole = Pose.turned(turn, 0.1).matrix @ np.ones(3)
    np.testing.assert_allclose(made[0], whole, rtol=1e-12)
    with pytest.raises(InputError, match=r"maps must be tilted alike, .*; received 2 tilts"):
        Misaligned(actuator=maps, tilts=(turn, (0.0, 0.0, 0.0)))


def test_faults() -> None:
    with pytest.raises(InputError, match="one for each of 3 inputs, or one for all; received 2"):
        Hardware(gain_errors=(0.1, 0.2)).built(Uniform())
    with pytest.raises(InputError, match="tilts of Hardware must be one for each of 1 inputs"):
        Hardware(tilts=((0.0, 0.0, 0.1), (0.0, 0.0, 0.1))).built(coil())
    with pytest.raises(InputError, match="must be of coils; received a magnet"):
        Hardware(tilts=((0.0, 0.0, 0.1),) * 6).built(Magnet(radius=0.02, remanence=1.0))
    with pytest.raises(InputError, match="delay of Hardware must be zero or positive"):
        Hardware(delay=-1.0)
