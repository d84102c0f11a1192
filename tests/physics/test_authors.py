"""Curves and shapes from the figures of the paper's authors (an earlier geometry).

X is the length fed past the tube's entrance, which has a straight entry of 0.15 L before it.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tables import figure
from wires import L, Passive, passive

Array = NDArray[np.float64]
ENTRY = 0.15
FORCES = {
    "authors-half-circle": "control_halfcircle_force",
    "authors-sinusoid": "control_sinusoid_force",
}


def run_of(name: str) -> Passive:
    return passive(name, push=ENTRY + (0.5 if name == "authors-narrow-bend" else 0.725))


def force(name: str, X: Array | float) -> Array:
    run = run_of(name)
    return np.interp(X, run.X - ENTRY, run.F)


@pytest.mark.parametrize("name", FORCES)
def test_force_at_every_point_of_the_curve(name: str) -> None:
    curve = figure(FORCES[name], "blue_triangle")
    assert run_of(name).status == "CONVERGED"
    np.testing.assert_allclose(force(name, curve[:, 0]), curve[:, 1], atol=0.1 * curve[:, 1].max())


@pytest.mark.parametrize(
    ("name", "bend"), [("authors-half-circle", 0.2), ("authors-sinusoid", 0.1)]
)
def test_clearance(name: str, bend: float) -> None:
    """Up to the outlet no node touches the wall; middles of edges by no more than their sagitta.

    The tubes are thin and sharply bent: a chord of 1 mm falls short of the arc by 6 and 13 um,
    which is as much as the nodes keep off the wall.
    """
    run = run_of(name)
    within = run.system.lumen.length / L > run.X
    assert np.nanmin(run.clearance[within]) > 0.0
    sagitta = (L / 99) ** 2 / (8.0 * bend * L)
    assert np.nanmin(run.between[within]) > -0.5 * sagitta


def test_half_circle_plateau() -> None:
    X = np.linspace(0.28, 0.42, 50)
    np.testing.assert_allclose(force("authors-half-circle", X), 39.4, rtol=0.1)
    assert force("authors-half-circle", X).mean() == pytest.approx(39.4, rel=0.05)


def test_sinusoid_peaks_and_pause() -> None:
    first, second = np.linspace(0.10, 0.16, 60), np.linspace(0.40, 0.48, 80)
    assert force("authors-sinusoid", first).max() == pytest.approx(33.5, rel=0.1)
    assert np.all(force("authors-sinusoid", np.linspace(0.29, 0.33, 20)) == 0.0)
    assert force("authors-sinusoid", second).max() == pytest.approx(82.5, rel=0.1)


def distance(points: Array, line: Array) -> Array:
    """Of points from a polyline."""
    start, along = line[:-1], np.diff(line, axis=0)
    part = np.sum((points[:, None] - start) * along, axis=2) / np.sum(along**2, axis=1)
    nearest = start + np.clip(part, 0.0, 1.0)[..., None] * along
    return np.asarray(np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1))


@pytest.mark.parametrize(
    ("name", "drawing"),
    [("authors-narrow-bend", "planar_case1"), ("authors-half-circle", "planar_case3")],
)
@pytest.mark.parametrize("series", ["t0", "t100", "t200", "t300"])
def test_shapes(name: str, drawing: str, series: str) -> None:
    """The push is not printed: it follows from the length of the drawn curve past x = 0."""
    drawn = figure(drawing, series)[:, 1:]
    push = float(np.linalg.norm(np.diff(drawn, axis=0), axis=1).sum()) + drawn[0, 0]
    assert drawn[0, 0] == pytest.approx(-0.1, abs=1e-3)
    run = run_of(name)
    shape = run.positions[np.abs(run.X - ENTRY - push).argmin(), :, :2] / L
    assert distance(drawn, shape).mean() < 0.005
    assert distance(drawn, shape).max() < 0.01
    assert np.linalg.norm(drawn[-1] - shape[-1]) < 0.01


@pytest.mark.parametrize(
    ("name", "drawing"),
    [("authors-narrow-bend", "planar_case1"), ("authors-half-circle", "planar_case3")],
)
def test_walls_are_where_they_are_drawn(name: str, drawing: str) -> None:
    wall = figure(drawing, "wall")[:, 1:]
    gaps = run_of(name).system.lumen.gap(np.column_stack([wall * L, np.zeros(len(wall))])) / L
    assert np.abs(gaps[np.isfinite(gaps)]).max() < 1e-4
