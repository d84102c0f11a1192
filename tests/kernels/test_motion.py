"""A wall that moves: gaps and their derivatives, and points carried along with it (P-40)."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier, Friction, WallMotion
from magwire.contact.motion import gone
from magwire.engine.system import System
from magwire.errors import InputError
from magwire.kernels.centreline import LumenArrays
from magwire.kernels.wall.gap import gap_jet, gap_value
from magwire.kernels.wall.motion import at_rest, came_from, carried, displacement_at
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire

LUMEN = Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
MOTIONS = (WallMotion((0.5e-3, 0.7e-3, -0.5e-3), 1.0, 20e-3), WallMotion((0, 0, 1e-3), 4.0, 40e-3))


def moving(now: float, before: float = 0.0) -> LumenArrays:
    """The bend, in metres, moved by parts of its displacements."""
    wire = Wire.uniform(1.0, 1e-4, 1e6, 3e5, 1000.0, 50)
    system = System(wire, LUMEN, Barrier(), wall_motion=MOTIONS)
    arrays = system.walls._replace(moving=system.new_moving())
    arrays.moving[0].now[:] = now, 0.5 * now
    arrays.moving[0].before[:] = before
    return arrays


def points(count: int) -> np.ndarray:
    """Points all along the bend, on both sides of its wall."""
    rng = np.random.default_rng(3)
    centre = LUMEN.branches[0].curve.at(np.linspace(4e-3, 70e-3, count))[:, :3]
    away = rng.normal(size=(count, 3))
    away *= rng.uniform(1e-3, 3.5e-3, count)[:, None] / np.linalg.norm(away, axis=1)[:, None]
    return np.asarray(centre + away)


def test_derivatives_of_the_gap_are_those_by_differences() -> None:
    arrays, step = moving(0.8), 1e-7
    for x in points(30):
        _, _, _, _, n, (xx, xy, xz, yy, yz, zz) = gap_jet(arrays, *x)
        hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        for c, axis in enumerate(np.eye(3) * step):
            ahead, behind = gap_jet(arrays, *(x + axis)), gap_jet(arrays, *(x - axis))
            assert (ahead[0] - behind[0]) / (2.0 * step) == pytest.approx(n[c], abs=1e-6)
            by_step = (np.array(ahead[4]) - behind[4]) / (2.0 * step)
            np.testing.assert_allclose(hessian[c], by_step, atol=1e-5 * np.abs(hessian).max())


def test_gaps_are_those_where_the_tissue_is_at_rest() -> None:
    rest = moving(0.0)
    for x in points(30):
        arrays = moving(0.8)
        u = sum(
            part * motion.at([x], LUMEN.entrance, 0.5 * motion.period)[0]
            for part, motion in zip((0.8, 0.4), MOTIONS, strict=True)
        )
        np.testing.assert_allclose(displacement_at(arrays.moving, tuple(x)), u, atol=1e-15)
        assert gap_value(arrays, *x)[0] == pytest.approx(gap_value(rest, *(x - u))[0], abs=1e-15)
        np.testing.assert_allclose(at_rest(arrays.moving, *x), x - u, atol=1e-15)


def test_what_is_carried_along_stays_as_far_from_the_wall() -> None:
    for x in points(30):
        gap = gap_value(moving(0.1), *x)[0]
        arrays = moving(0.9, before=0.1)
        arrays.moving[0].before[:] = 0.1, 0.05
        there = carried(arrays.moving, tuple(x))
        assert gap_value(arrays, *there)[0] == pytest.approx(gap, abs=1e-14)
        np.testing.assert_allclose(came_from(arrays.moving, there), x, atol=1e-14)


def test_the_tissue_is_never_strained_by_more_than_its_pace() -> None:
    arrays = moving(1.0)
    rng = np.random.default_rng(5)
    places = points(200)
    for x, way in zip(places, rng.normal(size=places.shape) * 1e-5, strict=True):
        apart = np.subtract(at_rest(arrays.moving, *(x + way)), at_rest(arrays.moving, *x))
        assert np.linalg.norm(apart) <= arrays.moving[0].pace * np.linalg.norm(way)


def test_motions_that_fold_the_tissue_are_refused() -> None:
    with pytest.raises(InputError, match=r"ramp of WallMotion must be at least 0\.00375 m"):
        WallMotion((0, 1e-3, 0), 1.0, 3e-3)
    with pytest.raises(InputError, match=r"period of WallMotion must be positive"):
        WallMotion((0, 1e-3, 0), 0.0, 3e-2)
    wire = Wire.uniform(0.1, 1e-4, 1e6, 3e5, 1000.0, 10)
    steep = WallMotion((0, 1e-3, 0), 1.0, 4e-3)
    with pytest.raises(InputError, match=r"must strain the tissue by at most 0\.5 in all"):
        Simulation(wire, LUMEN, wall_motion=[steep, steep])
    with pytest.raises(InputError, match="wall_motion"):
        Simulation(wire, LUMEN, wall_motion=Friction(0.1))  # type: ignore[arg-type]


def test_tissue_is_displaced_by_what_is_where_it_goes() -> None:
    """Up to the largest strain that is taken, where it matters most."""
    entrance = np.zeros(3)
    steep = WallMotion((0.0, 4e-3, 0.0), 2.0, 15e-3 * 0.5 / 0.4999)
    motions = (steep, WallMotion((1e-3, 0.0, 0.0), 0.7, 60e-3))
    rest = np.random.default_rng(5).uniform(-10e-3, 10e-3, (50, 3))
    there = gone(motions, rest, entrance, 0.8)
    by = sum(one.at(there, entrance, 0.8) for one in motions)
    np.testing.assert_allclose(there - by, rest, atol=1e-15)
    straight = rest + sum(one.at(rest, entrance, 0.8) for one in motions)
    assert np.abs(straight - there).max() > 1e-4
    np.testing.assert_array_equal(gone((), rest, entrance, 0.8), rest)
