"""Repeats side by side, and what is made of them."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from typing import TypeVar

import numpy as np

Key = TypeVar("Key")
Sample = dict[str, float]


def interleaved(
    jobs: Mapping[Key, Callable[[], Sample]],
    repeats: int,
    tell: Callable[[str], None],
    *,
    slow: Container[Key] = (),
) -> dict[Key, list[Sample]]:
    """Samples of all jobs, measured A B C A B C ...: what slows the machine down meets them all.

    Slow jobs take part in every other repeat, from the first one on.
    """
    samples: dict[Key, list[Sample]] = {key: [] for key in jobs}
    for number in range(repeats):
        for key, job in jobs.items():
            if number % 2 == 1 and key in slow:
                continue
            tell(f"repeat {number + 1} of {repeats}: {key}")
            samples[key].append(job())
    return samples


def column(samples: Sequence[Sample], name: str) -> list[float]:
    return [sample[name] for sample in samples]


def median(samples: Sequence[Sample], name: str) -> float:
    return float(np.median(column(samples, name)))


def least(samples: Sequence[Sample], name: str) -> float:
    return min(column(samples, name))


def exponent(sizes: Sequence[float], times: Sequence[float]) -> float:
    """Slope p of the least-squares line through (log size, log time): time ~ size^p."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
