"""Lumens of every kind, points around their walls, and the gap by brute force."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from magwire.lumen import Lumen

Array = NDArray[np.float64]
RADIUS = 3e-3


def _tapered() -> Lumen:
    w = np.linspace(0.0, 2.0, 60)
    points = 0.03 * np.column_stack([np.sin(w), 1.0 - np.cos(w), 0.3 * w])
    return Lumen.through(points, np.linspace(4e-3, 2e-3, 60))


def _random() -> Lumen:
    rng = np.random.default_rng(7)
    steps = np.array([1.0, 0.0, 0.0]) + 0.6 * rng.uniform(-1.0, 1.0, (12, 3))
    return Lumen.through(0.01 * np.cumsum(steps, axis=0), rng.uniform(2e-3, 2.6e-3, 12))


LUMENS: dict[str, Callable[[], Lumen]] = {
    "straight": lambda: Lumen.straight(0.1, RADIUS),
    "half-circle": lambda: Lumen.half_circle(0.025, RADIUS),
    "sinusoid": lambda: Lumen.sinusoid(0.015, 0.08, 0.08, RADIUS),
    "helix": lambda: Lumen.helix(0.01, 0.01, 0.09, RADIUS),
    "entry": lambda: Lumen.half_circle(0.025, RADIUS).with_entry(0.015),
    "tapered": _tapered,
    "random": _random,
}


def around(lumen: Lumen, count: int, low: float, high: float, seed: int = 0) -> Array:
    """Points at ``low`` to ``high`` radii from the centreline, away from the ends' planes."""
    rng = np.random.default_rng(seed)
    curve = lumen.branches[0].curve
    margin = 0.05 * lumen.length
    s = rng.uniform(margin, lumen.length - margin, count)
    centre, tangent = curve.at(s), curve.at(s, 1)[:, :3]
    across = np.cross(tangent, rng.normal(size=(count, 3)))
    across /= np.linalg.norm(across, axis=1)[:, None]
    distance = centre[:, 3:] * rng.uniform(low, high, (count, 1))
    return np.asarray(centre[:, :3] + distance * across)


def brute_force(lumen: Lumen, points: Array) -> tuple[Array, Array]:
    """Gap and arc parameter by dense sampling, refined around the best sample."""
    curve = lumen.branches[0].curve
    coarse = np.linspace(0.0, lumen.length, 2001)
    gaps, arcs = np.empty(len(points)), np.empty(len(points))
    for i, point in enumerate(points):
        s = coarse
        for _ in range(4):
            ball = curve.at(s)
            value = ball[:, 3] - np.linalg.norm(point - ball[:, :3], axis=1)
            k = int(np.argmax(value))
            width = s[1] - s[0]
            gaps[i], arcs[i] = value[k], s[k]
            s = np.linspace(max(s[k] - width, 0.0), min(s[k] + width, lumen.length), 101)
    return gaps, arcs
