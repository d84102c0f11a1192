"""The nearest point of a surface of triangles, exactly, by a tree of boxes.

The triangles lie in a row in an order that keeps neighbours close. The tree is complete: node i has
the children 2 i + 1 and 2 i + 2, and each leaf has the next ``LEAF`` triangles of the row.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from numpy.typing import NDArray

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import combine, dot, row, sub

LEAF = 4
"""Triangles of a leaf."""
DEEPEST = 64
"""Nodes that wait at most while the tree is searched."""


class Triangles(NamedTuple):
    """A surface to be searched.

    Attributes
    ----------
    corners
        Shape [triangles, 9], in the order of the tree.
    boxes
        Lower and upper corner of the box of each node, shape [nodes, 6].
    leaves
        Number of leaves, a power of two.
    beyond
        Whether a triangle is far past an end of the wall, where sides mean nothing, [triangles].
    normals
        Of each triangle, of its edges opposite to the corners and of its corners, the latter two
        sums over the triangles around them, shape [triangles, 7, 3]: they tell the sides apart
        (Baerentzen and Aanaes 2005).
    """

    corners: NDArray
    boxes: NDArray
    leaves: int
    beyond: NDArray
    normals: NDArray


@kernel
def apart(boxes, node, x, y, z):
    """Squared distance of a point from the box of a node."""
    u = max(boxes[node, 0] - x, x - boxes[node, 3], 0.0)
    v = max(boxes[node, 1] - y, y - boxes[node, 4], 0.0)
    w = max(boxes[node, 2] - z, z - boxes[node, 5], 0.0)
    return u * u + v * v + w * w


@kernel
def foot(corners, i, p):
    """Nearest point of triangle i to p, and where it is: 0 within, 1 to 3 an edge, 4 to 6 a corner.

    By the regions in which the nearest point may be (Ericson 2005, section 5.1.5). Edges have the
    number of the corner opposite to them.
    """
    a = (corners[i, 0], corners[i, 1], corners[i, 2])
    b = (corners[i, 3], corners[i, 4], corners[i, 5])
    c = (corners[i, 6], corners[i, 7], corners[i, 8])
    ab, ac, ap = sub(b, a), sub(c, a), sub(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return a, 4
    bp = sub(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return b, 5
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return combine(1.0, a, d1 / (d1 - d3), ab), 3
    cp = sub(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return c, 6
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return combine(1.0, a, d2 / (d2 - d6), ac), 2
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        return combine(1.0, b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), sub(c, b)), 1
    share = 1.0 / (va + vb + vc)
    q = combine(1.0, a, vb * share, ab)
    return combine(1.0, q, vc * share, ac), 0


@kernel
def closest(surface, p, first, waiting):
    """The triangle that is nearest to a point.

    Parameters
    ----------
    surface
        The triangles.
    p
        The point.
    first
        A triangle that may be near.
    waiting
        Scratch, shape [DEEPEST].

    Returns
    -------
    triangle
        Its place in the row.
    point, where
        As of ``foot``.
    """
    nearest = first
    q, where = foot(surface.corners, first, p)
    off = sub(p, q)
    best = dot(off, off)
    waiting[0] = 0
    count = 1
    while count > 0:
        count -= 1
        node = waiting[count]
        if apart(surface.boxes, node, p[0], p[1], p[2]) >= best:
            continue
        if node >= surface.leaves - 1:
            start = LEAF * (node - (surface.leaves - 1))
            for i in range(start, min(start + LEAF, surface.corners.shape[0])):
                here, region = foot(surface.corners, i, p)
                off = sub(p, here)
                if dot(off, off) < best:
                    best, nearest, q, where = dot(off, off), i, here, region
            continue
        left, right = 2 * node + 1, 2 * node + 2
        far = apart(surface.boxes, left, p[0], p[1], p[2])
        near = apart(surface.boxes, right, p[0], p[1], p[2])
        if far < near:
            left, right = right, left
        waiting[count] = left
        waiting[count + 1] = right
        count += 2
    return nearest, q, where


@kernel
def signed(surface, p, q, triangle, where):
    """Distance of p from its nearest point q, positive on the side that normals point away from."""
    off = sub(p, q)
    away = sqrt(dot(off, off))
    normal = row(surface.normals[triangle], where)
    return -away if dot(off, normal) > 0.0 else away


@kernel
def depths(surface, points, waiting, depth, triangle, nearest):
    """How deep points are inside of a surface, negative outside.

    Parameters
    ----------
    surface, waiting
        As of ``closest``.
    points
        Shape [n, 3]; faster if neighbours follow each other.
    depth, triangle, nearest
        Out, shapes [n], [n] and [n, 3]: depth, place of the nearest triangle in the row, and the
        nearest point of it.
    """
    last = 0
    for i in range(points.shape[0]):
        p = row(points, i)
        last, q, where = closest(surface, p, last, waiting)
        depth[i] = signed(surface, p, q, last, where)
        triangle[i] = last
        for c in range(3):
            nearest[i, c] = q[c]


@kernel
def fill(surface, corner, cell, places, edge, halo, waiting, values, far):
    """Depths at a brick's own points of a lattice, over its spacing.

    Parameters
    ----------
    surface, waiting
        As of ``closest``.
    corner, cell
        Lower corner of the box of bricks [3], and spacing of the lattice.
    places
        Where in the box each brick is, shape [bricks, 3].
    edge, halo
        Points along the edge of a brick, and how many more there are on either side.
    values
        Out, shape [bricks, (edge + 2 halo)^3].
    far
        Out, shape [bricks, edge^3]: whether what is nearest is ``beyond`` the ends.
    """
    wide = edge + 2 * halo
    last = 0
    for b in range(places.shape[0]):
        for i in range(edge):
            for j in range(edge):
                for k in range(edge):
                    p = (
                        corner[0] + cell * (edge * places[b, 0] + i),
                        corner[1] + cell * (edge * places[b, 1] + j),
                        corner[2] + cell * (edge * places[b, 2] + k),
                    )
                    last, q, where = closest(surface, p, last, waiting)
                    at = ((i + halo) * wide + j + halo) * wide + k + halo
                    values[b, at] = signed(surface, p, q, last, where) / cell
                    far[b, (i * edge + j) * edge + k] = surface.beyond[last]


@kernel
def surround(surface, corner, cell, places, beside, alone, edge, halo, waiting, values):
    """The depths around each brick: those of the bricks beside it, or new ones if there is none.

    Parameters
    ----------
    beside
        The 27 bricks around each one and itself, -1 for none, shape [bricks, 27].
    alone
        Whether there is no coarser brick around those at the border; if there is, nothing depends
        on depths in it.
    """
    wide = edge + 2 * halo
    last = 0
    for b in range(places.shape[0]):
        for i in range(wide):
            u = i - halo
            for j in range(wide):
                v = j - halo
                for k in range(wide):
                    w = k - halo
                    side = neighbour(u, v, w, edge)
                    if side == 13:
                        continue
                    at = (i * wide + j) * wide + k
                    other = beside[b, side]
                    if other >= 0:
                        there = (u % edge + halo) * wide + v % edge + halo
                        values[b, at] = values[other, there * wide + w % edge + halo]
                        continue
                    if not alone:
                        values[b, at] = 0.0
                        continue
                    p = (
                        corner[0] + cell * (edge * places[b, 0] + u),
                        corner[1] + cell * (edge * places[b, 1] + v),
                        corner[2] + cell * (edge * places[b, 2] + w),
                    )
                    last, q, where = closest(surface, p, last, waiting)
                    depth = signed(surface, p, q, last, where) / cell
                    a, c, d = clipped(u, edge), clipped(v, edge), clipped(w, edge)
                    off = sub((u, v, w), (a, c, d))
                    inner = values[b, ((a + halo) * wide + c + halo) * wide + d + halo]
                    if depth * inner < 0.0 and max(depth * depth, inner * inner) >= dot(off, off):
                        depth = -depth
                    values[b, at] = depth


@kernel
def clipped(i, edge):
    """The nearest index from 0 to edge - 1."""
    return min(max(i, 0), edge - 1)


@kernel
def neighbour(u, v, w, edge):
    """Which of the 27 bricks around one a point of the lattice is in; 13 for the one itself."""
    a = 0 if u < 0 else (1 if u < edge else 2)
    b = 0 if v < 0 else (1 if v < edge else 2)
    c = 0 if w < 0 else (1 if w < edge else 2)
    return (a * 3 + b) * 3 + c


@kernel
def root(parents, i):
    """What a point belongs to; the way there is made shorter."""
    while parents[i] != i:
        parents[i] = parents[parents[i]]
        i = parents[i]
    return i


@kernel
def agree(beside, edge, halo, values, far, parents, votes):
    """Have points that no wall can part take the same side, that of most of them.

    Where a surface folds over itself its normals do not tell the sides apart. Two points of the
    lattice are on one side if either is farther from the wall than from the other.

    Parameters
    ----------
    beside, edge, halo, values, far
        As of ``fill`` and ``surround``; values are changed in place.
    parents, votes
        Scratch, shape [bricks * edge^3].
    """
    wide, size = edge + 2 * halo, edge * edge * edge
    for i in range(parents.shape[0]):
        parents[i] = i
        votes[i] = 0
    for around in range(2):
        for b in range(values.shape[0]):
            for i in range(edge):
                for j in range(edge):
                    for k in range(edge):
                        here = (i * edge + j) * edge + k
                        at = ((i + halo) * wide + j + halo) * wide + k + halo
                        if far[b, here]:
                            continue
                        mine = root(parents, b * size + here)
                        if around == 1:
                            inside = votes[mine] > 0 or (votes[mine] == 0 and values[b, at] > 0.0)
                            values[b, at] = abs(values[b, at]) if inside else -abs(values[b, at])
                            continue
                        votes[mine] += 1 if values[b, at] > 0.0 else -1
                        for axis in range(3):
                            u, v, w = i + (axis == 0), j + (axis == 1), k + (axis == 2)
                            other = beside[b, neighbour(u, v, w, edge)]
                            if other < 0:
                                continue
                            u, v, w = u % edge, v % edge, w % edge
                            there = (u * edge + v) * edge + w
                            if far[other, there]:
                                continue
                            value = values[other, ((u + halo) * wide + v + halo) * wide + w + halo]
                            if max(abs(value), abs(values[b, at])) < 1.0:
                                continue
                            mine = root(parents, mine)
                            theirs = root(parents, other * size + there)
                            if mine != theirs:
                                parents[theirs] = mine
                                votes[mine] += votes[theirs]
