"""The wall that fits a wire and a lumen (P-11)."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np

from magwire.contact import Barrier
from magwire.kernels.arrays import JET, Between, BulgeGrid, Bulges
from magwire.lumen import Lumen
from magwire.lumen.bulge import Bulge, widened
from magwire.wire import Wire

ROOM = 0.01
"""Activation gap over the free room of the narrowest place: what contact leaves of it at most.

At half of it thin tubes take half as many iterations again; at twice it the hand-over of contact
from the tip to its neighbours is off by more than 3 percent of the largest force, as are sums of
forces where the wall presses all along the wire."""
FIRM = 16.0
"""K dhat, in units of the load per length that bends the wire along the sharpest bend.

At half of it and at twice it peaks of the tip force differ by a thousandth."""
LONGEST = 0.25
"""A wire is taken to be bent to a radius of this part of its length at least."""
THIN = 0.02
"""Activation gap of the barrier between the nodes, over that at the nodes."""
MARGIN = 4.0
"""Margin of the points between the nodes, in dips of the chords between them: with it the chord
from a point to a node that touches the wall stays inside, too."""
UNKNOWN = Bulges(np.zeros(0), np.zeros(1, dtype=np.int64), np.zeros(0))
"""No bulge is known by place."""
NOWHERE = BulgeGrid(np.zeros((0, 0, 0)), 0.0, 0.0, 0.0, 0.0)
"""The same at a wall of triangles."""
FINEST = 64
"""Parts of an edge at most; the certificate of a record is what tells beyond that."""


BED = 0.1
"""Dip of the chords between points at a wall that gives way, over the activation gap, at most."""
DEEPEST = 0.5
"""Part of the lumen's smallest radius by which a wall may be pressed in: gaps are known a radius
deep into it."""


class Firmness(NamedTuple):
    """Stiffness K [Pa] and activation gap dhat [m] of a barrier."""

    stiffness: float
    activation_gap: float


def fit(contact: Barrier, wire: Wire, path: Lumen) -> Firmness:
    """Stiffness and activation gap that were given, or that fit the wire on its path.

    The gap is a part of the room that the wire has where the path is narrowest. To bend a wire of
    bending stiffness EI to a radius rho all along takes EI/rho^3 per length; the barrier bears a
    multiple of that with half of its gap left, for the sharpest of the path's bends, of the wire's
    own rest curvature, and of a bend that the wire's length allows.
    """
    if not path.branches:
        return Firmness(
            1e3 if contact.stiffness == "auto" else contact.stiffness,
            1e-4 if contact.activation_gap == "auto" else contact.activation_gap,
        )
    gap = contact.activation_gap
    if gap == "auto":
        gap = ROOM * (path.narrowest - contact.keep_off(wire.radius))
    stiffness = contact.stiffness
    if stiffness == "auto":
        radius = min(path.branches[0].bend_radius().radius, LONGEST * wire.length)
        for section in wire.sections:
            curved = float(np.hypot(*section.rest_curvature))
            radius = min(radius, 1.0 / curved if curved > 0.0 else radius)
        stiffest = max(section.bending_stiffness for section in wire.sections)
        stiffness = FIRM * stiffest / (radius**3 * gap)
    return Firmness(float(stiffness), float(gap))


def divide_bed(firm: Firmness, edge: float, bulge: float, scale: float, edges: int) -> Between:
    """As ``divide``, at a wall that gives way: points between the nodes press as the nodes do.

    They share what wall the edges have, so that it is not pressed twice; nor do they need a margin,
    as a chord that dips into such a wall presses it in.
    """
    parts = ceil(edge * sqrt(0.125 * bulge / (BED * firm.activation_gap)))
    parts = min(max(parts, 1), FINEST)
    return Between(
        parts=parts,
        stiffness=firm.stiffness,
        gap=firm.activation_gap / scale,
        margin=0.0,
        known=np.full((edges, parts, 4), -np.inf),
        jet=np.zeros((edges, parts, JET)),
        clear=np.full((edges, 7), -np.inf),
        bulges=UNKNOWN,
        waiting=np.zeros(FINEST.bit_length() + 1, dtype=np.int64),
    )


def divide(firm: Firmness, edge: float, bulge: float, scale: float, edges: int) -> Between:
    """Barrier between the nodes of edges of a length [m] at a wall of some bulge [1/m].

    In units of the length ``scale`` [m], with the stiffness still in Pa. Where the chord between
    two nodes cannot come noticeably nearer to the wall than they are, there is none. No bulge is
    known by place yet; see ``by_place``.
    """
    gap = THIN * firm.activation_gap
    parts = ceil(edge * sqrt(0.125 * MARGIN * bulge / gap))
    parts = min(max(parts, 1), FINEST)
    chord = edge / parts
    return Between(
        parts=parts,
        stiffness=firm.stiffness * parts / THIN,
        gap=gap / scale,
        margin=MARGIN * min(0.125 * bulge * chord**2, 0.5 * chord) / scale,
        known=np.full((edges, parts, 4), -np.inf),
        jet=np.zeros((edges, parts, JET)),
        clear=np.full((edges, 7), -np.inf),
        bulges=UNKNOWN,
        waiting=np.zeros(FINEST.bit_length() + 1, dtype=np.int64),
    )


def by_place(bulges: Sequence[Bulge], edge: float, scale: float) -> Bulges:
    """How sharply the wall bulges within an edge [m] of each place, in units of ``scale`` [m]."""
    values = [widened(bulge, edge) for bulge in bulges]
    return Bulges(
        value=scale * np.concatenate(values),
        first=np.cumsum([0, *map(len, values)]),
        per_arc=np.array([scale / (bulge.arc[1] - bulge.arc[0]) for bulge in bulges]),
    )


def in_units(grid: BulgeGrid, scale: float) -> BulgeGrid:
    """How a wall of triangles bulges, in units of ``scale`` [m]; -1 stays -1."""
    value = np.where(grid.value < 0.0, -1.0, scale * grid.value)
    x0, y0, z0 = grid.x0 / scale, grid.y0 / scale, grid.z0 / scale
    return BulgeGrid(value, x0, y0, z0, scale * grid.per_cube)
