"""Friction at length: `pytest tests/campaigns/friction.py`; not one of the default tests."""

from __future__ import annotations

import numpy as np
import pytest

from lagging import buckled, whip
from magwire.contact import Barrier, Friction
from magwire.engine.feed import Feed
from magwire.evidence.verify.references.sliding import torque_arrived
from magwire.evidence.verify.ropes import THIN, Bend, climbed, rope, rope_pull
from magwire.simulation import Simulation
from wires import L, lumen, paper_wire

PITCH = 3e-3
"""Of bends of a full turn and more [m]: more than a tube is wide."""


def pull_of(friction: float, degrees: float) -> float:
    """Pull at the far end [N] that leaves the wire's stretch below some percent at the guide."""
    return min(20e-3, 2.0 * float(np.exp(-friction * np.radians(degrees))))


@pytest.mark.parametrize("edge", [1.25e-3, 0.8e-3])
@pytest.mark.parametrize("degrees", [90, 180, 360, 720])
@pytest.mark.parametrize("friction", [0.05, 0.1, 0.3, 0.6])
def test_capstan(friction: float, degrees: float, edge: float) -> None:
    bend = Bend(np.radians(degrees), pitch=PITCH if degrees >= 360 else 0.0)
    pull, expected = rope_pull(bend, friction, pull_of(friction, degrees), edge=edge)
    print(f"{friction} {degrees} {edge} {pull:.6g} {pull / expected:.5f}")
    assert pull == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("friction", [0.1, 0.6])
def test_capstan_at_other_steps_and_speeds(friction: float) -> None:
    """In time: step and speed ten times as large, each on its own, change less than 1 percent."""
    bend, pulls = Bend(np.pi), []
    for dt, parts in ((0.01, 100), (0.1, 10), (0.001, 100)):
        options = {"motion": "dynamic", "time_step": dt}
        pulls.append(rope_pull(bend, friction, 20e-3, parts=parts, **options)[0])  # type: ignore[arg-type]
    print(pulls)
    np.testing.assert_allclose(pulls, pulls[0], rtol=0.01)


@pytest.mark.parametrize("dt", [0.01, 1.0])
def test_no_creep_in_a_thousand_seconds(dt: float) -> None:
    angle, crept = climbed(np.arctan(0.9 * 0.5), Friction(0.5), 1000.0, dt)
    print(dt, crept / 50e-3, angle)
    assert crept < 1e-6 * 50e-3


@pytest.mark.parametrize("friction", [0.1, 0.3])
def test_torque_that_a_bend_takes(friction: float) -> None:
    bend, pull = Bend(np.pi), 50e-3
    session = rope(bend, Friction(friction), pull, 1e-3)
    for _ in range(200):
        session.step(twist_rate=0.05 / session.time_step)
    record = session.record()
    expected = torque_arrived(0.0, -bend.turned, friction, THIN, pull)
    print(friction, record.guide_torque / expected, record.guide_twist, record.tip_twist)
    assert record.guide_torque == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize(("friction", "edge"), [(0.15, 1.0e-3), (0.15, 0.7e-3), (0.1, 1.0e-3)])
def test_a_buckled_wire_locks_up(friction: float, edge: float) -> None:
    found = buckled(friction, 12.0, edge, slid=24e-3, step=0.2e-3)
    error = np.abs(found.force / found.expected - 1.0).max()
    print(friction, edge, found.turns, found.force[0] / found.force[-1], error)
    assert found.turns > 6.0
    assert error < 0.03


@pytest.mark.parametrize("curved", [15.0, 60.0])
@pytest.mark.parametrize("friction", [0.0, 0.1, 0.2])
def test_a_curved_tip_whips(friction: float, curved: float) -> None:
    found = whip(friction, curved, 1e-3, 0.05)
    off = np.abs(found.tip - found.expected)[found.guide > 1.0]
    jumps = [
        found.guide[np.diff(angles, prepend=0.0) > 1.0] for angles in (found.tip, found.expected)
    ]
    print(friction, curved, np.median(off), np.sqrt(np.mean(off**2)), off.max(), jumps)
    assert np.median(off) < 0.03


@pytest.mark.parametrize("dt", [0.001, 0.01, 0.1])
@pytest.mark.parametrize("friction", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("where", ["half-circle", "sinusoid", "helix"])
def test_nothing_leaves_the_lumen(where: str, friction: float, dt: float) -> None:
    barrier = Barrier(1e3, 1e-4, wall="centreline")
    sim = Simulation(paper_wire(), lumen(where), contact=barrier, friction=Friction(friction))
    run = sim.run(Feed(0.01 * L, (0.3 if dt < 0.01 else 0.72) * L), time_step=dt)
    assert run.status == "complete", run.message
    assert run.smallest_clearance > 0.0
