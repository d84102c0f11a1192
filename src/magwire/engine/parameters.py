"""How the forces in an equilibrium change with a parameter of the wire's sections (P-21).

The gradient is linear in stiffnesses, moments and weights, so that part comes from differences of
gradients without error. A thicker wire also meets the wall sooner: that part comes from
differences, too, in steps that are small against the clearance.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.point import Point
from magwire.engine.system import System
from magwire.kernels.arrays import Motion, Wall, Work
from magwire.kernels.assembly import assemble
from magwire.wire import Mesh, Parameter, mesh_rates

Array = NDArray[np.float64]

PROBE = 3e-4  # of the smallest clearance


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
        if np.any(change.radius):
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

    It meets the wall sooner if the wall keeps it off, and presses on more of one that gives way.
    From differences: the step is so small a part of the smallest clearance that what they leave
    out is below a millionth.
    """
    system, state = point.system, point.state
    model = system.new_terms(point.field)
    _, nearest = assemble(
        model, state, point.mouth, Motion(0.0, work.target), work.gradient, work.no_band
    )
    if not nearest < np.inf:
        return np.zeros((len(state.q), 4))
    rate = np.append(0.0, thicker) / system.wire.length
    step = PROBE * nearest / float(np.abs(rate).max())
    out = rate if system.contact.wall == "surface" else 0.0 * rate
    there, here = (
        point.gradient(
            work,
            rod=system.rod._replace(offset=system.rod.offset + sign * step * out),
            wall=_wider(system, sign * step * rate),
        )
        for sign in (1.0, -1.0)
    )
    load: Array = (there - here) / (2.0 * step)
    return load


def _wider(system: System, change: Array) -> Wall:
    """The wall for a wire whose nodes are thicker: more of its foundation bears."""
    wall = system.new_wall()
    radius = np.append(system.mesh.radius[0], system.mesh.radius) / system.wire.length
    ratio = wall.bed.ratio * radius / (radius + change)
    return wall._replace(bed=wall.bed._replace(ratio=ratio))
