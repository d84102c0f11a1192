"""The authors' own curves, of an earlier geometry (see ``published/README.md``)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.published import curve
from magwire.evidence.reproduce.runs import Ask

Array = NDArray[np.float64]
ENTRY = 0.15
"""Straight entry before the tube, in L."""
BEND = 0.2
"""Centreline radius of the half-circle with control, in L."""

COMMON = ("lumen.radius=1 mm", "lumen.entry=15 mm")
HALF_CIRCLE = Ask(
    "half-circle", changes=(*COMMON, "lumen.centreline_radius=20 mm", "feed.distance=77 mm")
)
NARROW_BEND = Ask(
    "half-circle", changes=(*COMMON, "lumen.centreline_radius=10 mm", "feed.distance=46.3 mm")
)
SINUSOID = Ask(
    "sinusoid",
    changes=(
        *COMMON,
        "lumen.amplitude=10 mm",
        "lumen.period=62.831853 mm",
        "feed.distance=87.5 mm",
    ),
)
# Four magnetised edges out of 99 fit the authors' field (P-4).
STEERED = Ask(
    "half-circle",
    "newton",
    (
        *COMMON,
        "lumen.centreline_radius=20 mm",
        "wire.magnetized_tip=4.040404 mm",
        "feed.distance=76 mm",
    ),
)


def field() -> tuple[Array, Array]:
    """Pushes past the tube's entrance, shape (n,), and B* in our sign, shape (n, 3)."""
    columns = [
        curve("control_halfcircle_field", series)
        for series in ("green_square", "red_circle", "blue_triangle")
    ]
    return columns[0][:, 0], -np.stack([column[:, 1] for column in columns], axis=1)


def across(push: Array, field: Array) -> Array:
    """Component of a field, shape (n, 3), across the half-circle where the tip is, shape (n,)."""
    angle = push / BEND
    return np.asarray(-np.sin(angle) * field[:, 0] + np.cos(angle) * field[:, 1])


def drawn_shapes(drawing: str) -> list[tuple[float, Array]]:
    """Pushes past the tube's entrance and shapes of the wire, shape (n, 2) [L].

    The push is not printed: it follows from the length of the drawn curve past x = 0.
    """
    found = []
    for series in ("t0", "t100", "t200", "t300"):
        line = curve(drawing, series)[:, 1:]
        length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
        found.append((length + float(line[0, 0]), line))
    return found


def distance(points: Array, line: Array) -> float:
    """Mean distance of points from a polyline."""
    start, along = line[:-1], np.diff(line, axis=0)
    part = np.sum((points[:, None] - start) * along, axis=2) / np.sum(along**2, axis=1)
    nearest = start + np.clip(part, 0.0, 1.0)[..., None] * along
    return float(np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1).mean())
