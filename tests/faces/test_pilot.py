"""A person's hands on a wire: held keys, a limit, the way back."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

import magwire as mw
from magwire.drive import DEAD_MAN, Pilot
from magwire.session import Session

DT = 0.01
SPEED = 4e-3


class Clock:
    """Seconds that pass when told to."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def session() -> Iterator[Session]:
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
    with mw.Simulation(wire, lumen).session(time_step=DT) as session:
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
    feed = session.plant.feed
    pilot.tick()
    assert session.plant.feed == pytest.approx(feed + SPEED * DT)
