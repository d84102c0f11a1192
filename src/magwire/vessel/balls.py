"""The tube that a file's own points make: the union of their balls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.spatial import KDTree

from magwire.vessel.files.drawing import Array

NEIGHBOURS = 8  # balls of about one size that are compared at first
MORE = 4  # times, where a wider one that is farther away may be deeper
SIZES = 4.0  # classes of size in an octave

DENSER = 4  # times: what is between balls of tubes is less than a hundredth of the radius


class Original(Protocol):
    """What a file says the vessel is."""

    def depth(self, points: Array) -> Array:
        """How deep points, shape (n, 3) [m], are inside, shape (n,) [m]; negative outside."""
        ...


def closer(balls: Array, parts: int) -> Array:
    """Balls along a line, shape (n, 4) [m], so many times as close together."""
    shares = np.arange(1, parts)[:, None, None] / parts
    more = (1.0 - shares) * balls[:-1] + shares * balls[1:]
    return np.concatenate([balls, more.reshape(-1, 4)])


@dataclass(frozen=True, eq=False)
class Balls:
    """The union of balls around points, shape (n, 3) [m], of a radius each, shape (n,) [m].

    Finer ones between them count, too: they are searched by themselves, since of dense balls the
    nearest ones do not reach as far.
    """

    points: Array
    radius: Array
    finer: Balls | None = None

    def depth(self, points: Array) -> Array:
        """How deep points, shape (n, 3) [m], are inside, shape (n,) [m]; negative outside."""
        best = np.full(len(points), -np.inf) if self.finer is None else self.finer.depth(points)
        for tree, radius in self._sizes:
            left, count = np.arange(len(points)), NEIGHBOURS
            while len(left) > 0:
                count = min(count, len(radius))
                distance, which = tree.query(points[left], k=count)
                distance = distance.reshape(len(left), -1)
                value = (radius[which].reshape(distance.shape) - distance).max(axis=1)
                best[left] = np.maximum(best[left], value)
                # those that are farther than all these may be deeper only if they are wider
                left = left[best[left] < radius.max() - distance[:, -1]]
                if count == len(radius):
                    break
                count *= MORE
        return best

    @cached_property
    def _sizes(self) -> list[tuple[KDTree, Array]]:
        """Balls of about one size each, since the deepest one need not be the nearest."""
        size = np.floor(SIZES * np.log2(self.radius / self.radius.min())).astype(np.int64)
        return [(KDTree(self.points[size == k]), self.radius[size == k]) for k in np.unique(size)]


def wall(tubes: Sequence[Array]) -> Balls:
    """The union of tubes, of balls of shape (n, 4) [m] each, a quarter of a radius apart."""
    every = np.concatenate([closer(balls, DENSER) for balls in tubes])
    return Balls(every[:, :3], every[:, 3])
