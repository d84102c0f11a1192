"""A march with somebody at the helm."""

from __future__ import annotations

from collections.abc import Iterator

from magwire.engine.dynamics import March
from magwire.engine.record import Record
from magwire.navigate.navigator import Navigator, Observation


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
    goal = float(march.feeds(march.steps).max())
    while march.step < march.steps:
        if march.step % update == 0:
            feeds = march.feeds(march.step + update)
            position, direction = march.tip()
            seen = Observation(march.feed, position, direction, goal)
            march.steer(navigator.plan(seen, float(feeds[-1])).at(feeds))
        step = min(every - march.step % every, update - march.step % update)
        converged = march.advance(step)
        if march.step % every == 0 or march.step == march.steps or not converged:
            yield march.record()
        if not converged:
            return
