"""How far the wall that is simulated is from the wall of the file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from magwire.vessel.balls import Balls, Original, closer
from magwire.vessel.files.drawing import Array
from magwire.vessel.words import long

SAMPLES = 20_000  # of the wall
INNER = 0.02  # depth in another tube, over the radius, from which a point is no wall
LIMIT = 0.1  # how far the wall may reach out of that of the file, over the radius


class Side(NamedTuple):
    """Median, 95 percent and largest, over all of the wall [m], and the same over the radius."""

    metres: tuple[float, float, float]
    radii: tuple[float, float, float]

    @property
    def words(self) -> str:
        """These numbers in words."""
        middle, most, worst = self.metres
        return (
            f"{long(middle)} in the median, {long(most)} at 95 percent, {long(worst)} at most "
            f"({self.radii[2]:.2g} R)"
        )


class Deviation(NamedTuple):
    """How far the wall lies outside and inside of that of the file."""

    outside: Side
    inside: Side


def deviation(tubes: Sequence[Array], original: Original, count: int = SAMPLES) -> Deviation:
    """How far the walls of tubes are from those of the file.

    Parameters
    ----------
    tubes
        Balls of each tube, shape (n, 4) [m]: centre and radius.
    original
        The vessel as the file has it.
    count
        Points of the wall that are looked at, about.
    """
    walls, radius = _wall(tubes, count)
    depth = original.depth(walls)
    return Deviation(_side(np.maximum(-depth, 0.0), radius), _side(np.maximum(depth, 0.0), radius))


def _side(off: Array, radius: Array) -> Side:
    quantiles = [50.0, 95.0, 100.0]
    metres, radii = np.percentile(off, quantiles), np.percentile(off / radius, quantiles)
    return Side(tuple(metres.tolist()), tuple(radii.tolist()))


def _wall(tubes: Sequence[Array], count: int) -> tuple[Array, Array]:
    """Points all over the wall of the union of tubes, and the radius there."""
    seen: set[bytes] = set()
    parts = []
    for balls in tubes:
        keys = [row.tobytes() for row in balls]
        first = next((k for k, key in enumerate(keys) if key not in seen), len(keys))
        seen.update(keys[first:])
        if first < len(balls) - 1:
            parts.append(balls[max(first - 1, 0) :])
    steps = [np.linalg.norm(np.diff(part[:, :3], axis=0), axis=1) for part in parts]
    size = sum(float(np.sum(s * part[1:, 3])) for s, part in zip(steps, parts, strict=True))
    made = [_rings(part, step, count / size) for part, step in zip(parts, steps, strict=True)]
    walls, radius = (np.concatenate([pair[k] for pair in made]) for k in (0, 1))
    union = np.concatenate([closer(part, 2) for part in parts])
    outer = Balls(union[:, :3], union[:, 3]).depth(walls) < INNER * radius
    return walls[outer], radius[outer]


def _rings(balls: Array, steps: Array, density: float) -> tuple[Array, Array]:
    """Points around a tube, where its balls touch their envelope, and the radius there."""
    rng = np.random.default_rng(0)
    number = rng.poisson(density * steps * balls[1:, 3])
    piece = np.repeat(np.arange(len(steps)), number)
    share = rng.random(len(piece))[:, None]
    ball = (1.0 - share) * balls[piece] + share * balls[piece + 1]
    step = (balls[piece + 1] - balls[piece]) / np.maximum(steps[piece], 1e-300)[:, None]
    ahead, slope = step[:, :3], np.clip(step[:, 3:], -1.0, 1.0)
    across = np.cross(ahead, rng.normal(size=(len(piece), 3)))
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    outward = -slope * ahead + np.sqrt(1.0 - slope**2) * across
    return ball[:, :3] + ball[:, 3:] * outward, ball[:, 3]
