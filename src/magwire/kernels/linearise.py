"""An equilibrium to first order: how tip and stability answer to a uniform field (P-21, P-22)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from magwire.kernels._jit import kernel, part
from magwire.kernels.arrays import Array, Motion
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import WIDTH, factor, solve
from magwire.kernels.groups import total
from magwire.kernels.hinge import material_frame
from magwire.kernels.lanes import LANES, four, load, splat
from magwire.kernels.magnetics import torque_gradient, torque_hessian
from magwire.kernels.newton import copy_band, take_step
from magwire.kernels.subspace import mix, slowest_modes
from magwire.kernels.vectors import dot, row
from magwire.kernels.wall.eased import times

PROBE = 1e-5  # step along the mode for the change of the stiffness, in wire lengths


class Linear(NamedTuple):
    """Arrays for one linearisation, allocated once.

    moves [3, rows] change of the unknowns by each field component [1/T]; slope [3] derivative of
    the smallest eigenvalue by the field [rad^2/s^2 per T]; modes [rows, 4] the slowest modes, the
    slowest first; image [rows, 4], stiff, mass and mixed [4, 4] what it takes to find them.
    """

    moves: Array
    slope: Array
    modes: Array
    image: Array
    stiff: Array
    mass: Array
    mixed: Array


def new_linear(rows):
    """Arrays for wires of so many rows."""
    square = np.zeros((3, LANES, LANES))
    return Linear(np.zeros((3, rows)), np.zeros(3), *np.zeros((2, rows, LANES)), *square)


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
        load_of_field(model.rod, state, held, axis, linear.moves[axis])
        solve(work.band, linear.moves[axis], FIRST, last)
    return True


@part
def bend(model, state, mouth, work, last):
    """Stiffness a little way along the mode in ``work.step``, either way: in ``kept`` and ``band``.

    Returns how much of the mode lies between. A difference to one side would not do: far from the
    wire it sees how its edges lengthen when they turn, and near it round-off.
    """
    size = 0.0
    for r in range(FIRST, last):
        size = max(size, abs(work.step[r]))
    probe = PROBE / size
    still = Motion(0.0, work.target)
    for sign in (-1.0, 1.0):
        take_step(state, work.spare, mouth.held, sign * probe, work.step)
        assemble(model, work.spare, mouth, still, work.gradient, work.band)
        if sign < 0.0:
            copy_band(work.band, work.kept, last)
    return 2.0 * probe


@part
def slopes_along(work, moves, last):
    """Products of ``work.step`` with three vectors under ``work.band`` less ``work.kept``."""
    s0 = s1 = s2 = splat(0.0)
    once = four(0.5, 1.0, 1.0, 1.0)  # what is on the diagonal comes twice
    mode = work.step
    for j in range(FIRST, last):
        a = once * (load(work.band, j, 0) - load(work.kept, j, 0))
        b = load(work.band, j, 4) - load(work.kept, j, 4)
        c = load(work.band, j, 8) - load(work.kept, j, 8)
        own = mode[j]
        along = a * load(mode, j, 0) + b * load(mode, j + 4, 0) + c * load(mode, j + 8, 0)
        a, b, c = own * a, own * b, own * c
        x = a * load(moves, 0, j) + b * load(moves, 0, j + 4) + c * load(moves, 0, j + 8)
        y = a * load(moves, 1, j) + b * load(moves, 1, j + 4) + c * load(moves, 1, j + 8)
        z = a * load(moves, 2, j) + b * load(moves, 2, j + 4) + c * load(moves, 2, j + 8)
        s0 = s0 + (moves[0, j] * along + x)
        s1 = s1 + (moves[1, j] * along + y)
        s2 = s2 + (moves[2, j] * along + z)
    return total(s0), total(s1), total(s2)


@part
def turned_by(rod, state, held, axis, mode):
    """Change of a mode's stiffness by one component of a uniform field, at the same place."""
    direction = (1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0)
    found = 0.0
    for j in range(held, state.length.shape[0]):
        m = row(rod.moment, j)
        if m[0] == 0.0 and m[1] == 0.0 and m[2] == 0.0:
            continue
        t = row(state.tangent, j)
        m1, m2 = material_frame(row(state.director, j), t, state.q[j, 3])
        h, edge_theta, theta = torque_hessian(m, m1, m2, t, 1.0 / state.length[j], direction)
        r = 4 * (j - held + 1)
        e = (mode[r + 4] - mode[r], mode[r + 5] - mode[r + 1], mode[r + 6] - mode[r + 2])
        turn = mode[r + 3]
        found += dot(times(h, e), e) + 2.0 * turn * dot(edge_theta, e) + theta * turn * turn
    return found


@kernel
def linearise(model, state, mouth, work, linear):
    """Linearise a stable equilibrium about its uniform field.

    Third derivatives of the energy are symmetric: what the stiffness of the mode changes by along
    any way is the way times the change of stiffness times mode along the mode itself. So two
    assemblies serve all components of the field.

    Fills ``linear``; returns the smallest eigenvalue [rad^2/s^2], or zero if the equilibrium is not
    stable, and then nothing is filled.
    """
    if not respond(model, state, mouth, work, linear):
        return 0.0
    rod, held = model.rod, mouth.held
    last = 4 * (state.q.shape[0] - held + 1) - 1
    mix(linear.modes, last)
    value = slowest_modes(work.band, rod, held, linear, last)
    for r in range(last + WIDTH):
        work.step[r] = linear.modes[r, 0] if FIRST <= r < last else 0.0
    probe = bend(model, state, mouth, work, last)
    moved = slopes_along(work, linear.moves, last)
    for axis in range(3):
        turned = turned_by(rod, state, held, axis, work.step)
        linear.slope[axis] = turned + moved[axis] / probe
    return value


@kernel
def steadiness(model, state, mouth, work, linear):
    """Smallest eigenvalue [rad^2/s^2] of an equilibrium in whatever field, 0 if it is not stable.

    Of ``linear`` only what finds the slowest modes is used: they start as a guess.
    """
    held = mouth.held
    still = Motion(0.0, work.target)
    last = 4 * (state.q.shape[0] - held + 1) - 1
    assemble(model, state, mouth, still, work.gradient, work.band)
    if factor(work.band, FIRST, last) >= 0:
        return 0.0
    mix(linear.modes, last)
    return slowest_modes(work.band, model.rod, held, linear, last)
