"""The course of the guide, releasing nodes and taking them back (P-15)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.record import Record
from magwire.engine.system import Release, System
from magwire.field import FieldSource, UniformField
from magwire.operate import March
from wires import L, lumen, paper_wire

Array = NDArray[np.float64]
PAUSE = 0.5  # time in which the guide turns round [s]
STEP = 0.02


def test_constant_speed() -> None:
    feed = Feed(2e-3, 0.05, twist=0.3)
    assert feed.duration == 25.0
    assert feed.largest == pytest.approx(0.05)
    assert feed.fastest == 2e-3
    np.testing.assert_allclose(feed.at([0.0, 10.0, 25.0, 99.0]), [0.0, 0.02, 0.05, 0.05])
    np.testing.assert_allclose(feed.twist_at([0.0, 7.0, 25.0]), 0.3)


@given(
    st.lists(
        st.tuples(st.floats(0.1, 5.0), st.floats(0.0, 2e-3), st.floats(-9.0, 9.0)),
        min_size=2,
        max_size=6,
    )
)
def test_feed_is_the_integral_of_its_speed(course: list[tuple[float, float, float]]) -> None:
    spans, speeds, twists = np.array(course).T
    times = np.concatenate(([0.0], np.cumsum(spans[1:])))
    feed = Feed.table(times.tolist(), speeds.tolist(), twists.tolist())
    fine = np.linspace(0.0, feed.duration, 20001)
    speed = np.interp(fine, times, speeds)
    fed = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(fine))))
    np.testing.assert_allclose(feed.at(fine), fed, atol=1e-8)
    np.testing.assert_allclose(feed.twist_at(times), twists)
    assert feed.largest == pytest.approx(fed.max(), abs=1e-8)


def test_largest_feed_is_where_the_speed_turns() -> None:
    feed = Feed.table([0.0, 2.0, 4.0], [1e-3, 1e-3, -1e-3])
    assert feed.largest == pytest.approx(2.5e-3)
    assert float(feed.at(feed.duration)) == pytest.approx(2e-3)


def march(
    name: str,
    feed: Feed,
    field: FieldSource,
    *,
    release: Release = "sliding",
    inertia: bool = True,
) -> tuple[March, list[Record]]:
    system = System(
        paper_wire(), lumen(name), Barrier(1e3, 1e-4, wall="centreline"), release=release
    )
    step = STEP if inertia else 5.0 * STEP
    run = March(system, field, feed, time_step=step, inertia=inertia)
    records = list(run.records(round(0.5 / step)))
    assert run.step == run.steps, run.plant.message
    return run, records


@pytest.mark.parametrize(
    ("release", "inertia", "close"),
    [("sliding", True, 2e-5), ("sliding", False, 1e-8), ("node", False, 1e-8)],
)
@pytest.mark.parametrize(
    ("name", "push", "field"),
    [
        ("half-circle", 0.5, (0.0, 0.0, 0.0)),
        ("half-circle", 0.4, (1e-3, 3e-3, 2e-3)),
        ("sinusoid", 0.3, (0.0, 0.0, 0.0)),
        ("helix", 0.4, (0.0, 0.0, 0.0)),
    ],
)
def test_retraction_goes_back_the_way_it_came(
    name: str,
    push: float,
    field: tuple[float, float, float],
    release: Release,
    inertia: bool,
    close: float,
) -> None:
    """In and out at 1 mm/s: the same place at the same feed, and in the end all on the guide.

    Node by node only without inertia: the clamp jumps, and the wire swings for a while.
    """
    speed, time = 0.01 * L, 100.0 * push
    course = Feed.table(
        [0.0, time, time + 2 * PAUSE, 2 * (time + PAUSE)], [speed] * 2 + [-speed] * 2
    )
    run, records = march(name, course, UniformField(field), release=release, inertia=inertia)
    middle = len(records) // 2
    for i in range(middle):
        there, back = records[i], records[-1 - i]
        assert there.feed == pytest.approx(back.feed, abs=1e-12)
        np.testing.assert_allclose(back.position, there.position, atol=close * L)
        assert np.all(np.isfinite(back.contact_force))
    last = records[-1]
    guide = np.linspace(-L, 0.0, 100)[:, None] * run.plant.system.lumen.direction
    np.testing.assert_allclose(last.position, guide, atol=1e-12)
    assert np.all(last.contact_force == 0.0)
    assert np.all(np.isnan(last.clearance))


def test_what_is_not_fed_is_on_the_guide() -> None:
    """On the guide line, in its place along it; the clearance of such nodes is no number."""
    _, records = march("half-circle", Feed(1e-3, 0.03), UniformField())
    station = np.linspace(0.0, L, 100)
    for record in records[1:]:
        held = np.isnan(record.clearance)
        along = station - (L - record.feed)
        half_cell = 0.5 * L / 99
        assert np.all(along[held] <= half_cell + 1e-12)
        assert np.all(along[~held] >= -half_cell - 1e-12)
        np.testing.assert_allclose(record.position[held, 0], along[held], atol=1e-12)
        np.testing.assert_allclose(record.position[held, 1:], 0.0, atol=1e-12)
        assert np.all(record.contact_force[held] == 0.0)


def test_speed_as_a_function_of_time() -> None:
    """Slow in contact: where the wire is depends on how far it is fed, not on how fast."""
    _, constant = march("half-circle", Feed(1e-3, 0.03), UniformField())
    varied = Feed.table([0.0, 10.0, 20.0, 35.0], [0.0, 2e-3, 1e-3, 2e-3 / 3.0])
    assert float(varied.at(35.0)) == pytest.approx(0.0375)
    run, records = march("half-circle", varied, UniformField())
    assert run.plant.totals.steps == 1750
    feeds = np.array([record.feed for record in records])
    np.testing.assert_allclose(feeds, varied.at([record.time for record in records]), atol=1e-12)
    tips = np.array([record.position[-1] for record in records])
    for record in constant[10::10]:
        nearest = np.array([np.interp(record.feed, feeds, tips[:, c]) for c in range(3)])
        np.testing.assert_allclose(nearest, record.position[-1], atol=1e-3 * L)


def test_standing_still_changes_nothing() -> None:
    course = Feed.table([0.0, 20.0, 20.02, 40.0], [1e-3, 1e-3, 0.0, 0.0])
    _, records = march("half-circle", course, UniformField())
    np.testing.assert_allclose(records[-1].position, records[-20].position, atol=1e-9)
