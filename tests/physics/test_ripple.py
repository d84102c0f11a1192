"""The force on the plateau must not feel the nodes passing the entrance (P-15)."""

from __future__ import annotations

import numpy as np
import pytest

from wires import passive


def ripple(release: str, nodes: int) -> float:
    """Largest deviation of the plateau from a smooth curve, over its mean."""
    run = passive("half-circle", nodes=nodes, release=release, every=5e-4)
    plateau = (run.X > 0.35) & (run.X < 0.70)
    smooth = np.polynomial.Polynomial.fit(run.X[plateau], run.F[plateau], 6)
    deviation = run.F[plateau] - smooth(run.X[plateau])
    return float(np.abs(deviation).max() / run.F[plateau].mean())


@pytest.mark.parametrize(("nodes", "bound"), [(50, 2e-3), (100, 1e-3)])
def test_sliding_mouth(nodes: int, bound: float) -> None:
    assert ripple("sliding", nodes) < bound


def test_node_by_node_is_worse() -> None:
    assert ripple("node", 100) > 0.03


def test_plateau_does_not_depend_on_the_mesh() -> None:
    means = []
    for nodes in (50, 100):
        run = passive("half-circle", nodes=nodes, every=5e-4)
        means.append(run.F[(run.X > 0.35) & (run.X < 0.70)].mean())
    assert means[0] == pytest.approx(means[1], rel=3e-3)
