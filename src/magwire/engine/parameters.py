"""How the forces in an equilibrium change with a parameter of the wire's sections (P-21).

The gradient is linear in stiffnesses, moments and weights, so that part comes from differences of
gradients without error. A thicker wire also meets the wall sooner: that part is the barrier's
second derivative.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.point import Point
from magwire.engine.system import System
from magwire.kernels.arrays import Work
from magwire.kernels.barrier import barrier
from magwire.kernels.observe import observe
from magwire.wire import Mesh, Parameter, mesh_rates

Array = NDArray[np.float64]


def parameter_loads(
    point: Point, parameter: Parameter, work: Work
) -> tuple[Array, tuple[int, ...]]:
    """Derivatives of the scaled gradient, shape [inputs, nodes + 1, 4], and the input's shape."""
    system = point.system
    base = point.gradient(work)
    loads = []
    for change in mesh_rates(system.wire, parameter):
        rates = _scaled(system, change)
        size = max(float(np.abs(rate).max()) for rate in rates.values())
        moved = {name: getattr(system.rod, name) + rate / size for name, rate in rates.items()}
        load = (point.gradient(work, rod=system.rod._replace(**moved)) - base) * size
        if system.contact.wall == "surface" and np.any(change.radius):
            load += _nearer(point, change.radius, work)
        loads.append(load)
    count = len(system.wire.sections)
    return np.stack(loads), (count, 3) if parameter == "magnetization" else (count,)


def _scaled(system: System, change: Mesh) -> dict[str, Array]:
    """What changes of the rod's arrays, apart from where its surface is."""
    length = system.wire.length
    energy = system.wire.bending_stiffness / length
    mass = change.mass - system.fluid_density * change.volume
    none = np.zeros((1, 3))
    return {
        "stretch": np.append(0.0, change.stretching_stiffness) * length / energy,
        "bend": np.append(0.0, change.bending_stiffness) / energy,
        "twist": np.append(0.0, change.twisting_stiffness) / energy,
        "moment": np.concatenate((none, change.moment)) / energy,
        "weight": np.concatenate((none, np.outer(mass, system.gravity))) * length / energy,
    }


def _nearer(point: Point, thicker: Array, work: Work) -> Array:
    """Change of the gradient as the wire's surface moves out, by the rate of each node's radius.

    The wall's force is along the gap's gradient and b'(d) long; d falls with the radius.
    """
    system, state = point.system, point.state
    wall = system.new_wall()
    model = (system.rod, point.field, wall, system.walls)
    force, clearance = np.zeros((len(state.q), 3)), np.zeros(len(state.q))
    observe(model, state, point.mouth, work, force, clearance)
    load = np.zeros((len(state.q), 4))
    for i in np.flatnonzero(np.any(force != 0.0, axis=1)):
        _, first, second = barrier(clearance[i], wall.gap)
        load[i, :3] = force[i] * (second / first * thicker[i - 1] / system.wire.length)
    return load
