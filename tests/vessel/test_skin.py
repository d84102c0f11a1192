"""Distance from triangles, and the depth in balls, against what is known."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from magwire.errors import InputError
from magwire.vessel import Vessel
from magwire.vessel.balls import Balls
from magwire.vessel.skin import Skin

trimesh = pytest.importorskip("trimesh")
RNG = np.random.default_rng(2)


def test_depth_in_a_box_is_exact() -> None:
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    points = RNG.normal(size=(3000, 3))
    off = np.abs(points) - [0.5, 1.0, 1.5]
    outside = np.linalg.norm(np.maximum(off, 0.0), axis=1)
    exact = -(outside + np.minimum(off.max(axis=1), 0.0))
    for triangles in (box.faces, box.faces[:, ::-1]):  # however they are turned
        skin = Skin(np.array(box.vertices), np.array(triangles), np.zeros((1, 3)))
        assert skin.depth(points) == pytest.approx(exact, abs=1e-12)


def test_depth_in_a_sphere_converges() -> None:
    points = 0.8 * RNG.normal(size=(2000, 3))
    exact, errors = 1.0 - np.linalg.norm(points, axis=1), []
    for cuts in (2, 3, 4):
        ball = trimesh.creation.icosphere(cuts)
        skin = Skin(np.array(ball.vertices), np.array(ball.faces), np.zeros((1, 3)))
        errors.append(np.abs(skin.depth(points) - exact).max())
    assert np.polyfit([0, 1, 2], np.log2(errors), 1)[0] == pytest.approx(-2.0, abs=0.2)


def test_depth_in_balls_of_many_sizes() -> None:
    s = np.zeros(1)
    while s[-1] < 100.0:  # a tenth of a radius apart, as the points of all cleaned lines
        s = np.append(s, s[-1] + 0.1 * (1.0 + 9.0 * (s[-1] / 100.0) ** 2))
    radius = 1.0 + 9.0 * (s / 100.0) ** 2
    balls = Balls(np.column_stack([s, 0 * s, 0 * s]), radius)
    points = np.array([100.0, 12.0, 12.0]) * RNG.random((2000, 3))
    every = (radius - np.linalg.norm(points[:, None] - balls.points, axis=2)).max(axis=1)
    found = balls.depth(points)
    inside = every > -0.5 * radius[np.searchsorted(s, points[:, 0])]
    assert np.abs(found - every)[inside].max() < 0.01
    assert np.all(found <= every + 1e-12)


def test_depth_in_a_cylinder_of_slender_triangles_is_that_of_all_of_them() -> None:
    cylinder = trimesh.creation.cylinder(5.0, 80.0, sections=40)
    skin = Skin(np.array(cylinder.vertices), np.array(cylinder.faces), np.zeros((1, 3)))
    points = RNG.uniform([-4.0, -4.0, -38.0], [4.0, 4.0, 38.0], (500, 3))
    points = points[np.hypot(points[:, 0], points[:, 1]) < 4.9]
    turned = np.arctan2(points[:, 1], points[:, 0]) % (np.pi / 20.0) - np.pi / 40.0
    side = 5.0 * np.cos(np.pi / 40.0) - np.hypot(points[:, 0], points[:, 1]) * np.cos(turned)
    exact = np.minimum(side, 40.0 - np.abs(points[:, 2]))
    assert skin.depth(points) == pytest.approx(exact, abs=1e-6)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: trimesh.creation.torus(25.0, 8.0), "closed surface that goes round in a loop"),
        (lambda: trimesh.creation.annulus(5.0, 7.0, 30.0), "surface that goes round in a loop"),
        (lambda: trimesh.creation.icosphere(3, 30.0), "has a surface that is no tube"),
    ],
)
def test_shapes_that_are_no_tube_are_refused(
    made: Callable[[], trimesh.Trimesh], message: str, tmp_path: Path
) -> None:
    made().export(tmp_path / "a.stl")
    with pytest.raises(InputError, match=message):
        Vessel.read(tmp_path / "a.stl", "mm")
