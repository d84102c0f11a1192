"""An equilibrium to first order: how tip and stability answer to a uniform field (P-21, P-22)."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from magwire.kernels._jit import kernel, part
from magwire.kernels.arrays import Array, Motion
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import WIDTH, factor, solve
from magwire.kernels.hinge import material_frame
from magwire.kernels.magnetics import torque_gradient
from magwire.kernels.newton import take_step
from magwire.kernels.sources.steer import steer
from magwire.kernels.vectors import row
from magwire.kernels.wall.push import press_tube

SWEEPS = 60  # of inverse iteration, at most
SHARE = 0.03  # of every direction in the first guess of a mode
SETTLED = 1e-9  # relative change of the eigenvalue at which they end
PROBE = 1e-5  # step along a sensitivity for the change of the stiffness, in wire lengths
STIFF = 1.0  # least sensitivity [1/T] for that: a field along a straight wire moves nothing


class Linear(NamedTuple):
    """Arrays for one linearisation, allocated once.

    moves [3, rows] change of the unknowns by each field component [1/T]; mode [rows] slowest mode;
    slope [3] derivative of its eigenvalue by the field [rad^2/s^2 per T].
    """

    moves: Array
    mode: Array
    slope: Array


@part
def load_of_field(rod, state, held, axis, rows):
    """Minus the derivative of the gradient by one component of a uniform field, as rows."""
    for i in range(len(rows)):
        rows[i] = 0.0
    direction = (1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0)
    for j in range(held, state.length.shape[0]):
        m = row(rod.moment, j)
        if m[0] == 0.0 and m[1] == 0.0 and m[2] == 0.0:
            continue
        t = row(state.tangent, j)
        m1, m2 = material_frame(row(state.director, j), t, state.q[j, 3])
        by_edge, by_theta = torque_gradient(m, m1, m2, t, 1.0 / state.length[j], direction)
        r = 4 * (j - held + 1)
        for c in range(3):
            rows[r + c] += by_edge[c]
            rows[r + 4 + c] -= by_edge[c]
        rows[r + 3] -= by_theta
    for i in range(FIRST):
        rows[i] = 0.0


@kernel
def tube_force(model, state, force, slope):
    """Force of the virtual tube on the tip (P-19).

    Fills ``force`` [3] and its derivative by the tip's position, ``slope`` [3, 3].
    """
    rod, _, wall, _ = model
    _, _, pushed, h = press_tube(rod, wall.tube, row(state.q, state.q.shape[0] - 1))
    rows = (h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5])
    for i in range(3):
        force[i] = -pushed[i]
        for j in range(3):
            slope[i, j] = -rows[3 * i + j]


@kernel
def lumped(rod, held, r):
    """Lumped mass of a row of the band."""
    i = held - 1 + r // 4
    return rod.inertia[i] if r % 4 == 3 else rod.mass[i]


@kernel
def quotient(band, mode, last):
    """Stiffness of a mode, mode.K.mode, from the assembled band."""
    total = 0.0
    for j in range(FIRST, last):
        total += band[j, 0] * mode[j] * mode[j]
        for k in range(1, WIDTH):
            total += 2.0 * band[j, k] * mode[j + k] * mode[j]
    return total


@part
def mix(mode, last):
    """Give every direction a share in the guess of the slowest mode.

    A guess that lies in a plane, as the mode before may, would never find a mode across it.
    """
    size = 0.0
    for r in range(FIRST, last):
        size = max(size, abs(mode[r]))
    for r in range(FIRST, last):
        mode[r] += SHARE * size


@part
def slowest_mode(band, rod, held, mode, last):
    """Smallest eigenvalue of stiffness against lumped mass, by inverse iteration on the factor.

    ``mode`` starts as a guess and ends as the eigenvector of unit mass.
    """
    value = 0.0
    for _ in range(SWEEPS):
        for r in range(FIRST, last):
            mode[r] *= lumped(rod, held, r)
        solve(band, mode, FIRST, last)
        size = 0.0
        for r in range(FIRST, last):
            size += lumped(rod, held, r) * mode[r] * mode[r]
        new = 1.0 / sqrt(size)
        for r in range(FIRST, last):
            mode[r] *= new
        if abs(new - value) <= SETTLED * new:
            return new
        value = new
    return value


@kernel
def respond(model, state, mouth, work, linear):
    """Change of the unknowns by each field component, into ``linear.moves`` (P-21).

    Leaves the factor of the tangent stiffness in the band; returns whether there is one, that is,
    whether the equilibrium is stable.
    """
    held = mouth.held
    still = Motion(0.0, work.target)
    last = 4 * (state.q.shape[0] - held + 1) - 1
    assemble(model, state, mouth, still, work.gradient, work.band)
    if factor(work.band, FIRST, last) >= 0:
        return False
    for axis in range(3):
        load_of_field(model[0], state, held, axis, linear.moves[axis])
        solve(work.band, linear.moves[axis], FIRST, last)
    return True


@kernel
def linearise(model, state, mouth, work, linear):
    """Linearise a stable equilibrium about its uniform field.

    Fills ``linear``; returns the smallest eigenvalue [rad^2/s^2], or zero if the equilibrium is not
    stable, and then nothing is filled.
    """
    if not respond(model, state, mouth, work, linear):
        return 0.0
    rod, field, _, _ = model
    held = mouth.held
    still = Motion(0.0, work.target)
    last = 4 * (state.q.shape[0] - held + 1) - 1
    mix(linear.mode, last)
    value = slowest_mode(work.band, rod, held, linear.mode, last)
    for axis in range(3):
        size = STIFF
        for r in range(FIRST, last):
            size = max(size, abs(linear.moves[axis, r]))
        probe = PROBE / size
        slope = 0.0
        for sign in (-1.0, 1.0):
            for r in range(last + 1):
                work.step[r] = linear.moves[axis, r] if FIRST <= r < last else 0.0
            take_step(state, work.spare, held, sign * probe, work.step)
            for c in range(3):
                work.inputs[c] = state.inputs[c] + (sign * probe if c == axis else 0.0)
            steer(field.sources, work.inputs, field.strength)
            assemble(model, work.spare, mouth, still, work.gradient, work.band)
            steer(field.sources, state.inputs, field.strength)
            slope += sign * quotient(work.band, linear.mode, last) / (2.0 * probe)
        linear.slope[axis] = slope
    return value


@kernel
def steadiness(model, state, mouth, work, mode):
    """Smallest eigenvalue [rad^2/s^2] of an equilibrium in whatever field, 0 if it is not stable.

    ``mode`` [rows] starts as a guess and ends as its mode.
    """
    held = mouth.held
    still = Motion(0.0, work.target)
    last = 4 * (state.q.shape[0] - held + 1) - 1
    assemble(model, state, mouth, still, work.gradient, work.band)
    if factor(work.band, FIRST, last) >= 0:
        return 0.0
    mix(mode, last)
    return slowest_mode(work.band, model[0], held, mode, last)
