"""Courses that are planned to their end before the wire sets out, and their spikes."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import magwire as mw
from magwire.navigate import Observation, tuned
from magwire.navigate.foresight import clearances, foresee
from magwire.navigate.pilot import norm
from magwire.navigate.stable import StableNavigator
from wires import paper_wire, simulation

GOAL = 0.03  # how far along the half-circle [m]


def navigator() -> StableNavigator:
    return StableNavigator(simulation("half-circle", paper_wire()).system)


def foreseen(*, level: bool = True) -> tuple[StableNavigator, list[str]]:
    planner = navigator()
    return planner, list(foresee(planner, mw.Feed(0.01, 0.06), GOAL, level=level))


def peak(planner: StableNavigator) -> float:
    return max(norm(knot.flux) for knot in planner.knots)


def test_it_is_the_course_that_is_planned_along_the_way() -> None:
    """Up to where the tip is at the goal; asked again, the navigator only hands it over."""
    planner, notes = foreseen()
    assert notes == []
    knots = planner.knots
    planner.model.return_to(knots[-1].snapshot)
    assert planner.model.tip_arc() >= GOAL
    planner.model.return_to(knots[-2].snapshot)
    assert planner.model.tip_arc() < GOAL
    stepwise, solved = navigator(), planner.model.solves
    feeds = [knot.feed for knot in knots[::3]]
    for feed, until in pairwise(feeds):
        seen = Observation(feed, np.zeros(3), np.zeros(3))
        own, other = planner.plan(seen, until), stepwise.plan(seen, until)
        middle = np.linspace(feed, until, 5)
        np.testing.assert_allclose(own.at(middle), other.at(middle), rtol=1e-9, atol=1e-12)
    assert planner.model.solves == solved


def test_around_a_spike_other_courses_are_planned(monkeypatch: pytest.MonkeyPatch) -> None:
    """What counts as one is lowered, and what is kept need not be better; the way there stays."""
    plain, _ = foreseen(level=False)
    monkeypatch.setattr(tuned, "SPIKE", replace(tuned.SPIKE, over=1.0, gain=1.5, rounds=1))
    planner, notes = foreseen()
    (note,) = notes
    tried = [f"{value:.3g}" for value in clearances(planner.demands.tip_clearance)]
    assert any(note.startswith(f"Planned with tip_clearance {value} around ") for value in tried)
    assert peak(planner) < 1.5 * peak(plain)
    assert len(planner.knots) != len(plain.knots) or any(
        np.any(one.flux != other.flux)
        for one, other in zip(planner.knots, plain.knots, strict=True)
    )
    top = max(plain.knots, key=lambda knot: norm(knot.flux))
    lead = top.feed - tuned.SPIKE.lead * plain.model.reach - 2.0 * plain.plan_every
    before = [(k.feed, k.flux) for k in plain.knots if k.feed < lead]
    for (feed, flux), knot in zip(before, planner.knots, strict=False):
        assert knot.feed == feed
        np.testing.assert_array_equal(knot.flux, flux)
    feeds = [knot.feed for knot in planner.knots]
    assert feeds == sorted(set(feeds))
    assert planner.demands == plain.demands


def test_a_course_that_none_betters_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    plain, _ = foreseen(level=False)
    monkeypatch.setattr(tuned, "SPIKE", replace(tuned.SPIKE, over=1.0, gain=1e-3))
    planner, notes = foreseen()
    assert notes == []
    for one, other in zip(planner.knots, plain.knots, strict=True):
        assert one.feed == other.feed
        np.testing.assert_array_equal(one.flux, other.flux)


def test_where_there_is_no_field_the_plan_ends() -> None:
    """The navigator says why when the wire comes there."""
    planner = StableNavigator(
        simulation("half-circle", paper_wire()).system, demands=mw.Demands(max_field=5e-3)
    )
    assert list(foresee(planner, mw.Feed(0.01, 0.06), GOAL)) == []
    end = planner.knots[-1].feed
    with pytest.raises(mw.NavigationError, match="the limit is 5 mT"):
        planner.plan(Observation(end, np.zeros(3), np.zeros(3)), end + 1e-3)
