"""The gap where the radius varies so much that a point has more than one deepest ball nearby."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.lumen import Lumen, synthetic

from .tubes import RADIUS, brute_force

Array = NDArray[np.float64]
CHAIN = 33  # points of a chain of segments


def waisted(seed: int) -> Lumen:
    """A winding tube whose radius goes up and down in straight lines, with kinks between."""
    rng = np.random.default_rng(seed)
    kinks = np.cumsum(rng.uniform(0.4, 3.0, 10))
    x = np.arange(kinks[0], kinks[-1], 0.12)
    radius = np.interp(x, kinks, rng.uniform(0.5, 1.3, 10))
    steepest = np.abs(np.diff(radius)).max() / 0.12
    radius = 1.0 + (radius - 1.0) * min(1.0, 0.7 / steepest)
    points = np.column_stack([x, np.sin(x / 5.0), np.cos(x / 4.0)])
    return Lumen.through(RADIUS * points, RADIUS * radius)


def stenosed(depth: float, width: float) -> Lumen:
    """A bent tube with two smooth narrowings."""
    x = np.linspace(0.0, 14.0, 200)
    radius = 1.0 - sum(depth * np.exp(-(((x - at) / width) ** 2)) for at in (5.0, 9.0))
    points = np.column_stack([x, 0.8 * np.sin(x / 4.0), 0.4 * np.cos(x / 3.0)])
    return Lumen.through(RADIUS * points, RADIUS * radius)


TUBES: dict[str, Callable[[], Lumen]] = {
    **{f"waisted {seed}": lambda seed=seed: waisted(seed) for seed in range(8)},
    "short stenosis": lambda: stenosed(0.4, 0.7),
    "long stenosis": lambda: stenosed(0.6, 1.2),
}
TREES: dict[str, Callable[[], Lumen]] = {
    "carotid": synthetic.carotid_bifurcation,
    "wide carotid": lambda: synthetic.carotid_bifurcation(radius=4e-3, angle=0.7),
    "coronary": synthetic.coronary_tree,
    "arch": synthetic.aortic_arch,
}


def chains(lumen: Lumen, count: int) -> Array:
    """Straight lines next to the wall, most of them along it, shape (chains, CHAIN, 3)."""
    rng = np.random.default_rng(1)
    found = []
    for branch in lumen.branches:
        s = rng.uniform(0.0, branch.length, count)
        ball, along = branch.curve.at(s), branch.curve.at(s, 1)[:, :3]
        across = np.cross(along, rng.normal(size=(count, 3)))
        across /= np.linalg.norm(across, axis=1)[:, None]
        radius = ball[:, 3:]
        start = ball[:, :3] + rng.uniform(0.1, 1.3, (count, 1)) * radius * across
        step = 10.0 ** rng.uniform(-3.0, -1.0, (count, 1)) * radius
        move = step * (along + 0.4 * rng.normal(size=(count, 3)))
        found.append(start[:, None] + move[:, None] * np.arange(CHAIN)[:, None])
    return np.concatenate(found)


def within(lumen: Lumen, points: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Gap where its ball is one of the tube's own, not past an end, else 0; and where that is."""
    gap = lumen.gap(points)
    arc, branch = lumen.locate(points)
    length = np.array([b.length for b in lumen.branches])[branch]
    inside = np.isfinite(gap) & (branch >= 0) & (arc > 0.0) & (arc < length)
    return np.where(inside, gap, 0.0), inside


@pytest.mark.parametrize("name", [*TUBES, *TREES])
def test_gap_is_lipschitz_where_the_radius_varies(name: str) -> None:
    lumen = {**TUBES, **TREES}[name]()
    lines = chains(lumen, 2000)
    gap, inside = (x.reshape(-1, CHAIN) for x in within(lumen, lines.reshape(-1, 3)))
    moved = np.linalg.norm(np.diff(lines, axis=1), axis=2)
    both = inside[:, 1:] & inside[:, :-1]
    assert np.count_nonzero(both) > 40_000
    change = np.abs(np.diff(gap, axis=1))[both]
    assert np.all(change <= moved[both] * (1.0 + 1e-9) + 1e-15)


@pytest.mark.parametrize("name", TUBES)
def test_gap_is_that_of_brute_force_where_the_radius_varies(name: str) -> None:
    lumen = TUBES[name]()
    points = chains(lumen, 500)[:, 0]
    gap, inside = within(lumen, points)
    points, gap = points[inside], gap[inside]
    expected, arc = brute_force(lumen, points)
    tube = (arc > 0.0) & (arc < lumen.length)
    assert tube.mean() > 0.9
    np.testing.assert_allclose(gap[tube], expected[tube], rtol=0, atol=1e-11)
