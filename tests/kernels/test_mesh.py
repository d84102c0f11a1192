"""Totals of a wire do not depend on its mesh, wherever its sections end (P-4)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from magwire.wire import Section, Wire, lay_out
from wires import L, paper_wire

from .rods import Array


def three_sections(first: float, second: float) -> tuple[Section, ...]:
    """Sections of different stuff, of the given parts of 0.1 m; the rest is the third."""
    common: dict[str, Any] = {"shear_modulus": 1e6}
    return (
        Section(first * L, 8e6, radius=0.7e-3, density=3000.0, inner_radius=0.3e-3, **common),
        Section(second * L, 3e6, radius=0.6e-3, density=2000.0, rest_curvature=(20, -5), **common),
        Section(
            (1.0 - first - second) * L,
            1e6,
            radius=0.5e-3,
            density=4000.0,
            magnetization=(1e4, -2e4, 1.28e5),
            rest_curvature=(0.0, 30.0),
            **common,
        ),
    )


def totals(wire: Wire) -> Array:
    """Moment (3), mass, volume, axial inertia, compliances (3), rest turn (2) of a whole wire."""
    mesh = lay_out(wire)
    stretch = (mesh.edge_length / mesh.stretching_stiffness).sum()
    bend, twist = (1.0 / mesh.bending_stiffness).sum(), (1.0 / mesh.twisting_stiffness).sum()
    sums = [mesh.mass.sum(), mesh.volume.sum(), mesh.axial_inertia.sum(), stretch, bend, twist]
    return np.concatenate([mesh.moment.sum(axis=0), sums, mesh.rest_turn.sum(axis=0)])


def by_hand(wire: Wire) -> Array:
    """The same from the sections themselves."""
    parts = []
    for s in wire.sections:
        moment = np.array(s.moment_per_length)
        ring = 0.5 * s.density * s.area * (s.radius**2 + s.inner_radius**2)
        soft = [1.0 / s.stretching_stiffness, 1.0 / s.bending_stiffness, 1.0 / s.twisting_stiffness]
        parts.append(
            s.length
            * np.concatenate([moment, [s.density * s.area, s.area, ring], soft, s.rest_curvature])
        )
    return np.asarray(sum(parts))


@settings(max_examples=50)
@given(first=st.floats(0.2, 0.4), second=st.floats(0.2, 0.4), nodes=st.integers(7, 300))
def test_totals(first: float, second: float, nodes: int) -> None:
    wire = Wire(three_sections(first, second), nodes)
    np.testing.assert_allclose(totals(wire), by_hand(wire), rtol=1e-12)


@pytest.mark.parametrize("nodes", [21, 50, 99, 100, 101, 400])
def test_paper_tip(nodes: int) -> None:
    """5 mm of 128 kA/m x pi (0.6 mm)^2, also where 99 edges do not divide 5 mm."""
    moment = lay_out(paper_wire(nodes)).moment
    expected = 128e3 * np.pi * 0.6e-3**2 * 5e-3
    np.testing.assert_allclose(moment.sum(axis=0), [0.0, 0.0, expected], rtol=1e-12)


def test_edges_share_a_section_by_what_they_cover() -> None:
    moment = lay_out(paper_wire(100)).moment[:, 2]
    edge = L / 99
    np.testing.assert_allclose(moment[-4:], moment[-1], rtol=1e-12)
    covered = (5e-3 - 4.0 * edge) / edge
    assert moment[-5] == pytest.approx(covered * moment[-1], rel=1e-9)
    assert np.all(moment[:-5] == 0.0)


def test_paper_stiffness() -> None:
    wire = paper_wire()
    assert wire.bending_stiffness == pytest.approx(3.054e-7, rel=1e-3)
    assert wire.moment_per_length == pytest.approx(0.1448, rel=1e-3)
    section = wire.sections[0]
    assert section.twisting_stiffness == pytest.approx(2.0 / 3.0 * section.bending_stiffness)


def test_cells_and_edges_fill_the_wire() -> None:
    mesh = lay_out(Wire(three_sections(0.3, 0.3), 30))
    cells = np.diff(np.concatenate(([0.0], mesh.cell_end)))
    assert mesh.edge_length.sum() == pytest.approx(L)
    assert cells.sum() == pytest.approx(L)
    np.testing.assert_allclose(cells[[0, -1]], 0.5 * mesh.edge_length[0])


def test_each_node_has_the_radius_of_its_section() -> None:
    mesh = lay_out(Wire(three_sections(0.3, 0.3), 101))
    assert mesh.radius[10] == 0.7e-3
    assert mesh.radius[45] == 0.6e-3
    assert mesh.radius[-1] == 0.5e-3
    assert mesh.radius[30] == 0.7e-3  # where two sections meet, the wider one
    thin_first = lay_out(Wire([*reversed(three_sections(0.3, 0.3))], 101))
    assert thin_first.radius[70] == 0.7e-3
    assert thin_first.radius[69] == 0.6e-3
