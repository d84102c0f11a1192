"""Plans for coils that are off, each by itself, in all combinations of signs."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest

import magwire as mw
from magwire.actuate import Hardware, Uniform
from magwire.navigate.model import View
from magwire.navigate.programme import AXES, NORMALS, Programme, constraints
from magwire.navigate.shares import shares_of
from magwire.scenario import inputs_of

from .test_allocation import PLACE, coils, platform

RNG = np.random.default_rng(4)
DEMANDS = mw.Demands(gain_tolerance=0.03)


def a_view() -> View:
    return View(
        flux=np.array([0.02, -0.03, 0.01]),
        axes=np.eye(3)[:2],
        offset=np.array([4e-4, -2e-4]),
        offset_by_flux=RNG.normal(size=(2, 3)) * 0.05,
        radius=3e-3,
        eigenvalue=200.0,
        eigenvalue_by_flux=RNG.normal(size=3) * 1e3,
    )


def test_the_shares_of_coils_make_up_the_field() -> None:
    """Each is what its current of least power makes at the place."""
    actuator = coils()
    shares = shares_of(actuator, PLACE)
    np.testing.assert_allclose(shares.sum(axis=0), np.eye(3), atol=1e-9)
    flux = np.array([6e-3, -3e-3, 2e-3])
    by_input = actuator.response(PLACE[None], np.zeros(8))[0][0].T
    weight = np.diag([1.0 / one.resistance for one in actuator.inputs])
    currents = weight @ by_input.T @ np.linalg.solve(by_input @ weight @ by_input.T, flux)
    np.testing.assert_allclose(shares @ flux, (by_input * currents).T, atol=1e-12)
    np.testing.assert_allclose(shares_of(Uniform(), PLACE), AXES, atol=1e-15)


def test_the_worst_signs_are_those_of_all_combinations() -> None:
    """Against every one of them, of four coils."""
    shares = shares_of(coils(4), PLACE)
    programme, view = Programme(DEMANDS, 0.05, 6e-4, 1e-4, shares), a_view()
    strong = 1.0 / DEMANDS.weakening
    offsets = []
    for signs in itertools.product((-1.0, 1.0), repeat=4):
        made = np.eye(3) + 0.03 * np.einsum("k,kij->ij", np.array(signs), shares)
        moved = strong * made @ view.flux - view.flux
        offsets.append(view.offset + view.offset_by_flux @ moved)
    expected = (np.array(offsets) @ NORMALS.T).max()
    assert programme.uneven(view) == pytest.approx(expected, rel=1e-12)


def test_conditions_are_linear_in_the_field_as_long_as_the_signs_stay() -> None:
    programme, view = Programme(DEMANDS, 0.05, 6e-4, 1e-4), a_view()
    step = 1e-6 * RNG.normal(size=3)
    moved = replace(view, flux=view.flux + step, offset=view.offset + view.offset_by_flux @ step)
    moved = replace(moved, eigenvalue=200.0 + float(view.eigenvalue_by_flux @ step))
    rows, upper, _ = constraints(programme, view, 300.0)
    there = constraints(programme, moved, 300.0).upper
    assert len(rows) == programme.starts[2] + 1
    np.testing.assert_allclose(there, upper - rows[:, :3] @ step / 0.05, atol=1e-11)


def test_the_helix_in_currents_swings_and_stays_free_whichever_coil_is_off() -> None:
    """Signs with which the wire went to the other side, or left the wall, without the tolerance."""
    job = mw.load_scenario("helix").build()
    system = job.simulation.system
    way = system.path.centreline()[0]
    middle = 0.5 * (way.min(axis=0) + way.max(axis=0))
    pose = replace(platform().pose, translation=tuple(middle.tolist()))
    simulation = mw.Simulation(
        system.wire,
        system.lumen,
        contact=system.contact,
        actuator=replace(platform(limit=48.0), pose=pose),
    )
    demands = mw.Demands(stability_margin=20.0, gain_tolerance=0.03)
    steering = mw.Allocated(mw.TipNavigator(demands, update_every=1e-3), objective="field")
    feed = mw.Feed(1e-3, 0.056)
    plan = simulation.run(feed, steering, time_step=0.02, record_every=1e-4)
    assert plan.status == "complete", plan.message
    assert plan.max_tip_force == 0.0
    for errors in ((-0.03, 0.03, 0.03), (0.03, -0.03, 0.03)):
        hardware = Hardware(quantum=0.01, delay=0.05, gain_errors=errors)
        made = simulation.run(
            feed,
            mw.Prescribed(inputs_of(plan)),
            time_step=0.02,
            record_every=1e-4,
            hardware=hardware,
        )
        assert made.status == "complete"
        assert made.max_tip_force == 0.0
