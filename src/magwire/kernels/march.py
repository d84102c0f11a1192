"""Time steps one after the other, without leaving compiled code (P-14, P-15)."""

from __future__ import annotations

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from magwire.kernels._jit import kernel, part
from magwire.kernels.arrays import Array, Motion, Mouth
from magwire.kernels.assembly import clear
from magwire.kernels.frames import update_frames
from magwire.kernels.guide import change_held, find_mouth, place_held
from magwire.kernels.newton import CONVERGED, Limits, copy_state, newton, take_step
from magwire.kernels.scatter import add_vector
from magwire.kernels.vectors import dot, row
from magwire.kernels.wall.between import press_edge
from magwire.kernels.wall.collision import allowed_part
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.push import press
from magwire.kernels.wall.slide import slide

COARSE = 6  # a step may be cut in half this many times before its parts follow the wall
RETRIES = 10  # and this many times in all


class Plan(NamedTuple):
    """Feed and twist of the guide at every step's end, shape [steps + 1] each; time step [s].

    Without inertia the steps are equilibria one after the other (P-16). flux [steps + 1, 3]: flux
    density [T] on top of the field's samples at every step's end, none if it has no rows; steer
    [3]: how much of it the samples hold at the moment.
    """

    feed: Array
    twist: Array
    time_step: float
    damping: float
    inertia: bool
    flux: Array = np.zeros((0, 3))
    steer: Array = np.zeros(3)


class Tally(NamedTuple):
    """What a march adds up.

    counts: steps, Newton iterations, factorisations, retries. forces: largest tip force, sum of the
    tip forces of all steps, feed of the first contact (-1 before it).
    """

    counts: Array
    forces: Array


@part
def tip_force(model, state, held, work):
    """Size of the wall force on the tip node (P-13)."""
    rod, _, wall, lumen = model
    tip = state.q.shape[0] - 1
    clear(work.gradient, tip - 1, tip + 1)
    _, _, pushed, _ = press(rod, lumen, wall, row(state.q, tip), tip)
    add_vector(work.gradient, tip, 1.0, pushed)
    if held < tip:
        press_edge(rod, lumen, wall, state, tip - 1, work.gradient, work.no_band, 0)
    pushed = row(work.gradient, tip)
    return sqrt(dot(pushed, pushed))


@part
def predict(rod, lumen, wall, state, velocity, held, dt, work, slides):
    """Move the free unknowns on at their velocities, as far as no point crosses the wall."""
    for i in range(held - 1, state.q.shape[0]):
        for c in range(4):
            free = i > held or (i == held and c == 3)
            work.step[4 * (i - held + 1) + c] = dt * velocity[i, c] if free else 0.0
    share = allowed_part(rod, lumen, wall, state.q, work.step, held, 0.0)
    if slides and share < 1.0:
        slide(rod, lumen, wall, state.q, work.step, held, 1.0, work.way)
        take_step(state, work.trial, held, 1.0, work.way)
        energy, _ = add_walls(rod, lumen, wall, work.trial, held, work.gradient, work.no_band)
        way = allowed_part(rod, lumen, wall, state.q, work.way, held, wall.gap)
        if energy < inf and way == 1.0:
            copy_state(work.trial, state, held)
            return
    for i in range(held, state.q.shape[0]):
        for c in range(4):
            state.q[i, c] += share * work.step[4 * (i - held + 1) + c]


@part
def follow_tangents(state, velocity, held, speed):
    """Velocities of a wire that slides along itself: the guess of quasi-static steps."""
    last = state.q.shape[0] - 1
    for i in range(held, last + 1):
        velocity[i, 3] = 0.0
        for c in range(3):
            ahead = state.tangent[min(i, last - 1), c]
            velocity[i, c] = speed * 0.5 * (state.tangent[i - 1, c] + ahead)


@part
def time_step(model, guide, state, velocity, work, limits, slides, before, start, end, dt, plan):
    """One step into ``work.ahead`` (P-14, P-16); start, end: (feed, twist) of the guide.

    slides: whether the wire's way follows the wall where it meets it.
    ``state`` changes only in what is held; returns how Newton ended and the last held node.
    """
    rod, _, wall, lumen = model
    nodes = state.q.shape[0]
    held, fraction = find_mouth(rod, guide, end[0])
    drive = (start[0], start[1], (end[0] - start[0]) / dt, (end[1] - start[1]) / dt)
    change_held(rod, guide, state, velocity, before, held, drive)
    copy_state(state, work.ahead, held)
    if held == nodes - 1:
        place_held(rod, guide, work.ahead, 0, held, end[0], end[1])
        return (CONVERGED, 0, 0, 0.0, inf), held
    drag = 1.0 + plan.damping * dt
    if not plan.inertia:
        follow_tangents(state, velocity, held, drive[2])
    for i in range(held, nodes):
        for c in range(4):
            work.target[i, c] = state.q[i, c] + dt / drag * velocity[i, c]
    predict(rod, lumen, wall, work.ahead, velocity, held, dt, work, slides)
    place_held(rod, guide, work.ahead, held - 1, held, end[0], end[1])
    update_frames(state, work.ahead, held)
    motion = Motion(drag / (dt * dt) if plan.inertia else 0.0, work.target)
    mouth = Mouth(held, fraction)
    limits = Limits(
        limits.tolerance, limits.iterations, limits.shift, limits.step, limits.turn, slides
    )
    return newton(model, work.ahead, mouth, motion, work, limits), held


@part
def accept(state, velocity, work, held, dt):
    """Take over the step in ``work.ahead`` and its velocities."""
    for i in range(held, state.q.shape[0]):
        for c in range(4):
            velocity[i, c] = (work.ahead.q[i, c] - state.q[i, c]) / dt
    copy_state(work.ahead, state, held)


@kernel
def copy_rows(source, target):
    """Copy an array of rows of four."""
    for i in range(source.shape[0]):
        for c in range(4):
            target[i, c] = source[i, c]


@kernel
def steer_field(field, plan, k, share):
    """Bring the field's samples to what the plan wants at a part of step k."""
    for c in range(3):
        wanted = (1.0 - share) * plan.flux[k, c] + share * plan.flux[k + 1, c]
        change = wanted - plan.steer[c]
        if change != 0.0:
            for j in range(field.flux_density.shape[0]):
                field.flux_density[j, c] += change
            plan.steer[c] = wanted


@part
def cuts_by_feed(rod, plan, k):
    """How often step k is cut in half beforehand, so that no part feeds more than an edge."""
    fed = abs(plan.feed[k + 1] - plan.feed[k])
    edge = rod.rest[rod.rest.shape[0] - 1]
    cuts = 0
    while fed > edge:
        fed *= 0.5
        cuts += 1
    return cuts


@kernel
def march(model, guide, state, velocity, work, limits, plan, first, last, held, tally):
    """Time steps first ... last - 1.

    A step that would feed more than an edge is done in parts. One that fails is cut in half a
    bounded number of times; if that does not help, the state is left as it was before the step.

    Returns the steps done, the last held node and how the last step ended: plain numbers, since an
    interrupt that arrives here would break the making of any other object.
    """
    for k in range(first, last):
        entry = held
        begun = cuts_by_feed(model[0], plan, k)
        halvings = begun
        slides = False
        done = 0.0
        touches = False
        while done < 1.0:
            share = 0.5**halvings
            start, end = moment(plan, k, done), moment(plan, k, done + share)
            dt = share * plan.time_step
            if len(plan.flux) > 0:
                steer_field(model[1], plan, k, done + share)
            outcome, held = time_step(
                model, guide, state, velocity, work, limits, slides, held, start, end, dt, plan
            )
            status, iterations, factorisations, _, nearest = outcome
            tally.counts[1] += iterations
            tally.counts[2] += factorisations
            if status != CONVERGED:
                if done == 0.0:
                    copy_state(state, work.before, 1)
                    copy_rows(velocity, work.pace)
                if slides and halvings == begun + RETRIES:
                    copy_state(work.before, state, 1)
                    copy_rows(work.pace, velocity)
                    if len(plan.flux) > 0:
                        steer_field(model[1], plan, k, 0.0)
                    return k - first, entry, status
                if slides or halvings < begun + COARSE:
                    halvings += 1
                else:
                    slides = True
                tally.counts[3] += 1
                continue
            accept(state, velocity, work, held, dt)
            touches = touches or nearest < inf
            done += share
            if slides and halvings > begun and done % (2.0 * share) == 0.0:
                halvings -= 1
        tally.counts[0] += 1
        if touches:
            size = tip_force(model, state, held, work)
            tally.forces[0] = max(tally.forces[0], size)
            tally.forces[1] += size
            if tally.forces[2] < 0.0:
                tally.forces[2] = plan.feed[k + 1]
    return last - first, held, CONVERGED


@kernel
def moment(plan, k, part):
    """Feed and twist of the guide at a part of step k."""
    rest = 1.0 - part
    return (
        rest * plan.feed[k] + part * plan.feed[k + 1],
        rest * plan.twist[k] + part * plan.twist[k + 1],
    )
