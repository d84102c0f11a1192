"""Newton's method on the total energy: line search, step filter, regularisation (P-14, P-16)."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from magwire.kernels._jit import kernel, part
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import factor, solve
from magwire.kernels.frames import update_frames
from magwire.kernels.vectors import combine, dot, norm, row, sub
from magwire.kernels.wall.collision import allowed_part
from magwire.kernels.wall.slide import slide

CONVERGED = 0
STALLED = 1
TOO_MANY_ITERATIONS = 2
PENETRATING = 3

ARMIJO = 1e-4
HALVINGS = 40
ROUND_OFF = 1e-13  # conditioning guard: energy differences below this part of it mean nothing
FARTHEST = 0.05  # longest step along a wall, in L: it is followed by its tangent and curvature
LAST = 0.01  # of the smallest clearance: a step that changes no wall force by much more than that
SHIFT_GROWTH = 8.0
SHIFTS = 24


class Limits(NamedTuple):
    """When Newton stops, and where regularisation begins.

    tolerance: force residual, in EI/L^2; iterations; shift: first regularisation [1/s^2]; step: a
    full step shorter than this, in L, and than a hundredth of every clearance in which the wall is
    felt, is the last one: it changes no wall force by more than a few percent, and the next step
    would be its square. turn: part of a step from which on its edges may turn, if the line search
    comes down to it. slide: whether steps follow the wall.
    """

    tolerance: float
    iterations: int
    shift: float
    step: float = 0.0
    turn: float = 1.0
    slide: bool = False


@kernel
def residual(gradient, held):
    """Largest force or moment on a free unknown; NaN counts as infinite."""
    last = gradient.shape[0] - 1
    largest = abs(gradient[held, 3])
    if not largest < inf:
        return inf
    for i in range(held + 1, last + 1):
        for c in range(4 if i < last else 3):
            value = abs(gradient[i, c])
            if not value < inf:
                return inf
            largest = max(largest, value)
    return largest


@part
def add_shift(rod, band, held, shift):
    """Add shift times the lumped mass to the band's diagonal: makes it positive definite."""
    nodes = rod.mass.shape[0]
    for i in range(held, nodes):
        r = 4 * (i - held + 1)
        if i > held:
            for c in range(3):
                band[r + c, 0] += shift * rod.mass[i]
        if i < nodes - 1:
            band[r + 3, 0] += shift * rod.inertia[i]


@part
def find_step(model, state, mouth, motion, work, limits):
    """Solve for the Newton step, regularised as far as Cholesky asks; count of factorisations.

    Expects gradient and band of ``state`` in ``work``. Leaves the factor in the band.
    """
    held = mouth.held
    nodes = state.q.shape[0]
    last = 4 * (nodes - held + 1) - 1
    shift = 0.0
    count = 0
    for _ in range(SHIFTS):
        count += 1
        if factor(work.band, FIRST, last) < 0:
            break
        shift = max(limits.shift, SHIFT_GROWTH * shift)
        assemble(model, state, mouth, motion, work.gradient, work.band)
        add_shift(model[0], work.band, held, shift)
    else:
        return -count
    for i in range(held - 1, nodes):
        for c in range(4):
            row = 4 * (i - held + 1) + c
            work.step[row] = -work.gradient[i, c] if FIRST <= row < last else 0.0
    solve(work.band, work.step, FIRST, last)
    return count


@kernel
def take_step(a, b, held, part, step):
    """Configuration b = a + part * step, with its frames transported from a."""
    nodes = a.q.shape[0]
    for i in range(held - 1, nodes):
        r = 4 * (i - held + 1)
        for c in range(4):
            b.q[i, c] = a.q[i, c] + part * step[r + c]
    for c in range(3):
        b.director[held - 1, c] = a.director[held - 1, c]
    update_frames(a, b, held)


@part
def turn_step(a, b, held, part, step, way):
    """Configuration b as of ``take_step``, but with edges that turn instead of growing longer.

    A straight step lengthens an edge that turns by an angle by half of its square, which a stiff
    edge resists: a stiff tip could turn by no more than the square root of its strain. Here every
    edge takes the direction of the straight step and its length to first order. Fills ``way`` with
    the change of the unknowns.
    """
    nodes = a.q.shape[0]
    for i in range(held - 1, held + 1):
        for c in range(4):
            b.q[i, c] = a.q[i, c] + part * step[4 * (i - held + 1) + c]
            way[4 * (i - held + 1) + c] = b.q[i, c] - a.q[i, c]
    for i in range(held + 1, nodes):
        r = 4 * (i - held + 1)
        x, y = row(a.q, i - 1), row(a.q, i)
        de = (step[r] - step[r - 4], step[r + 1] - step[r - 3], step[r + 2] - step[r - 2])
        e = combine(1.0, sub(y, x), part, de)
        length = a.length[i - 1] + part * dot(row(a.tangent, i - 1), de)
        size = length / norm(e)
        for c in range(3):
            b.q[i, c] = b.q[i - 1, c] + size * e[c]
        b.q[i, 3] = a.q[i, 3] + part * step[r + 3]
        for c in range(4):
            way[r + c] = b.q[i, c] - a.q[i, c]
    for c in range(3):
        b.director[held - 1, c] = a.director[held - 1, c]
    update_frames(a, b, held)


@kernel
def copy_state(source, target, held):
    """Copy what lies from the guide's last edge to the tip."""
    nodes = source.q.shape[0]
    for i in range(held - 1, nodes):
        target.twist[i] = source.twist[i]
        for c in range(4):
            target.q[i, c] = source.q[i, c]
        if i < nodes - 1:
            target.length[i] = source.length[i]
            for c in range(3):
                target.tangent[i, c] = source.tangent[i, c]
                target.director[i, c] = source.director[i, c]


@kernel
def longest(step, held, nodes):
    """Largest component of a step."""
    value = 0.0
    for r in range(FIRST, 4 * (nodes - held + 1) - 1):
        value = max(value, abs(step[r]))
    return value


@part
def search(model, a, b, mouth, motion, work, aim, turn):
    """Halve the step from a until the energy of b falls enough.

    aim: energy of a, its slope along the step, round-off. Returns the part of the step that was
    taken, zero if there was none, and energy and smallest clearance of b.
    """
    rod, _, wall, lumen = model
    held = mouth.held
    energy, slope, slack = aim
    share = allowed_part(rod, lumen, wall, a.q, work.step, held)
    lower, nearest = inf, inf
    for _ in range(HALVINGS):
        take_step(a, b, held, share, work.step)
        lower, nearest = assemble(model, b, mouth, motion, work.gradient, work.no_band)
        if lower <= energy + ARMIJO * share * slope + slack:
            return share, lower, nearest
        if share <= turn:
            turn_step(a, b, held, share, work.step, work.way)
            if allowed_part(rod, lumen, wall, a.q, work.way, held) == 1.0:
                lower, nearest = assemble(model, b, mouth, motion, work.gradient, work.no_band)
                if lower <= energy + ARMIJO * share * slope + slack:
                    return share, lower, nearest
        share *= 0.5
    return 0.0, lower, nearest


@part
def search_along_wall(model, a, b, mouth, motion, work, aim):
    """The same with steps that follow the wall; see ``slide``."""
    rod, _, wall, lumen = model
    held = mouth.held
    energy, slope, slack = aim
    share = min(1.0, FARTHEST / longest(work.step, held, a.q.shape[0]))
    lower, nearest = inf, inf
    for _ in range(HALVINGS):
        slide(rod, lumen, wall, a.q, work.step, held, share, work.way)
        free = allowed_part(rod, lumen, wall, a.q, work.way, held)
        take_step(a, b, held, free, work.way)
        lower, nearest = assemble(model, b, mouth, motion, work.gradient, work.no_band)
        if lower <= energy + ARMIJO * free * share * slope + slack:
            return free * share, lower, nearest
        share *= 0.5
    return 0.0, lower, nearest


@kernel
def newton(model, state, mouth, motion, work, limits):
    """Minimise the energy from ``state``, which ends as the last iterate, converged or not.

    Returns
    -------
    status, iterations, factorisations
        How it ended, and counts.
    residual
        Largest force or moment left on a free unknown.
    nearest
        Smallest clearance where the wall is felt; +inf if it is not.
    """
    held = mouth.held
    a, b = work.trial, work.spare
    copy_state(state, a, held)
    factorisations = 0
    iteration = 0
    energy, nearest = assemble(model, a, mouth, motion, work.gradient, work.band)
    size = residual(work.gradient, held)
    status = CONVERGED if energy < inf else PENETRATING
    while status == CONVERGED and not size <= limits.tolerance:
        if iteration == limits.iterations:
            status = TOO_MANY_ITERATIONS
            break
        if iteration > 0:
            assemble(model, a, mouth, motion, work.gradient, work.band)
        iteration += 1
        count = find_step(model, a, mouth, motion, work, limits)
        factorisations += abs(count)
        if count < 0:
            status = STALLED
            break
        slope = 0.0
        for i in range(held, a.q.shape[0]):
            for c in range(4):
                slope += work.gradient[i, c] * work.step[4 * (i - held + 1) + c]
        aim = energy, slope, ROUND_OFF * (1.0 + abs(energy))
        if limits.slide:
            share, lower, nearest = search_along_wall(model, a, b, mouth, motion, work, aim)
        else:
            share, lower, nearest = search(model, a, b, mouth, motion, work, aim, limits.turn)
        status = CONVERGED if share > 0.0 else STALLED
        if status == CONVERGED:
            a, b = b, a
            energy = lower
            size = residual(work.gradient, held)
            small = min(limits.step, LAST * nearest)
            if share == 1.0 and size < inf and longest(work.step, held, a.q.shape[0]) < small:
                break
    copy_state(a, state, held)
    return status, iteration, factorisations, size, nearest
