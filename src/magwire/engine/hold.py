"""Equilibria of a wire whose far end is held, too: carried to a place and turned there (P-16).

What is held is no unknown: the last edge, with its two nodes and its angle. It is carried there in
short steps, with an equilibrium after each of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magwire.engine.point import cut_off, free_rows
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.engine.uneven import Settled
from magwire.errors import InputError, array, finite
from magwire.kernels.arrays import Field, Motion, Mouth, State, Work
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import factor, solve
from magwire.kernels.frames import update_frames
from magwire.kernels.history import copy_configuration
from magwire.kernels.newton import (
    ARMIJO,
    HALVINGS,
    ROUND_OFF,
    SHIFT_GROWTH,
    SHIFTS,
    Limits,
    take_step,
)
from magwire.kernels.wall.collision import allowed_part

Array = NDArray[np.float64]

PLACE = 0.1  # largest step of the tip, in edges
ANGLE = 0.05  # largest step of its direction, and of its turn [rad]


@dataclass(frozen=True, eq=False)
class Hold:
    """Where the far end of a wire is held, and how it is turned.

    Parameters
    ----------
    position
        Place of the tip, shape (3,) [m].
    direction
        Direction of the last edge, shape (3,).
    turn
        Angle by which the end is turned about its axis, from how it is carried there without
        [rad].

    Raises
    ------
    InputError
        If shapes do not fit, a value is not finite, or the direction is none.
    """

    position: ArrayLike
    direction: ArrayLike
    turn: float = 0.0

    def __post_init__(self) -> None:
        position = array("Hold", "position", self.position, (3,), "m")
        direction = array("Hold", "direction", self.direction, (3,))
        size = float(np.linalg.norm(direction))
        if not size > 0.0:
            raise InputError("Input direction of Hold must not be zero; received [0, 0, 0].")
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "direction", direction / size)
        object.__setattr__(self, "turn", finite("Hold", "turn", self.turn, "rad"))


def carry(system: System, field: Field, state: State, mouth: Mouth, hold: Hold) -> Settled:
    """Carry the far end to where it is held, from where it is, and bring the rest to rest."""
    model = system.new_terms(field)
    length, edge = system.wire.length, float(system.rod.rest[-1])
    start, turn = state.q[-1, :3].copy(), float(state.q[-2, 3])
    tangent = state.tangent[-1].copy()
    way = np.asarray(hold.position) / length - start
    axis, angle = _turning(tangent, np.asarray(hold.direction))
    steps = max(
        1,
        math.ceil(float(np.linalg.norm(way)) / (PLACE * edge)),
        math.ceil(max(angle, abs(hold.turn)) / ANGLE),
    )
    work, base = system.new_work(), system.new_state()
    taken, size = 0, 0.0
    for k in range(1, steps + 1):
        part = k / steps
        copy_configuration(state, base, mouth.held)
        state.q[-1, :3] = start + part * way
        state.q[-2, :3] = state.q[-1, :3] - edge * _turned(tangent, axis, part * angle)
        state.q[-2, 3] = turn + part * hold.turn
        update_frames(base, state, mouth.held)
        status, taken, size = _newton(model, state, mouth, work, system.sharp_limits())
        if status != Status.CONVERGED:
            return Settled(field, status.remedy, taken, size)
    return Settled(field, "", taken, size)


def _turning(before: Array, after: Array) -> tuple[Array, float]:
    """Axis and angle of the shortest rotation between two unit vectors."""
    axis = np.cross(before, after)
    size = float(np.linalg.norm(axis))
    angle = math.atan2(size, float(before @ after))
    if size > 1e-12:
        return axis / size, angle
    if angle > 1.0:
        raise InputError(
            "Input direction of Hold must not be opposite to where the wire points, which leaves "
            "open which way round it is carried; go there by another hold."
        )
    return np.zeros(3), 0.0


def _turned(vector: Array, axis: Array, angle: float) -> Array:
    """A vector across an axis, turned about it."""
    result: Array = math.cos(angle) * vector + math.sin(angle) * np.cross(axis, vector)
    return result


def _newton(
    model: Any, state: State, mouth: Mouth, work: Work, limits: Limits
) -> tuple[Status, int, float]:
    """Newton's method as in the kernels, but for the rows of the far end (P-16)."""
    still, held = Motion(0.0, work.target), mouth.held
    nodes = len(state.q)
    last = free_rows(nodes, held, far_held=True)
    free = slice(held - 1, nodes)
    energy, _ = assemble(model, state, mouth, still, work.gradient, work.band)
    for iteration in range(limits.iterations):
        forces = work.gradient[free].ravel()[FIRST:last].copy()
        size = float(np.abs(forces).max())
        if size <= limits.tolerance:
            return Status.CONVERGED, iteration, size
        if not energy < np.inf:
            return Status.PENETRATING, iteration, size
        if not _factorise(model, state, mouth, work, limits):
            return Status.STALLED, iteration, size
        work.step[:] = 0.0
        work.step[FIRST:last] = -forces
        solve(work.band, work.step, FIRST, last)
        slope = float(forces @ work.step[FIRST:last])
        share = allowed_part(model.rod, model.lumen, model.wall, state.q, work.step, held, 0.0)
        slack = ROUND_OFF * (1.0 + abs(energy))
        copy_configuration(state, work.trial, held)
        for _ in range(HALVINGS):
            take_step(work.trial, state, held, share, work.step)
            lower, _ = assemble(model, state, mouth, still, work.gradient, work.no_band)
            if lower <= energy + ARMIJO * share * slope + slack:
                break
            share *= 0.5
        else:
            copy_configuration(work.trial, state, held)
            return Status.STALLED, iteration, size
        energy, _ = assemble(model, state, mouth, still, work.gradient, work.band)
    return Status.TOO_MANY_ITERATIONS, limits.iterations, size


def _factorise(model: Any, state: State, mouth: Mouth, work: Work, limits: Limits) -> bool:
    """Factorise the band of the free rows, regularised as far as it takes (P-14)."""
    last, shift = free_rows(len(state.q), mouth.held, far_held=True), 0.0
    still, rod, first = Motion(0.0, work.target), model.rod, mouth.held - 1
    lumped = np.column_stack([rod.mass] * 3 + [np.append(rod.inertia, 0.0)])[first:].ravel()
    for _ in range(SHIFTS):
        cut_off(work.band, last)
        if factor(work.band, FIRST, last) < 0:
            return True
        shift = max(limits.shift, SHIFT_GROWTH * shift)
        assemble(model, state, mouth, still, work.gradient, work.band)
        work.band[: len(lumped), 0] += shift * lumped
    return False
