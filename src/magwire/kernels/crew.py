"""Many bodies in one call: each thread takes one after the other until all are done.

The bodies are given by the addresses of their parts. No reference is counted on the way: two
threads that count references to the same lumen would wait for each other at every step. Who calls
keeps the bodies alive.
"""

from __future__ import annotations

from math import ceil, isfinite
from typing import NamedTuple

from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numpy import int64

from magwire.kernels._handle import parts_at, parts_of
from magwire.kernels._jit import entry, kernel, part
from magwire.kernels.arrays import Array, Index
from magwire.kernels.glance import GLANCE, glance
from magwire.kernels.march import Drive, march
from magwire.kernels.vectors import row
from magwire.kernels.wall.gap import balls_value, gap_value
from magwire.kernels.wall.motion import at_rest
from magwire.kernels.wall.push import asked_at

SEEN = GLANCE + 3
"""Numbers that are seen of a wire: a glance, then the arc parameter of the tip on the way to the
target and the gap there, nan where no voxel holds it, and the branch that the tip is in."""


class Orders(NamedTuple):
    """What n bodies are to do, and what came of it.

    places [n] addresses of the bodies' parts; counts [n] steps of each, -1 to leave one alone;
    feed, twist [n, k], inputs [n, k, m], time_step, damping [n] of their drives; patch [n], turn
    [n, 2] as in ``glance``; done, status [n] as ``march`` returns them; seen [n, SEEN]; guide
    [n, 2] and held [n, m]: where guide and inputs are in the end; next [1]: whose turn it is.
    """

    places: Index
    counts: Index
    feed: Array
    twist: Array
    inputs: Array
    time_step: Array
    damping: Array
    patch: Array
    turn: Array
    done: Index
    status: Index
    seen: Array
    guide: Array
    held: Array
    next: Index


@intrinsic
def take_number(context, counter):
    """The number in counter[0], which is one more for whoever asks next, in whichever thread."""

    def codegen(context, builder, signature, args):
        values = context.make_array(signature.args[0])(context, builder, args[0])
        one = ir.Constant(ir.IntType(64), 1)
        return builder.atomic_rmw("add", values.data, one, "monotonic")

    return types.int64(counter), codegen


@kernel
def branch_at(sheets, lumen, x, known, jet):
    """Branch of a point, which is remembered if the gap was asked for there; see ``push.query``."""
    if len(sheets) == 0 and asked_at(x, known):
        return int64(jet[11])
    rest = at_rest(lumen.moving, x[0], x[1], x[2])
    return int64(balls_value(lumen, rest[0], rest[1], rest[2])[2])


@kernel
def see(parts, work, patch, turn, seen):
    """Fill ``seen`` [SEEN] with what is seen of a wire, scaled."""
    wall, lumen = parts.model.wall, parts.model.lumen
    glance(parts.model, parts.state, work, patch, turn, seen)
    last = parts.state.q.shape[0] - 1
    tip = row(parts.state.q, last)
    g, s, _, _ = gap_value(parts.path, tip[0], tip[1], tip[2])
    seen[GLANCE], seen[GLANCE + 1] = s, g
    seen[GLANCE + 2] = branch_at(lumen.sheet, lumen, tip, wall.known[last], wall.jet[last])


@part
def room_of(hand, parts):
    """A workspace: the hand's, which is in the processor's cache, or a body's own if it is larger.

    Or smaller, or has other inputs.
    """
    same = hand.work.gradient.shape[0] == parts.work.gradient.shape[0]
    if same and hand.work.inputs.shape[0] == parts.work.inputs.shape[0]:
        return hand.work
    return parts.work


@kernel
def work_off(hand, orders, inertia):
    """Carry out orders until none is left; hand: parts with a workspace for this thread alone."""
    while True:
        i = take_number(orders.next)
        if i >= orders.places.shape[0]:
            return
        count = orders.counts[i]
        if count < 0:
            continue
        p = parts_at(orders.places[i], hand)
        work = room_of(hand, p)
        drive = Drive(
            orders.feed[i, :count],
            orders.twist[i, :count],
            orders.inputs[i, :count],
            orders.time_step[i],
            orders.damping[i],
            inertia,
        )
        done, status = march(p.model, p.guide, p.state, work, p.limits, drive, p.tally)
        orders.done[i], orders.status[i] = done, status
        see(p, work, orders.patch[i], (orders.turn[i, 0], orders.turn[i, 1]), orders.seen[i])
        for c in range(2):
            orders.guide[i, c] = p.state.guide[c]
        for c in range(p.state.inputs.shape[0]):
            orders.held[i, c] = p.state.inputs[c]


@kernel
def count_steps(speed, rate, wanted, time, only, step, slack, counts):
    """Number of time steps of each wire's interval, -1 of a wire that stays as it is.

    Returns the largest; 0 if a number is not finite, -1 if an interval is not positive.
    """
    most = 1
    for i in range(time.shape[0]):
        if not isfinite(speed[i]) or not isfinite(rate[i]):
            return 0
        for c in range(wanted.shape[1]):
            if not isfinite(wanted[i, c]):
                return 0
    for i in range(time.shape[0]):
        if not (time[i] > 0.0 and isfinite(time[i])):
            return -1
        most = max(most, ceil(time[i] / step - slack))
        counts[i] = max(ceil(time[i] / step - slack), 1) if only[i] else -1
    return most


@kernel
def lay_out(speed, rate, wanted, time, step, slack, length, orders):
    """Feeds, angles and inputs at the end of every step; a linear course of inputs."""
    for i in range(time.shape[0]):
        orders.done[i] = orders.status[i] = 0
        count = max(ceil(time[i] / step - slack), 1)
        each, limit = time[i] / count, length[i]
        orders.time_step[i] = each
        feed, twist = orders.guide[i, 0] * limit, orders.guide[i, 1]
        for k in range(max(orders.counts[i], 0)):
            feed = min(max(feed + speed[i] * each, 0.0), limit)
            twist += rate[i] * each
            orders.feed[i, k], orders.twist[i, k] = feed / limit, twist
            for c in range(wanted.shape[1]):
                held = orders.held[i, c]
                course = held + (wanted[i, c] - held) * ((k + 1) / count)
                # It ends where it was told to, not within rounding of it.
                orders.inputs[i, k, c] = wanted[i, c] if k + 1 == count else course


@entry
def carry_out(hand, orders, inertia):
    """Carry out orders until none is left; threads may do so at once, each with a hand of its own.

    hand: a body like the others, of which the workspace is used.
    """
    work_off(parts_of(hand), orders, inertia)
