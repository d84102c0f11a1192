"""A person's hands on a wire: held keys, a limit, the way back."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import magwire as mw
from magwire.drive import DEAD_MAN, Pilot
from magwire.drive.clockwork import Clockwork
from magwire.navigate import NavigationError
from magwire.session import Session

DT = 0.01
SPEED = 4e-3


class Clock:
    """Seconds that pass when told to."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def simulation() -> mw.Simulation:
    wire = mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=60,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    return mw.Simulation(wire, lumen)


@pytest.fixture
def session() -> Iterator[Session]:
    with simulation().session(time_step=DT) as session:
        yield session


def test_what_is_held_feeds_until_it_is_let_go(session: Session) -> None:
    clock = Clock()
    pilot = Pilot(session, clock=clock)
    start = session.plant.feed
    pilot.hold(SPEED)
    for _ in range(100):
        pilot.tick()
        clock.now += DT
    fed = session.plant.feed - start
    assert fed == pytest.approx(SPEED * DEAD_MAN, abs=1.001 * SPEED * DT)
    assert session.plant.time == pytest.approx(100 * DT)  # the wire's time goes on


def test_limit_stops_the_advance_and_lets_retract(session: Session) -> None:
    clock = Clock()
    for _ in range(100):  # into the bend
        session.step(feed_speed=SPEED * 8)
    assert session.observe().wall_force > 0.0
    pilot = Pilot(session, limit=0.5 * session.observe().wall_force, clock=clock)
    feed = session.plant.feed
    pilot.hold(SPEED)
    pilot.tick()
    assert session.plant.feed == feed
    assert "limit" in pilot.message
    pilot.hold(-SPEED)
    pilot.tick()
    assert session.plant.feed < feed
    assert pilot.message == ""


def test_rewind_comes_back_bit_for_bit(session: Session) -> None:
    pilot = Pilot(session, every=0.05, clock=Clock())
    pilot.hold(SPEED)
    seen = [session.record()]
    for _ in range(23):
        pilot.tick()
        seen.append(session.record())
    now = pilot.rewind(0.1)
    was = min(seen, key=lambda record: abs(record.time - now))
    assert 0.0 < now <= 0.13 + 1e-9
    assert was.time == now
    np.testing.assert_array_equal(session.record().position, was.position)
    feed = session.plant.feed
    pilot.tick()  # what was held is let go
    assert session.plant.feed == feed


def test_a_recording_goes_back_with_the_wire(tmp_path: Path) -> None:
    """Also what was flushed: times rise, and what was taken back is not in the file."""
    file = tmp_path / "hand.nc"
    with simulation().session(time_step=DT, record_every=0.05, out=file) as session:
        pilot = Pilot(session, every=0.05, clock=Clock())
        pilot.hold(8 * SPEED)
        for _ in range(60):
            pilot.tick()
        session._recording[0].flush()  # type: ignore[index]
        now = pilot.rewind(0.3)
        assert pilot.rewinds == 1
        pilot.hold(-SPEED)
        for _ in range(20):
            pilot.tick()
        feed, account = session.plant.feed, pilot.account
    result = mw.Result.load(file)
    assert result.status == "complete"
    assert np.all(np.diff(result.time) > 0.0)
    assert now in result.time
    assert result.feed[-1] == feed
    assert result.feed.max() == pytest.approx(8 * SPEED * now)
    # The account is of the steps that stand.
    assert account.time == pytest.approx(now + 20 * DT)
    assert account.retractions == 1
    # What was held, and for how long, is what was fed.
    times = np.array([*(row[0] for row in pilot.course), result.time[-1]])
    speeds = np.array([row[1] for row in pilot.course])
    assert np.sum(speeds * np.diff(times)) == pytest.approx(feed, abs=SPEED * DT)


def test_a_recording_in_memory_goes_back_too() -> None:
    with simulation().session(time_step=DT, record_every=0.05) as session:
        session.step(feed_speed=SPEED, duration=0.2)
        kept = session.snapshot()
        session.step(feed_speed=SPEED, duration=0.3)
        session.restore(kept)
    assert np.all(np.diff(session.result.time) > 0.0)
    assert session.result.time[-1] == kept.time
    assert session.result.feed[-1] == kept.feed


def test_account_adds_up_what_the_records_say() -> None:
    """Sums of the pilot against sums over records of every step."""
    with simulation().session(time_step=DT, record_every=DT) as session:
        pilot = Pilot(session, clock=Clock())
        for speed, turn in ((12 * SPEED, 0.0), (-4 * SPEED, 1.0), (2 * SPEED, -1.0)):
            pilot.hold(speed, turn)
            for _ in range(60):
                pilot.tick()
    data, account = session.result.dataset, pilot.account
    wall, feed, twist = (data[name].values for name in ("wall_force", "feed", "guide_twist"))
    assert wall.max() > 0.0
    assert account.peak_force == pytest.approx(wall.max(), rel=1e-12)
    trapezium = 0.5 * DT * (wall[1:] + wall[:-1]).sum()
    assert account.impulse == pytest.approx(trapezium, rel=1e-9)
    tip = data["position"].values[:, -1]
    assert account.path == pytest.approx(np.linalg.norm(np.diff(tip, axis=0), axis=1).sum())
    push, torque = data["push_force"].values, data["guide_torque"].values
    work = sum(
        0.5 * np.sum((force[1:] + force[:-1]) * np.diff(way))
        for force, way in ((push, feed), (torque, twist))
    )
    assert account.work == pytest.approx(work, rel=1e-9)
    assert account.retractions == 1


def test_inputs_go_no_faster_than_they_may(session: Session) -> None:
    pilot = Pilot(session, clock=Clock())
    pilot.steer([0.0, 10e-3, 0.0])
    assert not pilot.idle
    for step in (2e-3, 4e-3):  # 0.2 T/s
        assert pilot.tick().inputs[1] == pytest.approx(step)
    for _ in range(5):
        pilot.tick()
    assert pilot.sight.inputs[1] == 10e-3
    assert pilot.idle


class Along:
    """A navigator that takes its time; it wants a field that grows with the feed."""

    def __init__(self) -> None:
        self.may = threading.Event()

    def plan(self, observation: object, until: float) -> mw.Schedule:
        self.may.wait(10.0)
        if until > 0.02:
            raise NavigationError("There is no field.")
        return mw.Schedule(np.array([0.0, 0.1]), np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0]]))


def test_the_wire_waits_for_the_navigator_and_time_does_not(session: Session) -> None:
    along, clock = Along(), Clock()
    pilot = Pilot(session, navigator=lambda: along, clock=clock)
    pilot.ask("assist")
    pilot.hold(SPEED)
    for _ in range(5):
        pilot.tick()
    assert session.plant.feed == 0.0
    assert session.plant.time == pytest.approx(5 * DT)
    assert "planning" in pilot.message
    along.may.set()
    until = time.monotonic() + 20.0
    while session.plant.feed < 1e-2 and time.monotonic() < until:
        pilot.hold(50 * SPEED)
        pilot.tick()
        np.testing.assert_allclose(session.plant.inputs[1], session.plant.feed, atol=1e-12)
    assert session.plant.feed >= 1e-2
    while "no field" not in pilot.message and time.monotonic() < until:
        pilot.hold(SPEED)
        pilot.tick()
    assert pilot.message == "There is no field."
    there = session.plant.feed
    pilot.tick()
    assert session.plant.feed == there  # it says so until somebody retracts


def test_assist_keeps_the_tip_off_the_wall(session: Session) -> None:
    """Into the bend, where a wire that nobody steers presses on the wall from 13 mm on.

    All of the half-circle is in campaigns/drive_pictures.py: 25 s of planning.
    """
    system = session.plant.system
    pilot = Pilot(session, navigator=lambda: mw.TipNavigator(plan_every=1e-3).start(system))
    pilot.ask("assist")
    until = time.monotonic() + 120.0
    while session.plant.feed < 22e-3 and time.monotonic() < until:
        pilot.hold(2 * SPEED)
        pilot.tick()
        if pilot.message:
            time.sleep(5e-3)
    assert session.plant.feed >= 22e-3
    with pytest.raises(mw.InputError, match="switch it off to set it by hand"):
        pilot.steer([0.0, 10e-3, 0.0])
    np.testing.assert_array_equal(pilot.wanted, session.plant.inputs)
    assert session.plant.totals.max_tip_force == 0.0
    assert pilot.account.peak_force == 0.0
    assert np.linalg.norm(session.plant.inputs) > 1e-3


def test_a_step_that_fails_leaves_the_wire_and_the_way_back(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A field that no wire bears; by hand it is refused."""
    session.step(feed_speed=SPEED, duration=5.0)
    pilot = Pilot(session, clock=Clock())
    monkeypatch.setattr("magwire.drive.pilot.LARGEST", math.inf)
    monkeypatch.setattr(pilot, "_slew", np.full(3, 1e6))
    pilot.hold(SPEED)
    for _ in range(20):
        pilot.steer([0.0, -4e4, 0.0])
        before = pilot.sight
        now = pilot.tick()
        if pilot.message:
            break
        pilot.steer([0.0, 4e4, 0.0])
        pilot.tick()
    assert "did not converge" in pilot.message
    np.testing.assert_array_equal(now.points, before.points)
    assert now.time == before.time
    pilot.rewind(100.0)
    pilot.tick()
    assert pilot.message == ""
    assert pilot.sight.time > 0.0


def test_suggestions_leave_the_inputs_alone(session: Session) -> None:
    along = Along()
    along.may.set()
    pilot = Pilot(session, navigator=lambda: along, clock=Clock())
    pilot.ask("suggest")
    until = time.monotonic() + 20.0
    while pilot.suggested is None and time.monotonic() < until:
        pilot.tick()
    assert pilot.suggested is not None
    assert pilot.suggested[1] == pytest.approx(1e-4)
    assert not session.plant.inputs.any()
    with pytest.raises(mw.InputError, match="without a navigator"):
        Pilot(session).ask("assist")


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_absurd_values_are_refused_and_change_nothing(session: Session, value: float) -> None:
    pilot = Pilot(session, clock=Clock())
    pilot.hold(SPEED)
    with pytest.raises(mw.InputError):
        pilot.hold(value)
    with pytest.raises(mw.InputError):
        pilot.steer([value, 0.0, 0.0])
    with pytest.raises(mw.InputError):
        pilot.rewind(value)
    with pytest.raises(mw.InputError, match="at most 1 T"):
        pilot.steer([0.0, 5.0, 0.0])
    feed = session.plant.feed
    pilot.tick()
    assert session.plant.feed == pytest.approx(feed + SPEED * DT)


def test_orders_are_carried_out_in_order_also_at_rest(session: Session) -> None:
    """A key that is pressed and let go at once, while the time stands, stays let go."""
    pilot = Pilot(session)
    clockwork = Clockwork(pilot, lambda: None, lambda: None)
    clockwork.start()
    until = time.monotonic() + 20.0
    done: list[int] = []
    for first in range(0, 200, 2):
        for number in (first, first + 1):
            clockwork.order(lambda number=number: done.append(number))  # type: ignore[misc]
        while len(done) < first + 2 and time.monotonic() < until:
            time.sleep(1e-4)
    clockwork.stop()
    assert clockwork.failure is None
    assert done == list(range(200))
    assert session.plant.time == 0.0  # nobody looks and nothing is held
