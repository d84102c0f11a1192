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
        For each edge: length [m], EA [N], magnetic moment in the material frame, shape
        (nodes - 1, 3) [A m^2], moment of inertia about its axis [kg m^2].
    bending_stiffness, twisting_stiffness, rest_turn
        For each node's cell: EI/l and GJ/l [N m], integrated rest curvature, shape (nodes, 2).
    mass, volume, radius
        For each node's cell: mass [kg], volume of material [m^3], outer radius [m].
    shares
        Parts of each node's cell that belong to the sections, shape (nodes, sections).
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
    shares: Array

    @property
    def rest_curvature(self) -> Array:
        """Of each hinge at rest, in the measure of the bending energy, shape (nodes, 2).

        A hinge that turns by an angle has the curvature 2 tan(angle/2) (P-3).
        """
        angle = np.linalg.norm(self.rest_turn, axis=1, keepdims=True)
        result: Array = self.rest_turn * np.sinc(angle / (2.0 * np.pi)) / np.cos(0.5 * angle)
        return result


class Cells:
    """The bounds of a wire's edges and cells, and integrals over them.

    Attributes
    ----------
    pieces, owner
        The sections, tapered ones cut wherever an edge or a cell ends, so that no interval ends
        inside of a taper; which section each piece is of.
    """

    def __init__(self, wire: Wire) -> None:
        self.station = np.linspace(0.0, wire.length, wire.nodes)
        middle = 0.5 * (self.station[1:] + self.station[:-1])
        self.bounds = np.concatenate(([0.0], middle, [wire.length]))
        whole = np.concatenate(([0.0], np.cumsum([part.length for part in wire.sections])))
        whole[-1] = wire.length
        marks = np.union1d(self.station, self.bounds)
        self.pieces: list[Section] = []
        owner, ends = [], [0.0]
        for i, section in enumerate(wire.sections):
            cuts = [*self._inside(section, marks, whole[i], whole[i + 1]), whole[i + 1]]
            for cut in cuts:
                alone = len(cuts) == 1
                first, last = ends[-1] - whole[i], cut - whole[i]
                self.pieces.append(section if alone else section.cut(first, last))
                owner.append(i)
                ends.append(cut)
        self.owner, self.ends = np.array(owner), np.array(ends)
        self.which = self._widest()

    @staticmethod
    def _inside(section: Section, marks: Array, first: float, last: float) -> Array:
        """Where a tapered section is cut."""
        if section.end_radius is None:
            return np.zeros(0)
        near = 1e-9 * section.length
        return marks[(marks > first + near) & (marks < last - near)]

    def total(self, bounds: Array, density: Callable[[Section], float]) -> Array:
        """Integral of a density over each interval between bounds."""
        return self.spread(bounds, np.array([density(piece) for piece in self.pieces]))

    def spread(self, bounds: Array, heights: Array) -> Array:
        """The same, of a density given piece by piece, shape (pieces, ...)."""
        wide = heights.reshape(len(heights), -1)
        steps = wide * np.diff(self.ends)[:, None]
        sums = np.concatenate((np.zeros((1, wide.shape[1])), np.cumsum(steps, axis=0)))
        columns = [np.diff(np.interp(bounds, self.ends, column)) for column in sums.T]
        return np.stack(columns, axis=-1).reshape(-1, *heights.shape[1:])

    def turned(self, bounds: Array, heights: Array) -> Array:
        """The same, of vectors along m1 and m2, shape (pieces, 2), which turn with the rest twist.

        With m1 + i m2 as complex numbers, a piece of length x contributes an integral of
        exp(i twist s), which is x exp(i twist x/2) sinc(twist x/2).
        """
        twist = np.array([piece.rest_twist for piece in self.pieces])
        if not np.any(twist):
            return self.spread(bounds, heights)
        lengths = np.diff(self.ends)
        angle = np.concatenate(([0.0], np.cumsum(twist * lengths)))[:-1]
        start = (heights[:, 0] + 1j * heights[:, 1]) * np.exp(1j * angle)

        def arc(which: NDArray[np.int64], x: Array) -> NDArray[np.complex128]:
            half = 0.5 * twist[which] * x
            result: NDArray[np.complex128] = x * np.exp(1j * half) * np.sinc(half / np.pi)
            return start[which] * result

        sums = np.concatenate(([0.0], np.cumsum(arc(np.arange(len(lengths)), lengths))))
        last = len(lengths) - 1
        which = np.clip(np.searchsorted(self.ends, bounds, side="right") - 1, 0, last)
        whole = np.diff(sums[which] + arc(which, bounds - self.ends[which]))
        return np.stack([whole.real, whole.imag], axis=1)

    def moments(self, heights: Array) -> Array:
        """Magnetic moment of each edge, by that per length of each piece, shape (pieces, 3)."""
        across = self.turned(self.station, heights[:, :2])
        return np.concatenate((across, self.spread(self.station, heights[:, 2:])), axis=1)

    def shares(self, sections: int) -> Array:
        """Parts of each cell that belong to the sections, shape (nodes, sections)."""
        found: Array = self.spread(self.bounds, np.eye(sections)[self.owner])
        return found / np.diff(self.bounds)[:, None]

    def radius(self) -> Array:
        """Outer radius at each node [m]."""
        return self._widths(self.which)

    def _widest(self) -> NDArray[np.int64]:
        """The piece that gives each node its radius: the wider one where two meet at a node."""
        near = 1e-9 * self.station[-1]
        before, after = (
            np.clip(np.searchsorted(self.ends, self.station + off) - 1, 0, len(self.pieces) - 1)
            for off in (-near, near)
        )
        wider = self._widths(after) > (1.0 + 1e-12) * self._widths(before)
        result: NDArray[np.int64] = np.where(wider, after, before)
        return result

    def _widths(self, which: NDArray[np.int64]) -> Array:
        """Outer radius of a piece for each node, where that is on it or at its end [m]."""
        along = (self.station - self.ends[which]) / np.diff(self.ends)[which]
        pieces = [self.pieces[i] for i in which]
        return np.array(
            [p.radius * (1.0 + (p.ratio - 1.0) * x) for p, x in zip(pieces, along, strict=True)]
        )


def lay_out(wire: Wire) -> Mesh:
    """Lay a wire out on its evenly spaced nodes."""
    cells = Cells(wire)
    station, bounds = cells.station, cells.bounds
    edge_length = np.diff(station)
    moments = np.array([piece.moment_per_length for piece in cells.pieces])
    curvatures = np.array([piece.rest_curvature for piece in cells.pieces])
    return Mesh(
        station=station,
        cell_end=bounds[1:],
        edge_length=edge_length,
        stretching_stiffness=edge_length
        / cells.total(station, lambda s: 1.0 / s.stretching_stiffness),
        moment=cells.moments(moments),
        axial_inertia=cells.total(station, lambda s: s.axial_inertia),
        bending_stiffness=1.0 / cells.total(bounds, lambda s: 1.0 / s.bending_stiffness),
        twisting_stiffness=1.0 / cells.total(bounds, lambda s: 1.0 / s.twisting_stiffness),
        rest_turn=cells.turned(bounds, curvatures),
        mass=cells.total(bounds, lambda s: s.density * s.area),
        volume=cells.total(bounds, lambda s: s.area),
        radius=cells.radius(),
        shares=cells.shares(len(wire.sections)),
    )
