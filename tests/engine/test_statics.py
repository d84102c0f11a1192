"""Equilibria and their certificate (P-16)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.errors import ConvergenceError, InputError
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from wires import L, flux, free, lumen, magnet, paper_wire


def half_circle() -> Simulation:
    return Simulation(paper_wire(), lumen("half-circle"), contact=Barrier(1e3, 1e-4, wall="centreline"))


@pytest.mark.parametrize("feed", [0.0, 0.0007, 0.02, 0.0404, 0.072])
def test_certificate(feed: float) -> None:
    state = half_circle().equilibrium(feed)
    assert state.feed == feed
    assert state.stable
    assert state.residual < 1e-7 * half_circle().system.scales.force
    held = np.isnan(state.clearance)
    assert held.sum() == pytest.approx(100 * (1.0 - feed / L), abs=1)
    assert np.all(state.clearance[~held] > 0.0)
    assert np.all(state.wall_force[held] == 0.0)
    assert np.isfinite(state.positions).all()
    assert state.tip_force == np.linalg.norm(state.wall_force[-1])
    pressed = np.linalg.norm(state.wall_force, axis=1) > 0.0
    assert np.all(state.clearance[pressed] < 1e-4)


@pytest.mark.parametrize("feed", [0.03, 0.0404, 0.06])
def test_continuation_finds_what_is_found_directly(feed: float) -> None:
    sim = half_circle()
    direct = sim.equilibrium(feed)
    for begin in (0.01, feed - 3e-4, 0.072):  # from less fed, and from more
        there = sim.equilibrium(feed, start=sim.equilibrium(begin))
        np.testing.assert_allclose(there.positions, direct.positions, atol=1e-7 * L)
        np.testing.assert_allclose(
            there.wall_force, direct.wall_force, atol=1e-5 * np.abs(direct.wall_force).max()
        )


def test_a_start_is_left_as_it_was() -> None:
    sim = half_circle()
    start = sim.equilibrium(0.03)
    before = start.positions.copy()
    sim.equilibrium(0.05, [0.0, 5e-3, 0.0], start=start)
    assert np.all(start.positions == before)


def test_a_straight_wire_in_a_strong_antiparallel_field_is_unstable() -> None:
    wire = magnet(100)
    sim = free(wire)
    state = sim.equilibrium(L, flux(wire, 5.0, 180.0))
    assert not state.stable
    np.testing.assert_allclose(state.tip, [L, 0.0, 0.0], atol=1e-9 * L)
    bent = sim.equilibrium(L, flux(wire, 5.0, 179.0))
    assert bent.stable
    assert bent.tip[0] < 0.1 * L


def test_two_equilibria_by_two_starts() -> None:
    """In an antiparallel field the wire may bend to either side: the start decides."""
    wire = magnet(100)
    sim = free(wire)
    field = flux(wire, 5.0, 180.0)
    left = sim.equilibrium(L, field, start=sim.equilibrium(L, flux(wire, 5.0, 150.0)))
    right = sim.equilibrium(L, field, start=sim.equilibrium(L, flux(wire, 5.0, -150.0)))
    assert left.tip[1] > 0.5 * L
    np.testing.assert_allclose(right.tip, left.tip * [1.0, -1.0, 1.0], atol=1e-6 * L)


def test_an_arch_snaps_and_its_branch_ends() -> None:
    """Turning the antiparallel field past 180 degrees: held on its side, then over to the other.

    Both states exist for a while, with the same field: a hysteresis.
    """
    wire = magnet(60)
    sim = free(wire)
    state = sim.equilibrium(L, flux(wire, 5.0, 150.0))
    sides = []
    for degrees in np.arange(150.0, 300.0, 2.0):
        state = sim.equilibrium(L, flux(wire, 5.0, degrees), start=state)
        sides.append(np.sign(state.tip[1]))
    assert sides[0] == 1.0
    assert sides[-1] == -1.0
    switch = 150.0 + 2.0 * int(np.argmin(sides))
    assert 182.0 < switch < 270.0
    direct = sim.equilibrium(L, flux(wire, 5.0, 182.0))
    assert np.sign(direct.tip[1]) == -1.0


def test_a_lumen_far_from_the_origin() -> None:
    """Coordinates of a scanner: half a metre off, the solver must not ask for lost digits."""
    points, radius = lumen("half-circle").centreline()
    away = np.array([0.4, 0.3, -0.5])
    far = Lumen.through(points + away, radius)
    near = Lumen.through(points, radius)
    for field in ([0.0, 0.0, 0.0], [1e-3, 5e-3, 2e-3]):
        found = [
            Simulation(paper_wire(), where, contact=Barrier(1e3, 1e-4, wall="centreline")).equilibrium(
                0.04, field
            )
            for where in (far, near)
        ]
        np.testing.assert_allclose(found[0].positions - away, found[1].positions, atol=1e-7 * L)
        assert found[0].stable


def test_failure_carries_the_last_iterate_and_a_remedy() -> None:
    """A wall whose force is felt only within round-off of it."""
    sim = Simulation(paper_wire(), lumen("half-circle"), contact=Barrier(1e-6, wall="centreline"))
    with pytest.raises(
        ConvergenceError, match=r"at 30 mm of feed was not found: .*; try .*\.$"
    ) as e:
        sim.equilibrium(0.03)
    assert e.value.positions.shape == (100, 3)
    assert np.isfinite(e.value.positions).all()


@pytest.mark.parametrize(
    ("feed", "message"),
    [
        (-0.01, "Input feed of Simulation must be between 0 and 0.1 m; received -0.01 m."),
        (0.2, "Input feed of Simulation must be between 0 and 0.1 m; received 0.2 m."),
        (float("nan"), "Input feed of Simulation must be a finite number; received nan m."),
    ],
)
def test_feed_out_of_range(feed: float, message: str) -> None:
    with pytest.raises(InputError) as error:
        half_circle().equilibrium(feed)
    assert str(error.value) == message


def test_faulty_field_and_twist() -> None:
    with pytest.raises(InputError, match=r"Input field of Simulation must have shape \(3,\)"):
        half_circle().equilibrium(0.03, [0.0, 1.0])
    with pytest.raises(InputError, match="Input twist of Simulation must be a finite number"):
        half_circle().equilibrium(0.03, twist=float("inf"))
