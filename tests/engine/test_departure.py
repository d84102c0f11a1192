"""What *stable* means under friction (P-33): against a strut on a wall, and what the wire does.

The tip of a straight wire leans on a wall and just sticks. Forward along the wall it is unloaded:
its friction may fall faster than its push. The wire is a spring and a cantilever; see ``most``.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from engine.test_rubbing import ends
from magwire.contact import Barrier, Friction
from magwire.engine.departure import departs
from magwire.engine.rubbing import Branches
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import assemble
from magwire.kernels.band import HALF_BANDWIDTH
from magwire.kernels.wall.onward import fill, hold_walls, is_on_cone
from magwire.kernels.wall.traction import SLIP
from magwire.lumen import Lumen
from magwire.session import Session
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]

RADIUS, PUSH = 0.5e-3, 2e-5
ALONG = np.array([0.67, 0.74, 0.0])
"""The wall, about, where the tip meets it."""


def strut(friction: float, load: float, motion: str = "quasi-static") -> Session:
    """A wire whose tip is about to meet the outside of a bend, a load on it along the wall [N]."""
    turn = np.radians(70.0) * np.linspace(0.0, 1.0, 40)[1:]
    lead = np.linspace(0.0, 12.0, 25)[:, None] * [1.0, 0.0, 0.0]
    bend = np.stack((12.0 + 6.0 * np.sin(turn), 6.0 - 6.0 * np.cos(turn), 0.0 * turn), axis=1)
    on = bend[-1] + np.arange(0.5, 25.0, 0.5)[:, None] * [np.cos(turn[-1]), np.sin(turn[-1]), 0.0]
    sim = Simulation(
        Wire.uniform(40e-3, RADIUS, 3e6, 1e6, 2000.0, 41),
        Lumen.through(1e-3 * np.vstack((lead, bend, on)), 3e-3),
        contact=Barrier(1e6, 1e-5, wall="centreline"),
        friction=Friction(friction),
        tip_load=load * ALONG,
        damping=10.0,
    )
    return sim.session(feed=18.5e-3, motion=motion, time_step=0.1)  # type: ignore[arg-type]


def on_its_cone(load: float, motion: str = "quasi-static") -> tuple[Session, float]:
    """A tip that sticks under a load along the wall [N], and the coefficient at which it just does.

    The wall is made so slippery after the tip has come to rest.
    """
    lean, session = strut(5.0, 0.0), strut(5.0, load)
    while lean.record().tip_force < PUSH:
        lean.step(feed_speed=1e-6 / lean.time_step)
    session.restore(lean.snapshot())
    session.step()
    friction, contact = session.plant.model.wall.friction[0], session.plant.state.contact[-1]
    slip = float(np.linalg.norm(contact[SLIP : SLIP + 3]))
    friction.static[:] = friction.kinetic[:] = 5.0 * slip / friction.slip
    contact[SLIP : SLIP + 3] *= friction.slip / slip
    if motion == "quasi-static":
        return session, float(friction.static[-1])
    moving = strut(float(friction.static[-1]), load, motion)
    moving.restore(session.snapshot())
    return moving, float(friction.static[-1])


def most(session: Session) -> float:
    """Coefficient at which the wire would leave, by the closed form.

    Of the tip's place x, y and its slope: the stiffness K of a rod and a cantilever, the wall's b
    along its normal n, and the way g of the surface that slides, which the slope moves as well. The
    friction falls by mu b n, so that det(K + b n n - mu b g n) = 0.
    """
    plant = session.plant
    push = session.record().contact_force[-1]
    n = np.array([*push[:2], 0.0]) / np.linalg.norm(push)
    free, ei = plant.feed - 0.5e-3, 3e6 * 0.25 * np.pi * RADIUS**4  # from half an edge behind
    rod = np.diag([3e6 * np.pi * RADIUS**2 / free, 12.0 * ei / free**3, 4.0 * ei / free])
    rod[1, 2] = rod[2, 1] = -6.0 * ei / free**2
    scales, follows = plant.system.scales, plant.rubbing.walls[1].toarray()[-4:-1, -4:-1]
    b = -float(n @ follows @ n) * scales.force / scales.length
    way = np.array([n[1], -n[0], RADIUS * n[1] ** 2])
    return float(1.0 / (b * n @ np.linalg.solve(rod + b * np.outer(n, n), way)))


@pytest.mark.parametrize("load", [-3e-6, -3e-7, 3e-7, 3e-6])
def test_a_strut_leaves_where_friction_falls_faster_than_its_push(load: float) -> None:
    """Within 2 percent on both sides; without the change of the normal force all would stay."""
    session, friction = on_its_cone(load)
    part = friction / most(session)
    assert (part > 1.0) == (load > 0.0)
    if abs(load) < 1e-6:
        assert part == pytest.approx(1.0, abs=0.02)
    assert session.stable == (load < 0.0)
    assert session.record().stable == (load < 0.0)
    assert departs(session.plant.rubbing) == (load > 0.0)


@pytest.mark.parametrize("load", [-3e-6, 3e-6])
def test_what_is_not_stable_goes(load: float) -> None:
    """In time, after a nudge of the guide by 10 nm towards the edge of the cone."""
    session, _ = on_its_cone(load, "dynamic")
    start = session.record().position[-1]
    session.step(feed_speed=-np.sign(load) * 1e-8 / session.time_step)
    for _ in range(100):
        session.step()
    moved = float(np.linalg.norm(session.record().position[-1] - start))
    assert moved > 1e-5 if load > 0.0 else moved < 1e-6


def test_a_tip_inside_its_cone_stays() -> None:
    """With twice the friction at which it would leave."""
    session, _ = on_its_cone(3e-6)
    friction = session.plant.model.wall.friction[0]
    friction.static[:] *= 2.0
    friction.kinetic[:] *= 2.0
    session.plant.state.contact[-1, SLIP : SLIP + 3] *= 0.5
    assert session.stable
    assert not departs(session.plant.rubbing)


@pytest.mark.parametrize("back", [0.0, 1e-4])
def test_the_kernels_tangent_is_that_by_complex_steps(back: float) -> None:
    """Of a helix with a dozen contacts, in slip, and in slip and stick; it is not symmetric."""
    session, here = ends(back)
    session.restore(here)
    assert session.stable
    plant, rubbing = session.plant, session.plant.rubbing
    (rod, _, wall, lumen, _), state, work = plant.model, plant.state, plant.work
    friction, held = wall.friction[0], plant.mouth.held
    hold_walls(wall.friction, rod, lumen, wall, state, held, work)
    still = Motion(0.0, work.target)
    assemble(plant.model, state, plant.mouth, still, work.gradient, work.band)
    full = np.zeros_like(friction.tangent)
    fill(friction, state, held, work.kept, work.band, full)
    size, wide = rubbing.free.stop - rubbing.first, 2 * HALF_BANDWIDTH + 1
    found = np.zeros((size, size + wide))
    for r in range(size):
        found[r, r : r + wide] = full[r]
    found = found[:, HALF_BANDWIDTH : HALF_BANDWIDTH + size]
    on = np.array([is_on_cone(friction, int(i)) for i in rubbing.contacts.node])
    sliding, _ = rubbing.tangent(Branches(on, np.ones(len(on), dtype=bool)))
    expected = sliding.toarray()[
        rubbing.first : rubbing.free.stop, rubbing.first : rubbing.free.stop
    ]
    free = slice(rubbing.free.start - rubbing.first, None)
    skew = np.abs(expected - expected.T)[free, free].max()
    assert skew > 1e-3 * np.abs(expected).max()
    np.testing.assert_allclose(found[free, free], expected[free, free], atol=1e-4 * skew)
