"""From one planned field to the next: what is done where the next one is out of reach."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from magwire.navigate import NavigationError, Observation, tuned
from magwire.navigate.pilot import BOUND, Knot, Pilot
from magwire.navigate.stable import StableNavigator
from wires import paper_wire, simulation

Step = Callable[[Pilot, Knot, float], list[Knot]]


def in_bend() -> tuple[Pilot, Knot]:
    """A pilot, and a knot in the half-circle before the wire touches the wall."""
    navigator = StableNavigator(simulation("half-circle", paper_wire()).system)
    navigator.plan(Observation(0.0, np.zeros(3), np.zeros(3)), 0.01)
    return navigator._pilot, navigator._knots[-1]


def at_most(longest: float) -> Step:
    """A step that finds no field if it is longer."""
    step = Pilot._step

    def short(pilot: Pilot, last: Knot, feed: float) -> list[Knot]:
        if feed - last.feed > longest:
            raise NavigationError("too far")
        return step(pilot, last, feed)

    return short


def test_where_the_wall_holds_the_wire_the_way_is_halved(monkeypatch: pytest.MonkeyPatch) -> None:
    pilot, last = in_bend()
    pilot.firm = 0.0
    monkeypatch.setattr(Pilot, "_step", at_most(0.26e-3))
    found = pilot.advance(last, last.feed + 1e-3)
    np.testing.assert_allclose(
        [knot.feed - last.feed for knot in found], np.arange(5) * 0.25e-3, atol=1e-12
    )
    assert all(knot.view is not None for knot in found)
    assert tuned.PILOT.halves == 2
    with pytest.raises(NavigationError, match="too far"):
        pilot.advance(last, last.feed + 1.1e-3)


def test_a_wire_that_only_the_field_holds_is_not_fed_in_halves(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """There the margin is what is missing, or a swing."""
    pilot, last = in_bend()
    pilot.firm = float("inf")
    monkeypatch.setattr(Pilot, "_step", at_most(0.9e-3))
    with pytest.raises(NavigationError, match="too far"):
        pilot.advance(last, last.feed + 1e-3)


@pytest.mark.parametrize(("spare", "tries"), [(1.5, tuned.PILOT.tries), (1.0, BOUND)])
def test_at_its_limit_a_field_makes_no_wire_stiffer(
    spare: float, tries: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    pilot, last = in_bend()
    demands = pilot.programme.demands
    limit = spare * float(np.linalg.norm(last.flux)) / demands.weakening
    pilot.programme = replace(pilot.programme, demands=replace(demands, max_field=limit))
    tried: list[float] = []

    def lost(feed: float, last: Knot, moved: float) -> None:
        tried.append(feed)
        raise NavigationError("lost")

    monkeypatch.setattr(pilot, "_reach", lost)
    changed = 1.0 + 1e-6
    monkeypatch.setattr(
        pilot, "_improve", lambda view, before, moved: replace(view, flux=changed * view.flux)
    )
    with pytest.raises(NavigationError, match="lost"):
        pilot._step(last, last.feed + 0.25e-3)
    assert len(tried) == tries
    pilot.brisk, changed = True, 1.0  # a margin that changes nothing: nor will a larger one
    with pytest.raises(NavigationError, match="lost"):
        pilot._step(last, last.feed + 0.25e-3)
    assert len(tried) == tries + 1
