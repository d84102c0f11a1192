"""Progress where there is no terminal: lines now and then."""

from __future__ import annotations

import logging

import pytest

from magwire.engine.feed import Feed
from magwire.report import progress
from magwire.scenario import load
from wires import paper_wire, simulation


def lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return capsys.readouterr().err.splitlines()


def test_quick_work_prints_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.pieces(3) as begin:
        for name in ("one", "two", "three"):
            begin(name)
    assert lines(capsys) == []


def test_long_work_says_how_far_it_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(progress, "EVERY", 0.0)
    with progress.pieces(3) as begin:
        for name in ("one", "two", "three"):
            begin(name)
    said = lines(capsys)
    assert [line.split()[-1] for line in said] == ["one", "two", "three"]
    assert [line.split()[-3] for line in said] == ["0/3", "1/3", "2/3"]


def test_a_run_says_feed_force_and_pace(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(progress, "EVERY", 0.0)
    feed = Feed(1e-3, 3e-3)
    with progress.running(feed.duration) as watch:
        run = simulation("half-circle", paper_wire(30)).run(feed, watch=watch, record_every=1e-3)
    assert run.status == "complete"
    said = [" ".join(line.split()) for line in lines(capsys)]
    assert len(said) == 4  # one of them as the run begins
    assert "100% feed 3.0 mm tip force 0.000 mN" in said[-1]
    assert said[-1].endswith("x real time")


def test_a_magnet_on_an_arm_says_how_far_its_plan_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The whole course is planned before the first record comes."""
    monkeypatch.setattr(progress, "EVERY", 0.0)
    fast = ["feed.distance=12 mm", "feed.speed=4 mm/s", "solver.time_step=50 ms"]
    job = load("half-circle-magnet", [*fast, "navigate.update_every=2 mm"]).build()
    with progress.running(job.feed.duration) as watch:
        assert job.run(watch=watch).status == "complete"
    said = [" ".join(line.split()) for line in lines(capsys)]
    planned = [line for line in said if line.startswith("planning at")]
    assert planned[0].startswith("planning at 0.0 mm")
    assert planned[-1].startswith("planning at 11.5 mm")
    assert said[-1].startswith("running")
    assert "100% feed 12.0 mm" in said[-1]
    assert not logging.getLogger("magwire.navigate").handlers
