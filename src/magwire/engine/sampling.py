"""Sampling the outside field along the wire (P-7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.system import System
from magwire.field import FieldSource
from magwire.kernels.arrays import Field, State

Array = NDArray[np.float64]

SAMPLINGS = 20  # times a field that is not affine is sampled for one time step, at most
DIFFERENCE = 1e-4  # of places, in wire lengths


def sample(system: System, source: FieldSource, state: State) -> Field:
    """Background along the wire, [T] and [T per wire length], and an actuator without inputs."""
    middle = 0.5 * (state.q[1:, :3] + state.q[:-1, :3])
    flux, gradient = source.at(middle * system.wire.length)
    slope = np.array(gradient, dtype=np.float64).reshape(-1, 9) * system.wire.length
    return Field(
        flux_density=np.array(flux, dtype=np.float64),
        gradient=slope,
        origin=middle,
        uniform=np.array([not system.sources and source.affine and not np.any(slope)]),
        sources=system.sources,
        strength=system.idle_strength.copy(),
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


def unsampled_stiffness(system: System, source: FieldSource, state: State) -> Array:
    """What second derivatives of the field add to the stiffness, by the middle of each edge.

    Shape (edges, 3, 3), scaled: -M_i d^2 B_i / dx_j dx_k, from differences of the gradient.
    """
    middle = 0.5 * (state.q[1:, :3] + state.q[:-1, :3])
    first, third, angle = state.director, state.tangent, state.q[:-1, 3:]
    second = np.cross(third, first)
    m1 = np.cos(angle) * first + np.sin(angle) * second
    m2 = np.cos(angle) * second - np.sin(angle) * first
    moment = np.einsum("ei,iej->ej", system.rod.moment, np.stack([m1, m2, third]))
    length = system.wire.length
    slopes = [
        (source.at((middle + step) * length)[1] - source.at((middle - step) * length)[1])
        / (2.0 * DIFFERENCE)
        for step in DIFFERENCE * np.eye(3)
    ]
    result = -length * np.einsum("ei,keij->ejk", moment, np.stack(slopes))
    symmetric: Array = 0.5 * (result + np.swapaxes(result, 1, 2))
    return symmetric
