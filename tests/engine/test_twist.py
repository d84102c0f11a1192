"""Turning the wire at its proximal end."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.system import System
from magwire.field import UniformField
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire
from wires import L, flux, free, lumen, magnet, paper_wire

TURN = 2.0 * np.pi


def curved(nodes: int = 40) -> Wire:
    return Wire.uniform(L, 0.6e-3, 3e6, 1e6, 2000.0, nodes, rest_curvature=(10.0, 0.0))


@pytest.mark.parametrize("where", ["open space", "straight", "half-circle"])
@pytest.mark.parametrize("turns", [0.3, 2.0])
def test_a_round_straight_wire_turns_as_a_whole(where: str, turns: float) -> None:
    lumens = {"open space": Lumen.open_space, "straight": lambda: Lumen.straight(L, 3e-3)}
    tube = lumens[where]() if where in lumens else lumen(where)
    sim = Simulation(paper_wire(), tube, contact=Barrier(1e3, 1e-4, wall="centreline"))
    plain, turned = sim.equilibrium(0.05), sim.equilibrium(0.05, twist=turns * TURN)
    assert turned.twist == turns * TURN
    np.testing.assert_allclose(turned.positions, plain.positions, atol=1e-9 * L)
    np.testing.assert_allclose(turned.point.state.q[:-1, 3], turns * TURN, atol=1e-8)


def test_turning_in_time_reaches_the_tip() -> None:
    """Four turns while standing still: each edge follows, in whole turns."""
    system = System(paper_wire(60), Lumen.straight(L, 3e-3), Barrier(1e3, 1e-4, wall="centreline"))
    course = Feed.table(
        [0.0, 30.0, 30.02, 50.0, 60.0],
        [1e-3, 1e-3, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 4 * TURN, 4 * TURN],
    )
    run = March(system, UniformField(), course, time_step=0.02)
    assert run.advance(10**6), run.plant.message
    run.plant.record()
    np.testing.assert_allclose(run.plant.state.q[:-1, 3], 4.0 * TURN, atol=1e-4)


def test_the_tip_of_a_curved_wire_goes_round() -> None:
    """In open space the arc is carried round without effort, turn after turn."""
    sim = free(curved())
    state = sim.equilibrium(0.08)
    radius = np.hypot(*state.tip[1:])
    begin = np.arctan2(state.tip[2], state.tip[1])
    for angle in np.linspace(0.0, 3.0 * TURN, 37):
        state = sim.equilibrium(0.08, start=state, twist=angle)
        assert state.stable
        expected = radius * np.array([np.cos(begin + angle), np.sin(begin + angle)])
        np.testing.assert_allclose(state.tip[1:], expected, atol=1e-7 * L)


def test_many_turns_in_a_bend_stay_continuous() -> None:
    """A curved wire in a bend winds up and lets go, but no step loses count of a turn."""
    wire = Wire.uniform(L, 0.6e-3, 3e6, 1e6, 2000.0, 60, rest_curvature=(30.0, 0.0))
    system = System(wire, lumen("half-circle"), Barrier(1e3, 1e-4, wall="centreline"))
    course = Feed.table(
        [0.0, 39.98, 40.0, 70.0, 90.0],
        [1e-3, 1e-3, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 3 * TURN, 3 * TURN],
    )
    run = March(system, UniformField(), course, time_step=0.02)
    ends = {}
    while run.step < run.steps:
        assert run.advance(25), run.plant.message
        ends[run.step * 0.02] = run.plant.record().position[-1]
    # After whole turns the wire is back in its place: its twist went out through the tip.
    assert np.linalg.norm(ends[90.0] - ends[40.0]) < 2e-3 * L
    material = run.plant.state.q[:-1, 3]
    assert material[0] == pytest.approx(3.0 * TURN)
    assert np.abs(material - 3.0 * TURN).max() < 0.5 * TURN


def test_twist_turns_a_magnet_across_the_axis() -> None:
    """A straight wire with a moment across it, in a field across it: a torsion pendulum.

    GJ/l (angle - theta) = m B sin(theta) at the tip, the magnet being one short section.
    """
    wire = magnet(100, 0.02, magnetization=(60e3, 0.0, 0.0))
    sim = free(wire)
    along = sim.system.guide.director
    moment = wire.moment_per_length * 0.02 * L
    stiffness = wire.sections[0].twisting_stiffness / (0.99 * L)
    size = 0.2 * stiffness / moment
    for angle in (0.4, 1.2, 2.0):
        state = sim.equilibrium(L, size * along, twist=angle)
        theta = state.point.state.q[-2, 3]
        assert stiffness * (angle - theta) == pytest.approx(moment * size * np.sin(theta), rel=0.01)


def test_twisting_does_not_bend_a_magnetised_straight_wire() -> None:
    wire = magnet(60)
    sim = free(wire)
    plain = sim.equilibrium(L, flux(wire, 3.0, 90.0))
    turned = sim.equilibrium(L, flux(wire, 3.0, 90.0), start=plain, twist=5.0)
    np.testing.assert_allclose(turned.positions, plain.positions, atol=1e-7 * L)


def test_a_result_says_how_guide_and_tip_are_turned() -> None:
    """In a straight tube the tip follows the guide, and its director turns about the axis."""
    wire = Wire.uniform(
        length=0.05, radius=5e-4, youngs_modulus=3e6, shear_modulus=1e6, density=2e3, nodes=21
    )
    simulation = Simulation(wire, Lumen.straight(0.1, 3e-3), damping=20.0)
    with simulation.session(time_step=0.02, record_every=0.5) as turned:
        turned.step(feed_speed=0.02, twist_rate=0.6, duration=2.0)
        turned.step(duration=4.0)
    last = turned.result.dataset.isel(time=-1)
    assert float(last["guide_twist"]) == pytest.approx(1.2)
    assert float(last["tip_twist"]) == pytest.approx(1.2, abs=1e-3)
    first = turned.result.dataset["material_director"].values[0, -1]
    there = last["material_director"].values[-1]
    assert np.dot(first, there) == pytest.approx(np.cos(1.2), abs=1e-3)
    assert np.cross(first, there)[0] == pytest.approx(np.sin(1.2), abs=1e-3)
