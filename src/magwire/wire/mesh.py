"""A wire laid out on its nodes: what each edge and each cell holds (P-4).

Sections need not end at nodes. Masses, moments and rest curvatures of an edge or a cell are
integrals over it; stiffnesses come from the integral of the compliance, since stretches of a
wire act in series. So totals do not depend on the mesh.

What a mesh changes by when a section does follows by the chain rule: of k = 1 / int ds / EI,
dk = k^2 int d(EI) / EI^2 ds.
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

    @property
    def rest_curvature(self) -> Array:
        """Of each hinge at rest, in the measure of the bending energy, shape (nodes, 2).

        A hinge that turns by an angle has the curvature 2 tan(angle/2) (P-3).
        """
        angle = np.linalg.norm(self.rest_turn, axis=1, keepdims=True)
        result: Array = self.rest_turn * np.sinc(angle / (2.0 * np.pi)) / np.cos(0.5 * angle)
        return result


class Cells:
    """The bounds of a wire's edges and cells, and integrals over them."""

    def __init__(self, wire: Wire) -> None:
        self.sections = wire.sections
        self.station = np.linspace(0.0, wire.length, wire.nodes)
        middle = 0.5 * (self.station[1:] + self.station[:-1])
        self.bounds = np.concatenate(([0.0], middle, [wire.length]))
        self.ends = np.concatenate(([0.0], np.cumsum([part.length for part in wire.sections])))
        self.ends[-1] = wire.length
        which = np.searchsorted(self.ends, self.station, side="left") - 1
        self.which = np.clip(which, 0, len(wire.sections) - 1)

    def total(self, bounds: Array, density: Callable[[Section], float]) -> Array:
        """Integral of a density over each interval between bounds."""
        return self.spread(bounds, np.array([density(section) for section in self.sections]))

    def spread(self, bounds: Array, heights: Array) -> Array:
        """The same, of a density given section by section, shape (sections, ...)."""
        wide = heights.reshape(len(heights), -1)
        pieces = wide * np.diff(self.ends)[:, None]
        sums = np.concatenate((np.zeros((1, wide.shape[1])), np.cumsum(pieces, axis=0)))
        columns = [np.diff(np.interp(bounds, self.ends, column)) for column in sums.T]
        return np.stack(columns, axis=-1).reshape(-1, *heights.shape[1:])


def lay_out(wire: Wire) -> Mesh:
    """Lay a wire out on its evenly spaced nodes."""
    cells = Cells(wire)
    station, bounds = cells.station, cells.bounds
    edge_length = np.diff(station)
    moments = np.array([section.moment_per_length for section in wire.sections])
    curvatures = np.array([section.rest_curvature for section in wire.sections])
    return Mesh(
        station=station,
        cell_end=bounds[1:],
        edge_length=edge_length,
        stretching_stiffness=edge_length
        / cells.total(station, lambda s: 1.0 / s.stretching_stiffness),
        moment=cells.spread(station, moments),
        axial_inertia=cells.total(
            station, lambda s: 0.5 * s.density * s.area * (s.radius**2 + s.inner_radius**2)
        ),
        bending_stiffness=1.0 / cells.total(bounds, lambda s: 1.0 / s.bending_stiffness),
        twisting_stiffness=1.0 / cells.total(bounds, lambda s: 1.0 / s.twisting_stiffness),
        rest_turn=cells.spread(bounds, curvatures),
        mass=cells.total(bounds, lambda s: s.density * s.area),
        volume=cells.total(bounds, lambda s: s.area),
        radius=np.array([wire.sections[i].radius for i in cells.which]),
    )
