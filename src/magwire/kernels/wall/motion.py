"""A wall that moves: the displacement of the tissue at a point and a time (P-40).

A point x of the moved lumen is where the point X = x - u(x, t) of the lumen at rest has gone. Gaps
are those at X: the wall moves as the tissue does. u is a sum of displacements that rise from none
at the entrance, where the guide is, to their full size at a distance, and go to and fro in time.
"""

from __future__ import annotations

from math import inf, pi, sin

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import sym_add, sym_identity, sym_outer, sym_pair
from magwire.kernels.vectors import add, combine, dot, norm, row, scale, sub

PASSES = 100  # of the fixed point that ``carried`` is: each halves the error at least
ROUND_OFF = 1e-16


@kernel
def rise(share):
    """A rise from 0 to 1 over a share of the way, and its first and second derivatives."""
    if share >= 1.0:
        return 1.0, 0.0, 0.0
    rest = 1.0 - share
    value = share * share * share * (10.0 + share * (6.0 * share - 15.0))
    return value, 30.0 * (share * rest) ** 2, 60.0 * share * rest * (rest - share)


@kernel
def displacement(moving, factors, x):
    """Displacement of the tissue that is at x; factors [m]: part of each that there is."""
    r = norm(sub(x, row(moving.origin, 0)))
    u = (0.0, 0.0, 0.0)
    for k in range(factors.shape[0]):
        value, _, _ = rise(r / moving.ramp[k])
        u = combine(1.0, u, factors[k] * value, row(moving.amplitude, k))
    return u


@kernel
def at_rest(movings, x, y, z):
    """Where the tissue that is at a point is at rest."""
    if len(movings) == 0:
        return x, y, z
    else:
        u = displacement(movings[0], movings[0].now, (x, y, z))
        return x - u[0], y - u[1], z - u[2]


@kernel
def moved_jet(movings, x, y, z, n, h):
    """Gradient and Hessian of a gap by the point, from those by where it is at rest.

    X moves by (1 - b e^T) dx, with e from the entrance to the point.
    """
    if len(movings) == 0:
        return n, h
    else:
        moving = movings[0]
        e = sub((x, y, z), row(moving.origin, 0))
        r = norm(e)
        if r == 0.0:
            return n, h
        e = scale(1.0 / r, e)
        b, once, twice = (0.0, 0.0, 0.0), 0.0, 0.0
        for k in range(moving.now.shape[0]):
            per_ramp = 1.0 / moving.ramp[k]
            _, first, second = rise(r * per_ramp)
            a = row(moving.amplitude, k)
            b = combine(1.0, b, moving.now[k] * first * per_ramp, a)
            along = moving.now[k] * per_ramp * dot(a, n)
            once += along * first / r
            twice += along * second * per_ramp
        hb = (
            h[0] * b[0] + h[1] * b[1] + h[2] * b[2],
            h[1] * b[0] + h[3] * b[1] + h[4] * b[2],
            h[2] * b[0] + h[4] * b[1] + h[5] * b[2],
        )
        bent = sym_add(h, sym_pair(-1.0, hb, e))
        bent = sym_add(bent, sym_outer(dot(b, hb) - twice + once, e))
        return combine(1.0, n, -dot(b, n), e), sym_add(bent, sym_identity(-once))


@kernel
def pace(movings):
    """How much farther than a point of space the tissue may move that is there, at most."""
    if len(movings) == 0:
        return 1.0
    else:
        return movings[0].pace


@kernel
def found_from(moving, factors, x):
    """Where the tissue is, at some factors of the displacements, that is at rest at x."""
    there = x
    for _ in range(PASSES):
        ahead = add(x, displacement(moving, factors, there))
        away = norm(sub(ahead, there))
        there = ahead
        if away <= ROUND_OFF * (1.0 + norm(x)):
            break
    return there


@kernel
def taken(moving, start, end, x):
    """Where the tissue is at some factors that was at x at others."""
    return found_from(moving, end, sub(x, displacement(moving, start, x)))


@kernel
def carried(movings, x):
    """Where the tissue is now that was at a point before the step."""
    if len(movings) == 0:
        return x
    else:
        return taken(movings[0], movings[0].before, movings[0].now, x)


@kernel
def came_from(movings, x):
    """Where the tissue was before the step that is at a point now."""
    if len(movings) == 0:
        return x
    else:
        return taken(movings[0], movings[0].now, movings[0].before, x)


@kernel
def factor_at_time(rate, time):
    """Part of a displacement that there is at a time: it goes and comes back once a period."""
    half = sin(pi * rate * time)
    return half * half


@kernel
def forget(wall):
    """Forget what is known of the gap: a wall that has moved is another."""
    for i in range(wall.known.shape[0]):
        for c in range(4):
            wall.known[i, c] = -inf
    between = wall.between
    for j in range(between.clear.shape[0]):
        between.clear[j, 6] = -inf
        for k in range(between.known.shape[1]):
            for c in range(4):
                between.known[j, k, c] = -inf


@kernel
def move_wall(movings, wall, before, now):
    """Move the wall from where it is at one time to where it is at another, if it moves."""
    if len(movings) > 0:
        moving = movings[0]
        for k in range(moving.rate.shape[0]):
            moving.before[k] = factor_at_time(moving.rate[k], before)
            moving.now[k] = factor_at_time(moving.rate[k], now)
        forget(wall)


@kernel
def carry(movings, state, held):
    """Carry the free nodes along with the tissue around them, from before the step to now."""
    if len(movings) > 0:
        for i in range(held + 1, state.q.shape[0]):
            there = carried(movings, row(state.q, i))
            for c in range(3):
                state.q[i, c] = there[c]


@kernel
def less_carried(movings, before, ahead, held, step):
    """Take off a step's way that of the nodes that have been carried already."""
    if len(movings) > 0:
        for i in range(held + 1, ahead.q.shape[0]):
            for c in range(3):
                step[4 * (i - held + 1) + c] -= ahead.q[i, c] - before.q[i, c]


@kernel
def displacement_at(movings, x):
    """Displacement now of the tissue that is at x."""
    if len(movings) == 0:
        return (0.0, 0.0, 0.0)
    else:
        return displacement(movings[0], movings[0].now, x)
