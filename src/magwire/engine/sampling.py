"""Sampling the outside field along the wire (P-7)."""

from __future__ import annotations

import numpy as np

from magwire.engine.system import System
from magwire.field import FieldSource
from magwire.kernels.arrays import Field, State

SAMPLINGS = 20  # times a field that is not affine is sampled for one state, at most


def sample(system: System, source: FieldSource, state: State) -> Field:
    """Flux density [T] and gradient [T per wire length] at the middle of each edge."""
    middle = 0.5 * (state.q[1:, :3] + state.q[:-1, :3])
    flux, gradient = source.at(middle * system.wire.length)
    slope = np.array(gradient, dtype=np.float64).reshape(-1, 9) * system.wire.length
    return Field(
        flux_density=np.array(flux, dtype=np.float64),
        gradient=slope,
        origin=middle,
        uniform=not bool(np.any(slope)),
    )


def mismatch(system: System, used: Field, now: Field, held: int) -> float:
    """Largest error of force and of torque over edge length [EI/L^2] of samples that were used.

    The kernels take the field to be affine around each sample; where the wire has moved on, that
    differs from the field itself, sampled ``now``.
    """
    moved = now.origin - used.origin
    slope = used.gradient.reshape(-1, 3, 3)
    taken = used.flux_density + np.einsum("eij,ej->ei", slope, moved)
    moment = np.linalg.norm(system.rod.moment, axis=1)
    torque = moment * np.linalg.norm(now.flux_density - taken, axis=1) / system.rod.rest
    force = moment * np.linalg.norm(now.gradient - used.gradient, axis=1)
    return float(max(torque[held:].max(initial=0.0), force[held:].max(initial=0.0)))
