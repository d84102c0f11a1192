"""What the page is told: the world once, and what has become of the wire many times a second."""

from __future__ import annotations

import copy
import math
from base64 import b64encode
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from magwire.drive.account import Sight
from magwire.simulation import Simulation
from magwire.view import content

LARGEST_FIELD = 0.08
"""End of the slider of a uniform flux density, whose arrow is the longest [T]."""
BENT = 2.0
"""Limit of the wall's force if none is given, over EI / R^2 of the tightest bend."""
UNBENT = 50.0
"""The same over EI / L^2, where nothing is bent."""
FEED_TIME = 25.0
"""Time in which the whole wire is fed at the usual speed [s]."""
TURN_RATE = math.pi
"""Usual rate of the guide about its axis [rad/s]."""
FASTEST = 10.0
"""Fastest speed of the page over the usual one."""
ROUTE = 160
"""Points of a path."""


def aimed(simulation: Simulation, target: str | None) -> Simulation:
    """The same simulation with another outlet as its target."""
    lumen = simulation.system.lumen
    if target is None or target == lumen.target:
        return simulation
    other = copy.copy(simulation)
    other.system = replace(simulation.system, lumen=replace(lumen, target=target))
    return other


def usual_limit(simulation: Simulation) -> float:
    """A limit of the wall's force [N] that a wire pushed around the tightest bend comes near to."""
    system = simulation.system
    length, stiffness = system.wire.length, system.wire.bending_stiffness
    bends = [bend.radius for bend in system.path.bend_radius()]
    tightest = min(bends, default=math.inf)
    return max(BENT * stiffness / tightest**2, UNBENT * stiffness / length**2)


def usual_speed(simulation: Simulation) -> float:
    """A speed of the guide [m/s] at which the wire is fed in some time."""
    return simulation.system.wire.length / FEED_TIME


def world(simulation: Simulation, *, title: str, limit: float, help_note: str) -> dict[str, Any]:
    """All that does not change, in SI units.

    Parameters
    ----------
    simulation
        What is driven.
    title
        What it is called.
    limit
        Limit of the force of the wall [N].
    help_note
        Why no navigator helps; empty if one does.
    """
    system = simulation.system
    lumen, speed = system.lumen, usual_speed(simulation)
    branches = [lumen.centreline(i) for i in range(len(lumen.branches))]
    tubes = [np.column_stack(branch) for branch in branches]
    sheet = lumen.sheet
    paths = {name: lumen.path(name) for name in lumen.outlets} or {"outlet": system.path}
    ways = {name: path.centreline(points=ROUTE)[0].tolist() for name, path in paths.items()}
    return {
        "title": title,
        "branches": [
            {"points": points.tolist(), "radii": radii.tolist()} for points, radii in branches
        ],
        "surface": None if sheet is None else content.sheet(sheet.points, sheet.triangles, tubes),
        "motions": content.motions(system.wall_motion),
        "ways": ways if lumen.branches else {},
        "target": lumen.target,
        "wire": {
            "radius": system.wire.radius,
            "onAxis": system.keep_off < system.wire.radius,
            "magnet": magnets(simulation),
            "length": system.wire.length,
        },
        "inputs": inputs(simulation),
        "uniform": system.actuator is None,
        "largestField": LARGEST_FIELD,
        "speed": speed,
        "fastest": FASTEST * speed,
        "turnRate": TURN_RATE,
        "fastestTurn": FASTEST * TURN_RATE,
        "limit": limit,
        "noHelp": help_note,
    }


def inputs(simulation: Simulation) -> list[dict[str, Any]]:
    """Name, unit and range of each input."""
    actuator = simulation.system.actuator
    if actuator is None:
        names = simulation.system.input_names
        return [
            {"name": name, "unit": unit, "low": -LARGEST_FIELD, "high": LARGEST_FIELD}
            for name, unit in names
        ]
    return [
        {
            "name": one.name,
            "unit": one.unit,
            "low": one.low if math.isfinite(one.low) else -1.0,
            "high": one.high if math.isfinite(one.high) else 1.0,
        }
        for one in actuator.inputs
    ]


def magnets(simulation: Simulation) -> list[int]:
    """Which nodes lie in a magnet, shape (nodes,)."""
    wire = simulation.system.wire
    station = np.linspace(0.0, wire.length, wire.nodes)
    found, begin = np.zeros(wire.nodes, dtype=bool), 0.0
    slack = 1e-6 * wire.length
    for section in wire.sections:
        end = begin + section.length
        if any(section.magnetization):
            found |= (station >= begin - slack) & (station <= end + slack)
        begin = end
    return [int(flag) for flag in found]


def seen(sight: Sight) -> dict[str, Any]:
    """What has become of the wire; single numbers with all their digits."""
    return {
        "time": sight.time,
        "feed": sight.feed,
        "twist": sight.twist,
        "points": singles(sight.points),
        "forces": singles(sight.forces),
        "tipForce": sight.tip_force,
        "wallForce": sight.wall_force,
        "push": sight.push,
        "field": sight.field.tolist(),
        "inputs": sight.inputs.tolist(),
        "clearance": sight.clearance if math.isfinite(sight.clearance) else None,
    }


def singles(values: ArrayLike) -> str:
    """Numbers in single precision, as a text."""
    return b64encode(np.asarray(values, dtype="<f4").tobytes()).decode("ascii")
