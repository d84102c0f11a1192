"""A wire magnetised along its whole length in a uniform field, against tables of the elastica."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.engine.statics import Equilibrium
from tables import closed_form
from wires import L, flux, free, magnet

TABLE = closed_form("hard_magnetic_elastica_uniform")
BENT = [row for row in TABLE if row[0] < 180.0]
STRAIGHT = [row for row in TABLE if row[0] == 180.0 and row[2] == 0.0]
BUCKLED = [row for row in TABLE if row[0] == 180.0 and row[2] > 0.0]
ANGLE = 1e-3  # rad
PLACE = 1e-3  # of L


def name(row: tuple[float, ...]) -> str:
    return f"{row[0]:g} deg, b={row[1]:g}"


def compare(state: Equilibrium, row: tuple[float, ...]) -> None:
    _, _, angle, _, x, y = row
    assert np.arctan2(*state.tip_direction[1::-1]) == pytest.approx(angle, abs=ANGLE)
    assert np.hypot(*(state.tip[:2] / L - (x, y))) < PLACE
    assert abs(state.tip[2]) < 1e-9 * L


@pytest.mark.parametrize("row", BENT, ids=name)
def test_bent_by_a_field_from_the_side(row: tuple[float, ...]) -> None:
    wire = magnet(100)
    state = free(wire).equilibrium(L, flux(wire, row[1], row[0]))
    compare(state, row)
    assert state.stable


@pytest.mark.parametrize("row", BUCKLED, ids=name)
def test_post_buckled(row: tuple[float, ...]) -> None:
    """In the antiparallel field, from an equilibrium in a field slightly from the side.

    In the exactly antiparallel one the buckled shape may turn about the axis at no cost: it is
    neither stable nor unstable, so its stability is asked for in the slightly turned field.
    """
    wire = magnet(150 if row[1] > 20.0 else 100)
    sim = free(wire)
    sideways = sim.equilibrium(L, flux(wire, row[1], 175.0))
    assert sideways.stable
    compare(sim.equilibrium(L, flux(wire, row[1], 180.0), start=sideways), row)


@pytest.mark.parametrize("row", STRAIGHT, ids=name)
def test_straight_below_the_critical_field(row: tuple[float, ...]) -> None:
    wire = magnet(100)
    state = free(wire).equilibrium(L, flux(wire, row[1], 180.0))
    assert state.stable
    np.testing.assert_allclose(state.tip, [L, 0.0, 0.0], atol=1e-9 * L)


@pytest.mark.parametrize("degrees", [45.0, 90.0, 135.0])
@pytest.mark.parametrize("roll", [0.3, 1.9])
def test_the_plane_of_bending_does_not_matter(degrees: float, roll: float) -> None:
    """The same field turned about the wire's axis turns the wire."""
    wire = magnet(60)
    sim = free(wire)
    x, y, _ = flux(wire, 5.0, degrees)
    turned = sim.equilibrium(L, [x, y * np.cos(roll), y * np.sin(roll)])
    x, y, _ = sim.equilibrium(L, [x, y, 0.0]).tip
    np.testing.assert_allclose(turned.tip, [x, y * np.cos(roll), y * np.sin(roll)], atol=1e-8 * L)


@pytest.mark.parametrize("row", BENT[4::8], ids=name)
def test_magnetised_across_the_axis(row: tuple[float, ...]) -> None:
    """A moment along m1 or m2 in a field along itself: straight; with the field turned, bent."""
    for component in (0, 1):
        magnetization = [0.0, 0.0, 0.0]
        magnetization[component] = 20e3
        wire = magnet(60, magnetization=tuple(magnetization))
        sim = free(wire)
        director = sim.system.guide.director
        m = director if component == 0 else np.cross(sim.system.guide.direction, director)
        size = np.linalg.norm(flux(wire, row[1]))
        state = sim.equilibrium(L, size * m)
        np.testing.assert_allclose(state.tip, [L, 0.0, 0.0], atol=1e-9 * L)
        assert state.stable
        # Field tilted by 30 degrees towards the axis: the moment follows, the wire bends back.
        tilted = np.cos(np.pi / 6) * m + np.sin(np.pi / 6) * sim.system.guide.direction
        bent = sim.equilibrium(L, size * tilted)
        assert bent.stable
        assert -1.0 < bent.tip_direction @ m < -0.02


def test_a_thin_wire_is_found_from_afar() -> None:
    """The thinner the wire, the stiffer in stretching against bending: L/r = 2000 here."""
    wire = magnet(100, radius=0.05e-3)
    row = next(row for row in BENT if row[:2] == (135.0, 10.0))
    compare(free(wire).equilibrium(L, flux(wire, row[1], row[0])), row)
