"""Sensitivities by the parameters of a wire's sections (P-21) against differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.errors import InputError
from magwire.field import FieldSource, GradientField, UniformField
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Parameter, Section, Stiffness, Wire, lay_out, mesh_rates
from wires import L, lumen

STUFF = {"youngs_modulus": 3e6, "shear_modulus": 1e6, "density": 2000.0}
SECTIONS = (
    Section(0.0533, radius=0.6e-3, inner_radius=0.1e-3, rest_curvature=(8.0, 3.0), **STUFF),
    Section(0.0307, radius=0.5e-3, magnetization=(10e3, 0.0, 30e3), **{**STUFF, "density": 3e3}),
    Section(0.0160, radius=0.6e-3, magnetization=(-5e3, 8e3, 60e3), **STUFF),
)
STEPS: dict[Parameter, float] = {
    "youngs_modulus": 30.0,
    "shear_modulus": 30.0,
    "magnetization": 1.0,
    "radius": 2e-9,
}
FIELD = GradientField(
    (2e-3, 4e-3, 1e-3), ((0.02, 0.03, 0.01), (0.03, -0.04, 0.02), (0.01, 0.02, 0.02))
)


def simulation(sections: tuple[Section, ...], where: str, wall: str) -> Simulation:
    tube = Lumen.open_space() if where == "open" else lumen(where)
    return Simulation(
        Wire(sections, 60),
        tube,
        contact=Barrier(1e3, 1e-4, wall=wall),  # type: ignore[arg-type]
        gravity=(1.0, -3.0, -9.0),
        fluid_density=900.0,
    )


def changed(
    parameter: Parameter,
    index: tuple[int, ...],
    step: float,
    parts: tuple[Section, ...] = SECTIONS,
) -> tuple[Section, ...]:
    sections = list(parts)
    value = np.array(getattr(sections[index[0]], parameter), dtype=np.float64)
    value[index[1:]] += step
    new = tuple(value.tolist()) if value.ndim else float(value)
    sections[index[0]] = replace(sections[index[0]], **{parameter: new})
    return tuple(sections)


CASES: dict[str, tuple[str, str, float, FieldSource]] = {
    "space": ("open", "surface", 0.0704, FIELD),
    "wall on the surface": ("half-circle", "surface", 0.0404, UniformField((1e-3, 4e-3, 4e-3))),
    "wall on the axis": ("half-circle", "centreline", 0.0404, UniformField((1e-3, 4e-3, 4e-3))),
}


@pytest.mark.parametrize("parameter", STEPS)
@pytest.mark.parametrize("case", CASES)
def test_against_differences(case: str, parameter: Parameter) -> None:
    where, wall, feed, field = CASES[case]
    state = simulation(SECTIONS, where, wall).equilibrium(feed, field)
    assert np.any(state.wall_force != 0.0) == (case != "space")
    found = state.sensitivity("positions", wrt=parameter)
    step = STEPS[parameter]
    assert found.shape == (60, 3, 3, 3) if parameter == "magnetization" else (60, 3, 3)
    for index in np.ndindex(*found.shape[2:]):
        ends = [
            simulation(changed(parameter, index, sign * step), where, wall)
            .equilibrium(feed, field, start=state)
            .positions
            for sign in (1.0, -1.0)
        ]
        quotient = (ends[0] - ends[1]) / (2.0 * step)
        size = max(np.abs(found).max(), 1e-12)
        np.testing.assert_allclose(found[(..., *index)], quotient, atol=2e-5 * size)


def twisted_and_tapered() -> tuple[Section, ...]:
    """A taper, a section of stated stiffness, and a magnet that is twisted at rest."""
    first, second, third = SECTIONS
    stated = Stiffness(2e-7, 1.5e-7, 4.0)
    return (
        replace(first, end_radius=0.4e-3),
        replace(second, youngs_modulus=None, shear_modulus=None, stiffness=stated),
        replace(third, rest_twist=60.0, rest_curvature=(10.0, 0.0)),
    )


@pytest.mark.parametrize("parameter", ["magnetization", "youngs_modulus", "radius"])
def test_of_tapers_and_stated_stiffnesses(parameter: Parameter) -> None:
    """By what a section has, the others being what they are."""
    parts = list(twisted_and_tapered())
    if parameter == "youngs_modulus":
        parts[1] = SECTIONS[1]
    if parameter == "radius":
        parts[0] = SECTIONS[0]
    state = simulation(tuple(parts), "open", "surface").equilibrium(0.0704, FIELD)
    found = state.sensitivity("tip", wrt=parameter)
    step = STEPS[parameter]
    for index in np.ndindex(*found.shape[1:]):
        ends = [
            simulation(
                changed(parameter, index, sign * step, tuple(parts)), "open", "surface"
            ).equilibrium(0.0704, FIELD, start=state)
            for sign in (1.0, -1.0)
        ]
        quotient = (ends[0].tip - ends[1].tip) / (2.0 * step)
        size = np.abs(found).max()
        np.testing.assert_allclose(found[(..., *index)], quotient, atol=2e-5 * size)


@pytest.mark.parametrize(
    ("parameter", "section", "why"),
    [
        ("youngs_modulus", 1, "given by its stiffness"),
        ("shear_modulus", 1, "given by its stiffness"),
        ("radius", 0, "tapered"),
    ],
)
def test_a_parameter_that_a_section_does_not_have(
    parameter: Parameter, section: int, why: str
) -> None:
    state = simulation(twisted_and_tapered(), "open", "surface").equilibrium(0.0704)
    words = f"received '{parameter}', and section {section} of the wire is {why}."
    with pytest.raises(InputError, match=words):
        state.sensitivity("tip", wrt=parameter)


def test_stiffness_and_magnet_cancel() -> None:
    """Without weight and wall the shape depends on M B/E alone: E d/dE = -M d/dM (uniform wire)."""
    wire = Wire.uniform(L, 0.6e-3, 3e6, 1e6, 2000.0, 60, magnetized_tip=L, magnetization=20e3)
    state = Simulation(wire, Lumen.open_space()).equilibrium(L, [0.0, 1e-3, 0.0])
    stiff = 3e6 * state.sensitivity("tip", wrt="youngs_modulus")[:, 0]
    magnet = 20e3 * state.sensitivity("tip", wrt="magnetization")[:, 0, 2]
    assert np.abs(stiff).max() > 0.01 * L
    np.testing.assert_allclose(stiff, -magnet, atol=1e-9 * L)
    assert np.abs(state.sensitivity("tip", wrt="shear_modulus")).max() == 0.0


@pytest.mark.parametrize("parameter", STEPS)
def test_rates_of_the_mesh(parameter: Parameter) -> None:
    step = 1e-4 * np.max(np.abs(getattr(SECTIONS[1], parameter)))
    rates = mesh_rates(Wire(SECTIONS, 37), parameter)
    indices = list(np.ndindex(3, 3)) if parameter == "magnetization" else [(0,), (1,), (2,)]
    for rate, index in zip(rates, indices, strict=True):
        up, down = (lay_out(Wire(changed(parameter, index, s * step), 37)) for s in (1.0, -1.0))
        for name, value in vars(rate).items():
            if name == "axial_inertia":  # does not count at rest
                continue
            quotient = (getattr(up, name) - getattr(down, name)) / (2.0 * step)
            size = np.abs(quotient).max() + 1e-12 * np.abs(getattr(up, name)).max() / step
            np.testing.assert_allclose(value, quotient, atol=1e-6 * size, err_msg=name)
