"""The guide's mouth (P-15): the sliding one is a clamp at the entrance, of second order."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.evidence.verify.wires import order
from tables import closed_form
from wires import L, flux, free, magnet

NODES = np.array([26, 51, 101, 201])
B, ANGLE, X, Y = next(
    (row[1], row[2], row[4], row[5])
    for row in closed_form("hard_magnetic_elastica_uniform")
    if row[:2] == (90.0, 3.0)
)


def worst_error(nodes: int, release: str) -> float:
    """Of the tip's position, over entrances everywhere within one cell of the mesh."""
    wire = magnet(nodes)
    sim = free(wire, release=release)
    found = []
    for feed in 0.7 * L + L / (nodes - 1) * np.arange(8) / 8:
        tip = sim.equilibrium(feed, flux(wire, B, 90.0) * (L / feed) ** 2).tip / feed
        found.append(np.hypot(tip[0] - X, tip[1] - Y))
    return max(found)


@pytest.mark.parametrize(("release", "expected"), [("sliding", 2.0), ("node", 1.0)])
def test_order_of_the_clamp(release: str, expected: float) -> None:
    """A clamp made of whole edges is of first order: the paper's release, kept for comparison."""
    worst = [worst_error(nodes, release) for nodes in NODES]
    assert order(1.0 / (NODES - 1), worst) == pytest.approx(expected, abs=0.15)


def test_the_sliding_clamp_is_the_better_one_by_far() -> None:
    assert worst_error(101, "sliding") < 0.01 * worst_error(101, "node")
    assert worst_error(101, "sliding") < 2e-4


@pytest.mark.parametrize("release", ["sliding", "node"])
def test_tip_moves_continuously_with_the_feed(release: str) -> None:
    """Over a whole cell, in steps of a fiftieth of it; node by node it jumps."""
    nodes = 51
    wire = magnet(nodes)
    sim = free(wire, release=release)
    field = flux(wire, 5.0, 90.0)
    feeds = 0.7 * L + L / (nodes - 1) * np.linspace(0.0, 1.5, 76)
    tips = np.array([sim.equilibrium(feed, field).tip for feed in feeds])
    steps = np.linalg.norm(np.diff(tips, axis=0), axis=1)
    smooth = steps.max() < 1.1 * np.median(steps)
    assert smooth == (release == "sliding")
