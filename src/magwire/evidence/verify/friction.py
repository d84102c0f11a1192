"""Group 6: friction at the wall: ropes around bends, wires that stick, loops (P-29 to P-33)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Friction
from magwire.evidence.verify.evidence import Curve, Line
from magwire.evidence.verify.references.sliding import torque_arrived
from magwire.evidence.verify.ropes import THIN, Bend, climbed, rope, rope_pull, works
from magwire.simulation import Simulation
from magwire.wire import Wire

Array = NDArray[np.float64]

GROUP = "friction"
PULL = 20e-3
"""At the far end of a rope [N]."""
SINGH = "elastic rod on a drum, Singh 2022, and a rod's thickness"
LYING = 50e-3
"""Length of a wire that lies in a tube [m]."""
STICKS = 0.5
"""Its coefficient of friction."""


def evidence(full: bool) -> Iterator[Line | Curve]:
    """Lines and curves of the group; larger angles and longer times if ``full``."""
    yield from _capstan(full)
    yield from _stick(100.0 if full else 10.0)
    yield from _slides()
    yield from _loop()
    if full:
        yield from _torque()


def _capstan(full: bool) -> Iterator[Line | Curve]:
    """The pull at which a rope slides over a bend."""
    angles = (90.0, 180.0, 270.0) if full else (90.0,)
    pulls: dict[float, list[float]] = {}
    for friction in (0.05, 0.1, 0.3) if full else (0.05, 0.3):
        for degrees in angles:
            pull, expected = rope_pull(Bend(np.radians(degrees)), friction, PULL)
            pulls.setdefault(friction, []).append(pull)
            yield Line(
                GROUP, f"rope over {degrees:g} degrees, mu = {friction:g}", "pull at the guide",
                "N",
                expected, SINGH, pull, 0.01, relative=True,
            )  # fmt: skip
    if full:
        turned = np.radians(angles)
        fine = np.linspace(turned[0], turned[-1], 60)
        yield Curve(
            "Capstan",
            "angle [rad]",
            "ln of the pulls' ratio",
            {
                **{f"mu phi, mu = {mu:g}": (fine, mu * fine, "line") for mu in pulls},
                **{
                    f"magwire, mu = {mu:g}": (turned, np.log(np.divide(found, PULL)), "points")
                    for mu, found in pulls.items()
                },
            },
        )


def _stick(seconds: float) -> Iterator[Line]:
    """A wire in a tube that leans sideways by nine tenths of the angle of friction."""
    tilt = float(np.arctan(0.9 * STICKS))
    for dt in (0.1, 1.0):
        _, crept = climbed(tilt, Friction(STICKS), seconds, dt)
        yield Line(
            GROUP, f"wire at 0.9 of its cone for {seconds:g} s, steps of {dt:g} s", "creep", "L",
            0.0, "Coulomb: what is inside its cone rests", crept / LYING, 1e-6,
        )  # fmt: skip


def _slides() -> Iterator[Line]:
    """The same beyond the angle: it climbs until gravity is at the cone's edge again."""
    tilt = float(np.arctan(1.5 * STICKS))
    angle, _ = climbed(tilt, Friction(STICKS), 10.0, 0.1)
    yield Line(
        GROUP, "wire at 1.5 of its cone, let go", "angle on the wall", "rad",
        tilt - float(np.arctan(STICKS)), "gravity less the angle of friction",
        float(angle[-3]), 0.02, relative=True,
    )  # fmt: skip


def _loop() -> Iterator[Line]:
    """Pushed into a bend and drawn back: the second time the wire ends as it began."""
    wire = Wire.uniform(110e-3, THIN, 3e9, 1e9, 2000.0, 74)
    sim = Simulation(wire, Bend(0.5 * np.pi).lumen(), friction=Friction(0.2), damping=0.0)
    session = sim.session(feed=50e-3, motion="quasi-static")
    leg = [2e-6] * 20 + [0.2e-3] * 25  # short steps where the push turns round
    course = np.array([(feed, 0.0) for feed in (*leg, *(-part for part in leg))])
    works(session, course)
    found = works(session, course)
    case = "push and pull through a bend, mu = 0.2"
    for name, value in (("work of the guide", found.guide), ("what friction took", found.taken)):
        yield Line(
            GROUP, case, name, "J", found.summed, "friction times slip, summed over the nodes",
            value, 0.01, relative=True,
        )  # fmt: skip


def _torque() -> Iterator[Line]:
    """A wire that is turned in a bend, taut."""
    bend, pull = Bend(np.pi), 50e-3
    session = rope(bend, Friction(0.1), pull, 1e-3)
    for _ in range(60):
        session.step(twist_rate=0.05 / session.time_step)
    expected = torque_arrived(0.0, -bend.turned, 0.1, THIN, pull)
    yield Line(
        GROUP, "wire turned in half a turn, mu = 0.1", "torque at the guide", "N m",
        expected, "it climbs the wall by atan(mu)", session.record().guide_torque, 0.02,
        relative=True,
    )  # fmt: skip
