"""A march with somebody at the helm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np

from magwire.engine.dynamics import March
from magwire.engine.record import Record
from magwire.navigate.model import Model
from magwire.navigate.navigator import Navigator, Observation

SAME = 1e-9  # feeds that differ by less are the same [m]


@runtime_checkable
class Modelled(Protocol):
    """A navigator that has a model of the wire."""

    model: Model


def steered_records(
    march: March, navigator: Navigator, *, every: int, update: int
) -> Iterator[Record]:
    """March to the end under a navigator.

    Parameters
    ----------
    march
        The plant.
    navigator
        Who says which field comes next.
    every
        Time steps between two records.
    update
        Time steps between two observations.

    Yields
    ------
    Record
        At the start and after every so many steps; the last one where a step failed.

    Raises
    ------
    NavigationError
        If the navigator finds no field.
    """
    yield march.record()
    seen, gone = observe(march), float("nan")
    while march.step < march.steps:
        if march.step % update == 0:
            feeds = march.feeds(march.step + update)
            march.steer(navigator.plan(seen, float(feeds[-1])).at(feeds))
        step = min(every - march.step % every, update - march.step % update)
        converged = march.advance(step)
        if march.step % update == 0 or march.step == march.steps:
            seen = observe(march)
            gone = float(np.fmax(gone, departure(navigator, seen)))
        if march.step % every == 0 or march.step == march.steps or not converged:
            yield replace(march.record(), tip_departure=gone)
            gone = float("nan")
        if not converged:
            return


def observe(march: March) -> Observation:
    """What a navigator is told of the plant."""
    position, direction = march.tip()
    return Observation(march.feed, position, direction)


def departure(navigator: Navigator, seen: Observation) -> float:
    """Distance of the tip from where the navigator's model has it [m].

    NaN for a navigator without a model, or one whose model is at another feed.
    """
    if not isinstance(navigator, Modelled) or abs(navigator.model.feed - seen.feed) > SAME:
        return float("nan")
    tip = navigator.model.remember().state.q[-1, :3] * navigator.model.system.wire.length
    return float(np.linalg.norm(seen.tip - tip))
