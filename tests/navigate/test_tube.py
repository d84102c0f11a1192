"""Steering by the virtual tube: Newton with exact sensitivities, and the paper's optimiser."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine.system import System
from magwire.navigate import NavigationError, Observation, Schedule
from magwire.navigate.model import Model
from magwire.navigate.newton import TOLERANCE, NewtonNavigator
from magwire.navigate.paper import Optimiser, PaperNavigator
from magwire.navigate.tube import TUBE
from magwire.wire import Wire
from tables import control_field
from wires import L, lumen, paper_wire, simulation


def observation(feed: float) -> Observation:
    """What is seen of a wire at a feed: these navigators only ask for the feed."""
    return Observation(feed, np.zeros(3), np.array([1.0, 0.0, 0.0]))


def steered(name: str, until: float) -> tuple[NewtonNavigator, Schedule]:
    """The schedule that Newton's method finds."""
    navigator = NewtonNavigator(simulation(name, paper_wire()).system)
    return navigator, navigator.plan(observation(0.0), until)


def test_force_of_the_tube_changes_as_differences_say() -> None:
    system = simulation("half-circle", paper_wire()).system
    model = Model(system, system.lumen, TUBE * system.lumen.narrowest)
    for feed in np.linspace(0.0, 0.03, 30)[1:]:
        assert model.feed_to(float(feed))
    _, by_flux = model.hold()
    step = 1e-6
    start = model.remember()
    for axis in range(3):
        forces = []
        for sign in (1.0, -1.0):
            assert model.settle(start.inputs + sign * step * np.eye(3)[axis])
            forces.append(model.tube_force())
            model.return_to(start)
        difference = (forces[0] - forces[1]) / (2.0 * step)
        assert np.allclose(by_flux[:, axis], difference, atol=1e-4 * np.abs(by_flux).max())


@pytest.mark.parametrize("name", ["half-circle", "sinusoid", "helix"])
def test_newton_leaves_the_tube_nothing_to_do(name: str) -> None:
    navigator, course = steered(name, 0.072)
    system = navigator.model.system
    assert np.linalg.norm(navigator.model.tube_force()) <= TOLERANCE * system.scales.force
    view = navigator.model.look()
    assert view is not None
    assert np.linalg.norm(view.offset) < TUBE * view.radius
    assert navigator.model.solves / len(course.feed) < 4.0


def test_field_across_the_tip_is_that_of_the_authors() -> None:
    """Their earlier half-circle; four magnetised edges fit their curves (P-4).

    They print the field with the opposite sign; what is compared is the component across the
    centreline, since the one along the tip is a matter of choice (P-22).
    """
    wire = Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, 100, magnetized_tip=4.0 * L / 99.0, magnetization=128e3
    )
    entry = 0.15 * L
    system = System(wire, lumen("authors-half-circle"), Barrier(1e3, 1e-4, wall="centreline"))
    navigator = NewtonNavigator(system)
    assert navigator.model.feed_to(entry)
    course = navigator.plan(observation(entry), entry + 0.04)
    names, pushes, values = zip(*control_field(), strict=True)
    series, push, value = np.array(names), np.array(pushes), np.array(values)
    x, y = series == "green_square", series == "red_circle"
    within = (push[x] > 0.1) & (push[x] < 0.35)
    theirs = -np.stack([value[x], value[y]], axis=1)[within]
    ours = course.at(entry + L * push[x][within])[:, :2] / system.scales.flux_density
    angle = push[x][within] / 0.2
    across = np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    difference = np.einsum("ij,ij->i", ours - theirs, across)
    peak = np.abs(np.einsum("ij,ij->i", theirs, across)).max()
    assert len(difference) == 6
    assert np.abs(difference).max() < 0.05 * peak


def test_the_paper_needs_many_more_equilibria_for_the_same_root() -> None:
    newton, course = steered("half-circle", 0.03)
    baseline = PaperNavigator(newton.model.system)
    for feed in course.feed[1:]:
        baseline.plan(observation(0.0), float(feed))
    force = baseline.model.tube_force()
    assert np.linalg.norm(force) <= TOLERANCE * baseline.model.system.scales.force
    assert baseline.model.solves > 10 * newton.model.solves


def test_where_the_paper_stalls_it_says_so() -> None:
    system = simulation("half-circle", paper_wire()).system
    navigator = PaperNavigator(system, optimiser=Optimiser(iterations=1))

    def push_on() -> None:
        for feed in np.linspace(0.0, 0.03, 60)[1:]:
            navigator.plan(observation(0.0), float(feed))

    with pytest.raises(NavigationError, match="the optimiser stalls: after 1 iterations"):
        push_on()


def test_back_out_again() -> None:
    navigator, forth = steered("half-circle", 0.03)
    back = navigator.plan(observation(0.03), 0.02)
    scale = navigator.model.system.scales.flux_density
    assert back.feed[0] == pytest.approx(0.02)
    assert back.feed[-1] == pytest.approx(0.03)
    # Least-norm steps leave the component along the tip where it was: only the tip comes back.
    assert np.abs(back.at(0.02) - forth.at(0.02)).max() < 30.0 * scale
    view = navigator.model.look()
    assert view is not None
    assert np.linalg.norm(view.offset) < TUBE * view.radius
