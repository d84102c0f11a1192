"""What a wire's mesh changes by when a parameter of a section changes (P-4, P-21)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from magwire.wire.mesh import Cells, Mesh, lay_out
from magwire.wire.section import Section
from magwire.wire.wire import Wire

Array = NDArray[np.float64]
Parameter = Literal["youngs_modulus", "shear_modulus", "magnetization", "radius"]


@dataclass(frozen=True)
class _Rate:
    """Derivatives of EA, EI, GJ, moment per length, area and radius of a section."""

    stretching: float = 0.0
    bending: float = 0.0
    twisting: float = 0.0
    moment: tuple[float, float, float] = (0.0, 0.0, 0.0)
    area: float = 0.0
    radius: float = 0.0


def mesh_rates(wire: Wire, parameter: Parameter) -> list[Mesh]:
    """Derivatives of the mesh by a parameter of each section, in their order.

    Where the parameter is a vector, its components follow each other within a section. What does
    not count at rest is left out: the moment of inertia about the axis keeps a rate of zero.
    """
    mesh, cells = lay_out(wire), Cells(wire)
    still = replace(mesh, **{name: 0.0 * value for name, value in vars(mesh).items()})
    rates = []
    for i, section in enumerate(wire.sections):
        here = np.zeros(len(wire.sections))
        here[i] = 1.0
        edges, nodes = cells.spread(cells.station, here), cells.spread(cells.bounds, here)
        for rate in _section_rates(section, parameter):
            stretch = rate.stretching / section.stretching_stiffness**2 / mesh.edge_length
            bend = rate.bending / section.bending_stiffness**2
            twist = rate.twisting / section.twisting_stiffness**2
            change = replace(
                still,
                stretching_stiffness=mesh.stretching_stiffness**2 * stretch * edges,
                bending_stiffness=mesh.bending_stiffness**2 * bend * nodes,
                twisting_stiffness=mesh.twisting_stiffness**2 * twist * nodes,
                moment=np.outer(edges, rate.moment),
                mass=section.density * rate.area * nodes,
                volume=rate.area * nodes,
                radius=np.where(cells.which == i, rate.radius, 0.0),
            )
            rates.append(change)
    return rates


def _section_rates(section: Section, parameter: Parameter) -> list[_Rate]:
    """Derivatives of what a section is to the mesh; a bore keeps its radius."""
    area, second = section.area, section.second_moment
    if parameter == "youngs_modulus":
        return [_Rate(stretching=area, bending=second)]
    if parameter == "shear_modulus":
        return [_Rate(twisting=2.0 * second)]
    if parameter == "magnetization":
        return [_Rate(moment=tuple(area * axis)) for axis in np.eye(3)]
    wider, stiffer = 2.0 * math.pi * section.radius, math.pi * section.radius**3
    m1, m2, m3 = section.magnetization
    return [
        _Rate(
            stretching=section.youngs_modulus * wider,
            bending=section.youngs_modulus * stiffer,
            twisting=2.0 * section.shear_modulus * stiffer,
            moment=(m1 * wider, m2 * wider, m3 * wider),
            area=wider,
            radius=1.0,
        )
    ]
