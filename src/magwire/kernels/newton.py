"""Newton's method on the total energy: line search, step filter, regularisation (P-14, P-16)."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from magwire.kernels._jit import kernel, part, short
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import WIDTH, factor, solve
from magwire.kernels.frames import update_frames
from magwire.kernels.groups import larger, largest_of, total
from magwire.kernels.history import copy_configuration
from magwire.kernels.lanes import load, splat, store
from magwire.kernels.tube import within_tube
from magwire.kernels.vectors import combine, dot, norm, row, sub
from magwire.kernels.wall.collision import allowed_between, allowed_part
from magwire.kernels.wall.eased import EASED
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
    comes down to it. slide: whether steps follow the wall. brisk: see ``System``.
    """

    tolerance: float
    iterations: int
    shift: float
    step: float = 0.0
    turn: float = 1.0
    slide: bool = False
    brisk: bool = False


@kernel
def residual(gradient, held):
    """Largest force or moment on a free unknown; NaN counts as infinite."""
    tip = gradient.shape[0] - 1
    largest = abs(gradient[held, 3])
    if not largest < inf:
        return inf
    most = bad = splat(0.0)
    for i in range(held + 1, tip):
        size = abs(load(gradient, i, 0))
        most, bad = larger(size, most), bad + (size - size)  # what is not finite stays in ``bad``
    for c in range(3):
        value = abs(gradient[tip, c])
        if not value < inf:
            return inf
        largest = max(largest, value)
    return max(largest, largest_of(most)) if total(bad) == 0.0 else inf


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


@kernel
def copy_band(source, target, rows):
    """Copy the first rows of a band."""
    for r in range(rows):
        store(target, r, 0, load(source, r, 0))
        store(target, r, 4, load(source, r, 4))
        store(target, r, 8, load(source, r, 8))


@part
def find_step(model, state, mouth, motion, work, limits, level, usual):
    """Solve for the Newton step, regularised as little as Cholesky allows.

    Expects gradient and band of ``state`` in ``work``. Leaves the factor in the band.

    A matrix stays positive definite as the shift grows. Levels of it are therefore searched from
    where the iteration before found one, with copies of the band: where many iterations in a row
    need a large shift, that takes two factorisations in each. ``usual`` is the last level above 0
    that did: where none does not do, that is tried next.

    Returns the number of factorisations, negative if no level will do; and the level, 0 for none.
    """
    held = mouth.held
    nodes = state.q.shape[0]
    last = 4 * (nodes - held + 1) - 1
    count = 0
    short_of, enough = -1, SHIFTS  # levels that are known not to do, and to do
    jumped = False
    level = max(level - 1, 0)
    kept = level > 0
    if kept:
        copy_band(work.band, work.kept, last + 1)
    while True:
        if level > 0 and not kept:
            assemble(model, state, mouth, motion, work.gradient, work.band)
            copy_band(work.band, work.kept, last + 1)
            kept = True
        elif count > 0:
            copy_band(work.kept, work.band, last + 1)
        if level > 0:
            add_shift(model.rod, work.band, held, limits.shift * SHIFT_GROWTH ** (level - 1))
        count += 1
        if factor(work.band, FIRST, last) < 0:
            if level == short_of + 1:
                break
            enough = level
            level = (short_of + level) // 2 if jumped else level - 1
            continue
        short_of = level
        if enough < SHIFTS:
            level = (level + enough + 1) // 2
            continue
        level = max(level + 1, usual)
        jumped, usual = level > short_of + 1, 0
        if level == SHIFTS:
            return -count, 0
    backward(work, held, nodes)
    return count, level


@kernel
def backward(work, held, nodes):
    """The step against the gradient, by the factor in the band."""
    last = 4 * (nodes - held + 1) - 1
    for i in range(held, nodes):
        store(work.step, 4 * (i - held + 1), 0, -load(work.gradient, i, 0))
    for r in range(FIRST):
        work.step[r] = 0.0
    for r in range(last, last + WIDTH):  # what was never finite must not come back
        work.step[r] = 0.0
    solve(work.band, work.step, FIRST, last)


@short
def take_step(a, b, held, part, step):
    """Configuration b = a + part * step, with its frames transported from a."""
    nodes = a.q.shape[0]
    for i in range(held - 1, nodes):
        store(b.q, i, 0, load(a.q, i, 0) + part * load(step, 4 * (i - held + 1), 0))
    for c in range(3):
        b.director[held - 1, c] = a.director[held - 1, c]
    update_frames(a, b, held)


@part
def turn_step(a, held, part, step, way):
    """Fill ``way`` with the step ``part * step`` from a, but with edges that turn.

    A straight step lengthens an edge that turns by an angle by half of its square, which a stiff
    edge resists: a stiff tip could turn by no more than the square root of its strain. Here every
    edge takes the direction of the straight step and its length to first order.
    """
    nodes = a.q.shape[0]
    for r in range(8):
        way[r] = part * step[r]
    for i in range(held + 1, nodes):
        r = 4 * (i - held + 1)
        edge = sub(row(a.q, i), row(a.q, i - 1))
        de = (step[r] - step[r - 4], step[r + 1] - step[r - 3], step[r + 2] - step[r - 2])
        e = combine(1.0, edge, part, de)
        size = (a.length[i - 1] + part * dot(row(a.tangent, i - 1), de)) / norm(e)
        for c in range(3):
            way[r + c] = way[r - 4 + c] + size * e[c] - edge[c]
        way[r + 3] = part * step[r + 3]


@kernel
def longest(step, held, nodes):
    """Largest component of a step."""
    most = splat(0.0)
    for r in range(4, 4 * (nodes - held + 1), 4):  # what is not free does not move
        most = larger(abs(load(step, r, 0)), most)
    return largest_of(most)


@part
def search(model, a, b, mouth, motion, work, limits, aim):
    """Halve the step from a until the energy of b falls enough.

    aim: energy of a, its slope along the step, round-off, and whether the Hessian of the first b
    that is tried is wanted. Returns the part of the step that was taken, zero if there was none,
    energy and smallest clearance of b, and whether its Hessian is in the band.
    """
    rod, _, wall, lumen, tube = model
    held = mouth.held
    energy, slope, slack, ahead = aim
    lower, nearest = inf, inf
    if limits.slide:
        share = min(1.0, FARTHEST / longest(work.step, held, a.q.shape[0]))
        leeway = wall.gap
    else:
        share = allowed_part(rod, lumen, wall, a.q, work.step, held, 0.0)
        share = within_tube(tube, a.q, work.step, held, share)
        leeway = 0.0
    far = limits.step == 0.0  # from the end, where a step that is halved leads nowhere
    blind = not (limits.slide or far or limits.brisk)  # to points between the nodes
    if far and not limits.slide:
        share = allowed_between(rod, lumen, wall, a.q, work.step, held, share)
    for _ in range(HALVINGS):
        for turned in range(2):
            bent = limits.slide or turned == 1
            if turned == 1 and (limits.slide or share > limits.turn):
                break
            if turned == 1:
                turn_step(a, held, share, work.step, work.way)
            elif limits.slide:
                slide(rod, lumen, wall, a.q, work.step, held, share, work.way)
            if bent:
                free = allowed_part(rod, lumen, wall, a.q, work.way, held, leeway)
                if within_tube(tube, a.q, work.way, held, free) < 1.0:
                    continue
            take_step(a, b, held, 1.0 if bent else share, work.way if bent else work.step)
            band = work.band if ahead else work.no_band
            lower, nearest = assemble(model, b, mouth, motion, work.gradient, band)
            if lower <= energy + ARMIJO * share * slope + slack:
                return share, lower, nearest, ahead
            ahead = False
        clear = share
        if blind and not lower < inf:
            blind = False
            clear = allowed_between(rod, lumen, wall, a.q, work.step, held, share)
        share = clear if clear < share else 0.5 * share
    return 0.0, lower, nearest, False


@kernel
def refine(frictions, model, a, b, mouth, motion, work, tolerance, long, now):
    """With friction, bring what a last step left within the tolerance, by the factor it was from.

    A contact passes from stick to slip on a way as short as such a step is. The factor is nearly
    that of where the wire is now: each time forces are a hundredth or so of those before, without a
    Hessian. It ends where they do not halve; then Newton's method goes on.

    long: the last step, than which none is longer. now: energy and smallest clearance at a, and the
    largest force left. The same is returned of where a then is.
    """
    if len(frictions) == 0:
        return now
    else:
        energy, nearest, size = now
        held, nodes = mouth.held, a.q.shape[0]
        while not size <= tolerance:
            backward(work, held, nodes)
            if not longest(work.step, held, nodes) <= long:
                break
            take_step(a, b, held, 1.0, work.step)
            lower, near = assemble(model, b, mouth, motion, work.gradient, work.no_band)
            left = residual(work.gradient, held)
            if not (lower < inf and left < 0.5 * size):
                break
            copy_configuration(b, a, held)
            energy, nearest, size = lower, near, left
        return energy, nearest, size


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
    copy_configuration(state, a, held)
    factorisations = 0
    iteration = 0
    level, usual = 0, 0
    energy, nearest, size = 0.0, inf, inf
    status = CONVERGED
    known = False  # whether gradient and band are those of a
    easy = model.wall.easy
    while status == CONVERGED and not size <= limits.tolerance:
        if iteration > 0 and iteration == limits.iterations:
            status = TOO_MANY_ITERATIONS
            break
        easy[0] = 1.0 if iteration < EASED else 0.0
        if not known:
            value, near = assemble(model, a, mouth, motion, work.gradient, work.band)
        if iteration == 0:
            energy, nearest, size = value, near, residual(work.gradient, held)
            if not energy < inf:
                status = PENETRATING
            if not energy < inf or size <= limits.tolerance:
                break
        iteration += 1
        count, level = find_step(model, a, mouth, motion, work, limits, level, usual)
        usual = level if level > 0 else usual
        factorisations += abs(count)
        if count < 0:
            status = STALLED
            break
        slope = splat(0.0)
        for i in range(held, a.q.shape[0]):
            slope = slope + load(work.gradient, i, 0) * load(work.step, 4 * (i - held + 1), 0)
        # The Hessian costs little next to the gradient; after a step this short none is needed.
        long = longest(work.step, held, a.q.shape[0])
        ahead = not long < min(limits.step, LAST * nearest)
        aim = energy, total(slope), ROUND_OFF * (1.0 + abs(energy)), ahead
        share, energy, near, known = search(model, a, b, mouth, motion, work, limits, aim)
        if share == 0.0:
            status = STALLED
            break
        a, b = b, a
        nearest = near
        size = residual(work.gradient, held)
        small = min(limits.step, LAST * nearest)
        if share == 1.0 and size < inf and long < small:
            now = energy, nearest, size
            tolerance = limits.tolerance
            now = refine(
                model.wall.friction, model, a, b, mouth, motion, work, tolerance, long, now
            )
            energy, nearest, size = now
            if len(model.wall.friction) == 0:
                break
    easy[0] = 0.0
    copy_configuration(a, state, held)
    return status, iteration, factorisations, size, nearest
