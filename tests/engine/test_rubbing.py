"""Sensitivities under friction against short courses, where contacts slide and where they stick."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier, Friction, WallMotion
from magwire.engine import system
from magwire.engine.plant import Snapshot
from magwire.engine.rubbing import Branches, Change, Course
from magwire.errors import InputError
from magwire.session import Session
from magwire.simulation import Simulation
from wires import lumen, paper_wire

Array = NDArray[np.float64]
PARTS = 100
"""Steps of a short course: in each, the normal forces are those of its beginning (P-31)."""
SIZES = {"field": 4e-7, "feed": 2e-8, "twist": 2e-5}
"""Of short courses: a part of what takes a contact through its elastic slip [T, m, rad]."""
SHARP = 1e-11


def pushed(name: str = "helix", *, motion: str = "quasi-static") -> Session:
    """The paper's wire with friction, in a field."""
    sim = Simulation(
        paper_wire(40),
        lumen(name),
        contact=Barrier(1e3, 1e-4, wall="centreline"),
        friction=Friction(0.3),
    )
    return sim.session(motion=motion, time_step=0.1)  # type: ignore[arg-type]


def sharp(name: str = "helix") -> Session:
    """The same, with steps that end at a sharper tolerance."""
    before, system.TOLERANCE = system.TOLERANCE, SHARP
    try:
        return pushed(name)
    finally:
        system.TOLERANCE = before


@cache
def ends(back: float) -> tuple[Session, Snapshot]:
    """The end of a course into the helix, and a little back, with sharp steps at its end."""
    session = sharp()
    for _ in range(120):
        session.step(feed_speed=5e-3, inputs=(0.0, 2e-3, 4e-3))
    if back:
        for _ in range(20):
            session.step(feed_speed=-back / 20 / session.time_step)
    for step in (1e-6, 1e-7, 1e-8, 1e-9, 1e-10):  # so that normal forces are known ever better
        for _ in range(20):
            session.step(feed_speed=(-step if back else step) / session.time_step)
    return session, session.snapshot()


def course(session: Session, here: Snapshot, wrt: str, sign: float) -> Array:
    """How the nodes move over a short course, per unit of the input, shape (nodes, 3, ...)."""
    start, dt, rows = session.record().position, session.time_step, []
    for axis in range(3 if wrt == "field" else 1):
        session.restore(here)
        inputs = here.inputs.copy()
        for _ in range(PARTS):
            inputs[axis] += sign * SIZES["field"] / PARTS
            rate = sign * SIZES[wrt] / PARTS / dt
            if wrt == "field":
                session.step(inputs=inputs)
            elif wrt == "feed":
                session.step(feed_speed=rate)
            else:
                session.step(twist_rate=rate)
        rows.append((session.record().position - start) / (sign * SIZES[wrt]))
    session.restore(here)
    return np.moveaxis(np.array(rows), 0, -1) if wrt == "field" else rows[0]


@pytest.mark.parametrize("back", [0.0, 1e-4])
@pytest.mark.parametrize("change", ["rising", "falling"])
@pytest.mark.parametrize("wrt", ["field", "feed", "twist"])
def test_they_are_those_of_short_courses(wrt: Course, change: Change, back: float) -> None:
    """Contacts that slide on, and that stick as they would have to go back; of twelve contacts.

    A tangent without the change of the normal forces is off by up to a quarter.
    """
    session, here = ends(back)
    session.restore(here)
    found = session.sensitivity("positions", wrt=wrt, change=change)
    expected = course(session, here, wrt, 1.0 if change == "rising" else -1.0)
    assert np.abs(found - expected).max() < 0.015 * np.abs(expected).max()


@pytest.mark.parametrize("wrt", ["field", "feed", "twist"])
def test_contacts_inside_their_cones_are_springs(wrt: Course) -> None:
    """Drawn back by less than the elastic slip, the tip sticks; rising and falling are the same."""
    session = sharp("half-circle")
    for _ in range(100):
        session.step(feed_speed=5e-3, inputs=(0.0, 2e-3, 4e-3))
    for _ in range(20):
        session.step(feed_speed=-1e-8 / session.time_step)
    contacts, here = session.plant.rubbing.contacts, session.snapshot()
    assert len(contacts.node) > 0
    assert not contacts.on.any()
    for change, sign in (("rising", 1.0), ("falling", -1.0)):
        found = session.sensitivity("positions", wrt=wrt, change=change)  # type: ignore[arg-type]
        expected = course(session, here, wrt, sign)
        assert np.abs(found - expected).max() < 0.002 * np.abs(expected).max()


def test_the_tangent_is_not_symmetric_where_contacts_slide() -> None:
    session, here = ends(0.0)
    session.restore(here)
    rubbing = session.plant.rubbing
    on = rubbing.contacts.on
    assert on.sum() > 8
    sliding, _ = rubbing.friction(Branches(on, ~on))
    stuck, _ = rubbing.friction(Branches(~on, on))
    for tangent, skew in ((sliding, True), (stuck, False)):
        part = tangent.toarray()[rubbing.free, rubbing.free]
        odd = np.abs(part - part.T).max() / np.abs(part).max()
        assert (odd > 1e-3) == skew, odd


def test_without_friction_they_are_those_of_the_equilibrium() -> None:
    sim = Simulation(paper_wire(40), lumen("half-circle"))
    session = sim.session(feed=0.04, motion="quasi-static")
    session.step(inputs=(0.0, 2e-3, 4e-3))
    state = sim.equilibrium(0.04, session.plant.inputs)
    for output in ("tip", "tip_direction"):
        for wrt in ("inputs", "feed"):
            np.testing.assert_allclose(
                session.sensitivity(output, wrt=wrt),  # type: ignore[arg-type]
                state.sensitivity(output, wrt=wrt),  # type: ignore[arg-type]
                atol=1e-3 * np.abs(state.sensitivity(output, wrt=wrt)).max(),  # type: ignore[arg-type]
            )


def test_what_they_are_not_of_is_refused() -> None:
    moving = Simulation(
        paper_wire(40), lumen("half-circle"), wall_motion=WallMotion((0, 0, 1e-3), 1.0, 25e-3)
    )
    with pytest.raises(InputError, match="at rest"):
        moving.session(motion="quasi-static").sensitivity("tip", wrt="feed")
    with pytest.raises(InputError, match="'quasi-static' for sensitivities; received 'dynamic'"):
        pushed(motion="dynamic").sensitivity("tip", wrt="feed")
    with pytest.raises(InputError, match="change"):
        pushed().sensitivity("tip", wrt="feed", change="both")  # type: ignore[arg-type]
