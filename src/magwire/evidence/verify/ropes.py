"""Set-ups with friction: ropes around bends, wires lying in a tube, and the works over a course."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier, Friction
from magwire.evidence.verify.references.sliding import arc_growth, capstan
from magwire.lumen import Lumen
from magwire.session import Session
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]

THIN = 0.1e-3
"""Radius of the wires [m]."""
ROOM = 0.5e-3
"""What the axis has around the centreline [m]."""
LEAD = 30e-3
"""Straight parts before and behind a bend, at least as long as a free end takes [m]."""


@dataclass(frozen=True)
class Bend:
    """A bend between straight parts; as a helix if it has a pitch.

    Parameters
    ----------
    angle
        Turned around the axis of the bend [rad].
    drum
        Radius of the wire's axis where it is pulled taut [m].
    pitch
        Rise in one turn [m].
    """

    angle: float
    drum: float = 20e-3
    pitch: float = 0.0

    @property
    def rise(self) -> float:
        """Per angle [m]."""
        return self.pitch / (2.0 * np.pi)

    @property
    def turned(self) -> float:
        """The integral of the taut wire's curvature over its length [rad]."""
        return self.angle * self.drum / float(np.hypot(self.drum, self.rise))

    @property
    def radius(self) -> float:
        """Of the taut wire's curvature [m]."""
        return self.drum * (1.0 + (self.rise / self.drum) ** 2)

    def lumen(self, spacing: float = 0.5e-3) -> Lumen:
        """The tube; the wire's axis has ``ROOM`` around the centreline."""
        radius = self.drum + ROOM
        per = float(np.hypot(radius, self.rise))
        w = np.linspace(0.0, self.angle, int(self.angle * per / spacing) + 1)
        arc = np.stack((radius * np.sin(w), radius * (1.0 - np.cos(w)), self.rise * w), axis=1)
        ends = np.array([self._tangent(0.0), self._tangent(self.angle)])
        away = np.arange(1, round(LEAD / spacing) + 1)[:, None] * spacing
        points = np.vstack((-away[::-1] * ends[0], arc, arc[-1] + away * ends[1]))
        return Lumen.through(points, ROOM + THIN)

    def _tangent(self, w: float) -> Array:
        radius = self.drum + ROOM
        tangent = np.array([radius * np.cos(w), radius * np.sin(w), self.rise])
        return np.asarray(tangent / np.linalg.norm(tangent))

    @property
    def exit(self) -> Array:
        """Direction in which it ends."""
        return self._tangent(self.angle)


def rope(
    bend: Bend,
    friction: Friction | None,
    pull: float,
    edge: float,
    contact: Barrier | None = None,
    **options: float | str,
) -> Session:
    """A steel wire through a bend, pulled at its tip [N] and held by the guide, without anchors."""
    lumen = bend.lumen()
    feed = lumen.length - 5e-3
    length = feed + 12e-3
    wire = Wire.uniform(length, THIN, 3e9, 1e9, 2000.0, round(length / edge) + 1)
    load = pull * bend.exit
    sim = Simulation(wire, lumen, contact=contact, friction=friction, tip_load=load, damping=10.0)
    return sim.session(feed=feed, **{"motion": "quasi-static", **options})  # type: ignore[arg-type]


def rope_pull(
    bend: Bend,
    friction: float,
    pull: float,
    *,
    edge: float = 1e-3,
    travel: float = 1e-3,
    parts: int = 4,
    **options: float | str,
) -> tuple[float, float]:
    """Pull at the guide [N] at which a rope slides, and that of an elastic rod on a drum."""
    session = rope(bend, Friction(friction), pull, edge, **options)  # type: ignore[arg-type]
    for _ in range(parts):
        session.step(feed_speed=-travel / parts / session.time_step)
    stiffness = session.plant.system.wire.bending_stiffness
    turned = bend.turned - ROOM / LEAD  # the guide is beside the drum's tangent
    thin = capstan(pull, turned, friction, bend.radius, stiffness)
    thick = arc_growth(friction, THIN / bend.drum) - friction
    return -session.record().push_force, thin * float(np.exp(thick * turned))


def lying(tilt: float, friction: Friction) -> Simulation:
    """A limp, heavy wire in a wide tube; gravity leans sideways by an angle, and it cannot roll."""
    wire = Wire.uniform(50e-3, 0.3e-3, 3e4, 1e9, 3000.0, 26)
    gravity = 9.81 * np.array([0.0, -np.sin(tilt), -np.cos(tilt)])
    tube = Lumen.straight(80e-3, 2e-3)
    return Simulation(wire, tube, friction=friction, gravity=gravity, damping=1000.0)


def climbed(tilt: float, friction: Friction, seconds: float, dt: float) -> tuple[Array, float]:
    """Angles on the tube's wall [rad] of the last nodes of such a wire, and how far it creeps [m].

    It lies down first, then gravity leans for 20 s until it is at rest, then the given time passes.
    """
    flat = lying(0.0, friction).session(feed=45e-3)
    for _ in range(20):
        flat.step()
    session = lying(tilt, friction).session(feed=45e-3, time_step=dt)
    session.restore(flat.snapshot())
    session.step(duration=20.0)
    rest = session.record().position
    session.step(duration=seconds)
    place = session.record().position
    angle = np.arctan2(-place[-5:, 1], -place[-5:, 2])
    return angle, float(np.abs(place - rest).max())


@dataclass(frozen=True)
class Works:
    """Over a course [J]: of the guide, what friction took, the same summed independently."""

    guide: float
    taken: float
    summed: float


def works(session: Session, course: Array) -> Works:
    """The works over a course of feeds and twists of the guide, shape (steps, 2) [m, rad]."""
    record = session.record()
    begun, guide, summed = record.friction_work, 0.0, 0.0
    dt = session.time_step
    for feed, twist in course:
        before = record
        session.step(feed_speed=feed / dt, twist_rate=twist / dt)
        record = session.record()
        guide += 0.5 * (before.insertion_force + record.insertion_force) * feed
        guide += 0.5 * (before.guide_torque + record.guide_torque) * twist
        rubs = np.linalg.norm(record.friction_force, axis=1)
        summed += float(rubs @ (record.slip - before.slip))
    return Works(guide, record.friction_work - begun, summed)
