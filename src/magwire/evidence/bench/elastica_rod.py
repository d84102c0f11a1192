"""The magnetic cantilever as PyElastica's Cosserat rod: explicit steps, shear and rotation free."""

from __future__ import annotations

import time
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
COURANT = 0.35  # time step over that of a longitudinal wave along an edge; more falls apart


def time_step(length: float, nodes: int, youngs_modulus: float, density: float) -> float:
    """Dt that the explicit method bears [s]."""
    return COURANT * length / (nodes - 1) / float(np.sqrt(youngs_modulus / density))


def cantilever(
    shape: dict[str, float],
    nodes: int,
    duration: float,
    damping: float,
    couple: tuple[float, Array],
) -> tuple[Array, float, float]:
    """Let a straight clamped rod go in a field.

    Its first element is held and reaches half its length in front of the origin: a rod whose first
    element is held is clamped at the middle of that element.

    Parameters
    ----------
    shape
        ``length``, ``radius``, ``density``, ``youngs_modulus``, ``shear_modulus``, in SI units.
    nodes
        Number of nodes.
    duration
        Simulated time [s].
    damping
        Against all velocities [1/s].
    couple
        Magnetic moment per length, along the rod [A m]; flux density, shape (3,) [T].

    Returns
    -------
    tuple
        Tip, shape (3,) [m]; time that a step took [s]; time step [s].
    """
    ea: Any = import_module("elastica")

    class System(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):  # type: ignore[misc]
        """What can be done to the rod."""

    class Couples(ea.NoForces):  # type: ignore[misc]
        """Torque m x B on every element, in its own frame."""

        def apply_torques(self, system: Any, time: float = 0.0) -> None:
            across = np.einsum("ijk,j->ik", system.director_collection, moment * flux)
            system.external_torques[0] -= across[1]
            system.external_torques[1] += across[0]

    edge = shape["length"] / (nodes - 1.5)
    moment, flux = couple[0] * edge, couple[1]
    step = time_step(shape["length"], nodes, shape["youngs_modulus"], shape["density"])
    world = System()
    rod = ea.CosseratRod.straight_rod(
        nodes - 1,
        np.array([-0.5 * edge, 0.0, 0.0]),
        np.array([1.0, 0.0, 0.0]),
        np.array([0.0, 0.0, 1.0]),
        edge * (nodes - 1),
        shape["radius"],
        shape["density"],
        youngs_modulus=shape["youngs_modulus"],
        shear_modulus=shape["shear_modulus"],
    )
    world.append(rod)
    world.constrain(rod).using(
        ea.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    world.add_forcing_to(rod).using(Couples)
    world.dampen(rod).using(
        ea.AnalyticalLinearDamper, uniform_damping_constant=damping, time_step=step
    )
    world.finalize()
    method, now = ea.PositionVerlet(), np.float64(0.0)
    now = method.step(world, now, step)  # compiles
    steps = round(duration / step)
    began = time.perf_counter()
    for _ in range(steps):
        now = method.step(world, now, step)
    seconds = (time.perf_counter() - began) / steps
    return rod.position_collection[:, -1].copy(), seconds, step
