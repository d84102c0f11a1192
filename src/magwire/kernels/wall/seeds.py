"""Which balls of a lumen matter in which voxel: the seeds of the queries in ``gap``."""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import dot, norm

# Columns of the samples: ball's centre and radius, arc parameter, branch.
X, Y, Z, RADIUS, ARC, BRANCH = 0, 1, 2, 3, 4, 5
DENSITY = 4.0  # samples per radius of arc length
ROUGHNESS = 0.5 / DENSITY  # how far below the true maximum a sampled one may be, over the radius
SHOULDER = 0.5  # the same where another point of the voxel may have a second maximum
SPREAD = 3.0  # farthest distance between seeds on one flat ridge, over the radius
# Columns of the places where a valley may be: centre and radius as above, their first and second
# derivatives by the arc parameter, the arc parameter, branch, and the distance to the next place.
FIRST, SECOND, PLACE, BRANCH_OF, STEP = 4, 8, 12, 13, 14


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
                    if value < least(best[index], near[index], radius, slack, blend):
                        continue
                    count = visit(samples, j, value, slack, index, state, out, count)
    for index in range(len(state)):
        if state[index, 0] >= 0.0 and state[index, 2] > 0.0:
            count = emit(index, int(state[index, 0]), out, count)
    return count


@kernel
def least(best, near, radius, slack, blend):
    """Smallest R - |x - c| at a voxel's centre of a ball that may matter somewhere in the voxel."""
    rough = ROUGHNESS * radius
    value = best - 2.0 * slack - rough - blend
    return min(value, -radius - slack - rough) if near == 2 else value


@kernel
def valleys(places, corner, cell, shape, slack, blend, best, near, state, out):
    """Seeds on both sides of each valley that R - |x - c| may have somewhere in a voxel.

    Between two maxima along a branch there is a valley: F = (x - c).c' + R' |x - c| vanishes, and
    its derivative is not negative. F moves by 1 + |R'| times as much as the point, and where it
    vanishes, its derivative (x - c).c'' - |c'|^2 + R'' |x - c| + R'^2 by |c'' + R'' n| times as
    much. Maxima may be anywhere close to the valley, and come and go as the point moves: no
    seed of another maximum replaces these.

    Parameters
    ----------
    places
        Shape [n, 15]; columns as named at the top of this module.
    corner, cell, shape, slack, blend, best, near
        As of ``ridges``.
    state
        Scratch, shape [voxels]: last place that may be in a valley, -1 at first.
    out
        Voxel and place of each seed, shape [n, 2]; no more than its length is written.

    Returns
    -------
    Number of seeds found.
    """
    count = 0
    for j in range(len(places)):
        radius = places[j, RADIUS]
        reach = 2.0 * radius + 3.0 * slack + 2.0 * ROUGHNESS * radius
        low_x, high_x = span(places[j, X], reach, corner[0], cell, shape[0])
        low_y, high_y = span(places[j, Y], reach, corner[1], cell, shape[1])
        low_z, high_z = span(places[j, Z], reach, corner[2], cell, shape[2])
        for a in range(low_x, high_x):
            dx = corner[0] + (a + 0.5) * cell - places[j, X]
            for b in range(low_y, high_y):
                dy = corner[1] + (b + 0.5) * cell - places[j, Y]
                for c in range(low_z, high_z):
                    index = (a * shape[1] + b) * shape[2] + c
                    if near[index] == 0:
                        continue
                    dz = corner[2] + (c + 0.5) * cell - places[j, Z]
                    value = radius - sqrt(dx * dx + dy * dy + dz * dz)
                    if value < least(best[index], near[index], radius, slack, blend):
                        continue
                    if in_valley(places[j], (dx, dy, dz), slack):
                        count = follow(places, j, index, state, out, count)
    for index in range(len(state)):
        if state[index] >= 0:
            count = emit(index, after(places, state[index]), out, count)
    return count


@kernel
def in_valley(place, p, slack):
    """Whether a place may be the bottom of a valley for a point at most ``slack`` from c + p."""
    c1 = (place[FIRST], place[FIRST + 1], place[FIRST + 2])
    c2 = (place[SECOND], place[SECOND + 1], place[SECOND + 2])
    radius1, radius2 = place[FIRST + 3], place[SECOND + 3]
    distance = norm(p)
    ascent = dot(p, c1) + radius1 * distance
    slope = dot(p, c2) - dot(c1, c1) + radius2 * distance + radius1 * radius1
    turn = slack * (norm(c2) + abs(radius2))
    within = slack * (1.0 + abs(radius1)) + place[STEP] * (abs(slope) + turn)
    return slope + turn >= 0.0 and abs(ascent) <= within


@kernel
def follow(places, j, index, state, out, count):
    """Go on in a valley of a voxel to place ``j``, or leave one and enter the next."""
    last = state[index]
    state[index] = j
    if last >= 0 and last == j - 1 and adjacent(places, last):
        return count
    if last >= 0:
        count = emit(index, after(places, last), out, count)
    return emit(index, before(places, j), out, count)


@kernel
def before(places, j):
    """The place before, or the same if the branch begins there."""
    return j - 1 if j > 0 and adjacent(places, j - 1) else j


@kernel
def after(places, j):
    """The next place, or the same if the branch ends there."""
    return j + 1 if j + 1 < len(places) and adjacent(places, j) else j


@kernel
def adjacent(places, j):
    """Whether the place past ``j`` is the next one on the same branch."""
    apart = places[j + 1, PLACE] - places[j, PLACE]
    return places[j + 1, BRANCH_OF] == places[j, BRANCH_OF] and apart < 1.5 * places[j, STEP]


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
