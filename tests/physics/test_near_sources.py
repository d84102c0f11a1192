"""Wires at the edge of a Helmholtz pair and near a magnet, against Kirchhoff's rod with gradient.

Wire and sources lie in one plane. The reference shoots from the free tip, with n = m = 0 there, to
the clamp. It has its field from the law of Biot and Savart, over windings that are polygons: around
a circle the trapezoidal rule converges faster than any power.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import root

import magwire as mw
from magwire.actuate import Helmholtz, Magnet, Pair, Pose
from magwire.actuate.actuator import Actuator

L = 0.05
PER_AMPERE = 1.25663706127e-6 / (4.0 * np.pi)
SIDES = 64
Array = np.ndarray
Field = Callable[[Array], tuple[Array, Array]]

TURN = 0.7
PAIR = Helmholtz(
    pairs=(Pair("x", 0.1, 200.0),), pose=Pose.turned([0.0, 0.0, 1.0], TURN, (0.03, -0.07, 0.0))
)
CURRENT = 20.0
RADIUS, LENGTH, REMANENCE, AWAY = 0.025, 0.05, 1.45, 0.025
AXIS = np.array([0.6, 0.8, 0.0])
CENTRE = np.array([0.5 * L, 0.0, 0.0]) - (AWAY + 0.5 * LENGTH) * AXIS


def of_loops(centres: Array, axis: Array, radius: float, amperes: Array) -> Field:
    """Flux density and gradient of loops about one axis, shape (n, 3) and (n, 3, 3)."""
    first = np.cross(axis, [0.0, 0.0, 1.0])
    second = np.cross(axis, first)
    angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
    ring = radius * (np.outer(np.cos(angle), first) + np.outer(np.sin(angle), second))
    along = np.outer(-np.sin(angle), first) + np.outer(np.cos(angle), second)
    places = (centres[:, None] + ring).reshape(-1, 3)
    pieces = radius * 2.0 * np.pi / SIDES * PER_AMPERE * amperes[:, None, None] * along
    dl = pieces.reshape(-1, 3)

    def field(points: Array) -> tuple[Array, Array]:
        r = points[:, None] - places
        size = np.linalg.norm(r, axis=2)[..., None]
        turned = np.cross(dl, r)
        gradient = np.empty((len(points), 3, 3))
        for j, unit in enumerate(np.eye(3)):
            slope = np.cross(dl, unit) / size**3 - 3.0 * turned * r[..., j : j + 1] / size**5
            gradient[:, :, j] = slope.sum(axis=1)
        return (turned / size**3).sum(axis=1), gradient

    return field


def of_pair() -> Field:
    axis = np.array([np.cos(TURN), np.sin(TURN), 0.0])
    centres = np.array([0.03, -0.07, 0.0]) + np.outer([0.05, -0.05], axis)
    return of_loops(centres, axis, 0.1, np.full(2, 200.0 * CURRENT))


def of_magnet() -> Field:
    """Its magnetisation is a current around its side, Br/mu0 for each unit of length."""
    x, w = np.polynomial.legendre.leggauss(12)
    centres = CENTRE + np.outer(0.5 * LENGTH * x, AXIS)
    amperes = 0.5 * LENGTH * w * REMANENCE / (4.0 * np.pi * PER_AMPERE)
    return of_loops(centres, AXIS, RADIUS, amperes)


def wire(magnetization: float) -> mw.Wire:
    return mw.Wire.uniform(
        length=L,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=101,
        magnetized_tip=L,
        magnetization=magnetization,
    )


def solved(one: mw.Wire, source: Field, pull: float = 1.0) -> Array:
    """Places of the reference, shape (101, 3) [m]; the gradient's force times ``pull``.

    theta' = m/EI,  m' = -(t x n) - (M x B),  n' = -grad(M . B),  with M along t.
    """
    moment, stiffness = one.moment_per_length, one.bending_stiffness
    free = np.array([L, 0.0, 0.0])

    def slope(_: float, y: Array, part: float) -> Array:
        t = np.array([np.cos(y[2]), np.sin(y[2]), 0.0])
        flux, gradient = source(np.array([[y[0], y[1], 0.0]]))
        drawn = part * pull * moment * (t @ gradient[0])
        turned = t[0] * y[4] - t[1] * y[3]
        turned += part * moment * (t[0] * flux[0, 1] - t[1] * flux[0, 0])
        return np.array([t[0], t[1], y[5] / stiffness, -drawn[0], -drawn[1], -turned])

    def shot(tip: Array, part: float, stations: Array) -> Array:
        start = np.concatenate([tip, np.zeros(3)])
        found = solve_ivp(slope, (L, 0.0), start, t_eval=stations, args=(part,), rtol=1e-7)
        return found.y

    for part in (0.1, 0.25, 0.5, 0.75, 1.0):
        miss = root(lambda tip, part=part: shot(tip, part, np.zeros(1))[:3, 0], free, tol=1e-9)
        assert miss.success, miss.message
        free = miss.x
    places = shot(free, 1.0, np.linspace(L, 0.0, 101))
    return np.stack([places[0, ::-1], places[1, ::-1], np.zeros(101)], axis=1)


MAGNET = Magnet(radius=RADIUS, length=LENGTH, remanence=REMANENCE)
POSE = np.concatenate([CENTRE, AXIS])
CASES = {
    "edge of a pair": (PAIR, np.array([CURRENT]), of_pair(), 20e3),
    "25 mm from a magnet": (MAGNET, POSE, of_magnet(), 5e3),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_a_wire_near_its_source_is_kirchhoffs_rod(
    case: tuple[Actuator, Array, Field, float],
) -> None:
    actuator, inputs, source, magnetization = case
    one = wire(magnetization)
    found = mw.Simulation(one, mw.Lumen.open_space(), actuator=actuator).equilibrium(
        L, inputs=inputs
    )
    flux, gradient = actuator.at(found.positions, inputs)
    expected_flux, expected_gradient = source(found.positions)
    np.testing.assert_allclose(flux, expected_flux, atol=1e-6 * np.abs(flux).max())
    np.testing.assert_allclose(gradient, expected_gradient, atol=1e-5 * np.abs(gradient).max())
    assert found.stable
    expected = solved(one, source)
    assert np.linalg.norm(expected[-1] - [L, 0.0, 0.0]) > 0.2 * L
    assert np.abs(found.positions - expected).max() < 1e-3 * L
    # The gradient's force is no small part of it.
    assert np.abs(solved(one, source, pull=0.0) - expected).max() > 5e-3 * L


def test_a_wire_that_snaps_onto_the_magnet_is_told_so() -> None:
    """Turned the other way the magnet draws the tip on to itself; 60 mm away it only bends it."""
    simulation = mw.Simulation(wire(5e3), mw.Lumen.open_space(), actuator=MAGNET)

    def pose(away: float) -> Array:
        return np.array([0.8 * L, -(away + 0.5 * LENGTH), 0.0, 0.0, -1.0, 0.0])

    far = simulation.equilibrium(L, inputs=pose(0.06))
    assert far.stable
    assert MAGNET.distance(pose(0.06), far.positions).min() > 0.02
    with pytest.raises(mw.ConvergenceError, match="the wire snaps onto the magnet: its axis comes"):
        simulation.equilibrium(L, inputs=pose(0.04))
