"""Which balls of a lumen matter in which voxel: the seeds of the queries in ``gap``."""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel

# Columns of the samples: ball's centre and radius, arc parameter, branch.
X, Y, Z, RADIUS, ARC, BRANCH = 0, 1, 2, 3, 4, 5
DENSITY = 4.0  # samples per radius of arc length
ROUGHNESS = 0.5 / DENSITY  # how far below the true maximum a sampled one may be, over the radius
SHOULDER = 0.5  # the same where another point of the voxel may have a second maximum
SPREAD = 3.0  # farthest distance between seeds on one flat ridge, over the radius


@kernel
def span(centre, reach, corner, cell, count):
    """First and one past the last voxel whose centre is within ``reach`` along one axis."""
    low = max(int((centre - reach - corner) / cell - 0.5), 0)
    high = min(int((centre + reach - corner) / cell + 0.5) + 1, count)
    return low, high


@kernel
def deepest(samples, corner, cell, shape, slack, best, near):
    """Largest R - |x - c| of the samples at each voxel's centre, and which voxels are near.

    Parameters
    ----------
    samples
        Balls, shape [n, 6]; columns as named at the top of this module.
    corner, cell, shape
        Lower corner [3] and edge length of the voxels, and their number [3].
    slack
        Half the diagonal of a voxel: the gap changes by no more within it.
    best, near
        Out, shape [voxels]: largest value, and 1 where a ball's wall is at most its radius away;
        2 around open ends is there before.
    """
    for j in range(len(samples)):
        radius = samples[j, RADIUS]
        rough = ROUGHNESS * radius
        reach = 2.0 * radius + 3.0 * slack + 2.0 * rough
        low_x, high_x = span(samples[j, X], reach, corner[0], cell, shape[0])
        low_y, high_y = span(samples[j, Y], reach, corner[1], cell, shape[1])
        low_z, high_z = span(samples[j, Z], reach, corner[2], cell, shape[2])
        for a in range(low_x, high_x):
            dx = corner[0] + (a + 0.5) * cell - samples[j, X]
            for b in range(low_y, high_y):
                dy = corner[1] + (b + 0.5) * cell - samples[j, Y]
                for c in range(low_z, high_z):
                    dz = corner[2] + (c + 0.5) * cell - samples[j, Z]
                    value = radius - sqrt(dx * dx + dy * dy + dz * dz)
                    index = (a * shape[1] + b) * shape[2] + c
                    best[index] = max(best[index], value)
                    if near[index] == 0 and value + slack + rough >= -radius:
                        near[index] = 1


@kernel
def ridges(samples, corner, cell, shape, slack, blend, best, near, state, out):
    """Samples that may lead to the largest gap somewhere in a voxel.

    They are the local maxima along the branch of R - |x - c| at the voxel's centre that come
    within 2 ``slack`` + ``blend`` of the best one, and further ones where the slope at the centre
    is so small that elsewhere in the voxel it may vanish: a point that moves by ``slack`` turns
    the direction to the ball's centre by ``slack`` over its distance, and the slope by no more.
    Around open ends all within a radius of a wall count: the space past an end is free only
    where no other part of the lumen is near.

    Parameters
    ----------
    samples, corner, cell, shape, slack, best, near
        As of ``deepest``.
    blend
        How far below the best one a branch may be and still be felt where branches blend.
    state
        Scratch, shape [voxels, 4]: last sample seen (-1 at first), its value, whether it climbs,
        arc parameter of the last seed.
    out
        Voxel and sample of each seed, shape [n, 2]; no more than its length is written.

    Returns
    -------
    Number of seeds found.
    """
    count = 0
    for j in range(len(samples)):
        radius = samples[j, RADIUS]
        rough = ROUGHNESS * radius
        reach = 2.0 * radius + 3.0 * slack + 2.0 * rough
        low_x, high_x = span(samples[j, X], reach, corner[0], cell, shape[0])
        low_y, high_y = span(samples[j, Y], reach, corner[1], cell, shape[1])
        low_z, high_z = span(samples[j, Z], reach, corner[2], cell, shape[2])
        for a in range(low_x, high_x):
            dx = corner[0] + (a + 0.5) * cell - samples[j, X]
            for b in range(low_y, high_y):
                dy = corner[1] + (b + 0.5) * cell - samples[j, Y]
                for c in range(low_z, high_z):
                    index = (a * shape[1] + b) * shape[2] + c
                    if near[index] == 0:
                        continue
                    dz = corner[2] + (c + 0.5) * cell - samples[j, Z]
                    value = radius - sqrt(dx * dx + dy * dy + dz * dz)
                    least = best[index] - 2.0 * slack - rough - blend
                    if near[index] == 2:
                        least = min(least, -radius - slack - rough)
                    if value < least:
                        continue
                    count = visit(samples, j, value, slack, index, state, out, count)
    for index in range(len(state)):
        if state[index, 0] >= 0.0 and state[index, 2] > 0.0:
            count = emit(index, int(state[index, 0]), out, count)
    return count


@kernel
def visit(samples, j, value, slack, index, state, out, count):
    """Follow the ridge of a voxel from its last sample to sample ``j``; see ``ridges``."""
    last = int(state[index, 0])
    if last != j - 1 or samples[last, BRANCH] != samples[j, BRANCH]:
        if last >= 0 and state[index, 2] > 0.0:
            count = emit(index, last, out, count)
        state[index, 2] = 1.0
        state[index, 3] = samples[j, ARC]
    elif value < state[index, 1] and state[index, 2] > 0.0:
        count = emit(index, last, out, count)
        state[index, 2] = 0.0
        state[index, 3] = samples[last, ARC]
    elif value > state[index, 1]:
        state[index, 2] = 1.0
    flat = False
    if last == j - 1:
        rise = abs(value - state[index, 1]) / (samples[j, ARC] - samples[last, ARC])
        flat = rise * (samples[j, RADIUS] - value - slack) < slack
    if samples[j, ARC] - state[index, 3] > (SHOULDER if flat else SPREAD) * samples[j, RADIUS]:
        count = emit(index, j, out, count)
        state[index, 3] = samples[j, ARC]
    state[index, 0] = j
    state[index, 1] = value
    return count


@kernel
def emit(index, sample, out, count):
    """Write one seed if there is room."""
    if count < len(out):
        out[count, 0] = index
        out[count, 1] = sample
    return count + 1


@kernel
def spread(away, shape):
    """How many voxels each voxel is from the nearest that holds a zero, diagonals counting one.

    Two sweeps, there and back, each looking at the half of the neighbours that it has passed.

    Parameters
    ----------
    away
        Zero, or a number larger than any that can come out, shape [voxels]; changed in place.
    shape
        Number of voxels [3].
    """
    for sweep in (1, -1):
        for index in range(len(away)):
            here = index if sweep == 1 else len(away) - 1 - index
            a, rest = here // (shape[1] * shape[2]), here % (shape[1] * shape[2])
            b, c = rest // shape[2], rest % shape[2]
            least = away[here]
            for i in range(max(a - 1, 0), min(a + 2, shape[0])):
                for j in range(max(b - 1, 0), min(b + 2, shape[1])):
                    for k in range(max(c - 1, 0), min(c + 2, shape[2])):
                        there = (i * shape[1] + j) * shape[2] + k
                        if sweep * (there - here) < 0:
                            least = min(least, away[there] + 1)
            away[here] = least
