"""Trees of every kind: sharing their path, leaving at an angle, of several generations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from magwire.lumen import Lumen

Array = NDArray[np.float64]
RADIUS = 3e-3
TRUNK = [[0.0, 0.0, 0.0], [0.025, 0.0, 0.0]]


def shared() -> dict[str, Lumen]:
    """Three tubes from the entrance on that part one after the other."""
    stem = [[0.028, -22.0, -8.0], [0.037, -22.0, -8.0], [0.04, 0.0, 0.0]]
    tables = {
        "left": [*TRUNK, [0.028, 66.0, 24.0], [0.036, 66.0, 24.0], [0.076, 14.0, -14.0]],
        "middle": [*TRUNK, *stem, [0.043, 20.0, -52.0], [0.054, 20.0, -52.0], [0.076, 4.0, 14.0]],
        "right": [*TRUNK, *stem, [0.043, -34.0, 42.0], [0.054, -34.0, 42.0], [0.076, 16.0, -8.0]],
    }
    return {name: Lumen.bends(table, RADIUS) for name, table in tables.items()}


def angled() -> dict[str, Lumen]:
    """Narrower tubes that leave a straight one at an angle, and one that leaves one of them."""
    return {
        "aorta": Lumen.straight(0.1, 8e-3),
        "first": Lumen.through([[0.03, 0, 0], [0.05, 0.02, 0], [0.06, 0.05, 0.01]], 4e-3),
        "second": Lumen.through([[0.06, 0, 0], [0.06, 0, 0.02], [0.07, -0.01, 0.06]], 3e-3),
        "twig": Lumen.through([[0.05, 0.02, 0], [0.03, 0.04, -0.01], [0.03, 0.06, -0.02]], 2e-3),
    }


def tapered() -> dict[str, Lumen]:
    """Two tubes of falling radius that share noisy points."""
    rng = np.random.default_rng(1)
    s = np.linspace(0.0, 1.0, 80)[:, None]
    trunk = s * [0.03, 0.0, 0.0]
    past = s[1:]
    up = [0.03, 0.0, 0.0] + past * [0.03, 0.0, 0.0] + past**2 * [0.0, 0.04, 0.0]
    down = [0.03, 0.0, 0.0] + past * [0.03, 0.0, 0.0] - past**2 * [0.0, 0.03, 0.01]
    radius = np.concatenate([np.full(80, 4e-3), 4e-3 - 2e-3 * past[:, 0] ** 2])
    return {
        name: Lumen.through(np.concatenate([trunk, way]) + 1e-6 * rng.normal(size=(159, 3)), radius)
        for name, way in (("up", up), ("down", down))
    }


LINES: dict[str, Callable[[], dict[str, Lumen]]] = {
    "shared": shared,
    "angled": angled,
    "tapered": tapered,
}


def junctions(tree: Lumen) -> list[tuple[Array, float]]:
    """Where each branch but the first leaves: a point and the radius there."""
    places = []
    for branch in tree.branches[1:]:
        middle = branch.curve.at(np.array([1.5 * branch.radius.max()]))[0]
        places.append((middle[:3], float(branch.radius.max())))
    return places
