"""Walls that give way against closed forms of beams and strings on elastic foundations (P-39)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier, Friction, WallMotion
from magwire.engine.feed import Feed
from magwire.evidence.verify.ropes import THIN, Bend, rope, works
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire
from rubbing import energy
from wires import lumen, paper_wire

FOUNDATION = 1e8  # [Pa/m]


def test_a_heavy_wire_sinks_in_by_its_weight() -> None:
    """Weight per length over foundation times width: w = q/(c d), away from the guide."""
    wire = Wire.uniform(60e-3, 0.5e-3, 1e6, 3e5, 3000.0, 61)
    soft = Barrier(foundation=FOUNDATION)
    tube = Lumen.straight(80e-3, 3e-3)
    sim = Simulation(wire, tube, contact=soft, gravity=(0.0, 0.0, -9.81))
    session = sim.session(feed=55e-3, motion="quasi-static")
    session.step()
    record = session.record()
    expected = 3000.0 * np.pi * 0.25e-6 * 9.81 / (FOUNDATION * 1e-3)
    assert record.wall_indentation[-15:-2] == pytest.approx(expected, rel=0.01)
    assert record.clearance[-15:].min() > 0.0


def test_a_beam_on_an_elastic_foundation() -> None:
    """Hetenyi's semi-infinite beam, pressed at its free end by P: w(x) = 2 P b/k e^-bx cos bx.

    b = (k/(4 EI))^(1/4), k = c d. The wire lies in the wall all along, by its weight.
    """
    foundation, radius, load = 2e8, 0.5e-3, 20e-3
    wire = Wire.uniform(80e-3, radius, 2e7, 7e6, 2e5, 161)
    unit = foundation * 2.0 * radius
    tube = Lumen.straight(100e-3, 1e-3)
    lying = []
    for press in (0.0, load):
        sim = Simulation(
            wire,
            tube,
            contact=Barrier(foundation=foundation, activation_gap=1e-7),
            gravity=(0.0, 0.0, -9.81),
            tip_load=(0.0, 0.0, -press),
        )
        flat = sim.session(feed=75e-3, motion="quasi-static")
        flat.step()
        lying.append(flat.record().wall_indentation)
    beta = (unit / (4.0 * wire.bending_stiffness)) ** 0.25
    x = np.linspace(0.0, 80e-3, 161)[::-1]
    form = 2.0 * load * beta / unit * np.exp(-beta * x) * np.cos(beta * x)
    near = x < 1.5 / beta
    assert lying[1][-60:].min() > 0.0  # it lifts nowhere
    error = np.abs(lying[1] - lying[0] - form)[near].max()
    assert error < 0.01 * form.max()


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_taut_wire_cuts_into_the_inside_of_a_bend(friction: float) -> None:
    """The foundation carries the tension over the radius: c d w = T/(R - w).

    Where the wire comes to the drum T is less than the pull by EI/(2 R^2); see ``capstan``. Of m
    parts of a chord of length l the points lie (m^2 - 1) l^2/(12 m^2 R) deeper than its ends.
    """
    bend, pull, edge, foundation = Bend(np.pi), 20e-3, 0.5e-3, 6e7
    soft = Barrier(foundation=foundation)
    session = rope(bend, Friction(friction), pull, edge, contact=soft)
    for _ in range(4):
        session.step(feed_speed=-0.25e-3 / session.time_step)
    record = session.record()
    middle = len(record.clearance) // 2
    depth = float(record.wall_indentation[middle - 3 : middle + 4].mean())
    parts = session.plant.system.new_wall().between.parts
    depth += (1.0 - 1.0 / parts**2) * edge**2 / (12.0 * bend.drum)
    sizes = np.linalg.norm(record.contact_force, axis=1)
    radius = bend.drum - depth
    tension = pull - 0.5 * session.plant.system.wire.bending_stiffness / radius**2
    tension += friction * (sizes[middle + 1 :].sum() + 0.5 * sizes[middle])
    assert depth == pytest.approx(tension / (foundation * 2.0 * THIN * radius), rel=0.01)
    assert record.clearance_along > 0.0


def test_a_loop_in_a_soft_bend_costs_what_friction_takes() -> None:
    wire = Wire.uniform(110e-3, THIN, 3e9, 1e9, 2000.0, 74)
    sim = Simulation(
        wire,
        Bend(0.5 * np.pi).lumen(),
        contact=Barrier(foundation=1e8),
        friction=Friction(0.2),
        damping=0.0,
    )
    session = sim.session(feed=50e-3, motion="quasi-static")
    leg = [2e-6] * 20 + [0.2e-3] * 25
    course = np.array([(feed, 0.0) for feed in (*leg, *(-part for part in leg))])
    works(session, course)
    stored = energy(session)
    found = works(session, course)
    assert energy(session) == pytest.approx(stored, abs=1e-3 * found.guide)
    assert found.guide == pytest.approx(found.summed, rel=0.01)


def test_a_hard_foundation_is_a_rigid_wall() -> None:
    wire = Wire.uniform(0.1, 0.6e-3, 3e6, 1e6, 2000.0, 50)
    bend = Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    runs = [
        Simulation(wire, bend, contact=Barrier(foundation=stiff)).run(
            Feed(0.02, 0.05), time_step=0.02, record_every=1e-3
        )
        for stiff in (None, 1e13)
    ]
    assert [run.status for run in runs] == ["complete", "complete"]
    assert runs[1].tip_force[-1] == pytest.approx(runs[0].tip_force[-1], rel=0.01)
    assert runs[1].largest_indentation < 1e-8
    assert runs[0].largest_indentation == 0.0


def test_a_soft_wall_that_moves() -> None:
    """Guide and wall do what wire and wall store, within 1 percent, and no contact is missed."""
    breath = WallMotion((0.6e-3, 0.6e-3, 0.529e-3), 1.0, 25e-3)
    sim = Simulation(
        paper_wire(40),
        lumen("half-circle"),
        contact=Barrier(foundation=1e7),
        wall_motion=breath,
    )
    session = sim.session(feed=45e-3, motion="quasi-static", time_step=5e-3)
    session.step()
    begun, stored = session.record(), energy(session)
    done = works(session, np.tile([0.05e-3, 0.0], (100, 1)))
    record = session.record()
    wall = record.wall_work - begun.wall_work
    assert done.guide + wall == pytest.approx(energy(session) - stored, abs=0.01 * done.guide)
    assert abs(wall) > 0.05 * done.guide
    assert record.clearance_along > 0.0
    assert record.wall_indentation.max() > 1e-6


def test_how_deep_a_wall_is_pressed_in_has_an_end() -> None:
    """Half of the path's smallest radius: up to there a heavy wire sinks in, then it is said.

    Where it lies flat it is as deep as its weight over the foundation; where it comes down, deeper.
    """
    wire = Wire.uniform(60e-3, 0.5e-3, 1e6, 3e5, 3000.0, 31)
    tube = Lumen.straight(80e-3, 2e-3)
    weight = 3000.0 * np.pi * 0.25e-6 * 9.81
    for flat, ends in ((0.4e-3, False), (0.6e-3, True)):
        soft = Barrier(foundation=weight / (1e-3 * flat))
        sim = Simulation(wire, tube, contact=soft, gravity=(0.0, 0.0, -9.81), damping=10.0)
        run = sim.run(Feed(20e-3, 55e-3), time_step=0.02)
        assert (run.status == "complete") != ends
        assert run.smallest_clearance > 0.0
        assert run.largest_indentation < 1e-3
        if ends:
            assert "half of the path's smallest radius" in run.message
        else:
            np.testing.assert_allclose(run.wall_indentation[-1, -8:], flat, rtol=0.02)
            assert run.largest_indentation > 1.5 * flat
