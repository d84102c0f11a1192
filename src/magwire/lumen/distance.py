"""The signed distance from a wall of triangles as a spline, which the kernels ask (P-39).

A cubic B-spline through bricks of cells: coarse inside, finer towards the wall where it is narrow or
where the spline is off the triangles, each time by half. Finer cells add a correction to what the
coarser ones make, and the correction fades out within them: so the spline is twice continuously
differentiable everywhere. At last it is set inward by as much as it reaches out of any triangle.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from magwire.errors import InputError
from magwire.kernels.wall.closest import DEEPEST, agree, fill, surround
from magwire.kernels.wall.seeds import spread
from magwire.kernels.wall.sheet import (
    BRICK,
    MOUTH_POINT,
    MOUTH_RADIUS,
    WIDE,
    splines,
    steepest,
)
from magwire.kernels.wall.sheet import Sheet as SheetArrays
from magwire.lumen.branch import Branch
from magwire.lumen.mouths import Mouths, open_up
from magwire.lumen.sheet import Sheet, nearest

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

COARSE = 0.25  # edge length of a cell over the largest radius, at most
FINE = 0.25  # the same near the wall, over the radius there
FINEST = 0.02  # the same where the spline is off the triangles, over the smallest radius
OUTWARD = 0.004  # how far the spline may reach out of the triangles, over the smallest radius
INWARD = 0.02  # how far it may stay inside of them, over the radius there
BAND = 3.0  # cells on both sides of the wall that are as fine as it has to be
WHOLE = 1.5  # cells around a point on which finer coefficients there hang
BOX = 200_000  # bricks of the box, at most
MOST = 80_000  # bricks, at most: 110 MB
DENSE = 3.0  # samples of the triangles per edge of the finest cell
SAMPLES = 400_000  # of the triangles, at most
ROOM = 0.02  # in finest cells: what the spline may do between samples
DEEPER = 0.5  # part of the inset that may be lacking on the path
STEEPER = 1.02  # slope that counts over the largest that is found
HALO = 2  # points around a brick that its coefficients depend on
SIDES = np.array(list(product((-1, 0, 1), repeat=3)))


class Wall(NamedTuple):
    """A wall of triangles as the kernels take it.

    Attributes
    ----------
    arrays
        In metres.
    inset
        How far it was set inward [m].
    off
        How far it lies inside of the triangles, all over them, shape (n,) [m].
    radius
        Radius of the lumen at the same places, shape (n,) [m].
    spots
        These places, shape (n, 3) [m].
    """

    arrays: SheetArrays
    inset: float
    off: Array
    radius: Array
    spots: Array


@dataclass(eq=False)
class _Level:
    """Bricks of one size.

    Attributes
    ----------
    corner, cell
        Lower corner of the box, and edge length of a cell [m].
    shape
        How many bricks of this size the box would have.
    places
        Where in the box each brick is, in the order of its number there, shape (bricks, 3).
    """

    corner: Array
    cell: float
    shape: Indices
    places: Indices
    coefficients: Array = field(default_factory=lambda: np.zeros((0, WIDE**3)))
    finer: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))

    @property
    def edge(self) -> float:
        """Edge length of a brick [m]."""
        return BRICK * self.cell

    @property
    def slack(self) -> float:
        """Half the diagonal of a brick [m]."""
        return 0.5 * float(np.sqrt(3.0)) * self.edge

    @property
    def middles(self) -> Array:
        """Centres of the bricks, shape (bricks, 3) [m]."""
        return self.corner + (self.places + 0.5) * self.edge

    @cached_property
    def keys(self) -> Indices:
        """Number of each brick in the box; they increase."""
        return self._key(self.places)

    def _key(self, places: Indices) -> Indices:
        return (places[..., 0] * self.shape[1] + places[..., 1]) * self.shape[2] + places[..., 2]

    def at(self, places: Indices) -> Indices:
        """Which brick is at each place of the box, -1 for none, shape (...)."""
        inside = ((places >= 0) & (places < self.shape)).all(axis=-1)
        keys = np.where(inside, self._key(places), -1)
        found = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
        return np.where(inside & (self.keys[found] == keys), found, -1)

    @cached_property
    def beside(self) -> Indices:
        """The 27 bricks around each one, shape (bricks, 27)."""
        return np.ascontiguousarray(self.at(self.places[:, None, :] + SIDES))

    def samples(self, mouths: Mouths, alone: bool) -> Array:
        """Coefficients of a spline close to the signed distance, shape (bricks, 7, 7, 7).

        They are the distance less a sixth of its second differences, so that what is cubic comes
        out as it is but for its fourth differences.
        """
        count, wide = len(self.places), BRICK + 2 * HALO + 1
        padded = BRICK + 2 * (HALO + 1)
        values = np.empty((count, padded**3))
        far = np.empty((count, BRICK**3), dtype=bool)
        waiting = np.empty(DEEPEST, dtype=np.int64)
        place = (mouths.tree, self.corner, self.cell, self.places)
        fill(*place, BRICK, HALO + 1, waiting, values, far)
        scratch = np.empty((2, count * BRICK**3), dtype=np.int64)
        agree(self.beside, BRICK, HALO + 1, values, far, *scratch)
        surround(*place, self.beside, alone, BRICK, HALO + 1, waiting, values)
        values = values.reshape(count, padded, padded, padded)[:, 1:, 1:, 1:]
        inner = slice(1, wide - 1)
        laplacian = -6.0 * values[:, inner, inner, inner]
        for step in (-1, 1):
            moved = slice(1 + step, wide - 1 + step)
            laplacian += values[:, moved, inner, inner]
            laplacian += values[:, inner, moved, inner]
            laplacian += values[:, inner, inner, moved]
        return np.asarray(values[:, inner, inner, inner] - laplacian / 6.0)

    def finished(self) -> Array:
        """Which coefficients have all their cells in bricks that are there, (bricks, 7, 7, 7)."""
        there = (self.beside >= 0).reshape(-1, 3, 3, 3)
        found = np.ones((len(self.places), WIDE, WIDE, WIDE), dtype=bool)
        parts = ((0, slice(0, 3)), (1, slice(3, 4)), (2, slice(4, 7)))
        for (a, x), (b, y), (c, z) in product(parts, repeat=3):
            needed = product({1, a}, {1, b}, {1, c})
            found[:, x, y, z] = np.all([there[:, i, j, k] for i, j, k in needed], axis=0)[
                :, None, None, None
            ]
        return found


_MADE: dict[bytes, Wall] = {}
"""The wall that was made last: a scenario is looked at, and then it is run."""


def build(sheet: Sheet, branches: Sequence[Branch]) -> Wall:
    """The wall of triangles around branches, for the kernels, in metres; the last one is kept."""
    digest = hashlib.sha256(sheet.points.tobytes() + sheet.triangles.tobytes())
    for branch in branches:
        digest.update(branch.points.tobytes() + branch.radius.tobytes())
    key = digest.digest()
    if key not in _MADE:
        made = _build(sheet, branches)
        _MADE.clear()
        _MADE[key] = made
    return _MADE[key]


def _build(sheet: Sheet, branches: Sequence[Branch]) -> Wall:
    """The wall of triangles around branches.

    Raises
    ------
    InputError
        If the branches do not run inside of the triangles.
    """
    mouths = open_up(sheet, branches)
    points = np.concatenate([branch.points for branch in branches])
    radius = np.concatenate([branch.radius for branch in branches])
    if float(np.median(nearest(mouths.tree, points).depth)) < 0.0:
        return _build(sheet.turned(), branches)
    near = KDTree(points)
    narrow = float(radius.min())
    levels = [_box(mouths, float(radius.max()), narrow)]
    levels[0].coefficients = levels[0].samples(mouths, True).reshape(-1, WIDE**3)
    spots = _spots(sheet, 0.06 * narrow)
    wide = radius[near.query(spots)[1]]
    off = np.zeros(len(spots))
    while True:
        level = levels[-1]
        there, here = _of_level(level, spots)
        off[there] = level.cell * here
        wanted = _coarse(level, mouths, near, radius) & _large(level, FINE, narrow, near, radius)
        reached = level.cell * here
        for more in (1.0, 2.0, 4.0):  # if there are too many bricks, only where it is worst
            finer = wanted
            if level.cell > FINEST * narrow:
                bad = reached > more * OUTWARD * narrow
                bad |= (reached < -INWARD * wide[there]) & (more == 1.0)
                finer = wanted | _around(level, spots[there[bad]])
            total = sum(len(one.places) for one in levels) + 8 * int(finer.sum())
            if total <= MOST:
                break
        level.finer = finer if total <= MOST else np.zeros_like(finer)
        if not level.finer.any():
            break
        levels.append(_halved(level, mouths))
    inset = max(float(off.max()), 0.0) + ROOM * levels[-1].cell
    arrays = _packed(levels, mouths, inset, narrow)
    return Wall(arrays, inset, inset - off, wide, spots)


def _box(mouths: Mouths, widest: float, narrow: float) -> _Level:
    """The largest bricks: those with points inside, near the wall, or in a mouth."""
    cell = COARSE * widest
    corners = mouths.tree.corners[~mouths.tree.beyond].reshape(-1, 3)
    while True:
        slack = 0.5 * np.sqrt(3.0) * BRICK * cell
        room = slack + narrow
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        shape = np.ceil((high - low) / (BRICK * cell)).astype(np.int64)
        if shape.prod() <= BOX:
            break
        cell *= 1.1
    places = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3)
    box = _Level(low, cell, shape, places)
    found = nearest(mouths.tree, box.middles)
    active = found.depth > -room
    for end in range(len(mouths.ends)):
        radius = mouths.ends[end, MOUTH_RADIUS]
        mine = _mine(mouths, end, found.points, 0.0)
        past, off = mouths.past(end, box.middles)
        reach = past < radius + room
        active &= ~mine | reach
        active |= mine & reach & (off < mouths.widest[end] + radius + room)
    return _Level(low, cell, shape, places[active])


def _mine(mouths: Mouths, end: int, points: Array, before: float) -> NDArray[np.bool_]:
    """Whether points of the wall are past the plane of an end, or at most ``before`` it [m]."""
    past, off = mouths.past(end, points)
    return (past >= -before) & (off < 1.01 * mouths.widest[end])


def _spots(sheet: Sheet, spacing: float) -> Array:
    """Points all over the triangles, their corners among them, shape (n, 3) [m]."""
    corners = sheet.points[sheet.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    spacing /= DENSE
    while True:
        parts = np.maximum(np.ceil(longest / spacing).astype(np.int64), 2)
        if ((parts + 1) * (parts + 2) // 2).sum() <= SAMPLES:
            break
        spacing *= 1.3
    found = []
    for part in np.unique(parts):
        i, j = np.meshgrid(np.arange(part + 1), np.arange(part + 1), indexing="ij")
        kept = i + j <= part
        shares = np.column_stack([i[kept], j[kept], part - i[kept] - j[kept]]) / part
        found.append(np.einsum("sk,tkx->tsx", shares, corners[parts == part]).reshape(-1, 3))
    return np.concatenate(found)


def _of_level(level: _Level, spots: Array) -> tuple[Indices, Array]:
    """Which points are in bricks of a level, and its spline there, in cells."""
    inside = (spots - level.corner) / level.edge
    places = inside.astype(np.int64)
    bricks = level.at(places)
    there = np.flatnonzero(bricks >= 0)
    value = np.empty(len(there))
    splines(level.coefficients, bricks[there], BRICK * (inside[there] - places[there]), value)
    return there, value


def _coarse(
    level: _Level, mouths: Mouths, near: KDTree, radius: Array
) -> NDArray[np.bool_]:
    """Which bricks are within the band around the wall."""
    found = nearest(mouths.tree, level.middles)
    return (np.abs(found.depth) < level.slack + BAND * level.cell) & ~found.beyond


def _large(level, fine, narrow, near, radius):
    wide = radius[near.query(level.middles)[1]]
    return level.cell > 1.001 * fine * wide


def _around(level: _Level, spots: Array) -> NDArray[np.bool_]:
    """Which bricks have to be finer for all that the finer spline hangs on at some points."""
    places = (spots - level.corner) / level.edge
    found = np.zeros(len(level.places), dtype=bool)
    for side in product((-WHOLE, WHOLE), repeat=3):
        bricks = level.at(np.floor(places + np.array(side) / BRICK).astype(np.int64))
        found[bricks[bricks >= 0]] = True
    return found


def _halved(level: _Level, mouths: Mouths) -> _Level:
    """The bricks that finer ones are made of, in eight parts each, with their corrections."""
    parents = np.flatnonzero(level.finer)
    octants = np.array(list(product((0, 1), repeat=3)))
    places = (2 * level.places[parents][:, None, :] + octants).reshape(-1, 3)
    made = _inserted(level.coefficients[parents]).reshape(-1, WIDE**3)
    keys = _Level(level.corner, 0.5 * level.cell, 2 * level.shape, places).keys
    order = np.argsort(keys)
    finer = _Level(level.corner, 0.5 * level.cell, 2 * level.shape, places[order])
    made = made[order].reshape(-1, WIDE, WIDE, WIDE)
    wanted = finer.samples(mouths, False)
    finer.coefficients = np.where(finer.finished(), wanted, made).reshape(-1, WIDE**3)
    return finer


def _inserted(coefficients: Array) -> Array:
    """The same splines by cells of half the size, in eight parts, in units of these.

    Shape (bricks, 2, 2, 2, 7, 7, 7). Knots are inserted in the middle of each cell: a coefficient
    is the mean of two, or (1, 6, 1)/8 of three.
    """
    half = np.zeros((2, WIDE, WIDE))
    for part in range(2):
        for i in range(WIDE):  # coefficient i - 1 of the part, i - 1 + BRICK * part of the whole
            fine = i - 1 + BRICK * part
            if fine % 2 == 0:
                half[part, i, fine // 2 : fine // 2 + 3] = 0.125, 0.75, 0.125
            else:
                half[part, i, (fine - 1) // 2 + 1 : (fine - 1) // 2 + 3] = 0.5
    cubes = coefficients.reshape(-1, WIDE, WIDE, WIDE)
    made = np.einsum("axi,byj,czk,nijk->nabcxyz", half, half, half, cubes, optimize=True)
    return 2.0 * made


def _packed(levels: list[_Level], mouths: Mouths, inset: float, narrow: float) -> SheetArrays:
    """All bricks for the kernels."""
    first, tree = levels[0], []
    values, finer, middles = [], [], []
    starts = np.cumsum([0, *(len(level.places) for level in levels)])
    count = 0
    # Entries of the tree: of the first level in its order, then eight for each finer brick.
    entry = [np.arange(len(first.places))]
    total = len(first.places)
    for level, below in zip(levels, levels[1:], strict=False):
        parents = np.flatnonzero(level.finer)
        begin = total + 8 * np.arange(len(parents))
        place = np.full(len(level.places), -1, dtype=np.int64)
        place[parents] = begin
        up = level.at(below.places // 2)
        octant = below.places % 2 @ np.array([4, 2, 1])
        entry.append(place[up] + octant)
        total += 8 * len(parents)
    tree = np.zeros(total, dtype=np.int32)
    for depth, level in enumerate(levels):
        leaves = ~level.finer if len(level.finer) else np.ones(len(level.places), dtype=bool)
        tree[entry[depth][leaves]] = count + np.arange(int(leaves.sum()))
        if depth + 1 < len(levels):
            parents = np.flatnonzero(level.finer)
            children = levels[depth + 1]
            up = level.at(children.places // 2)
            octant = children.places % 2 @ np.array([4, 2, 1])
            whole = octant == 0
            tree[entry[depth][up[whole]]] = -1 - entry[depth + 1][whole]
        count += int(leaves.sum())
        scale = 0.5**depth
        values.append((level.coefficients[leaves] * scale - inset / first.cell).astype(np.float32))
        finer.append(np.full(int(leaves.sum()), 2.0**depth))
        middles.append(level.middles[leaves])
    rows = np.concatenate(values)
    sizes = np.concatenate(finer)
    mouth, flags = _mouths(np.concatenate(middles), first.cell / sizes, mouths)
    away = np.full(int(first.shape.prod()), int(first.shape.max()), dtype=np.int32)
    away[first.keys] = 0
    spread(away, first.shape)
    bricks = -away
    bricks[first.keys] = np.arange(len(first.places))
    steep = STEEPER * max(1.0, steepest(rows, sizes, mouth, flags, -first.cell * 0.0))
    x0, y0, z0 = map(float, first.corner)
    nx, ny, nz = map(int, first.shape)
    return SheetArrays(
        bricks=bricks,
        tree=tree,
        values=rows,
        mouth=mouth,
        mouths=flags,
        ends=mouths.ends,
        x0=x0,
        y0=y0,
        z0=z0,
        cell=first.cell,
        nx=nx,
        ny=ny,
        nz=nz,
        margin=narrow,
        steep=float(steep),
    )


def _mouths(
    middles: Array, cells: Array, mouths: Mouths
) -> tuple[NDArray[np.int32], NDArray[np.int16]]:
    """The mouth that each cell is in: whose wall is nearest, or whose rim."""
    edges = BRICK * cells
    flags = np.full((len(middles), BRICK**3), -1, dtype=np.int16)
    inner = (np.stack(np.meshgrid(*[np.arange(BRICK)] * 3, indexing="ij"), axis=-1) + 0.5) / BRICK
    inner = inner.reshape(-1, 3) - 0.5
    found = nearest(mouths.tree, middles)
    for end in range(len(mouths.ends)):
        past, _ = mouths.past(end, middles)
        near, off = mouths.past(end, found.points)
        may = (past > -edges) & (near > -2.0 * edges) & (off < mouths.widest[end] + 2.0 * edges)
        rows = np.flatnonzero(may)
        if len(rows) == 0:
            continue
        points = middles[rows][:, None, :] + edges[rows][:, None, None] * inner
        size = np.repeat(cells[rows], BRICK**3)
        points = points.reshape(-1, 3)
        there = nearest(mouths.tree, points).points
        mine = _mine(mouths, end, there, 0.0) | (
            _mine(mouths, end, there, 2.0 * float(cells.max())) & (mouths.past(end, points)[0] > -size)
        )
        mine &= mouths.past(end, points)[0] > -size
        part = flags[rows]
        part[mine.reshape(len(rows), -1)] = end
        flags[rows] = part
    in_mouth = (flags >= 0).any(axis=1)
    mouth = np.full(len(middles), -1, dtype=np.int32)
    mouth[in_mouth] = np.arange(int(in_mouth.sum()))
    return mouth, np.ascontiguousarray(flags[in_mouth])


def scaled_sheet(arrays: SheetArrays, length_scale: float) -> SheetArrays:
    """The same wall in units of ``length_scale`` [m]; its coefficients are those of both."""
    ends = arrays.ends.copy()
    ends[:, MOUTH_POINT : MOUTH_POINT + 3] /= length_scale
    ends[:, MOUTH_RADIUS] /= length_scale
    return arrays._replace(
        ends=ends,
        x0=arrays.x0 / length_scale,
        y0=arrays.y0 / length_scale,
        z0=arrays.z0 / length_scale,
        cell=arrays.cell / length_scale,
        margin=arrays.margin / length_scale,
    )
