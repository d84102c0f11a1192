"""The signed distance from a wall of triangles as a spline, which the kernels ask (P-41).

A cubic B-spline through bricks of cells: coarse inside, finer towards the wall where it is narrow
or where the spline is off the triangles, each time by half. Finer cells add a correction to what
the coarser ones make, and the correction fades out within them: so the spline is twice continuously
differentiable everywhere. At last it is set inward by as much as it reaches out of any triangle.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError
from magwire.kernels.wall.seeds import spread
from magwire.kernels.wall.sheet import BRICK, MOUTH_POINT, MOUTH_RADIUS, steepest
from magwire.kernels.wall.sheet import Sheet as SheetArrays
from magwire.lumen.branch import Branch
from magwire.lumen.bricks import Level
from magwire.lumen.mouths import Mouths, open_up
from magwire.lumen.sheet import Sheet, nearest

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

COARSE = 0.25  # edge length of a cell over the largest radius, at most
FINE = 0.25  # the same at the wall, over the radius there
FINEST = 0.03  # cells are divided only if they are larger than this part of the smallest radius
OUTWARD = 0.01  # how far the spline may reach out of the triangles, over the smallest radius
INWARD = 0.02  # how far it may stay inside of them, over the radius there
BAND = 3.0  # cells on both sides of the wall that are as fine as it has to be
BOX = 200_000  # bricks of the box, at most
MOST = 80_000  # bricks, at most: 110 MB
SPACING = 0.02  # of the samples of the triangles, over the smallest radius
SAMPLES = 400_000  # of the triangles, at most
ROOM = 0.02  # in finest cells: what the spline may do between samples
NEAREST = 0.25  # distance of a centreline from the wall, over its radius, at least
STEEPER = 1.02  # slope that counts over the largest that is found


class Wall(NamedTuple):
    """A wall of triangles as the kernels take it.

    Attributes
    ----------
    arrays
        In metres.
    inset
        How far it was set inward [m].
    spots, off, radius
        Places all over the triangles, shape (n, 3) [m], and there how far the wall lies inside of
        them and the radius of the lumen, shapes (n,) [m].
    """

    arrays: SheetArrays
    inset: float
    spots: Array
    off: Array
    radius: Array


_MADE: dict[bytes, Wall] = {}
"""The wall that was made last: a scenario is looked at, and then it is run."""


def build(sheet: Sheet, branches: Sequence[Branch]) -> Wall:
    """The wall of triangles around branches, for the kernels, in metres; the last one is kept.

    Raises
    ------
    InputError
        If the branches do not run inside of the triangles.
    """
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
    if sheet.volume < 0.0:
        sheet = sheet.turned()
    mouths = open_up(sheet, branches)
    points = np.concatenate([branch.points for branch in branches])
    radius = np.concatenate([branch.radius for branch in branches])
    depth = nearest(mouths.tree, points).depth
    _check_inside(points, radius, depth)
    from scipy.spatial import KDTree  # slow to import, and not every wall has triangles

    near, narrow = KDTree(points), float(radius.min())
    spots = _spots(sheet, SPACING * narrow)
    wide = radius[near.query(spots)[1]]
    off = np.zeros(len(spots))
    levels = [_box(mouths, float(radius.max()), narrow)]
    while True:
        level = levels[-1]
        there, value = level.off(spots)
        off[there] = value
        narrower = level.cell > 1.001 * FINE * radius[near.query(level.middles)[1]]
        found = nearest(mouths.tree, level.middles)
        banded = np.abs(found.depth) < level.slack + BAND * level.cell
        wanted = narrower & banded & ~found.beyond
        for more in (1.0, 2.0, 4.0):  # if there are too many bricks, only where it is worst
            bad = value > more * OUTWARD * narrow
            bad |= (value < -INWARD * wide[there]) & (more == 1.0)
            bad &= level.cell > FINEST * narrow
            finer = wanted | level.around(spots[there[bad]])
            total = sum(len(one.places) for one in levels) + 8 * int(finer.sum())
            if total <= MOST:
                break
        level.finer = finer if total <= MOST else np.zeros_like(finer)
        if not level.finer.any():
            break
        levels.append(level.halved(mouths.tree))
    inset = max(float(off.max()), 0.0) + ROOM * levels[-1].cell
    return Wall(_packed(levels, mouths, inset, narrow), inset, spots, inset - off, wide)


def _check_inside(points: Array, radius: Array, depth: Array) -> None:
    """Refuse centrelines that are not well inside of the triangles."""
    if np.any(depth < NEAREST * radius):
        worst = int(np.argmin(depth / radius))
        x, y, z = points[worst]
        raise InputError(
            "Input triangles of Lumen.with_surface must have the branches inside of them; received "
            f"a centreline with radius {radius[worst]:.6g} m that is {depth[worst]:.6g} m inside "
            f"near ({x:.6g}, {y:.6g}, {z:.6g}) m."
        )


def _box(mouths: Mouths, widest: float, narrow: float) -> Level:
    """The largest bricks: those with points inside, near the wall, or in a mouth."""
    cell = COARSE * widest
    corners = mouths.tree.corners[~mouths.tree.beyond].reshape(-1, 3)
    while True:
        room = 0.5 * float(np.sqrt(3.0)) * BRICK * cell + narrow
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        shape = np.ceil((high - low) / (BRICK * cell)).astype(np.int64)
        if shape.prod() <= BOX:
            break
        cell *= 1.1
    places = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3)
    middles = Level(low, cell, shape, places).middles
    found = nearest(mouths.tree, middles)
    active = found.depth > -room
    for end in range(len(mouths.ends)):
        radius = mouths.ends[end, MOUTH_RADIUS]
        mine = mouths.mine(end, found.points)
        past, off = mouths.past(end, middles)
        reached = past < radius + room
        active &= ~mine | reached
        active |= mine & reached & (off < mouths.widest[end] + radius + room)
    box = Level(low, cell, shape, places[active])
    box.coefficients = box.samples(mouths.tree, True).reshape(len(box.places), -1)
    return box


def _spots(sheet: Sheet, spacing: float) -> Array:
    """Points all over the triangles, their corners among them, shape (n, 3) [m]."""
    corners = sheet.points[sheet.triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    while True:
        parts = np.maximum(np.ceil(longest / spacing).astype(np.int64), 2)
        if ((parts + 1) * (parts + 2) // 2).sum() <= max(SAMPLES, 6 * len(parts)):
            break
        spacing *= 1.3
    found = []
    for part in np.unique(parts):
        i, j = np.meshgrid(np.arange(part + 1), np.arange(part + 1), indexing="ij")
        kept = i + j <= part
        shares = np.column_stack([i[kept], j[kept], part - i[kept] - j[kept]]) / part
        found.append(np.einsum("sk,tkx->tsx", shares, corners[parts == part]).reshape(-1, 3))
    return np.concatenate(found)


def _packed(levels: list[Level], mouths: Mouths, inset: float, narrow: float) -> SheetArrays:
    """All bricks for the kernels."""
    first = levels[0]
    tree = _tree(levels)
    leaves = [~level.finer for level in levels]
    values = np.concatenate(
        [
            (level.coefficients[leaf] * (level.cell / first.cell) - inset / first.cell)
            for level, leaf in zip(levels, leaves, strict=True)
        ]
    ).astype(np.float32)
    middles = np.concatenate([x.middles[leaf] for x, leaf in zip(levels, leaves, strict=True)])
    cells = np.repeat([x.cell for x in levels], [int(leaf.sum()) for leaf in leaves])
    mouth, flags = _mouths(middles, cells, mouths)
    away = np.full(int(first.shape.prod()), int(first.shape.max()), dtype=np.int32)
    away[first.keys] = 0
    spread(away, first.shape)
    bricks = -away
    bricks[first.keys] = np.arange(len(first.places))
    steep = steepest(values, first.cell / cells, mouth, flags, 0.0)
    x0, y0, z0 = (float(corner) for corner in first.corner)
    nx, ny, nz = (int(count) for count in first.shape)
    return SheetArrays(
        bricks=bricks,
        tree=tree,
        values=values,
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
        steep=float(STEEPER * max(1.0, steep)),
    )


def _tree(levels: list[Level]) -> NDArray[np.int32]:
    """Entries of the first level's bricks in their order, and then eight for each divided one."""
    entries = [np.arange(len(levels[0].places))]
    total = len(entries[0])
    for level, below in pairwise(levels):
        parents = np.flatnonzero(level.finer)
        begin = np.zeros(len(level.places), dtype=np.int64)
        begin[parents] = total + 8 * np.arange(len(parents))
        octant = below.places % 2 @ np.array([4, 2, 1])
        entries.append(begin[level.at(below.places // 2)] + octant)
        total += 8 * len(parents)
    tree = np.zeros(total, dtype=np.int32)
    count = 0
    for depth, level in enumerate(levels):
        leaves = np.flatnonzero(~level.finer)
        tree[entries[depth][leaves]] = count + np.arange(len(leaves))
        count += len(leaves)
        if depth + 1 < len(levels):
            below = levels[depth + 1]
            whole = np.flatnonzero((below.places % 2 == 0).all(axis=1))
            up = level.at(below.places[whole] // 2)
            tree[entries[depth][up]] = -1 - entries[depth + 1][whole]
    return tree


def _mouths(
    middles: Array, cells: Array, mouths: Mouths
) -> tuple[NDArray[np.int32], NDArray[np.int16]]:
    """The mouth that each cell is in: whose wall is nearest, or whose rim."""
    edges, count = BRICK * cells, BRICK**3
    flags = np.full((len(middles), count), -1, dtype=np.int16)
    cube = np.stack(np.meshgrid(*[np.arange(BRICK)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    inner = (cube + 0.5) / BRICK - 0.5
    found = nearest(mouths.tree, middles)
    for end in range(len(mouths.ends)):
        past, _ = mouths.past(end, middles)
        near, off = mouths.past(end, found.points)
        may = (past > -edges) & (near > -2.0 * edges) & (off < mouths.widest[end] + 2.0 * edges)
        rows = np.flatnonzero(may)
        if len(rows) == 0:
            continue
        points = (middles[rows][:, None, :] + edges[rows][:, None, None] * inner).reshape(-1, 3)
        size = np.repeat(cells[rows], count)
        mine = mouths.mine(end, nearest(mouths.tree, points).points, 2.0 * size)
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
