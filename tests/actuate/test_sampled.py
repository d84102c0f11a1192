"""Fields of magpylib's collections as maps: their error, their file, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from magwire.actuate import Box, Helmholtz, Input, Pair, Pose, sampled, write_grid
from magwire.actuate.grids import read_grid
from magwire.errors import InputError

magpylib = pytest.importorskip("magpylib")
BOX = Box((-0.02, -0.01, -0.015), (0.02, 0.03, 0.015))
COIL, MAGNET = Input("I", "A", -5.0, 5.0), Input("share", "A", 0.0, 1.0)


def pair() -> Any:
    """100 turns each of 80 mm radius, at 1 A."""
    ring = {"diameter": 0.16, "current": 100.0}
    circles = [magpylib.current.Circle(position=(0, 0, z), **ring) for z in (-0.04, 0.04)]
    return magpylib.Collection(*circles)


def block() -> Any:
    cuboid = magpylib.magnet.Cuboid(
        polarization=(0.0, 1.2, 0.0), dimension=(0.03, 0.03, 0.03), position=(0.01, -0.06, 0.0)
    )
    return magpylib.Collection(cuboid)


def inside() -> np.ndarray:
    return np.random.default_rng(3).uniform(BOX.low, BOX.high, (500, 3))


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_a_map_is_as_good_as_it_says(tolerance: float) -> None:
    actuator, error = sampled({COIL: pair(), MAGNET: block()}, BOX, tolerance=tolerance)
    assert error <= tolerance
    for u, one in (([1.0, 0.0], pair()), ([0.0, 1.0], block())):
        expected = one.getB(inside())
        off = np.linalg.norm(actuator.at(inside(), u)[0] - expected, axis=1).max()
        assert off < 1.5 * tolerance * np.linalg.norm(expected, axis=1).max()
    both = actuator.at(inside(), [2.0, 0.5])[0]
    alone = [actuator.at(inside(), u)[0] for u in ([2.0, 0.0], [0.0, 0.5])]
    np.testing.assert_allclose(both, sum(alone), atol=1e-15)


def test_a_pair_is_that_of_helmholtz_where_it_stands() -> None:
    pose = Pose.turned([1.0, 2.0, 0.5], 0.7, (0.1, 0.0, -0.05))
    actuator, _ = sampled({COIL: pair()}, BOX, tolerance=1e-5, pose=pose)
    same = Helmholtz(pairs=(Pair("z", 0.08, 100.0),), pose=pose)
    points = np.array([pose.placed(point) for point in inside()])
    expected = same.at(points, [3.0])[0]
    np.testing.assert_allclose(
        actuator.at(points, [3.0])[0], expected, atol=2e-5 * np.abs(expected).max()
    )


def test_its_file_is_read_as_a_measured_map(tmp_path: Path) -> None:
    actuator, _ = sampled({COIL: pair()}, BOX)
    write_grid(tmp_path / "coil.csv", actuator.fields[0])
    read = read_grid(tmp_path / "coil.csv")
    np.testing.assert_allclose(read.values, actuator.fields[0].values, rtol=1e-12)
    np.testing.assert_allclose(read.step, actuator.fields[0].step, rtol=1e-12)


def test_a_source_inside_of_the_box_is_refused() -> None:
    box = Box((-0.02, -0.08, -0.015), (0.02, 0.03, 0.015))
    with pytest.raises(InputError, match="is a source inside of its box"):
        sampled({MAGNET: block()}, box)


def test_what_is_no_field_is_refused() -> None:
    class Broken:
        def getB(self, points: np.ndarray) -> np.ndarray:
            return np.full((len(points), 3), np.nan)

    with pytest.raises(InputError, match="input I must be 216 rows of three finite numbers"):
        sampled({COIL: Broken()}, BOX)
    with pytest.raises(InputError, match=r"sources of sampled must be objects with a getB.*\["):
        sampled({COIL: [pair()]}, BOX)  # type: ignore[dict-item]
    with pytest.raises(InputError, match="controls of Map must be an Input; received 'I'"):
        sampled({"I": pair()}, BOX)  # type: ignore[dict-item]
