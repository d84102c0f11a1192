"""How a wire goes to an outlet: what it is planned with, and what it is replayed in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.kernels.wall.barrier import barrier
from magwire.lumen import Lumen
from magwire.navigate import tuned
from magwire.navigate.navigator import Navigator
from magwire.simulation import Simulation
from magwire.wire import Wire

if TYPE_CHECKING:
    from magwire.results import Result

LARGE = 0.9999  # feed in a time step, over an edge: one that feeds more is cut in half
LONGEST = 2.0  # the same, over the feed between two planned fields, at most
SPEED = 0.01  # wire lengths in a second; there is no inertia


def route_to(lumen: Lumen, wire: Wire, contact: Barrier | None = None) -> Route:
    """How a wire that fits goes to the lumen's target; see ``plan``."""
    way = lumen.path().branches[0]
    radii = way.curve.at(way.curve.knots())[:, 3]
    room = float(radii.min()) - (contact or Barrier()).keep_off(wire.radius)
    long = fitted(wire, tuned.OUTLET.slack * way.length)
    every = min(
        tuned.OUTLET.finest * long.length, tuned.OUTLET.pace * float(np.quantile(radii, 0.25))
    )
    gap = min(tuned.OUTLET.gap, tuned.OUTLET.part * room)
    yielding = firm_wall(wire, way.bend_radius().radius, gap)
    return Route(
        planned=Simulation(long, lumen, contact=contact or yielding),
        replayed=_briskly(Simulation(long, lumen, contact=contact or Barrier())),
        feed=Feed(SPEED * long.length, tuned.OUTLET.slack * way.length),
        every=every,
        step=min(LARGE * long.edge_length, LONGEST * every),
        goal=way.length - float(radii[-1]),
    )


def _briskly(simulation: Simulation) -> Simulation:
    """The simulation, with steps that are made for large feeds along a hard wall."""
    simulation.system = replace(simulation.system, brisk=True)
    return simulation


@dataclass(frozen=True)
class Route:
    """How a wire goes to an outlet: planned on one wall, replayed on another.

    every: feed between two planned fields; step: in a time step of the replay [m].
    """

    planned: Simulation
    replayed: Simulation
    feed: Feed
    every: float
    step: float
    goal: float

    def run(self, distance: float, navigator: Navigator) -> Result:
        """Feed the wire on with inertia until its tip is at the goal, or by a distance [m]."""
        return self.replayed.run(
            Feed(self.feed.fastest, distance),
            navigator,
            time_step=self.step / self.feed.fastest,
            record_every=self.step,
            update_every=self.step,
            until=self.goal,
        )


def fitted(wire: Wire, length: float) -> Wire:
    """The wire, or if it is too short, the wire with a longer proximal section, on the same edges.

    Parameters
    ----------
    wire
        The wire.
    length
        What it has to have at least [m].
    """
    if wire.length >= length:
        return wire
    first = wire.sections[0]
    count = int(np.ceil(length / wire.edge_length - 1e-9))
    grown = replace(first, length=first.length + count * wire.edge_length - wire.length)
    return Wire((grown, *wire.sections[1:]), count + 1)


def firm_wall(wire: Wire, bend: float, gap: float) -> Barrier:
    """A barrier that bends the wire around a bend while it keeps it off by a part of its gap.

    Middles between the nodes cut the inside of a bend: a wall that lets the nodes come much closer
    than its activation gap would be cut by them. To bend a wire of stiffness EI to a radius rho all
    along takes forces of EI/rho^3 per length; a wire that cuts bends presses more at few places,
    so the wall is a thousandth as stiff as the wire's material at least.

    Parameters
    ----------
    wire
        The wire.
    bend
        Radius of the bend [m].
    gap
        Activation gap of the barrier [m].
    """
    line_force = wire.bending_stiffness / bend**3
    slope = -barrier(tuned.OUTLET.left * gap, gap)[1]  # of its energy, over K
    return Barrier(max(tuned.OUTLET.hard * wire.body.bending_modulus, line_force / slope), gap)
