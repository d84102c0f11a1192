"""A wire laid out on its nodes: what each edge and each cell holds (P-4).

Sections need not end at nodes. Masses, moments and rest curvatures of an edge or a cell are
integrals over it; stiffnesses come from the integral of the compliance, since stretches of a
wire act in series. So totals do not depend on the mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.wire.section import Section
from magwire.wire.wire import Wire

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mesh:
    """A wire on its mesh, in SI units.

    Attributes
    ----------
    station
        Material coordinate of each node from the proximal end, shape (nodes,) [m].
    cell_end
        Where each node's Voronoi cell ends, shape (nodes,) [m].
    edge_length, stretching_stiffness, moment, axial_inertia
        Of each edge: length [m], EA [N], magnetic moment in the material frame, shape
        (nodes - 1, 3) [A m^2], moment of inertia about its axis [kg m^2].
    bending_stiffness, twisting_stiffness, rest_turn
        Of each node's cell: EI/l and GJ/l [N m], integrated rest curvature, shape (nodes, 2).
    mass, volume, radius
        Of each node's cell: mass [kg], volume of material [m^3], outer radius [m].
    """

    station: Array
    cell_end: Array
    edge_length: Array
    stretching_stiffness: Array
    moment: Array
    axial_inertia: Array
    bending_stiffness: Array
    twisting_stiffness: Array
    rest_turn: Array
    mass: Array
    volume: Array
    radius: Array


def lay_out(wire: Wire) -> Mesh:
    """Lay a wire out on its evenly spaced nodes."""
    station = np.linspace(0.0, wire.length, wire.nodes)
    middle = 0.5 * (station[1:] + station[:-1])
    cells = np.concatenate(([0.0], middle, [wire.length]))
    ends = np.concatenate(([0.0], np.cumsum([section.length for section in wire.sections])))
    ends[-1] = wire.length

    def total(bounds: Array, density: Callable[[Section], float]) -> Array:
        """Integral of a density over each interval between bounds."""
        heights = np.array([density(section) for section in wire.sections])
        sums = np.concatenate(([0.0], np.cumsum(heights * np.diff(ends))))
        return np.diff(np.interp(bounds, ends, sums))

    def vectors(bounds: Array, density: Callable[[Section], tuple[float, ...]]) -> Array:
        count = len(density(wire.sections[0]))
        return np.stack(
            [total(bounds, lambda s, c=c: density(s)[c]) for c in range(count)],  # type: ignore[misc]
            axis=1,
        )

    edge_length = np.diff(station)
    which = np.clip(np.searchsorted(ends, station, side="left") - 1, 0, len(wire.sections) - 1)
    return Mesh(
        station=station,
        cell_end=cells[1:],
        edge_length=edge_length,
        stretching_stiffness=edge_length / total(station, lambda s: 1.0 / s.stretching_stiffness),
        moment=vectors(station, lambda s: s.moment_per_length),
        axial_inertia=total(
            station, lambda s: 0.5 * s.density * s.area * (s.radius**2 + s.inner_radius**2)
        ),
        bending_stiffness=1.0 / total(cells, lambda s: 1.0 / s.bending_stiffness),
        twisting_stiffness=1.0 / total(cells, lambda s: 1.0 / s.twisting_stiffness),
        rest_turn=vectors(cells, lambda s: s.rest_curvature),
        mass=total(cells, lambda s: s.density * s.area),
        volume=total(cells, lambda s: s.area),
        radius=np.array([wire.sections[i].radius for i in which]),
    )
