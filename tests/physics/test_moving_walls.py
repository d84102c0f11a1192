"""Walls that move: no contact is missed, and what they do to the wire is accounted for (P-40)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier, Friction, WallMotion
from magwire.engine.feed import Feed
from magwire.evidence.verify.ropes import works
from magwire.session import Session
from magwire.simulation import Simulation
from rubbing import energy
from wires import lumen, paper_wire

BREATH = WallMotion((0.6e-3, 0.6e-3, 0.529e-3), 1.0, 25e-3)  # 1 mm, also out of the bend's plane


def breathing(friction: Friction | None = None) -> Simulation:
    """The paper's wire and half-circle, which moves by 1 mm at 1 Hz."""
    return Simulation(
        paper_wire(40),
        lumen("half-circle"),
        contact=Barrier(1e3, 1e-4, wall="centreline"),
        friction=friction,
        wall_motion=BREATH,
    )


@pytest.mark.parametrize("dt", [0.01, 0.13])
@pytest.mark.parametrize("friction", [None, Friction(0.2)])
def test_no_contact_is_missed(friction: Friction | None, dt: float) -> None:
    """Over two periods, while the wire is pushed on and held: never outside, and never let go."""
    session = breathing(friction).session(feed=45e-3, time_step=dt)
    for k in range(round(2.0 / dt)):
        session.step(duration=dt, feed_speed=2e-3 if k * dt < 1.0 else 0.0)
        record = session.record()
        assert record.clearance_along > 0.0
        assert np.abs(record.contact_force).max() > 0.0
    assert session.plant.time == pytest.approx(2.0, abs=dt)


def breathe(session: Session, parts: int, duration: float) -> tuple[float, float]:
    """Work of the wall, and the same of its forces as recorded, while the guide holds still [J]."""
    record = session.record()
    begun, summed = record.wall_work, 0.0
    for _ in range(parts):
        before = record
        session.step(duration=duration / parts)
        record = session.record()
        force = before.contact_force + before.friction_force
        force = 0.5 * (force + record.contact_force + record.friction_force)
        summed += float(np.sum(force * (record.wall_displacement - before.wall_displacement)))
    return record.wall_work - begun, summed


@pytest.mark.parametrize("friction", [None, Friction(0.2)])
def test_energy_is_accounted_for(friction: Friction | None) -> None:
    """The wall's work is what wire, wall and elastic slips store, and what friction takes."""
    session = breathing(friction).session(feed=45e-3, motion="quasi-static", time_step=5e-3)
    session.step(duration=5e-3)
    stored, taken = energy(session), session.record().friction_work
    wall, summed = breathe(session, 100, 0.5)
    stored, taken = energy(session) - stored, session.record().friction_work - taken
    assert wall == pytest.approx(summed, rel=1e-6)
    assert stored + taken == pytest.approx(wall, rel=1e-3)
    assert abs(wall) > 1e-8
    assert (taken > 0.05 * abs(wall)) == (friction is not None)


@pytest.mark.parametrize("friction", [None, Friction(0.2)])
def test_feeding_into_a_bend_that_moves_is_accounted_for(friction: Friction | None) -> None:
    """Guide and wall do what is stored and taken, within 1 percent of what the guide does.

    A third of the push and more is work of the mouth, which squeezes the bent wire out.
    """
    session = breathing(friction).session(feed=45e-3, motion="quasi-static", time_step=5e-3)
    session.step()
    begun, stored = session.record(), energy(session)
    done = works(session, np.tile([0.05e-3, 0.0], (100, 1)))
    record = session.record()
    wall = record.wall_work - begun.wall_work
    stored = energy(session) - stored
    assert done.guide + wall == pytest.approx(stored + done.taken, abs=0.01 * done.guide)
    assert abs(wall) > 0.1 * done.guide
    assert record.insertion_force < 0.8 * record.push_force


def test_it_goes_on_from_where_it_was() -> None:
    """A snapshot knows the time, and with it where the wall is."""
    session = breathing(Friction(0.1)).session(feed=45e-3)
    session.step(duration=0.2)
    kept = session.snapshot()
    session.step(duration=0.1)
    first = session.record()
    session.step(duration=0.3)
    session.restore(kept)
    session.step(duration=0.1)
    again = session.record()
    np.testing.assert_array_equal(again.position, first.position)
    np.testing.assert_array_equal(again.wall_displacement, first.wall_displacement)
    assert again.wall_work == first.wall_work
    assert np.abs(first.wall_displacement).max() > 1e-4


def test_a_run_is_recorded_with_it() -> None:
    run = breathing().run(Feed(0.05, 0.05), record_every=1e-3)
    assert run.status == "complete"
    assert run.smallest_clearance > 0.0
    moved = np.linalg.norm(run.wall_displacement, axis=2)
    assert moved.max() == pytest.approx(1e-3, rel=0.01)
    assert np.all(moved[:, 0] == 0.0)
    assert run.work_of_wall != 0.0


def test_an_amplitude_of_nothing_is_a_wall_at_rest() -> None:
    sims = [
        Simulation(paper_wire(30), lumen("half-circle"), wall_motion=motion)
        for motion in ((), WallMotion((0, 0, 0), 1.0, 20e-3))
    ]
    runs = [sim.run(Feed(0.05, 0.04), record_every=1e-3) for sim in sims]
    np.testing.assert_allclose(runs[1].position, runs[0].position, atol=1e-7)
    assert runs[1].work_of_wall == 0.0
