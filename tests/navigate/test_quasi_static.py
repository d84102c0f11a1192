"""Runs by equilibria: the plant without the virtual tube, whoever steers (P-16, P-19)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine import Feed
from magwire.errors import InputError
from magwire.field import UniformField
from magwire.lumen import Lumen
from magwire.navigate import Observation
from magwire.results import Result
from magwire.scenario import load, schedule_of
from magwire.scenario.replays import replayed
from magwire.simulation import Simulation
from wires import L, lumen, paper_wire, simulation

METHODS = ("none", "stable", "newton", "paper", "schedule")


@lru_cache
def run(method: str, name: str = "half-circle", distance: int = 40) -> Result:
    """A quasi-static run of a scenario; the schedule is that of ``stable``."""
    keys = [f"navigate.method={method}", "solver.motion=quasi-static"]
    keys += [f"feed.distance={distance} mm", "output.record_every=0.5 mm"]
    if method == "schedule":
        described = replayed(run("stable", name, distance), ["solver.motion=quasi-static"])
        return described.run()
    return load(name, keys).run()


@pytest.mark.parametrize("method", METHODS)
def test_records_are_equilibria_of_the_wire_without_the_tube(method: str) -> None:
    result, sim = run(method), simulation("half-circle", paper_wire())
    assert result.status == "complete", result.message
    assert result.motion == "quasi-static"
    assert result.steps == 80
    np.testing.assert_allclose(result.time, result.feed / 1e-3, atol=1e-9)
    assert result.stable.all()
    for k in (40, 60, 80):
        state = sim.equilibrium(result.feed[k], result.field[k])
        assert state.stable
        np.testing.assert_allclose(result.position[k], state.positions, atol=2e-6 * L)
        size = sim.system.scales.force
        np.testing.assert_allclose(result.contact_force[k], state.wall_force, atol=2e-2 * size)
    assert (result.max_tip_force > 0.0) == (method == "none")


@pytest.mark.parametrize("method", ["stable", "newton"])
def test_it_ends_where_the_dynamic_run_ends(method: str) -> None:
    keys = [f"navigate.method={method}", "feed.distance=40 mm", "solver.time_step=50 ms"]
    dynamic, static = load("half-circle", keys).run(), run(method)
    assert dynamic.motion == "dynamic"
    np.testing.assert_allclose(static.field[-1], dynamic.field[-1], atol=1e-9)
    np.testing.assert_allclose(static.position[-1], dynamic.position[-1], atol=5e-4 * L)


def test_records_observations_and_edges_set_the_step() -> None:
    sim, feed = simulation("half-circle", paper_wire()), Feed(1e-3, 0.01)
    seen: list[float] = []

    class Watching:
        update_every = 1e-3

        def start(self, system: object) -> Watching:
            return self

        def plan(self, observation: Observation, until: float):  # type: ignore[no-untyped-def]
            seen.append(observation.feed)
            return schedule_of(run("stable"))

    settings = {"motion": "quasi-static", "record_every": 2e-3}
    result = sim.run(feed, Watching(), **settings)  # type: ignore[arg-type]
    assert (result.steps, result.time.size) == (20, 6)
    np.testing.assert_allclose(seen, np.arange(10) * 1e-3, atol=1e-12)
    seen.clear()
    assert sim.run(feed, Watching(), update_every=5e-3, **settings).steps == 20  # type: ignore[arg-type]
    np.testing.assert_allclose(seen, [0.0, 5e-3], atol=1e-12)
    settings["record_every"] = 2e-4
    assert sim.run(feed, **settings).steps == 50  # type: ignore[arg-type]


def test_a_run_ends_where_its_tip_is_to_come_to() -> None:
    """In a bend a wire that lies on the outside is fed farther than its tip comes."""
    sim = simulation("half-circle", paper_wire())
    result = sim.run(Feed(1e-3, 0.06), motion="quasi-static", record_every=5e-4, until=0.03)
    arc = [sim.tip_arc(position) for position in result.position]
    assert result.status == "complete"
    assert arc[-2] < 0.03 <= arc[-1] < 0.0305
    assert 0.0305 < result.feed[-1] < 0.04


def test_turning_alone_is_done_in_time_steps() -> None:
    sim = Simulation(paper_wire(40), Lumen.straight(L, 3e-3))
    feed = Feed.table([0.0, 2.0], [0.0, 0.0], [0.0, 1.0])
    result = sim.run(feed, motion="quasi-static", time_step=0.5)
    assert (result.status, result.steps) == ("complete", 4)


def test_an_unstable_equilibrium_ends_the_run() -> None:
    """A field against the tip: straight on is an equilibrium that buckling has left behind."""
    sim = Simulation(paper_wire(), Lumen.straight(L, 3e-3), field=UniformField((-0.02, 0.0, 0.0)))
    feed = Feed(1e-3, 0.04)
    result = sim.run(feed, motion="quasi-static", record_every=5e-4)
    assert result.status == "unstable"
    assert result.stable[:-1].all()
    assert not result.stable[-1]
    assert result.message == (
        "The equilibrium at 24.5 mm of feed is unstable: a wire leaves it, and quasi-static motion "
        "does not tell where to; dynamic motion does."
    )
    assert not sim.equilibrium(0.0245, start=sim.equilibrium(0.024)).stable
    assert sim.equilibrium(0.024).stable


def test_no_force_of_a_state_that_did_not_converge() -> None:
    barrier = Barrier(1e-12, wall="centreline")  # it would hold the wire only within round-off
    sim = Simulation(paper_wire(), lumen("half-circle"), contact=barrier)
    result = sim.run(Feed(1e-3, 0.03), motion="quasi-static")
    assert result.status == "not converged"
    assert "; try " in result.message
    assert result.feed[-1] < 0.013
    assert np.all(result.tip_force < 1e-6)


def test_a_snap_is_seen() -> None:
    """In the helix only the tube holds the tip of a least-norm schedule: without it, it slips.."""
    slips, holds = run("newton", "helix"), run("newton")
    assert slips.largest_move > 1.5e-3 > 1e-4 > holds.largest_move
    assert slips.largest_tip_departure > 1.5e-3 > 1e-4 > holds.largest_tip_departure


def test_a_schedule_proves_itself_in_dynamic_motion() -> None:
    assert replayed(run("stable")).solver.motion == "dynamic"


def test_faults_and_what_is_none() -> None:
    keys = ["solver.motion=quasi-static", "solver.time_step=100 s", "feed.distance=40 mm"]
    assert load("half-circle", keys).solver.motion == "quasi-static"  # no step in time, no fault
    sim, feed = simulation("half-circle", paper_wire()), Feed(1e-3, 0.01)
    with pytest.raises(InputError, match="'dynamic' or 'quasi-static'; received 'static'"):
        sim.run(feed, motion="static")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="record_every of Simulation must be positive"):
        sim.run(feed, motion="quasi-static", record_every=0.0)
