"""The wall's force along the wire and along the lumen, from the forces on the nodes (P-37).

Everything here is taken from the sum of the nodes' forces up to a place on the wire, which no
mesh changes by much; sizes are summed and not vectors, so that a wire pressed from two sides
does not seem free.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from magwire.engine.record import patch_length

if TYPE_CHECKING:
    from scipy.spatial import KDTree

Array = NDArray[np.float64]

SHARE = 0.95  # of the wall's force on the wire, which its contact length carries
BINS = 5  # places of the path in a patch
MOST_BINS = 400  # on the whole path
SAMPLES = 10  # of the path in a bin, to find where a node is
BESIDE = 1.05  # of the path's radius: nodes farther from it are in another branch


@dataclass(frozen=True)
class Layout:
    """Where forces are summed: along a wire of evenly spaced nodes, and along its path.

    Attributes
    ----------
    length, nodes
        Length of the wire [m]; number of its nodes.
    magnet
        Where the distal magnet begins and ends on the wire [m]; NaN without one.
    way
        Points and radius of the path from the entrance to the target, densely along it, shape
        (q, 4) [m]; no rows in open space.
    """

    length: float
    nodes: int
    magnet: tuple[float, float]
    way: Array

    @cached_property
    def patch(self) -> float:
        """Length over which forces are summed or averaged [m]."""
        return patch_length(self.length, self.nodes)

    @cached_property
    def station(self) -> Array:
        """Place of each node on the wire, shape (nodes,) [m]."""
        return np.linspace(0.0, self.length, self.nodes)

    @cached_property
    def bounds(self) -> Array:
        """Where the cells of the nodes begin and end, shape (nodes + 1,) [m]."""
        middle = 0.5 * (self.station[1:] + self.station[:-1])
        found: Array = np.concatenate(([0.0], middle, [self.length]))
        return found

    @cached_property
    def spread(self) -> dict[int, Array]:
        """How forces are smoothed along the wire: diagonals of a matrix, by their number [1/m]."""
        here, there = self.station[:, None], self.station
        images = (there, -there, 2.0 * self.length - there)
        whole = np.sum([_hat(here - x, self.patch) for x in images], axis=0)
        node, other = np.nonzero(whole)
        return {int(k): np.diagonal(whole, k) for k in np.unique(other - node)}

    @cached_property
    def _along(self) -> Array:
        """Arc parameter of the points of the path, shape (q,) [m]."""
        steps = np.linalg.norm(np.diff(self.way[:, :3], axis=0), axis=1)
        found: Array = np.concatenate(([0.0], np.cumsum(steps)))
        return found

    @cached_property
    def arc(self) -> Array:
        """Places along the path at which its forces are given, shape (bins,) [m]."""
        if len(self.way) == 0:
            return np.zeros(0)
        whole = float(self._along[-1])
        bins = int(np.clip(np.ceil(BINS * whole / self.patch), 1, MOST_BINS))
        found: Array = whole / bins * (np.arange(bins, dtype=np.float64) + 0.5)
        return found

    def point(self, arc: Array) -> Array:
        """Points and radius of the path at arc parameters, shape (n, 4) [m]."""
        columns = [np.interp(arc, self._along, column) for column in self.way.T]
        return np.stack(columns, axis=-1)

    @cached_property
    def _samples(self) -> tuple[Array, Array, KDTree]:
        """Arc parameters [m] and radii [m] of finely spaced points of the path; and the points."""
        from scipy.spatial import KDTree  # slow to import, and not every wire touches

        arc = np.linspace(0.0, self._along[-1], SAMPLES * len(self.arc) + 1)
        found = self.point(arc)
        return arc, found[:, 3], KDTree(found[:, :3])

    def locate(self, points: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Arc parameter on the path of points, shape (n,) [m]; and whether they are in it."""
        arc, radius, tree = self._samples
        away, nearest = tree.query(points)
        return arc[nearest], away <= BESIDE * radius[nearest]


def sizes(contact_force: Array) -> Array:
    """Sizes of the forces on the nodes, shape (t, nodes) [N]."""
    found: Array = np.sqrt(np.einsum("tnc,tnc->tn", contact_force, contact_force))
    return found


def _up_to(layout: Layout, force: Array, station: Array) -> Array:
    """Sum of the forces up to places on the wire, shape (t, places) [N].

    The force on a node is spread over its cell.
    """
    bounds = layout.bounds
    sums = np.concatenate((np.zeros((len(force), 1)), np.cumsum(force, axis=1)), axis=1)
    cell = np.clip(np.searchsorted(bounds, station, side="right") - 1, 0, layout.nodes - 1)
    share = (station - bounds[cell]) / (bounds[cell + 1] - bounds[cell])
    found: Array = (1.0 - share) * sums[:, cell] + share * sums[:, cell + 1]
    return found


def between(layout: Layout, force: Array, begin: Array, end: Array) -> Array:
    """Forces on stretches of the wire, shape (t, stretches) [N]."""
    found: Array = np.maximum(_up_to(layout, force, end) - _up_to(layout, force, begin), 0.0)
    return found


def largest_over(layout: Layout, force: Array, length: float) -> Array:
    """Largest force on any stretch of the wire of some length [m], shape (t,) [N].

    The sum is linear within a cell, so a largest stretch begins or ends where one does.
    """
    begin = np.unique(np.concatenate((layout.bounds, layout.bounds - length)))
    begin = np.clip(begin, 0.0, layout.length - length)
    found: Array = between(layout, force, begin, begin + length).max(axis=1, initial=0.0)
    return found


def _hat(away: Array, reach: float) -> Array:
    """A hat of unit area [1/m]: 1/reach in its middle, zero from a distance of ``reach`` on."""
    found: Array = np.maximum(1.0 - np.abs(away) / reach, 0.0) / reach
    return found


def per_length(layout: Layout, force: Array) -> Array:
    """Force per length at the nodes, smoothed by a hat, shape (t, nodes) [N/m].

    The hat reaches one patch to either side and is mirrored at the ends of the wire: the integral
    is the sum of the forces.
    """
    spread, nodes = layout.spread, layout.nodes
    found = np.zeros(force.shape)
    # Diagonal by diagonal, not as a product of matrices: that is rounded by how many records there
    # are at once.
    for k, share in spread.items():
        here, there = slice(max(0, -k), nodes - max(0, k)), slice(max(0, k), nodes + min(0, k))
        found[:, here] += share * force[:, there]
    return found


def magnet(layout: Layout, force: Array) -> Array:
    """Force on the distal magnet, shape (t,) [N]; NaN without one.

    The force on a node counts by the part of its cell that is magnetised.
    """
    begin, end = layout.magnet
    if not end > begin:
        return np.full(len(force), np.nan)
    inside = np.diff(np.clip(layout.bounds, begin, end)) / np.diff(layout.bounds)
    found: Array = (force * inside).sum(axis=1)
    return found


def contact_length(layout: Layout, density: Array) -> Array:
    """Shortest length of wire that carries 95 percent of a force per length, shape (t,) [m]."""
    order = np.argsort(-density, axis=1, kind="stable")
    heights = np.take_along_axis(density, order, axis=1)
    cells = np.diff(layout.bounds)[order]
    carried = np.cumsum(heights * cells, axis=1)
    wanted = SHARE * carried[:, -1:]
    full = carried < wanted
    rest = np.maximum(wanted - np.where(full, carried, 0.0).max(axis=1, keepdims=True), 0.0)
    last = np.take_along_axis(heights, full.sum(axis=1, keepdims=True), axis=1)
    part = np.divide(rest, last, out=np.zeros_like(rest), where=last > 0.0)
    found: Array = (np.where(full, cells, 0.0).sum(axis=1, keepdims=True) + part)[:, 0]
    return found


def per_way(layout: Layout, position: Array, force: Array) -> Array:
    """Force per length of the path at ``arc``, smoothed by a hat, shape (t, bins) [N/m].

    A node counts where the path is nearest to it. What presses in another branch, or past
    the outlet, is left out. The hat is mirrored at the ends of the path.
    """
    arc, records = layout.arc, len(force)
    found = np.zeros((records, len(arc)))
    which, node = np.nonzero(force)
    if len(arc) == 0 or len(which) == 0:
        return found
    place, inside = layout.locate(position[which, node])
    place, size, which = place[inside], force[which, node][inside], which[inside]
    whole, spacing = arc[0] + arc[-1], 2.0 * arc[0]
    reach = min(layout.patch, whole)
    bins = np.arange(int(np.ceil(2.0 * reach / spacing)) + 1)
    for middle in (place, -place, 2.0 * whole - place):
        near = np.floor((middle - reach) / spacing).astype(np.int64)[:, None] + bins
        share = size[:, None] * _hat(spacing * (near + 0.5) - middle[:, None], reach)
        known = (near >= 0) & (near < len(arc))
        flat = (which[:, None] * len(arc) + near)[known]
        found += np.bincount(flat, share[known], minlength=found.size).reshape(found.shape)
    return found
