"""A tip that is magnetised across: the field turns the wire about its axis (P-6)."""

from __future__ import annotations

import math

import numpy as np
import pytest

import magwire as mw
from magwire.wire.section import MU_0

MAGNETIZATION, TIP, RADIUS, FEED = 128e3, 5e-3, 0.6e-3, 0.02
FLUX = 1e-3


def equilibrium(magnetization: tuple[float, float, float], flux: list[float]) -> mw.Equilibrium:
    wire = mw.Wire.uniform(
        0.05, RADIUS, 3e6, 1e6, 2e3, 51, magnetized_tip=TIP, magnetization=magnetization
    )
    return mw.Simulation(wire, mw.Lumen.open_space()).equilibrium(FEED, flux)


def shaft_torque() -> float:
    """Torque of a rigid magnet on a twisted shaft, by its own iteration: T = m B cos(phi).

    The magnet turns with the wire; over it the torque falls linearly, so that phi is that of the
    shaft and a third of the magnet's own length.
    """
    moment = MAGNETIZATION * math.pi * RADIUS**2 * TIP
    compliance = (FEED - TIP + TIP / 3.0) / (1e6 * 0.5 * math.pi * RADIUS**4)
    torque = moment * FLUX
    for _ in range(50):
        torque = moment * FLUX * math.cos(torque * compliance)
    return torque


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_guide_holds_the_torque_of_the_field(sign: float) -> None:
    state = equilibrium(mw.across(MAGNETIZATION), [0.0, sign * FLUX, 0.0])
    assert state.guide_torque == pytest.approx(sign * shaft_torque(), rel=1e-4)
    np.testing.assert_allclose(state.tip, [FEED, 0.0, 0.0], atol=1e-9)


def test_the_first_direction_is_z_for_a_lumen_along_x() -> None:
    state = equilibrium(mw.across(MAGNETIZATION), [0.0, 0.0, FLUX])
    assert abs(state.guide_torque) < 1e-6 * shaft_torque()


def test_the_second_direction_is_minus_y() -> None:
    state = equilibrium(mw.across(MAGNETIZATION, math.pi / 2), [0.0, -FLUX, 0.0])
    assert abs(state.guide_torque) < 1e-6 * shaft_torque()


def test_axial_is_what_a_lone_number_means() -> None:
    bent = equilibrium(mw.axial(MAGNETIZATION), [0.0, FLUX, 0.0])
    make = mw.Make(
        radius=RADIUS,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2e3,
        remanence=mw.axial(MU_0 * MAGNETIZATION),
    )
    wire = mw.Wire.of(make, 0.05, 51, magnetized_tip=TIP)
    same = mw.Simulation(wire, mw.Lumen.open_space()).equilibrium(FEED, [0.0, FLUX, 0.0])
    assert bent.tip[1] > 1e-4
    np.testing.assert_allclose(same.positions, bent.positions, atol=1e-9)


@pytest.mark.parametrize("make", [mw.axial, mw.across])
def test_no_number(make: object) -> None:
    with pytest.raises(mw.InputError, match="must be a number; received 'strong'"):
        make("strong")  # type: ignore[operator]
