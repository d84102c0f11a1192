"""What to know of a vessel before a wire goes in: per outlet, and of its walls."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.spatial import KDTree

from magwire.lumen.branch import Bend, Branch
from magwire.vessel.balls import wall
from magwire.vessel.files import Drawing
from magwire.vessel.files.drawing import Array
from magwire.vessel.placement import Placement
from magwire.vessel.vessel import Vessel

FLIPS = {
    "x and y": (-1.0, -1.0, 1.0),
    "x": (-1.0, 1.0, 1.0),
    "y": (1.0, -1.0, 1.0),
    "z": (1.0, 1.0, -1.0),
}
"""Axes that files of the same vessel may disagree on; x and y are those of LPS against RAS."""
APART = 4.0  # arc length from which a tube that meets itself does so from elsewhere, over R
DENSITY = 4.0  # points per radius that are compared
BETTER = 0.5  # how much less the distance must be for axes to be called flipped


class Course(NamedTuple):
    """The path to an outlet.

    Attributes
    ----------
    name
        Name of the outlet.
    length
        Arc length [m].
    radii
        Smallest and largest radius of the vessel along it [m]: in a trunk that of the trunk.
    narrowest
        Arc parameter of the smallest radius [m].
    bend
        Smallest radius of curvature [m], and where.
    own
        Length that no path before it shares [m].
    passable
        Smallest radius of the path by itself [m]: a wire has to be thinner.
    """

    name: str
    length: float
    radii: tuple[float, float]
    narrowest: float
    bend: Bend
    own: float
    passable: float


class Reach(NamedTuple):
    """Whether a wire gets to an outlet.

    Attributes
    ----------
    fits
        Whether it is thinner than the lumen all along the path.
    force
        EI over the square of the tightest bend's radius [N]: about what the wall has to push
        with to bend the wire that much.
    """

    fits: bool
    force: float


def courses(vessel: Vessel) -> list[Course]:
    """The paths to all outlets, in their order."""
    found, before = [], np.zeros((0, 4))
    every = wall([*vessel.balls.values(), *vessel.trunks])
    for name, tube in vessel.tubes.items():
        arcs = tube.curve.knots()
        balls = tube.curve.at(arcs)
        wide = np.maximum(balls[:, 3], every.depth(balls[:, :3]))
        thin = int(np.argmin(wide))
        own = tube.length
        if len(before):
            distance, nearest = KDTree(before[:, :3]).query(balls[:, :3])
            shared = np.flatnonzero(distance <= 0.5 * before[nearest, 3])
            own = tube.length - float(arcs[shared[-1]]) if len(shared) else tube.length
        radii, passable = (float(wide[thin]), float(wide.max())), float(balls[:, 3].min())
        bend = tube.bend_radius()
        found.append(Course(name, tube.length, radii, float(arcs[thin]), bend, own, passable))
        before = np.concatenate([before, balls])
    return found


def reach(course: Course, radius: float, stiffness: float) -> Reach:
    """Whether a wire gets to an outlet.

    Parameters
    ----------
    course
        The path to it.
    radius
        Radius of the wire [m].
    stiffness
        EI [N m^2].
    """
    bent = 0.0 if math.isinf(course.bend.radius) else stiffness / course.bend.radius**2
    return Reach(radius < course.passable, bent)


def self_contacts(vessel: Vessel) -> Iterator[str]:
    """Where tubes meet themselves away from any junction, a sentence each."""
    for name, tube in vessel.tubes.items():
        arcs, balls = _samples(tube)
        close = KDTree(balls[:, :3]).query_pairs(
            2.0 * float(balls[:, 3].max()), output_type="ndarray"
        )
        a, b = close[:, 0], close[:, 1]
        reach = balls[a, 3] + balls[b, 3]
        gap = np.linalg.norm(balls[a, :3] - balls[b, :3], axis=1) - reach
        meets = (gap < 0.0) & (np.abs(arcs[a] - arcs[b]) > APART * 0.5 * reach)
        if meets.any():
            worst = int(np.flatnonzero(meets)[np.argmin(gap[meets])])
            x, y, z = 1e3 * balls[a[worst], :3]
            yield (
                f"The tube to '{name}' meets itself near ({x:.4g}, {y:.4g}, {z:.4g}) mm: its walls "
                f"overlap by {-1e3 * gap[worst]:.3g} mm."
            )


def flipped_axes(vessel: Vessel, other: Drawing, placement: Placement) -> str | None:
    """Which axes of another file of the same vessel point the other way; None if none do.

    Parameters
    ----------
    vessel
        The vessel.
    other
        What the other file holds: a surface, or lines.
    placement
        Placement of the other file.
    """
    points = [line.points for line in other.lines]
    if other.surface is not None:
        points.append(other.surface.points)
    places = placement.points(np.concatenate(points))
    balls = np.concatenate([_samples(tube)[1] for tube in vessel.tubes.values()])

    def off(sign: tuple[float, float, float]) -> float:
        distance, nearest = KDTree(balls[:, :3]).query(places * np.array(sign))
        return float(np.median(distance / balls[nearest, 3]))

    here = off((1.0, 1.0, 1.0))
    flips = {name: off(sign) for name, sign in FLIPS.items()}
    best = min(flips, key=lambda name: flips[name])
    return best if flips[best] < BETTER * here and here > 1.5 else None


def _samples(tube: Branch) -> tuple[Array, Array]:
    """Arc parameters and balls of a tube, some per radius."""
    narrow = float(tube.radius.min())
    count = min(max(int(DENSITY * tube.length / narrow), 8), 4000)
    arcs = np.linspace(0.0, tube.length, count)
    return arcs, tube.curve.at(arcs)
