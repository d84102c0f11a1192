"""What a wire's mesh changes by when a parameter of a section changes (P-4, P-21)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from magwire.errors import InputError
from magwire.wire.mesh import Cells, Mesh, lay_out
from magwire.wire.section import Section
from magwire.wire.wire import Wire

Array = NDArray[np.float64]
Parameter = Literal["youngs_modulus", "shear_modulus", "magnetization", "radius"]


@dataclass(frozen=True)
class _Rate:
    """By how much less a piece gives way, and what more there is of it, per unit of a parameter.

    Of stretching, bending and twisting -d(1/EA), -d(1/EI), -d(1/GJ); and the derivatives of moment
    per length, area and radius.
    """

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

    Raises
    ------
    InputError
        If a section has no such parameter: no modulus if its stiffness is given, and no one radius
        if it is tapered.
    """
    for i, section in enumerate(wire.sections):
        _refuse_missing(section, parameter, i)
    mesh, cells = lay_out(wire), Cells(wire)
    still = replace(mesh, **{name: 0.0 * value for name, value in vars(mesh).items()})
    changes = []
    for i in range(len(wire.sections)):
        own = np.flatnonzero(cells.owner == i)
        for rates in zip(*(_piece_rates(cells.pieces[k], parameter) for k in own), strict=True):
            every = [_Rate()] * len(cells.pieces)
            for k, rate in zip(own, rates, strict=True):
                every[k] = rate
            changes.append(_change(mesh, still, cells, every))
    return changes


def _refuse_missing(section: Section, parameter: Parameter, index: int) -> None:
    stated = section.stiffness is not None and parameter in ("youngs_modulus", "shear_modulus")
    if stated or (section.end_radius is not None and parameter == "radius"):
        why = "is given by its stiffness" if stated else "is tapered"
        raise InputError(
            "Input wrt of sensitivity must be a parameter that every section has; received "
            f"{parameter!r}, and section {index} of the wire {why}."
        )


def _change(mesh: Mesh, still: Mesh, cells: Cells, rates: list[_Rate]) -> Mesh:
    """What the mesh changes by when its pieces do."""

    def over(bounds: Array, name: str) -> Array:
        return cells.spread(bounds, np.array([getattr(rate, name) for rate in rates]))

    area = over(cells.bounds, "area")
    density = np.array([piece.density for piece in cells.pieces])
    thicker = np.array([rate.radius for rate in rates])
    heavier = density * np.array([rate.area for rate in rates])
    edges = over(cells.station, "stretching") / mesh.edge_length
    return replace(
        still,
        stretching_stiffness=mesh.stretching_stiffness**2 * edges,
        bending_stiffness=mesh.bending_stiffness**2 * over(cells.bounds, "bending"),
        twisting_stiffness=mesh.twisting_stiffness**2 * over(cells.bounds, "twisting"),
        moment=cells.moments(np.array([rate.moment for rate in rates])),
        mass=cells.spread(cells.bounds, heavier),
        volume=area,
        radius=thicker[cells.which],
    )


def _piece_rates(piece: Section, parameter: Parameter) -> list[_Rate]:
    """Derivatives of what a piece is to the mesh; a bore keeps its radius."""
    ea, ei, gj = piece.stretching_stiffness, piece.bending_stiffness, piece.twisting_stiffness
    young, shear = piece.youngs_modulus, piece.shear_modulus
    if parameter == "youngs_modulus" and young is not None:
        return [_Rate(stretching=1.0 / (ea * young), bending=1.0 / (ei * young))]
    if parameter == "shear_modulus" and shear is not None:
        return [_Rate(twisting=1.0 / (gj * shear))]
    if parameter == "magnetization":
        return [_Rate(moment=tuple(piece.area * axis)) for axis in np.eye(3)]
    wider, stiffer = 2.0 * math.pi * piece.radius, math.pi * piece.radius**3
    m1, m2, m3 = piece.magnetization
    thicker = _Rate(moment=(m1 * wider, m2 * wider, m3 * wider), area=wider, radius=1.0)
    if young is None or shear is None:
        return [thicker]  # what is stated stays
    return [
        replace(
            thicker,
            stretching=young * wider / ea**2,
            bending=young * stiffer / ei**2,
            twisting=2.0 * shear * stiffer / gj**2,
        )
    ]
