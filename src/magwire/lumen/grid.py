"""The voxel grid that tells a query where to start: built once per lumen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.centreline import (
    BEGIN,
    BLEND,
    COLUMNS,
    END,
    END_COSINE,
    END_OPEN,
    END_POINT,
    END_RADIUS,
    END_SLOPE,
    END_TANGENT,
    FIRST,
    PIECES,
    SPACING,
    LumenArrays,
    settle,
)
from magwire.kernels.wall.seeds import DENSITY, deepest, ridges, spread, valleys
from magwire.lumen.branch import Branch

Array = NDArray[np.float64]

VOXELS = 2_000_000  # at most; larger lumens get larger voxels
FINENESS = 0.5  # edge length of a voxel over the smallest radius
FINE = 16.0  # places per smallest radius where valleys are looked for, at least
SAME = 1e-4  # distance of settled seeds that are one, over the edge of a voxel
BLENDED = 2.0  # how far below the deepest branch one is still felt, in blends: three may blend


class _Voxels(NamedTuple):
    """Where the voxels are, half the diagonal of one, and how far around a wall they reach."""

    corner: Array
    cell: float
    shape: NDArray[np.int64]
    slack: float
    margin: float


NOWHERE = _Voxels(np.zeros(3), 1.0, np.zeros(3, dtype=np.int64), 0.0, 0.0)
NO_SEEDS = np.zeros((0, 3))
NOT_FORKED = np.zeros(0, dtype=bool)


def build(branches: Sequence[Branch]) -> LumenArrays:
    """Arrays of a lumen for the kernels, in metres."""
    table = _table(branches)
    if not branches:
        return _pack(np.zeros((0, 4, 4)), table)
    samples = np.concatenate([_samples(b, i) for i, b in enumerate(branches)])
    mouths = np.concatenate(
        [_mouth(row, i, end) for i, row in enumerate(table) for end in (BEGIN, END)]
    )
    voxels = _voxels(samples, mouths)
    size = int(voxels.shape.prod())
    best = np.full(size, -np.inf, dtype=np.float32)
    near = np.zeros(size, dtype=np.uint8)
    at_mouths = _mouth_seeds(mouths, table, voxels)
    near[at_mouths[:, 0].astype(np.int64)] = 2
    place = (voxels.corner, voxels.cell, voxels.shape, voxels.slack)
    deepest(samples, *place, best, near)
    felt = BLENDED * float(table[:, BLEND].max())
    found = _ridges(samples, place, felt, best, near)
    seeds = np.empty((len(found), 3))
    seeds[:, 0], seeds[:, 1:] = found[:, 0], samples[:, [5, 4]][found[:, 1]]
    at_valleys = _valley_seeds(branches, place, felt, best, near)
    seeds = np.concatenate([seeds, at_mouths, at_valleys])
    forked = np.arange(len(seeds)) >= len(seeds) - len(at_valleys)
    coefficients = np.concatenate([b.curve.coefficients for b in branches])
    return _pack(coefficients, table, voxels, *_thin(seeds, forked, float(samples[:, 3].min())))


def _table(branches: Sequence[Branch]) -> Array:
    """One row per branch, columns as named in ``kernels.wall.gap``."""
    table = np.zeros((len(branches), COLUMNS))
    first = 0
    for row, branch in zip(table, branches, strict=True):
        curve = branch.curve
        row[SPACING], row[FIRST], row[PIECES] = curve.spacing, first, len(curve.coefficients)
        row[BLEND] = branch.blend
        first += len(curve.coefficients)
        ends = np.array([0.0, curve.length])
        points, slopes = curve.at(ends), curve.at(ends, 1)
        for i, (at, is_open) in enumerate(((BEGIN, branch.open_begin), (END, branch.open_end))):
            outward = slopes[i] * (1 if at == END else -1) / np.linalg.norm(slopes[i, :3])
            row[at + END_POINT : at + END_POINT + 3] = points[i, :3]
            row[at + END_TANGENT : at + END_TANGENT + 3] = outward[:3]
            row[at + END_RADIUS], row[at + END_SLOPE] = points[i, 3], outward[3]
            row[at + END_COSINE] = np.sqrt(1.0 - outward[3] ** 2)
            row[at + END_OPEN] = float(is_open)
    return table


def _samples(branch: Branch, index: int) -> Array:
    """Balls of a branch, denser where it is narrow: columns as named in ``kernels.wall.seeds``."""
    curve = branch.curve
    knots = np.linspace(0.0, curve.length, 2 * len(curve.coefficients) + 1)
    pace = DENSITY / curve.at(knots)[:, 3]
    progress = np.concatenate([[0.0], np.cumsum(0.5 * (pace[1:] + pace[:-1]) * np.diff(knots))])
    count = max(2, int(np.ceil(progress[-1])) + 1)
    s = np.interp(np.linspace(0.0, progress[-1], count), progress, knots)
    return np.column_stack([curve.at(s), s, np.full(count, float(index))])


def _mouth(row: Array, index: int, at: int) -> Array:
    """Balls that cover the flared wall past an open end, as samples at the end."""
    if not row[at + END_OPEN]:
        return np.zeros((0, 6))
    past = np.linspace(0.0, 1.0, int(DENSITY) + 1)[:, None]
    radius = row[at + END_RADIUS]
    tangent = row[at + END_TANGENT : at + END_TANGENT + 3]
    points = row[at + END_POINT : at + END_POINT + 3] + past * radius * tangent
    flared = radius * (1.0 + max(row[at + END_SLOPE], 0.0) * past + past**3)
    arc = 0.0 if at == BEGIN else row[SPACING] * row[PIECES]
    rest = np.tile([arc, float(index)], (len(past), 1))
    return np.column_stack([points, flared, rest])


def _voxels(samples: Array, mouths: Array) -> _Voxels:
    """Voxels that cover every ball and as much again around it."""
    balls = np.concatenate([samples, mouths])
    reach = 2.5 * balls[:, 3:4]
    low, high = (balls[:, :3] - reach).min(axis=0), (balls[:, :3] + reach).max(axis=0)
    cell = max(
        FINENESS * float(samples[:, 3].min()), float(np.prod(high - low) / VOXELS) ** (1.0 / 3.0)
    )
    shape = np.ceil((high - low) / cell).astype(np.int64)
    corner = 0.5 * (low + high - cell * shape)
    return _Voxels(
        corner, cell, shape, 0.5 * float(np.sqrt(3.0)) * cell, float(samples[:, 3].min())
    )


def _ridges(
    samples: Array,
    place: tuple[Array, float, NDArray[np.int64], float],
    blend: float,
    best: NDArray[np.float32],
    near: NDArray[np.uint8],
) -> NDArray[np.int64]:
    """Voxel and sample of each seed, shape (n, 2)."""
    found = np.empty((8 * int(near.sum()) + 1024, 2), dtype=np.int64)
    while True:
        state = np.zeros((len(best), 4), dtype=np.float32)
        state[:, 0] = -1.0
        count = ridges(samples, *place, blend, best, near, state, found)
        if count <= len(found):
            return found[:count]
        found = np.empty((count, 2), dtype=np.int64)


def _mouth_seeds(mouths: Array, table: Array, voxels: _Voxels) -> Array:
    """Seeds at the open ends for the voxels around their flared walls: voxel, branch, arc."""
    parts = [np.zeros((0, 3))]
    for x, y, z, radius, arc, branch in mouths:
        row = table[int(branch)]
        at = BEGIN if arc == 0.0 else END
        reach = radius + row[at + END_RADIUS] + voxels.slack
        centre = np.array([x, y, z])
        low = np.maximum(((centre - reach - voxels.corner) / voxels.cell).astype(np.int64), 0)
        high = ((centre + reach - voxels.corner) / voxels.cell).astype(np.int64) + 1
        axes = [np.arange(a, b) for a, b in zip(low, np.minimum(high, voxels.shape), strict=True)]
        index = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        middle = voxels.corner + (index + 0.5) * voxels.cell - centre
        past = (middle + centre - row[at + END_POINT : at + END_POINT + 3]) @ row[
            at + END_TANGENT : at + END_TANGENT + 3
        ]
        inside = (np.linalg.norm(middle, axis=1) <= reach) & (past >= -voxels.slack)
        flat = np.ravel_multi_index(tuple(index[inside].T), tuple(voxels.shape)).astype(float)
        parts.append(np.column_stack([flat, np.full(len(flat), branch), np.full(len(flat), arc)]))
    return np.concatenate(parts)


def _valley_seeds(
    branches: Sequence[Branch],
    place: tuple[Array, float, NDArray[np.int64], float],
    blend: float,
    best: NDArray[np.float32],
    near: NDArray[np.uint8],
) -> Array:
    """Seeds on both sides of valleys, where there are any: voxel, branch, arc."""
    places = np.concatenate([_places(b, i, 4.0 * place[3]) for i, b in enumerate(branches)])
    if len(places) == 0:
        return NO_SEEDS
    found = np.empty((64 * len(places) + 1024, 2), dtype=np.int64)
    while True:
        state = np.full(len(best), -1, dtype=np.int64)
        count = valleys(places, *place, blend, best, near, state, found)
        if count <= len(found):
            where = places[found[:count, 1]][:, [13, 12]]
            seeds: Array = np.column_stack([found[:count, 0], where])
            return seeds
        found = np.empty((count, 2), dtype=np.int64)


def _places(branch: Branch, index: int, beyond: float) -> Array:
    """Places of a branch where ``in_valley`` may hold, and the ones next to them.

    None of a tube that does not bend much and has the same radius everywhere. Columns as named in
    ``kernels.wall.seeds``; ``beyond`` is added to the distance of two radii up to which it counts.
    """
    curve = branch.curve
    narrowest = float(curve.at(curve.knots())[:, 3].min())
    parts = int(np.ceil(FINE * curve.spacing / narrowest))
    s = np.linspace(0.0, curve.length, parts * len(curve.coefficients) + 1)
    ball, first, second = curve.at(s), curve.at(s, 1), curve.at(s, 2)
    bend = np.linalg.norm(second[:, :3], axis=1) + np.maximum(second[:, 3], 0.0)
    may = (2.0 * ball[:, 3] + beyond) * bend >= 1.0 - first[:, 3] ** 2
    may = may | np.append(may[1:], False) | np.append(False, may[:-1])
    rest = np.tile([float(index), s[1]], (len(s), 1))
    places: Array = np.column_stack([ball, first, second, s, rest])[may]
    return places


def _thin(
    seeds: Array, forked: NDArray[np.bool_], narrowest: float
) -> tuple[Array, NDArray[np.bool_]]:
    """Seeds by voxel, branch and arc, without those close to another.

    Those at a valley, ``forked``, all stay: two maxima may be as close as one likes.
    """
    voxel, branch = seeds[:, 0].astype(np.int64), seeds[:, 1].astype(np.int64)
    key = voxel * (1 + branch.max(initial=0)) + branch
    bits = 61 - int(key.max(initial=0)).bit_length()  # left for the arc: one sort, not of three
    longest = float(seeds[:, 2].max(initial=0.0)) or 1.0
    arc = (seeds[:, 2] * ((2.0**bits - 1.0) / longest)).astype(np.int64)
    order = np.argsort((((key << bits) + arc) << 1) + forked)
    forked, key = forked[order], key[order]
    close = (key[1:] == key[:-1]) & (np.diff(seeds[order, 2]) < 0.5 * narrowest)
    dropped = np.concatenate([[False], close]) | np.concatenate([close & forked[1:], [False]])
    kept = forked | ~dropped
    return seeds[order[kept]], forked[kept]


def _pack(
    coefficients: Array,
    table: Array,
    voxels: _Voxels = NOWHERE,
    seeds: Array = NO_SEEDS,
    forked: NDArray[np.bool_] = NOT_FORKED,
) -> LumenArrays:
    """The arrays as the kernels take them."""
    voxel, branch = seeds[:, 0].astype(np.int64), seeds[:, 1].astype(np.int32)
    settled = np.zeros((len(seeds), 4))
    settled[:, 0] = seeds[:, 2]
    if len(seeds) > 0:
        alone = np.flatnonzero(~forked)  # at a valley the centre's maximum may not be the point's
        place = np.unravel_index(voxel[alone], tuple(voxels.shape))
        middles = voxels.corner + (np.stack(place, axis=1) + 0.5) * voxels.cell
        found = settled[alone]
        settle(coefficients, table, branch[alone], middles, voxels.slack, found)
        settled[alone] = found
        same = ~forked[1:] & (voxel[1:] == voxel[:-1]) & (branch[1:] == branch[:-1])
        same &= np.abs(np.diff(settled[:, 0])) < SAME * voxels.cell
        kept = np.concatenate([[True], ~same])
        voxel, branch, settled = voxel[kept], branch[kept], settled[kept]
    start = np.flatnonzero(np.diff(voxel, prepend=-1))
    voxel, last = voxel[start], np.append(start, len(settled))[1:] - 1
    branch[last] = -1 - branch[last]
    x0, y0, z0 = (float(corner) for corner in voxels.corner)
    nx, ny, nz = (int(count) for count in voxels.shape)
    return LumenArrays(
        coefficients=coefficients,
        branches=table,
        cells=_cells(voxels, voxel, start),
        seeds=settled,
        seed_branch=branch,
        x0=x0,
        y0=y0,
        z0=z0,
        cell=voxels.cell,
        nx=nx,
        ny=ny,
        nz=nz,
        margin=voxels.margin,
    )


def _cells(
    voxels: _Voxels, voxel: NDArray[np.int64], start: NDArray[np.int64]
) -> NDArray[np.int32]:
    """First seed of each voxel, or minus the number of voxels to the nearest one with seeds."""
    away = np.full(int(voxels.shape.prod()), int(voxels.shape.max()), dtype=np.int32)
    if len(voxel) == 0:
        return np.ones_like(away)
    away[voxel] = 0
    spread(away, voxels.shape)
    cells = -away
    cells[voxel] = start
    return cells


def scaled(arrays: LumenArrays, length_scale: float) -> LumenArrays:
    """The same lumen in units of ``length_scale`` [m]."""
    powers = length_scale ** np.arange(-1.0, 3.0)
    branches = arrays.branches.copy()
    branches[:, [SPACING, BLEND]] /= length_scale
    for at in (BEGIN, END):
        branches[:, at + END_POINT : at + END_POINT + 3] /= length_scale
        branches[:, at + END_RADIUS] /= length_scale
    return arrays._replace(
        coefficients=arrays.coefficients * powers[:, None],
        branches=branches,
        seeds=arrays.seeds / np.array([length_scale, 1.0, 1.0, 1.0]),
        x0=arrays.x0 / length_scale,
        y0=arrays.y0 / length_scale,
        z0=arrays.z0 / length_scale,
        cell=arrays.cell / length_scale,
        margin=arrays.margin / length_scale,
    )
