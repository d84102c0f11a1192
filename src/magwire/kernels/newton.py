"""Newton's method on the total energy: line search, step filter, regularisation (P-14, P-16)."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from magwire.kernels._jit import kernel, part
from magwire.kernels.assembly import FIRST, assemble, update_frames
from magwire.kernels.band import factor, solve
from magwire.kernels.collision import allowed_part

CONVERGED = 0
STALLED = 1
TOO_MANY_ITERATIONS = 2
PENETRATING = 3

ARMIJO = 1e-4
HALVINGS = 40
ROUND_OFF = 1e-13  # conditioning guard: energy differences below this part of it mean nothing
SHIFT_GROWTH = 8.0
SHIFTS = 24


class Limits(NamedTuple):
    """When Newton stops, and where regularisation begins.

    tolerance: force residual, in EI/L^2; iterations; shift: first regularisation [1/s^2]; step: a
    full step shorter than this, in L, is the last one, since the next would be its square.
    """

    tolerance: float
    iterations: int
    shift: float
    step: float = 0.0


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


@kernel
def newton(model, state, mouth, motion, work, limits):
    """Minimise the energy from ``state``, which ends as the last iterate, converged or not.

    Returns
    -------
    status, iterations, factorisations
        How it ended, and counts.
    residual
        Largest force or moment left on a free unknown.
    touching
        How many nodes feel the wall.
    """
    rod, _, wall, lumen = model
    held = mouth.held
    a, b = work.trial, work.spare
    copy_state(state, a, held)
    factorisations = 0
    iteration = 0
    energy, touching = assemble(model, a, mouth, motion, work.gradient, work.band)
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
        share = allowed_part(rod, lumen, wall, a.q, work.step, held)
        slack = ROUND_OFF * (1.0 + abs(energy))
        status = STALLED
        for _ in range(HALVINGS):
            take_step(a, b, held, share, work.step)
            lower, touching = assemble(model, b, mouth, motion, work.gradient, work.no_band)
            if lower <= energy + ARMIJO * share * slope + slack:
                status = CONVERGED
                break
            share *= 0.5
        if status == CONVERGED:
            a, b = b, a
            energy = lower
            size = residual(work.gradient, held)
            if share == 1.0 and size < inf and longest(work.step, held, a.q.shape[0]) < limits.step:
                break
    copy_state(a, state, held)
    return status, iteration, factorisations, size, touching
