"""Pictures of a wire in its lumen, drawn with arrays alone."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Image = NDArray[np.uint8]

SMALL, LARGE = 84, 400
"""Edge of an observed image, and of a frame that people look at [pixels]."""
MARGIN = 0.06
"""Of the edge that is left free around the lumen."""
PAPER, WALL, HOLLOW = (250, 250, 248), (150, 130, 125), (243, 222, 214)
BODY, MAGNET, MARK = (40, 60, 110), (190, 30, 45), (60, 140, 70)
BRIGHT, VESSEL, WIRE = 215.0, 0.12, 1.6
"""Grey level without anything in the beam, and what lumen and wire absorb of it."""


class View:
    """A parallel projection that shows as much as can be of a lumen.

    Parameters
    ----------
    outline
        Centres and radii of the lumen's branches, shape (n, 4) [m].
    """

    def __init__(self, outline: Array) -> None:
        centre = outline[:, :3]
        self._middle = centre.mean(axis=0)
        _, _, axes = np.linalg.svd(centre - self._middle, full_matrices=False)
        axes = axes[:2]
        largest = np.argmax(np.abs(axes), axis=1)
        self._axes = axes * np.sign(axes[[0, 1], largest])[:, None]
        flat = (centre - self._middle) @ self._axes.T
        reach = outline[:, 3].max()
        low, high = flat.min(axis=0) - reach, flat.max(axis=0) + reach
        self._corner = 0.5 * (low + high)
        self._extent = float((high - low).max()) / (1.0 - 2.0 * MARGIN)
        self._flat, self._radius = flat, outline[:, 3]
        self._paper: Image | None = None
        self._shade: Array | None = None

    def pixels(self, flat: Array, size: int) -> Array:
        """Columns and rows of projected points in an image, shape (n, 2)."""
        place = (flat - self._corner) / self._extent
        return np.column_stack([0.5 + place[:, 0], 0.5 - place[:, 1]]) * size

    def _discs(self, image: NDArray[np.generic], flat: Array, radii: Array, ink: Any) -> None:
        """Fill discs of radii [pixels] around projected points."""
        size = image.shape[0]
        for (x, y), radius in zip(self.pixels(flat, size), radii, strict=True):
            x0, x1 = max(int(x - radius), 0), min(int(x + radius) + 2, size)
            y0, y1 = max(int(y - radius), 0), min(int(y + radius) + 2, size)
            if x0 < x1 and y0 < y1:
                rows, columns = np.ogrid[y0:y1, x0:x1]
                inside = (columns + 0.5 - x) ** 2 + (rows + 0.5 - y) ** 2 <= radius * radius
                image[y0:y1, x0:x1][inside] = ink

    def frame(self, nodes: Array, magnet: Array, goal: Array) -> Image:
        """A coloured picture, shape (400, 400, 3).

        Parameters
        ----------
        nodes
            Those of the wire, shape (n, 3) [m].
        magnet
            Which of its edges are magnetised, shape (n - 1,).
        goal
            Where the tip is to come, shape (3,) [m].
        """
        per = LARGE / self._extent
        if self._paper is None:
            paper = np.full((LARGE, LARGE, 3), PAPER, dtype=np.uint8)
            self._discs(paper, self._flat, self._radius * per + 1.5, WALL)
            self._discs(paper, self._flat, self._radius * per, HOLLOW)
            self._paper = paper
        image = self._paper.copy()
        self._discs(image, self._project(goal[None]), np.array([5.0]), MARK)
        dense, share = _between(nodes, magnet, 4)
        flat = self._project(dense)
        for ink, chosen in ((BODY, share < 0.5), (MAGNET, share >= 0.5)):
            some = flat[chosen]
            self._discs(image, some, np.full(len(some), 2.6 if ink is MAGNET else 2.0), ink)
        return image

    def fluoroscopy(self, nodes: Array) -> Image:
        """A grey picture like that of a fluoroscope with a faint road map, shape (84, 84)."""
        if self._shade is None:
            mask = np.zeros((SMALL, SMALL))
            self._discs(mask, self._flat, self._radius * SMALL / self._extent, 1.0)
            self._shade = mask * VESSEL
        dense, _ = _between(nodes, np.zeros(len(nodes) - 1), 3)
        at = self.pixels(self._project(dense), SMALL) - 0.5
        corner = np.floor(at).astype(np.int64)
        rest = at - corner
        edge = np.linalg.norm(nodes[-1] - nodes[-2]) / 3.0 * SMALL / self._extent
        dark = np.zeros(SMALL * SMALL)
        for dx in (0, 1):
            for dy in (0, 1):
                x, y = corner[:, 0] + dx, corner[:, 1] + dy
                weight = np.abs(1 - dx - rest[:, 0]) * np.abs(1 - dy - rest[:, 1])
                inside = (x >= 0) & (x < SMALL) & (y >= 0) & (y < SMALL)
                spots = (y * SMALL + x)[inside]
                dark += np.bincount(spots, weight[inside] * edge, minlength=len(dark))
        absorbed = self._shade + WIRE * dark.reshape(SMALL, SMALL)
        return np.asarray(BRIGHT * np.exp(-absorbed)).astype(np.uint8)

    def _project(self, points: Array) -> Array:
        return np.asarray((points - self._middle) @ self._axes.T)


def _between(nodes: Array, values: NDArray[np.generic], parts: int) -> tuple[Array, Array]:
    """Points on the edges between nodes, and the value of the edge that each is on."""
    share = (np.arange(parts) / parts)[None, :, None]
    points = nodes[:-1, None] * (1.0 - share) + nodes[1:, None] * share
    dense = np.concatenate([points.reshape(-1, 3), nodes[-1:]])
    known = np.repeat(np.asarray(values, dtype=np.float64), parts)
    return dense, np.append(known, known[-1:])
