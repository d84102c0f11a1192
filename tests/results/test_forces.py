"""Forces along the wire and the lumen from made-up forces on the nodes, where they are known."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import trapezoid

from magwire.results import forces
from magwire.results.forces import Layout
from records import half_circle

Array = NDArray[np.float64]
L = 0.1
NOWHERE = np.zeros((0, 4))
TUBE = np.array([[0.0, 0.0, 0.0, 2e-3], [0.08, 0.0, 0.0, 2e-3]])


def layout(nodes: int = 201, length: float = L, way: Array = NOWHERE) -> Layout:
    return Layout(length, nodes, (0.95 * length, length), way)


def spread(wire: Layout, begin: float, end: float, density: float) -> Array:
    """An even force per length on part of the wire, as forces on its nodes, shape (1, nodes)."""
    inside = np.clip(wire.bounds, begin, end)
    return density * np.diff(inside)[None]


def point(wire: Layout, place: float, force: float) -> Array:
    """A force at a point, on the two nodes next to it."""
    found = np.zeros((1, wire.nodes))
    k = min(int(place / wire.length * (wire.nodes - 1)), wire.nodes - 2)
    share = place / wire.station[1] - k
    found[0, k : k + 2] = force * (1.0 - share), force * share
    return found


def test_patch_is_5_mm_unless_the_edges_are_long_or_the_wire_is_short() -> None:
    assert layout().patch == 5e-3
    assert layout(11).patch == pytest.approx(0.02)
    assert layout(11, 2e-3).patch == 2e-3


@pytest.mark.parametrize("nodes", [61, 121, 481])
@pytest.mark.parametrize("place", [0.04321, 0.0981, L])
def test_a_point_force_is_the_same_on_every_mesh(nodes: int, place: float) -> None:
    wire = layout(nodes)
    force = point(wire, place, 2e-3)
    density = forces.per_length(wire, force)
    assert forces.largest_over(wire, force, wire.patch) == pytest.approx(2e-3, rel=1e-9)
    mirrored = 2.0 * L - place
    hat = [np.maximum(1.0 - np.abs(wire.station - x) / 5e-3, 0.0) for x in (place, mirrored)]
    exact = 2e-3 / 5e-3 * np.sum(hat, axis=0)
    assert density[0] == pytest.approx(exact, abs=0.01 * 2e-3 / 5e-3 * 200 / nodes)


@pytest.mark.parametrize("nodes", [61, 121, 481])
def test_an_even_force(nodes: int) -> None:
    wire = layout(nodes)
    force = spread(wire, 0.03, 0.07, 0.5)
    density = forces.per_length(wire, force)
    assert forces.largest_over(wire, force, 5e-3) == pytest.approx(0.5 * 5e-3, rel=1e-9)
    assert forces.largest_over(wire, force, 0.06) == pytest.approx(0.5 * 0.04, rel=1e-9)
    middle = (wire.station > 0.036) & (wire.station < 0.064)
    assert density[0, middle] == pytest.approx(0.5, rel=0.01)
    assert np.all(density[0, wire.station < 0.024] == 0.0)
    assert forces.contact_length(wire, density) == pytest.approx(0.04, rel=0.03)


def test_the_integral_is_the_sum_up_to_both_ends() -> None:
    rng = np.random.default_rng(3)
    wire = layout(101)
    force = rng.random((4, 101))
    density = forces.per_length(wire, force)
    sums = trapezoid(density, wire.station, axis=1)
    assert sums == pytest.approx(force.sum(axis=1), rel=1e-9)


def test_records_have_the_same_bits_alone_and_together() -> None:
    """How many are written together hangs on the clock."""
    wire = layout(101)
    chance = np.random.default_rng(0)
    force = chance.random((97, 101)) * (chance.random((97, 101)) < 0.2)
    for derived in (forces.per_length, forces.magnet):
        together = derived(wire, force)
        for size in (1, 7, 40):
            parts = [derived(wire, force[k : k + size]) for k in range(0, 97, size)]
            np.testing.assert_array_equal(np.concatenate(parts), together)


def test_sides_do_not_cancel() -> None:
    vectors = np.zeros((1, 201, 3))
    vectors[0, 100, 1], vectors[0, 101, 1] = 1e-3, -1e-3
    assert forces.largest_over(layout(), forces.sizes(vectors), 5e-3) == pytest.approx(2e-3)


@pytest.mark.parametrize("nodes", [100, 101])
def test_the_magnet_has_its_share_of_every_cell(nodes: int) -> None:
    wire = layout(nodes)
    assert forces.magnet(wire, spread(wire, 0.0, L, 0.5)) == pytest.approx(0.5 * 5e-3)
    bare = Layout(L, nodes, (np.nan, np.nan), NOWHERE)
    assert np.isnan(forces.magnet(bare, np.ones((3, nodes)))).all()


def test_contact_length_of_a_point_and_of_nothing() -> None:
    wire = layout(401)
    force = np.concatenate(
        [point(wire, 0.05, 1e-3), point(wire, L, 1e-3), 0.0 * wire.station[None]]
    )
    found = forces.contact_length(wire, forces.per_length(wire, force))
    one_sided = 5e-3 * (1.0 - np.sqrt(0.05))
    assert found == pytest.approx([2.0 * one_sided, one_sided, 0.0], rel=0.03)


def test_forces_along_a_tube_are_where_the_nodes_are() -> None:
    wire = layout(201, way=TUBE)
    position = np.zeros((1, 201, 3))
    position[0, :, 0] = wire.station - 0.04  # fed by 60 mm
    position[0, :, 1] = 1e-3
    force = spread(wire, 0.06, 0.08, 0.5)
    along = forces.per_way(wire, position, force)[0]
    exact = forces.per_length(wire, force)[0]
    at = np.interp(wire.arc, wire.station - 0.04, exact)
    assert along == pytest.approx(at, abs=0.01 * exact.max())
    assert along.sum() * 2.0 * wire.arc[0] == pytest.approx(force.sum(), rel=1e-3)


@pytest.mark.parametrize("place", [0.0, 0.08])
def test_at_the_ends_of_the_way_nothing_is_lost(place: float) -> None:
    wire = layout(201, way=TUBE)
    position, force = np.zeros((2, 201, 3)), np.zeros((2, 201))
    position[:, :, 0], force[1, -1] = place, 3e-3
    along = forces.per_way(wire, position, force)
    assert not along[0].any()
    assert along[1].sum() * 2.0 * wire.arc[0] == pytest.approx(3e-3, rel=1e-3)


def test_on_a_bend_the_arc_is_that_of_the_centreline() -> None:
    line = half_circle(400)
    wire = layout(201, way=np.column_stack([line, np.full(len(line), 3e-3)]))
    position, force = np.zeros((1, 201, 3)), np.zeros((1, 201))
    angle = 1.2
    position[0, -1] = 0.027 * np.array([np.sin(angle), 0.0, 0.0])  # 2 mm outside of the centreline
    position[0, -1, 1] = 0.025 - 0.027 * np.cos(angle)
    force[0, -1] = 1e-3
    along = forces.per_way(wire, position, force)[0]
    assert (along @ wire.arc) / along.sum() == pytest.approx(0.025 * angle, abs=1e-4)


def test_what_presses_in_another_branch_is_not_on_the_way() -> None:
    wire = layout(201, way=TUBE)
    position, force = np.zeros((1, 201, 3)), np.zeros((1, 201))
    position[0, -1] = 0.05, 0.004, 0.0
    force[0, -1] = 1e-3
    assert not forces.per_way(wire, position, force).any()
