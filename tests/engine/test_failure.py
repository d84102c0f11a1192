"""A run that cannot converge ends with a status and a result up to there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.status import Status
from magwire.field import UniformField
from magwire.operate import March
from magwire.results import Result
from magwire.simulation import Simulation
from wires import lumen, paper_wire

FEED = Feed(1e-3, 0.03)


def hopeless() -> Simulation:
    """A wall so weak that it would hold the wire only within round-off of itself."""
    barrier = Barrier(1e-12, wall="centreline")
    return Simulation(paper_wire(), lumen("half-circle"), contact=barrier)


def test_status_and_remedy() -> None:
    result = hopeless().run(FEED, time_step=0.1)
    assert result.status == "not converged"
    assert not result.converged
    assert result.message.startswith("The step to 12.")
    assert "did not converge, even when cut into 1024 parts" in result.message
    assert "; try " in result.message
    assert result.message.endswith(".")


def test_what_was_reached_is_kept_and_readable(tmp_path: Path) -> None:
    path = tmp_path / "hopeless.nc"
    written = hopeless().run(FEED, time_step=0.1, out=path)
    read = Result.load(path)
    assert read.status == "not converged"
    assert read.message == written.message
    assert 0.012 < read.feed[-1] < 0.013
    assert np.isfinite(read.position).all()
    assert np.isfinite(read.tip_force).all()
    assert np.all(read.tip_force < 1e-6)


def test_a_failed_step_leaves_no_trace() -> None:
    """The state after the failure is that of a run that was never asked for the failing step."""
    system = hopeless().system
    run = March(system, UniformField(), FEED, time_step=0.1)
    assert not run.advance(10**6)
    assert run.plant.status is not Status.CONVERGED
    assert run.plant.totals.retries == 11  # once along the wall, then ten halvings
    assert run.plant.totals.steps == run.step < run.steps
    after = run.plant.record()

    other = March(system, UniformField(), FEED, time_step=0.1)
    assert other.advance(run.step)
    before = other.plant.record()
    assert after.feed == before.feed
    np.testing.assert_array_equal(after.position, before.position)
    np.testing.assert_array_equal(after.contact_force, before.contact_force)
    assert after.totals.max_tip_force == before.totals.max_tip_force
    assert after.totals.mean_tip_force == before.totals.mean_tip_force
    np.testing.assert_equal(after.totals.first_contact_feed, before.totals.first_contact_feed)


@pytest.mark.parametrize("time_step", [2.0, 10.0])
def test_a_step_that_feeds_several_edges_is_done_in_parts(time_step: float) -> None:
    """Two or ten edges fed in one step: right in the end, and without a failure on the way."""
    system = Simulation(
        paper_wire(), lumen("half-circle"), contact=Barrier(1e3, 1e-4, wall="centreline")
    ).system
    large = March(system, UniformField(), Feed(1e-3, 0.05), time_step=time_step)
    assert large.advance(10**6), large.plant.message
    assert large.plant.totals.steps == round(50.0 / time_step)
    assert large.plant.totals.retries == 0
    small = March(system, UniformField(), Feed(1e-3, 0.05), time_step=0.1)
    assert small.advance(10**6)
    assert small.plant.totals.retries == 0
    np.testing.assert_allclose(
        large.plant.record().position, small.plant.record().position, atol=1e-4
    )


def test_every_status_has_a_remedy() -> None:
    for status in Status:
        if status is not Status.CONVERGED:
            assert "; " in status.remedy
            assert not status.remedy.endswith(".")
