"""A wire that is let go: time steps from an equilibrium in another field, and their balances."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magwire.engine.point import Point
from magwire.engine.sampling import sample
from magwire.engine.statics import Equilibrium
from magwire.field import FieldSource
from magwire.kernels.arrays import Work
from magwire.kernels.history import copy_state
from magwire.kernels.march import Drive, Tally, march
from magwire.kernels.newton import CONVERGED

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Swing:
    """What a wire did, step by step.

    Attributes
    ----------
    time
        Shape (steps + 1,) [s].
    positions, velocities
        Shape (steps + 1, nodes, 3) [m, m/s].
    energy
        Kinetic and potential energy, shape (steps + 1,) [J].
    guide_force
        Force of the guide on the free nodes, shape (steps + 1, 3) [N].
    held
        Number of nodes on the guide.
    """

    time: Array
    positions: Array
    velocities: Array
    energy: Array
    guide_force: Array
    held: int


def let_go(start: Equilibrium, source: FieldSource, time_step: float, steps: int) -> Swing:
    """Implicit Euler steps from an equilibrium at rest, in a field that is affine.

    The damping is that of the equilibrium's own simulation.
    """
    system, mouth = start.point.system, start.point.mouth
    state = system.new_state()
    copy_state(start.point.state, state)
    feed = start.feed / system.wire.length
    point = Point(system, sample(system, source, state), state, mouth)
    model = system.new_terms(point.field)
    drive = Drive(
        np.array([feed]), np.array([start.twist]), np.zeros((1, 3)), time_step, system.damping, True
    )
    limits = system.step_limits()._replace(tolerance=1e-8, step=0.0)
    work, spare = system.new_work(), system.new_work()
    rows = [_row(point, spare)]
    for _ in range(steps):
        tally = Tally(np.zeros(4), np.zeros(3))
        _, status = march(model, system.guide, state, work, limits, drive, tally)
        if status != CONVERGED or tally.counts[3] > 0:
            raise RuntimeError("A time step did not converge, or not in one piece.")
        rows.append(_row(point, spare))
    columns: list[Array] = [np.array(column) for column in zip(*rows, strict=True)]
    time = time_step * np.arange(0.0, steps + 1.0)
    positions, velocities, energy, force = columns
    return Swing(time, positions, velocities, energy, force, mouth.held)


def _row(point: Point, work: Work) -> tuple[Array, Array, float, Array]:
    """Positions, velocities, energy and the guide's force at one time, in SI."""
    system, held = point.system, point.mouth.held
    length, force = system.wire.length, system.scales.force
    mass, inertia = system.mesh.mass[held:], system.mesh.axial_inertia[held - 1 :]
    velocity = point.state.velocity
    speed = velocity[1:, :3] * length
    kinetic = 0.5 * float(mass @ (speed[held:] ** 2).sum(axis=1))
    kinetic += 0.5 * float(inertia @ velocity[held:-1, 3] ** 2)
    energy, gradient = point.energy(work)
    return (
        point.state.q[1:, :3] * length,
        speed,
        kinetic + energy * force * length,
        gradient[: held + 1, :3].sum(axis=0) * force,
    )
