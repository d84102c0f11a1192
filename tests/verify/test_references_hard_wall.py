"""The rods between hard walls: derivatives, limits, meshes, and the tables made from them."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.evidence.verify.references import hard_contact, hard_wall, passages, pushed
from tables import hard_wall as table

Array = NDArray[np.float64]


@lru_cache
def curve(name: str, links: int, reach: float) -> Array:
    return pushed.curve(name, links, reach)


@pytest.mark.parametrize("name", ["sinusoid", "helix-cone"])
def test_derivatives_of_the_room(name: str) -> None:
    passage, step = pushed.CASES[name], 1e-5
    rng = np.random.default_rng(5)
    w = rng.uniform(0.1, 0.7, 20)
    points = passage.curve(w)[0] + rng.uniform(-0.01, 0.01, (20, 3))

    def room(x: Array) -> tuple[Array, Array, Array]:
        return passage.room(x, passage.nearest(x, w))

    _, gradient, hessian = room(points)
    for axis in range(3):
        moved = step * np.eye(3)[axis]
        (above, up, _), (below, down, _) = room(points + moved), room(points - moved)
        np.testing.assert_allclose((above - below) / (2.0 * step), gradient[:, axis], atol=1e-8)
        np.testing.assert_allclose((up - down) / (2.0 * step), hessian[:, :, axis], atol=1e-6)


@pytest.mark.parametrize("name", ["half-circle", "sinusoid", "helix", "helix-cone"])
def test_nearest_balls_are_the_deepest(name: str) -> None:
    """Against all balls along the centreline, at the joints of a rod in contact."""
    passage = pushed.CASES[name]
    *_, rod = hard_wall.push(passage, 0.02, 0.6)
    w = np.linspace(0.0, passage.end, 20001)
    away = np.linalg.norm(rod.joints[:, None] - passage.curve(w)[0], axis=2)
    deepest = (0.5 * ((passage.radius + passage.taper * w) ** 2 - away**2)).max(axis=1)
    np.testing.assert_allclose(rod.gap, deepest, atol=1e-8)
    assert np.all(rod.gap > 0.0)
    assert rod.sizes.max() > 10.0


def test_links_keep_their_length() -> None:
    *_, rod = hard_wall.push(pushed.CASES["helix"], 0.02, 0.4)
    links = np.diff(rod.joints, axis=0, prepend=np.zeros((1, 3)))
    np.testing.assert_allclose(np.linalg.norm(links, axis=1), 0.02, rtol=1e-8)


@pytest.mark.parametrize("links", [20, 30, 50])
def test_planar_chain_of_angles(links: int) -> None:
    """Another method, other unknowns; turns count as 1 - cos there as half of their square."""
    flat = hard_contact.press(links, 0.01, 0.2, 0.01)
    *_, rod = hard_wall.push(pushed.CASES["thin"], 0.01, 0.01 * links)
    np.testing.assert_allclose(rod.joints[:, :2], flat.joints, atol=5e-4)
    np.testing.assert_allclose(rod.joints[:, 2], 0.0, atol=1e-9)
    size = np.linalg.norm(flat.wall_force, axis=1)
    assert rod.sizes[-1] == pytest.approx(size[-1], rel=5e-3)
    assert rod.sizes.sum() == pytest.approx(size.sum(), rel=1e-2)


def test_work_of_the_push() -> None:
    """dE/dX is the walls' force against the push less EI k^2/2 of the curvature at the mouth.

    That is taken a quarter of a link past it: the error is of first order.
    """
    step, begin = 0.005, pushed.CASES["helix"].direction
    before, rod, after = list(hard_wall.push(pushed.CASES["helix"], step, 0.4))[-3:]
    bend = np.linalg.norm(rod.joints[0] / step - begin) / (0.5 * step)
    work = (_energy(after, step) - _energy(before, step)) / (2.0 * step)
    assert work == pytest.approx(-rod.wall_force.sum(axis=0) @ begin - 0.5 * bend**2, rel=1e-2)


def _energy(rod: hard_wall.Rod, step: float) -> float:
    begin = rod.joints[0] - step * pushed.CASES["helix"].direction
    turns = np.diff(np.vstack((np.zeros(3), rod.joints)), n=2, axis=0)
    return float((turns**2).sum() / (2.0 * step**3) + (begin**2).sum() / step**3)


def test_a_helix_without_rise_is_a_circle() -> None:
    flat = passages.Passage(passages.helix(0.25, 1e-9), 0.7, 0.03)
    *_, rod = hard_wall.push(flat, 0.02, 0.3)
    *_, other = hard_wall.push(pushed.CASES["half-circle"], 0.02, 0.3)
    np.testing.assert_allclose(rod.joints, other.joints, atol=1e-8)
    np.testing.assert_allclose(rod.wall_force, other.wall_force, atol=1e-4)


def test_second_order_in_the_links() -> None:
    at = [curve("half-circle", links, 0.24)[-1, 1] for links in (50, 100, 200)]
    first, second = (b - a for a, b in pairwise(at))
    assert first / second == pytest.approx(4.0, rel=0.1)
    assert at[2] + second / 3.0 == pytest.approx(np.interp(0.24, *_tips("half-circle")), rel=1e-4)


def _tips(name: str) -> tuple[Array, Array]:
    return table(name)["X"], table(name)["tip"]


@pytest.mark.parametrize(
    ("name", "reach"), [("sinusoid", 0.3), ("helix", 0.4), ("cone", 0.3), ("thin", 0.3)]
)
def test_tables_are_computed_again(name: str, reach: float) -> None:
    """With links eight times as long, within a percent of the peak."""
    rows, kept = curve(name, 100, reach), table(name)
    peak = kept["tip"].max()
    for column, values in zip(pushed.COLUMNS, rows.T, strict=True):
        expected = np.interp(rows[:, 0], kept["X"], kept[column])
        np.testing.assert_allclose(values, expected, atol=0.01 * peak, err_msg=column)


@pytest.mark.parametrize(
    ("name", "peak"),
    [
        ("half-circle-narrow", 24.6),
        ("half-circle", 20.8),
        ("half-circle-wide", 18.6),
        ("sinusoid", 45.1),
    ],
)
def test_peaks_that_others_found(name: str, peak: float) -> None:
    """Three digits of a nonlinear programme; where contact is counted shows in the sinusoid."""
    assert table(name)["tip"].max() == pytest.approx(peak, rel=0.007)


def test_distal_sum_counts_parts_of_cells() -> None:
    sizes = np.ones(100)
    assert pushed.distal(sizes, 0.01, 0.05) == pytest.approx(5.5)
    assert pushed.distal(sizes, 0.01, 0.054) == pytest.approx(5.9)
    assert pushed.distal(np.eye(100)[-1], 0.01, 0.05) == 1.0
