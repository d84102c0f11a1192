"""Forces of hard walls on a pushed rod over the push: the cases, and what is kept of them.

Lengths in L, forces in EI/L^2. No field, and nobody turns the rod.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.evidence.verify.references import hard_wall, passages
from magwire.evidence.verify.references.passages import Passage

Array = NDArray[np.float64]
HALF = 0.25 * np.pi
TURNS = 0.9

CASES = {
    "half-circle-narrow": Passage(passages.circle(0.25), HALF, 0.02),
    "half-circle": Passage(passages.circle(0.25), HALF, 0.03),
    "half-circle-wide": Passage(passages.circle(0.25), HALF, 0.04),
    "sinusoid": Passage(passages.cosine(0.15, 0.8), 0.8, 0.03),
    "helix": Passage(passages.helix(0.1, 0.1), TURNS, 0.03),
    "cone": Passage(passages.circle(0.25), HALF, 0.04, -0.02 / HALF),
    "helix-cone": Passage(passages.helix(0.1, 0.1), TURNS, 0.04, -0.02 / TURNS),
    "thin": Passage(passages.circle(0.2), 0.2 * np.pi, 0.01),
}
"""A cone's radius falls from 0.04 to 0.02 along its centreline."""

DISTAL = (0.04, 0.05, 0.06)
"""Lengths behind the tip over which forces are summed."""

COLUMNS = ("X", "tip", *(f"distal_{100 * length:.0f}mm" for length in DISTAL), "wire")
"""With the millimetres of a wire of 100 mm."""


def distal(sizes: Array, step: float, length: float) -> float:
    """Sum of the joints' forces over a length behind the tip.

    Each is spread over its cell, half a link to either side, and counts with the part of it.
    """
    behind = step * np.arange(len(sizes))[::-1]
    parts = np.clip((length - behind) / step + 0.5, 0.0, 1.0)
    return float(parts @ sizes)


def curve(name: str, links: int, push: float = 0.72) -> Array:
    """Rows of ``COLUMNS`` for every link fed, shape (n, 6).

    ``links`` would be those of a rod of length 1.
    """
    step, rows = 1.0 / links, []
    for rod in hard_wall.push(CASES[name], step, push):
        sizes = rod.sizes
        sums = [distal(sizes, step, length) for length in DISTAL]
        rows.append([len(sizes) * step, sizes[-1], *sums, sizes.sum()])
    return np.array(rows)
