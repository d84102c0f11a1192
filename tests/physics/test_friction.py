"""Wires under friction against what is known of ropes, sliders and rods (P-29 to P-33).

The long ones are in ``tests/campaigns/friction.py``.
"""

from __future__ import annotations

import numpy as np
import pytest

from lagging import buckled, whip
from magwire.contact import Barrier, Friction
from magwire.engine.feed import Feed
from magwire.evidence.verify.references.sliding import torque_arrived
from magwire.evidence.verify.ropes import (
    THIN,
    Bend,
    climbed,
    lying,
    rope,
    rope_pull,
    works,
)
from magwire.simulation import Simulation
from magwire.wire import Wire
from rubbing import energy, in_balance
from wires import L, lumen, paper_wire

PULL = 20e-3
QUARTER = Bend(0.5 * np.pi)


def paper(friction: Friction | None, nodes: int = 100, damping: float = 0.01) -> Simulation:
    """The paper's wire and half-circle."""
    barrier = Barrier(1e3, 1e-4, wall="centreline")
    return Simulation(
        paper_wire(nodes), lumen("half-circle"), contact=barrier, friction=friction, damping=damping
    )


@pytest.mark.parametrize(("friction", "edge"), [(0.05, 1e-3), (0.3, 1e-3), (0.3, 0.6e-3)])
def test_a_stiff_rope_around_a_drum(friction: float, edge: float) -> None:
    """Within 1 percent; a limp rope would need up to 4 percent less at the larger coefficient."""
    pull, expected = rope_pull(QUARTER, friction, PULL, edge=edge)
    assert pull == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("dt", [0.01, 0.001])
def test_neither_step_nor_speed_matters(dt: float) -> None:
    """By equilibria in steps of 0.25 mm, and in time in steps of 50 um at 5 and at 50 mm/s."""
    pull, _ = rope_pull(QUARTER, 0.3, PULL)
    moving, _ = rope_pull(QUARTER, 0.3, PULL, parts=20, motion="dynamic", time_step=dt)
    assert moving == pytest.approx(pull, rel=0.01)


def test_forces_are_in_balance() -> None:
    """Guide, wall, friction and load, along the guide."""
    session = rope(QUARTER, Friction(0.3, 0.2), PULL, 1e-3)
    direction = session.plant.system.lumen.direction
    for _ in range(5):
        session.step(feed_speed=-1e-4 / session.time_step)
        record = session.record()
        missing, largest = in_balance(record, PULL * QUARTER.exit, direction)
        assert abs(missing) < 1e-9 * largest
        assert np.linalg.norm(record.friction_force.sum(axis=0)) > 0.1 * largest


@pytest.mark.parametrize("dt", [0.01, 1.0])
def test_a_wire_inside_the_cone_does_not_creep(dt: float) -> None:
    angle, crept = climbed(np.arctan(0.9 * 0.5), Friction(0.5), 20.0 if dt < 1.0 else 1000.0, dt)
    assert crept < 1e-6 * 50e-3
    assert np.all(np.abs(angle) < 0.01)


@pytest.mark.parametrize(("part", "kinetic"), [(1.1, 0.5), (2.0, 0.5), (1.1, 0.3)])
def test_a_wire_outside_the_cone_slides_until_it_is_inside(part: float, kinetic: float) -> None:
    """Up the tube's wall, until gravity is at the angle of the kinetic cone with its normal."""
    tilt = float(np.arctan(part * 0.5))
    angle, crept = climbed(tilt, Friction(0.5, kinetic), 10.0, 0.01)
    assert angle[-3] == pytest.approx(tilt - np.arctan(kinetic), rel=0.02)
    assert crept < 1e-6 * 50e-3


@pytest.mark.parametrize("kinetic", [0.2, 0.15])
def test_a_loop_costs_what_friction_takes(kinetic: float) -> None:
    """A wire that is pushed into a bend and back: the second time, it ends as it began."""
    wire = Wire.uniform(110e-3, THIN, 3e9, 1e9, 2000.0, 74)
    sim = Simulation(wire, QUARTER.lumen(), friction=Friction(0.2, kinetic), damping=0.0)
    session = sim.session(feed=50e-3, motion="quasi-static")
    leg = [2e-6] * 20 + [0.2e-3] * 25  # short steps where the push turns round
    course = np.array([(feed, 0.0) for feed in (*leg, *(-part for part in leg))])
    works(session, course)
    stored = energy(session)
    found = works(session, course)
    assert energy(session) == pytest.approx(stored, abs=1e-3 * found.guide)
    assert found.guide == pytest.approx(found.summed, rel=0.01)
    assert found.taken == pytest.approx(found.summed, rel=0.01)


@pytest.mark.parametrize("friction", [Friction(0.1), Friction(0.2, 0.05)])
def test_no_step_gains_energy(friction: Friction) -> None:
    """Of a wire without damping that a field has let go: its motion, bending, slips and losses."""
    session = paper(friction, nodes=40, damping=0.0).session()
    for _ in range(50):
        session.step(feed_speed=0.05, inputs=(0.0, 0.0, 0.1))
    session.time_step = 1e-3
    session.step(inputs=(0.0, 0.0, 0.0))
    unit = session.plant.system.scales.force * session.plant.system.scales.length
    left, lost = [], []
    for _ in range(100):
        session.step()
        lost.append(float(session.plant.state.spent[0]) * unit)
        left.append(energy(session))
    assert lost[-1] - lost[0] > 1e-3 * left[0]
    assert np.diff(np.add(left, lost)).max() < 1e-9 * left[0]


def test_a_wire_that_is_turned_in_a_bend_loses_torque() -> None:
    """Within 2 percent, under a pull that is the same all along."""
    bend, pull = Bend(np.pi), 50e-3
    session = rope(bend, Friction(0.1), pull, 1e-3)
    for _ in range(40):
        session.step(twist_rate=0.05 / session.time_step)
    record = session.record()
    assert -record.push_force == pytest.approx(pull, rel=1e-3)
    expected = torque_arrived(0.0, -bend.turned, 0.1, THIN, pull)
    assert record.guide_torque == pytest.approx(expected, rel=0.02)
    assert record.tip_twist < record.guide_twist - 0.3


def test_a_buckled_wire_locks_up() -> None:
    """F = F_0/(1 + x/x*) within 3 percent, over more than six pitches: a third of it is lost."""
    found = buckled(0.15, 9.0, 1.25e-3, slid=2e-3, step=0.5e-3)
    assert found.turns > 6.0
    assert found.expected[-1] < 0.75 * found.expected[0]
    np.testing.assert_allclose(found.force, found.expected, rtol=0.03)


@pytest.mark.parametrize(("friction", "curved"), [(0.1, 60.0)])
def test_a_curved_tip_whips(friction: float, curved: float) -> None:
    """Tip against guide over two turns; the stiffer one jumps by most of a turn at a time."""
    found = whip(friction, curved, 1e-3, 0.1)
    late = found.guide > 1.0  # how it came to rest at the start is in its friction
    off = np.abs(found.tip - found.expected)[late]
    assert np.median(off) < 0.03
    assert np.sum(off > 0.2) <= (0 if curved < 50.0 else 4)  # a jump may be a step late
    assert (np.diff(found.tip).max() > 4.0) == (curved > 50.0)


def test_none_is_no_friction_bit_for_bit() -> None:
    runs = [paper(friction).run(Feed(0.1 * L, 0.3 * L)) for friction in (None, Friction(0.0))]
    for name, values in runs[0].dataset.data_vars.items():
        if name != "wall_time":
            assert values.equals(runs[1].dataset[name]), name
    assert not runs[0].dataset["friction_force"].values.any()


@pytest.mark.parametrize(("friction", "dt"), [(1.0, 0.1), (0.5, 0.02), (1.0, 0.002)])
def test_nothing_leaves_the_lumen(friction: float, dt: float) -> None:
    run = paper(Friction(friction), nodes=50).run(
        Feed(0.02 * L, (0.5 if dt > 0.01 else 0.3) * L), time_step=dt, record_every=1e-3
    )
    assert run.status == "complete"
    assert run.smallest_clearance > 0.0
    assert run.friction_work[-1] > 0.0


def test_drag_is_work_as_well() -> None:
    """And it grows with the speed, as Coulomb friction does not."""
    taken = []
    for speed in (0.01 * L, 0.1 * L):
        run = paper(Friction(drag=1.0), nodes=40).run(Feed(speed, 0.4 * L), record_every=1e-3)
        assert run.status == "complete"
        taken.append(float(run.friction_work[-1]))
    assert taken[1] == pytest.approx(10.0 * taken[0], rel=0.1)


def test_drag_is_a_force_of_the_record() -> None:
    """Of a tip that is fed along the wall: coefficient times its share of wire and its speed."""
    drag, speed = 5.0, 0.02 * L
    session = paper(Friction(drag=drag), nodes=40).session(motion="quasi-static")
    session.step(feed_speed=speed, duration=25.0)
    before = session.record()
    session.step(feed_speed=speed)
    record = session.record()
    moved = (record.position - before.position)[-1] / session.time_step
    normal = record.contact_force[-1] / np.linalg.norm(record.contact_force[-1])
    along = moved - (moved @ normal) * normal
    cell = 0.5 * L / 39
    force = -drag * cell * along
    assert np.linalg.norm(record.contact_force[-1]) > 0.0
    np.testing.assert_allclose(record.friction_force[-1], force, rtol=0.05)
    direction = session.plant.system.lumen.direction
    missing, largest = in_balance(record, np.zeros(3), direction)
    assert abs(missing) < 1e-6 * largest
    assert np.linalg.norm(force) > 1e-3 * largest


def test_resting_wires_remember() -> None:
    """A snapshot has the contacts in it: what is restored goes on as before."""
    session = lying(0.0, Friction(0.5)).session(feed=45e-3)
    for _ in range(10):
        session.step(feed_speed=-1e-3)
    kept = session.snapshot()
    session.step(feed_speed=-1e-3)
    first = session.record()
    session.restore(kept)
    session.step(feed_speed=-1e-3)
    again = session.record()
    np.testing.assert_array_equal(again.friction_force, first.friction_force)
    assert np.abs(again.friction_force).max() > 0.0
