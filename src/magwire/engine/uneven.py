"""Equilibria in fields that are not linear in space (P-7, P-16).

The kernels take the field to be affine around the places where it was sampled. To look for the
equilibrium, sample again where it is, and so on, is a fixed point iteration: it diverges where the
field varies strongly along the wire. A pull c m (x - x_0) back to where the field was sampled makes
each step as short as need be. The wire then creeps down its energy like in a viscous fluid; where
it comes to rest it is in equilibrium, and in a stable one of the true field.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.engine.sampling import mismatch, sample
from magwire.engine.status import Status
from magwire.engine.system import System
from magwire.field import FieldSource
from magwire.kernels.arrays import Field, Motion, Mouth, State, Work
from magwire.kernels.history import copy_configuration
from magwire.kernels.newton import Limits, newton

Array = NDArray[np.float64]

REFUSED = (
    "the wire does not come to rest; a magnet that attracts it may be too near or too strong; "
    "try a weaker field, or a start in a field that is nearly the same"
)
STEPS = 1000
ITERATIONS = 4000
"""Of Newton's method, in all steps."""
TRIES = 100
"""Iterations in one step, before the pull is made stronger."""
REACH = 0.1
"""Longest move of a node in one step, in wire lengths."""
FIRST = 10.0
"""Pull that is tried first, in units of Newton's first regularisation."""
STRONGER, STRONG, WEAKER = 4.0, 2.0, 0.7
TURN = 0.5
"""Part of a step that the next may take back, or repeat, without a change of the pull."""


class Settled(NamedTuple):
    """How a state came to rest: samples of the field there; why it did not, or nothing."""

    field: Field
    reason: str
    iterations: int
    residual: float


def settle(system: System, source: FieldSource, state: State, mouth: Mouth, work: Work) -> Settled:
    """Bring a state to rest in a field that is not linear in space."""
    limits, held = system.sharp_limits(), mouth.held
    short = limits._replace(iterations=TRIES)
    wall, base = system.new_wall(), system.new_state()
    weight = np.column_stack([system.rod.mass] * 3 + [np.append(system.rod.inertia, 0.0)])
    samples = sample(system, source, state)
    pull, iterations, residual, before = 0.0, 0, np.inf, np.zeros_like(state.q)
    for _ in range(STEPS):
        copy_configuration(state, base, held)
        work.target[:] = state.q
        model = system.new_terms(samples, wall=wall)
        status, taken, _, residual, _ = newton(
            model, state, mouth, Motion(pull, work.target), work, short
        )
        iterations += taken
        way = state.q - work.target
        if status == Status.PENETRATING:
            return Settled(samples, Status.PENETRATING.remedy, iterations, residual)
        if iterations > ITERATIONS:
            break
        if status != Status.CONVERGED or np.abs(way[:, :3]).max() > REACH:
            copy_configuration(base, state, held)
            pull = max(FIRST * limits.shift, STRONGER * pull)
            continue
        used, samples = samples, sample(system, source, state)
        off = mismatch(system, used, samples, held)
        left = pull * float(np.abs(weight * way).max())
        if max(off, left) <= limits.tolerance:
            return Settled(samples, "", iterations, residual + left)
        pull = _next(pull, limits, way, before)
        before = way
    return Settled(samples, REFUSED, iterations, residual)


def _next(pull: float, limits: Limits, way: Array, before: Array) -> float:
    """Pull of the next step: stronger if the wire turns back, weaker if it goes on."""
    along = float(np.sum(way[:, :3] * before[:, :3]))
    size = float(np.sum(before[:, :3] ** 2))
    if along < -TURN * size:
        return max(FIRST * limits.shift, STRONG * pull)
    return WEAKER * pull if along > TURN * size and pull > FIRST * limits.shift else pull
