"""Time steps one after the other, without leaving compiled code (P-14, P-15)."""

from __future__ import annotations

from math import inf, sqrt
from typing import NamedTuple

from magwire.kernels._jit import kernel, part
from magwire.kernels.arrays import Array, Motion, Mouth
from magwire.kernels.assembly import FIRST
from magwire.kernels.frames import update_frames
from magwire.kernels.guide import change_held, find_mouth, place_held
from magwire.kernels.history import copy_configuration, copy_state
from magwire.kernels.lanes import clear_rows, load, store
from magwire.kernels.newton import (
    CONVERGED,
    HALVINGS,
    TOO_MANY_ITERATIONS,
    Limits,
    newton,
    take_step,
)
from magwire.kernels.scatter import add_vector
from magwire.kernels.sources.steer import steer
from magwire.kernels.tube import within_tube
from magwire.kernels.vectors import dot, row
from magwire.kernels.wall.between import add_between, press_edge
from magwire.kernels.wall.collision import allowed_part
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.motion import carry, less_carried, move_wall
from magwire.kernels.wall.push import press
from magwire.kernels.wall.slide import slide
from magwire.kernels.wall.traction import begin, keep_contacts, reload
from magwire.kernels.wall.work import count_half

COARSE = 6  # a step may be cut in half this many times before its parts follow the wall
RETRIES = 10  # and this many times in all
SNAPPING = 10  # times as many iterations has a step without inertia under friction: it may snap
WHOLE = 0.99  # edges that a step feeds at least for the wire to follow itself
EAGER = 5  # after so many times they are changed by half: they may go to and fro for ever
LOADINGS = 60  # times that the normal forces of a step with friction are read off its end


class Drive(NamedTuple):
    """Where guide and actuator are at the ends of the next steps.

    feed, twist [k] insertion and twist of the guide; inputs [k, m] of the actuator; time_step [s];
    damping [1/s]; inertia: without it the steps are equilibria one after the other (P-16).
    """

    feed: Array
    twist: Array
    inputs: Array
    time_step: float
    damping: float
    inertia: bool


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
    rod, wall, lumen = model.rod, model.wall, model.lumen
    tip = state.q.shape[0] - 1
    clear_rows(work.gradient, tip - 1, tip + 1)
    _, _, pushed, _ = press(rod, lumen, wall, row(state.q, tip), tip)
    add_vector(work.gradient, tip, 1.0, pushed)
    if held < tip:
        press_edge(rod, lumen, wall, state, tip - 1, work.gradient, work.no_band, 0)
    pushed = row(work.gradient, tip)
    return sqrt(dot(pushed, pushed))


@part
def predict(model, state, before, held, dt, work, slides, inertia):
    """Move the free unknowns on at their velocities, as far as no point comes into the wall.

    ``state`` begins as ``before``, or where a wall that moves has carried it.
    """
    rod, _, wall, lumen, tube = model
    for i in range(held, state.q.shape[0]):
        store(work.step, 4 * (i - held + 1), 0, dt * load(before.velocity, i, 0))
    for r in range(FIRST):
        work.step[r] = 0.0
    if inertia:
        less_carried(lumen.moving, before, state, held, work.step)
    share = allowed_part(rod, lumen, wall, state.q, work.step, held, 0.0)
    share = within_tube(tube, state.q, work.step, held, share)
    if slides and share < 1.0:
        slide(rod, lumen, wall, state.q, work.step, held, 1.0, work.way)
        take_step(state, work.trial, held, 1.0, work.way)
        energy, _ = add_walls(rod, lumen, wall, work.trial, held, work.gradient, work.no_band)
        way = allowed_part(rod, lumen, wall, state.q, work.way, held, wall.gap)
        way = within_tube(tube, state.q, work.way, held, way)
        if energy < inf and way == 1.0:
            copy_configuration(work.trial, state, held)
            return
    origin = work.trial.q
    for i in range(held, state.q.shape[0]):
        store(origin, i, 0, load(state.q, i, 0))
    for _ in range(HALVINGS):
        for i in range(held, state.q.shape[0]):
            ahead = share * load(work.step, 4 * (i - held + 1), 0)
            store(state.q, i, 0, load(origin, i, 0) + ahead)
        if wall.between.parts < 2:
            return
        _, energy = add_between(rod, lumen, wall, state, held, work.gradient, work.no_band)
        if energy < inf:
            return
        share *= 0.5


@part
def trail(model, state, before, held, dt, fed, work):
    """Move the free unknowns on as those of the next node moved; whether that keeps off the wall.

    A wire that is fed by an edge follows itself: where a wall holds it, each node comes to where
    the one after it was. If it would touch, it is guessed to be there, or half of the way there.
    fed: in edges.
    """
    rod, wall, lumen = model.rod, model.wall, model.lumen
    tip = state.q.shape[0] - 1
    for share in (1.0, 0.5, 0.0):
        for i in range(held, tip + 1):
            j, r = min(i + 1, tip), 4 * (i - held + 1)
            way = dt * load(before.velocity, j, 0)
            if i < tip:
                onto = fed * (load(before.q, j, 0) - load(before.q, i, 0))
                way = share * way + (1.0 - share) * onto
            store(work.way, r, 0, way)
            work.way[r + 3] = dt * before.velocity[i, 3]
        for r in range(FIRST):
            work.way[r] = 0.0
        take_step(state, work.trial, held, 1.0, work.way)
        energy, _ = add_walls(rod, lumen, wall, work.trial, held, work.gradient, work.no_band)
        if energy < inf:
            copy_configuration(work.trial, state, held)
            return True
    return False


@part
def follow_tangents(state, held, speed):
    """Velocities of a wire that slides along itself: the guess of quasi-static steps."""
    last = state.q.shape[0] - 1
    for i in range(held, last + 1):
        state.velocity[i, 3] = 0.0
        for c in range(3):
            ahead = state.tangent[min(i, last - 1), c]
            state.velocity[i, c] = speed * 0.5 * (state.tangent[i - 1, c] + ahead)


@part
def time_step(model, guide, state, work, limits, slides, start, end, dt, drive):
    """One step into ``work.ahead`` (P-14, P-16); start, end: (feed, twist) of the guide.

    slides: whether the wire's way follows the wall where it meets it.
    ``state`` changes only in what is held; returns how Newton ended.
    """
    rod, wall, lumen = model.rod, model.wall, model.lumen
    nodes = state.q.shape[0]
    held, fraction = find_mouth(rod, guide, end[0])
    moves = (start[0], start[1], (end[0] - start[0]) / dt, (end[1] - start[1]) / dt)
    change_held(rod, guide, state, held, moves)
    copy_configuration(state, work.ahead, held)
    if held == nodes - 1:
        place_held(rod, guide, work.ahead, 0, held, end[0], end[1])
        return CONVERGED, 0, 0, 0.0, inf
    drag = 1.0 + drive.damping * dt
    if not drive.inertia:
        follow_tangents(state, held, moves[2])
    onwards = dt / drag
    for i in range(held, nodes):
        store(work.target, i, 0, load(state.q, i, 0) + onwards * load(state.velocity, i, 0))
    carry(lumen.moving, work.ahead, held)
    fed = (end[0] - start[0]) / rod.rest[rod.rest.shape[0] - 1]
    follows = limits.brisk and drive.inertia and fed > WHOLE
    if not (follows and trail(model, work.ahead, state, held, dt, fed, work)):
        predict(model, work.ahead, state, held, dt, work, slides, drive.inertia)
    place_held(rod, guide, work.ahead, held - 1, held, end[0], end[1])
    update_frames(state, work.ahead, held)
    motion = Motion(drag / (dt * dt) if drive.inertia else 0.0, work.target)
    snaps = not drive.inertia and len(wall.friction) > 0
    limits = Limits(
        limits.tolerance,
        limits.iterations * (SNAPPING if snaps else 1),
        limits.shift,
        limits.step,
        limits.turn,
        slides,
        limits.brisk,
    )
    mouth = Mouth(held, fraction)
    return solve_step(wall.friction, model, state, mouth, motion, work, limits, dt)


@kernel
def carried_state(movings, state, work):
    """A state, or a copy of it that the wall has carried along in the step if it moves."""
    if len(movings) == 0:
        return state
    else:
        held = state.held[0]
        copy_configuration(state, work.trial, held)
        carry(movings, work.trial, held)
        return work.trial


@kernel
def solve_step(frictions, model, state, mouth, motion, work, limits, dt):
    """Newton's method, with or without friction: one is compiled, see ``wall.traction``."""
    if len(frictions) == 0:
        return newton(model, work.ahead, mouth, motion, work, limits)
    else:
        rod, wall, lumen = model.rod, model.wall, model.lumen
        begin(
            rod, lumen, wall, state, carried_state(lumen.moving, state, work), mouth.held, dt, work
        )
        return rub(model, state, mouth, motion, work, limits)


@kernel
def rub(model, state, mouth, motion, work, limits):
    """Newton's method with friction: again until the normal forces are those of the step's end."""
    wall = model.wall
    iterations, factorisations = 0, 0
    for k in range(LOADINGS):
        outcome = newton(model, work.ahead, mouth, motion, work, limits)
        status, taken, factored, residual, nearest = outcome
        iterations += taken
        factorisations += factored
        if status != CONVERGED or reload(
            wall.friction[0], state, work.ahead, 1.0 if k < EAGER else 0.5
        ):
            return status, iterations, factorisations, residual, nearest
    return TOO_MANY_ITERATIONS, iterations, factorisations, residual, nearest


@part
def accept(model, state, work, dt, end, clock):
    """Take over the step in ``work.ahead``: configuration, velocities, and where the guide is.

    clock: the time at its end.
    """
    rod, wall, lumen = model.rod, model.wall, model.lumen
    held = state.held[0]
    begun = carried_state(lumen.moving, state, work)
    count_half(lumen.moving, model, state, begun, work)
    keep_contacts(wall.friction, rod, state, work.ahead)
    count_half(lumen.moving, model, state, work.ahead, work)
    state.clock[0] = clock
    for i in range(held, state.q.shape[0]):
        store(state.velocity, i, 0, (load(work.ahead.q, i, 0) - load(state.q, i, 0)) / dt)
    copy_configuration(work.ahead, state, held)
    state.guide[0], state.guide[1] = end


@part
def cuts_by_feed(rod, fed):
    """How often a step is cut in half beforehand, so that no part feeds more than an edge."""
    fed = abs(fed)
    edge = rod.rest[rod.rest.shape[0] - 1]
    cuts = 0
    while fed > edge:
        fed *= 0.5
        cuts += 1
    return cuts


@kernel
def blend(start, end, share):
    """What lies between the start and the end of a step, at a share of it: two numbers each."""
    rest = 1.0 - share
    return rest * start[0] + share * end[0], rest * start[1] + share * end[1]


@kernel
def differ(a, b):
    """Whether any of two rows of numbers differ."""
    for c in range(a.shape[0]):
        if a[c] != b[c]:
            return True
    return False


@kernel
def march(model, guide, state, work, limits, drive, tally):
    """Time steps along a drive, one after the other.

    A step that would feed more than an edge is done in parts. One that fails is cut in half a
    bounded number of times; if that does not help, the state is left as it was before the step.

    Returns the steps done and how the last one ended: plain numbers, since an interrupt that
    arrives here would break the making of any other object.
    """
    field = model.field
    steer(field.sources, state.inputs, field.strength)
    for k in range(drive.feed.shape[0]):
        entry = state.held[0]
        first = state.guide[0], state.guide[1]
        last = drive.feed[k], drive.twist[k]
        clock = state.clock[0]
        begun = cuts_by_feed(model.rod, last[0] - first[0])
        halvings = begun
        slides = False
        done = 0.0
        touches = False
        while done < 1.0:
            share = 0.5**halvings
            end = blend(first, last, done + share)
            dt = share * drive.time_step
            then = clock + (done + share) * drive.time_step
            move_wall(model.lumen.moving, model.wall, state.clock[0], then)
            if differ(state.inputs, drive.inputs[k]):
                for c in range(state.inputs.shape[0]):
                    rest = 1.0 - (done + share)
                    work.inputs[c] = rest * state.inputs[c] + (done + share) * drive.inputs[k, c]
                steer(field.sources, work.inputs, field.strength)
            outcome = time_step(
                model, guide, state, work, limits, slides, blend(first, last, done), end, dt, drive
            )
            status, iterations, factorisations, _, nearest = outcome
            tally.counts[1] += iterations
            tally.counts[2] += factorisations
            if status != CONVERGED:
                if done == 0.0:
                    copy_state(state, work.before)
                if slides and halvings == begun + RETRIES:
                    copy_state(work.before, state)
                    state.held[0] = entry
                    steer(field.sources, state.inputs, field.strength)
                    move_wall(model.lumen.moving, model.wall, clock, clock)
                    return k, status
                if slides or halvings < begun + COARSE:
                    halvings += 1
                else:
                    slides = True
                tally.counts[3] += 1
                continue
            accept(model, state, work, dt, end, then)
            touches = touches or nearest < inf
            done += share
            if slides and halvings > begun and done % (2.0 * share) == 0.0:
                halvings -= 1
        for c in range(state.inputs.shape[0]):
            state.inputs[c] = drive.inputs[k, c]
        tally.counts[0] += 1
        if touches:
            size = tip_force(model, state, state.held[0], work)
            tally.forces[0] = max(tally.forces[0], size)
            tally.forces[1] += size
            if tally.forces[2] < 0.0:
                tally.forces[2] = drive.feed[k]
    return drive.feed.shape[0], CONVERGED
