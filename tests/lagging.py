"""Wires under friction that tests and campaigns share: buckled in a tube, and curved in a bend."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Friction
from magwire.evidence.verify.references.sliding import locked_up
from magwire.evidence.verify.references.whip import whipped
from magwire.evidence.verify.ropes import LEAD, THIN, Bend
from magwire.kernels.frames import update_frames
from magwire.kernels.history import copy_configuration, copy_state
from magwire.lumen import Lumen
from magwire.session import Session
from magwire.simulation import Simulation
from magwire.wire import Section, Wire

Array = NDArray[np.float64]

CLEARANCE = 0.3e-3
PITCH = 20e-3
"""Of the helix where the force arrives [m]."""
PUSHED = 20e-3
"""Force that arrives [N]."""


class Buckled(NamedTuple):
    """A helix that slides in a tube: force along its middle, the same by theory [N], pitches."""

    force: Array
    expected: Array
    turns: float


def buckled(friction: float, pitches: float, edge: float, slid: float, step: float) -> Buckled:
    """A wire that is pushed through a straight tube against a force, until it slides steadily [m].

    It begins as a helix without friction. One and a half pitches at its beginning and one and a
    quarter at its end are left out.
    """
    length, ei = pitches * PITCH, PUSHED * PITCH**2 / (8.0 * np.pi**2)
    young = ei / (0.25 * np.pi * THIN**4)
    feed = length + 5e-3
    wire = Wire.uniform(
        feed + slid, THIN, young, young / 3.0, 2000.0, round((feed + slid) / edge) + 1
    )
    tube = Lumen.straight(feed + slid + 20e-3, CLEARANCE + THIN)

    def pushed(rubs: Friction | None) -> Session:
        load = (-PUSHED, 0.0, 0.0)
        sim = Simulation(wire, tube, friction=rubs, tip_load=load, damping=10.0)
        return sim.session(feed=length, motion="quasi-static")

    smooth, session = pushed(None), pushed(Friction(friction))
    _wind(smooth)
    session.restore(smooth.snapshot())
    for _ in range(round(slid / step)):
        session.step(feed_speed=step / session.time_step)
    record = session.record()
    x, y, z = record.position.T
    rubbed = np.cumsum(record.friction_force[::-1, 0])[::-1]
    force = PUSHED - rubbed + 0.5 * record.friction_force[:, 0]
    middle = np.flatnonzero((x > 1.5 * PITCH) & (x < x[-1] - 1.25 * PITCH))
    turned = np.unwrap(np.arctan2(z[middle], y[middle]))
    first = middle[0]
    clearance = float(np.median(np.hypot(y[middle], z[middle])))
    expected = [locked_up(force[first], x[k] - x[first], friction, clearance, ei) for k in middle]
    turns = abs(turned[-1] - turned[0]) / (2.0 * np.pi)
    return Buckled(force[middle], np.array(expected), float(turns))


def _wind(session: Session) -> None:
    """Bring a wire in a tube to rest as a helix."""
    plant = session.plant
    system, state = plant.system, plant.state
    base, held = system.new_state(), int(state.held[0])
    copy_configuration(state, base, held)
    x = (state.q[held + 1 :, 0] - state.q[held, 0]) * system.wire.length
    rise = np.minimum(1.0, 2.0 * x / PITCH)
    radius = 0.9 * CLEARANCE * rise**2 * (3.0 - 2.0 * rise) / system.wire.length
    state.q[held + 1 :, 1] += radius * np.cos(2.0 * np.pi * x / PITCH)
    state.q[held + 1 :, 2] += radius * np.sin(2.0 * np.pi * x / PITCH)
    update_frames(base, state, held)
    wound = system.new_state()
    copy_state(state, wound)
    plant.start_at(wound)
    plant.settle(system.sharp_limits())


class Whip(NamedTuple):
    """Angles of the guide, of the tip, and of the tip by theory [rad]."""

    guide: Array
    tip: Array
    expected: Array


def whip(friction: float, curved: float, edge: float, step: float) -> Whip:
    """A wire with a tip that is curved at rest [1/m], taut in half a turn, turned by two turns."""
    bend, pull, tip = Bend(np.pi), 50e-3, 10e-3
    lumen = bend.lumen()
    feed, arc = lumen.length - 5e-3, bend.drum * np.pi
    length, straight = feed + 12e-3, 12e-3 + LEAD + arc - tip
    plain = {"radius": THIN, "youngs_modulus": 3e9, "shear_modulus": 1e9, "density": 2000.0}
    nodes = round(length / edge) + 1
    guide = Simulation(Wire.uniform(length, THIN, 3e9, 1e9, 2000.0, nodes), lumen).system.guide
    second = np.cross(guide.direction, guide.director)
    towards = (curved * float(second[2]), -curved * float(guide.director[2]))
    sections = [
        Section(straight, **plain),
        Section(length - straight, rest_curvature=towards, **plain),
    ]
    wire = Wire(sections, nodes)
    sim = Simulation(
        wire, lumen, friction=Friction(friction), tip_load=pull * bend.exit, damping=10.0
    )
    session = sim.session(feed=feed, motion="quasi-static")
    session.step()
    angles, found = np.arange(step, 4.0 * np.pi + step, step), []
    for _ in angles:
        session.step(twist_rate=step / session.time_step)
        found.append(session.record().tip_twist)
    x = np.linspace(0.0, feed, 300)
    bent = np.where((x > LEAD) & (x < LEAD + arc), 1.0 / bend.drum, 0.0)
    hold = np.where(x > straight - 12e-3, wire.bending_stiffness * curved * bent, 0.0)
    drag = friction * THIN * pull * bent / np.sqrt(1.0 + friction**2)
    twisting = 1e9 * 0.5 * np.pi * THIN**4
    return Whip(angles, np.array(found), whipped(angles, feed, twisting, hold, drag))
