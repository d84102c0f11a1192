"""Wires whose far end is held, against closed forms (P-16)."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.errors import InputError
from magwire.evidence.verify.references import twisted
from wires import L, flux, free, magnet


def test_beam_between_clamps_that_are_set_aside() -> None:
    """Small deflection d: y = d (3 s^2 - 2 s^3), and the ends come nearer by 3 d^2/(5 L)."""
    d = 0.01 * L
    place = (L - 0.6 * d**2 / L, d, 0.0)
    state = free(magnet(81, 0.0)).equilibrium(L, hold=mw.Hold(place, (1.0, 0.0, 0.0)))
    assert state.stable
    s = np.linspace(0.0, 1.0, 81)
    np.testing.assert_allclose(state.positions[:, 1] / d, 3.0 * s**2 - 2.0 * s**3, atol=2e-2)
    np.testing.assert_allclose(state.tip, place, atol=1e-12)
    np.testing.assert_allclose(state.tip_direction, [1.0, 0.0, 0.0], atol=1e-12)


def test_turned_between_clamps_it_buckles() -> None:
    """At the moment of the characteristic equation, GJ/EI = 2/3 times the turn."""
    sim, here = free(magnet(101, 0.0)), {"position": (L, 0, 0), "direction": (1, 0, 0)}
    critical = twisted.clamped_moment(0.0) * 1.5
    below = sim.equilibrium(L, hold=mw.Hold(**here, turn=0.97 * critical))
    assert below.stable
    twist = np.diff(below.point.state.q[1:-1, 3]).mean() * 100
    assert twist == pytest.approx(0.97 * critical, rel=2e-2)
    above = sim.equilibrium(L, start=below, hold=mw.Hold(**here, turn=0.06 * critical))
    assert not above.stable


def test_a_magnet_between_clamps_does_not_let_go() -> None:
    """Its sensitivity agrees with differences, and its ends stay where they are held."""
    wire = magnet(41)
    sim, hold = free(wire), mw.Hold((0.9 * L, 0.1 * L, 0.05 * L), (1.0, 0.3, 0.0), turn=0.4)
    field = flux(wire, 3.0, 60.0)
    state = sim.equilibrium(L, field, hold=hold)
    assert state.stable
    slope = state.sensitivity("positions", wrt="field")
    assert np.abs(slope[-2:]).max() == 0.0
    still = mw.Hold(hold.position, hold.direction)
    step = 1e-3 * np.linalg.norm(field)
    for c, axis in enumerate(np.eye(3)):
        ends = [sim.equilibrium(L, field + s * step * axis, start=state, hold=still)
                for s in (1.0, -1.0)]  # fmt: skip
        quotient = (ends[0].positions - ends[1].positions) / (2.0 * step)
        np.testing.assert_allclose(slope[..., c], quotient, atol=1e-4 * np.abs(slope).max())


def test_let_go_it_goes_where_a_free_wire_is() -> None:
    wire = magnet(41)
    sim, field = free(wire), flux(wire, 2.0, 90.0)
    held = sim.equilibrium(L, field, hold=mw.Hold((0.95 * L, -0.1 * L, 0.0), (1.0, 0.0, 0.0)))
    again = sim.equilibrium(L, field, start=held)
    np.testing.assert_allclose(again.tip, sim.equilibrium(L, field).tip, atol=1e-7 * L)


def test_faulty_holds_are_refused() -> None:
    sim = free(magnet(41))
    with pytest.raises(InputError, match="direction of Hold must not be zero"):
        mw.Hold((0, 0, 0), (0, 0, 0))
    with pytest.raises(InputError, match="direction of Hold must not be opposite"):
        sim.equilibrium(L, hold=mw.Hold((L, 0, 0), (-1, 0, 0)))
    with pytest.raises(InputError, match="feed of Simulation must let go of 4 nodes"):
        sim.equilibrium(0.02 * L, hold=mw.Hold((0.02 * L, 0, 0), (1, 0, 0)))
    start = sim.equilibrium(0.5 * L)
    with pytest.raises(InputError, match="start of Simulation must be at the same feed"):
        sim.equilibrium(L, start=start, hold=mw.Hold((L, 0, 0), (1, 0, 0)))
