"""The navigator's model to first order, against differences and a dense eigenvalue problem."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from magwire.navigate import Observation
from magwire.navigate.model import Model, View
from magwire.navigate.stable import StableNavigator
from tangent import mass, stiffness
from wires import L, paper_wire, simulation

FEED = 0.0404
FLUX = np.array([-8e-3, 9e-3, 2e-3])  # steers the tip of the half-circle in the middle of it


def model() -> Model:
    """The half-circle, with the wire half-way in and a field that keeps the tip off the wall."""
    system = simulation("half-circle", paper_wire()).system
    steered = Model(system, system.lumen)
    for feed in np.linspace(0.0, FEED, 40)[1:]:
        steered.flux = FLUX * min(1.0, feed / 0.02)
        assert steered.feed_to(float(feed))
    assert steered.settle(FLUX)
    return steered


def look(at: Model, flux: np.ndarray) -> View:
    """The view in another field, from the same start."""
    start = at.remember()
    assert at.settle(flux)
    view = at.look()
    at.return_to(start)
    assert view is not None
    return view


def test_sensitivities_are_what_differences_say() -> None:
    steered = model()
    view = look(steered, FLUX)
    step = 2e-6
    for axis in range(3):
        change = step * np.eye(3)[axis]
        above, below = look(steered, FLUX + change), look(steered, FLUX - change)
        offset = (above.offset - below.offset) / (2.0 * step)
        eigen = (above.eigenvalue - below.eigenvalue) / (2.0 * step)
        scale = np.abs(view.offset_by_flux).max()
        assert np.allclose(view.offset_by_flux[:, axis], offset, atol=1e-5 * scale)
        scale = np.abs(view.eigenvalue_by_flux).max()
        assert view.eigenvalue_by_flux[axis] == pytest.approx(eigen, abs=1e-4 * scale)


def test_eigenvalue_is_the_smallest_of_stiffness_against_mass() -> None:
    steered = model()
    state = simulation("half-circle", paper_wire()).equilibrium(FEED, FLUX)
    smallest = eigh(stiffness(state), np.diag(mass(state)), eigvals_only=True)[0]
    assert look(steered, FLUX).eigenvalue == pytest.approx(smallest, rel=1e-4)


def test_offset_is_the_distance_from_the_centreline() -> None:
    steered = model()
    state = simulation("half-circle", paper_wire()).equilibrium(FEED, FLUX)
    distance = steered.system.lumen.offset(state.tip[None])[0]
    assert np.linalg.norm(look(steered, FLUX).offset) == pytest.approx(distance, abs=1e-7 * L)


def test_returning_restores_the_equilibrium() -> None:
    steered = model()
    before = look(steered, FLUX)
    memory = steered.remember()
    assert steered.settle(1.1 * FLUX)
    assert steered.feed_to(FEED + 1e-3)
    steered.return_to(memory)
    after = steered.look()
    assert after is not None
    assert steered.feed == pytest.approx(FEED)
    assert np.array_equal(after.offset, before.offset)


def test_an_unstable_equilibrium_has_no_view() -> None:
    system = simulation("half-circle", paper_wire()).system
    steered = Model(system, system.lumen)
    assert steered.feed_to(0.008)
    assert steered.settle(np.array([-0.5, 0.0, 0.0]))
    assert steered.look() is None


def test_slowest_mode_is_found_from_a_guess_in_another_plane() -> None:
    """Where the wire is about to swing out of the plane, though the guess lies in it."""
    navigator = StableNavigator(simulation("half-circle", paper_wire()).system)
    navigator.plan(Observation(0.0, np.zeros(3), np.array([1.0, 0.0, 0.0])), 0.06)
    steered = navigator.model
    before = steered.look()
    assert before is not None
    mode = steered._linear.modes[
        8 : 4 * (len(steered._plant.state.q) - int(steered._plant.state.held[0]) + 1) - 1, 0
    ]
    assert np.abs(mode[2::4]).max() > 10.0 * np.abs(mode[0::4]).max()  # it swings along z
    steered._linear.modes[:] = 0.0
    mode[1::4] = 1.0
    after = steered.look()
    assert after is not None
    assert after.eigenvalue == pytest.approx(before.eigenvalue, rel=1e-6)


def test_slopes_are_finite_where_a_field_moves_nothing() -> None:
    """A straight wire in a field along it."""
    system = simulation("half-circle", paper_wire()).system
    model = Model(system, system.path)
    assert model.feed_to(0.004)
    view = model.look()
    assert view is not None
    assert np.all(np.isfinite(view.eigenvalue_by_flux))
    assert view.eigenvalue_by_flux[0] > 0.0


def test_it_says_whether_the_wall_presses() -> None:
    system = simulation("half-circle", paper_wire()).system
    passive = Model(system, system.lumen)
    assert not passive.near_wall  # nothing is inside
    for feed, touches in ((0.08 * L, False), (0.2 * L, True), (0.08 * L, False)):
        assert passive.feed_to(feed)
        assert passive.near_wall == touches  # first contact is at 0.12 L
