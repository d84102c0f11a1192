"""The measured tip against the one in the navigator's model."""

from __future__ import annotations

import numpy as np
import pytest

import magwire as mw
from magwire.actuate import Helmholtz, Pair, Pose
from magwire.engine import Feed
from magwire.navigate import Prescribed
from magwire.navigate.allocation import Allocated, Objective
from magwire.navigate.stable import StableNavigator
from magwire.scenario import schedule_of
from magwire.wire import Wire
from wires import L, paper_wire, simulation

FEED = Feed(1e-3, 0.03)


def softer(part: float) -> Wire:
    """The paper's wire with moduli that are smaller by a part."""
    moduli = 3e6 * (1.0 - part), 1e6 * (1.0 - part)
    return Wire.uniform(L, 0.6e-3, *moduli, 2000.0, 100, magnetized_tip=5e-3, magnetization=128e3)


def test_a_wire_that_is_as_believed_is_where_it_is_believed() -> None:
    sim = simulation("half-circle", paper_wire())
    result = sim.run(FEED, StableNavigator(sim.system), motion="quasi-static")
    known = np.isfinite(result.tip_departure)
    np.testing.assert_allclose(result.feed[known], np.arange(1, 61) * 5e-4, atol=1e-9)
    assert result.largest_tip_departure < 1e-6 * L


@pytest.mark.parametrize("part", [0.05, 0.2])
def test_a_wire_that_is_softer_is_elsewhere(part: float) -> None:
    """What departs is the tip of the softer wire, at rest, from that of the believed one."""
    believed = simulation("half-circle", paper_wire())
    real = simulation("half-circle", softer(part))
    result = real.run(FEED, StableNavigator(believed.system), time_step=0.05)
    fed, field = result.feed[-1], result.field[-1]
    tips = [sim.equilibrium(fed, field).tip for sim in (real, believed)]
    expected = float(np.linalg.norm(tips[1] - tips[0]))
    assert expected > 1e-3 * L * part
    assert result.tip_departure[-1] == pytest.approx(expected, rel=0.01)


def test_nobody_compares_without_a_model() -> None:
    sim = simulation("half-circle", paper_wire())
    short = Feed(1e-3, 0.012)
    passive = sim.run(short, motion="quasi-static")
    blind = sim.run(short, Prescribed(schedule_of(passive)), motion="quasi-static")
    for result in (passive, blind):
        assert np.isnan(result.tip_departure).all()
        assert np.isnan(result.largest_tip_departure)


@pytest.mark.parametrize("objective", ["power", "field"])
def test_in_coils_the_model_is_asked_in_the_currents_that_flow(objective: Objective) -> None:
    """Not in the weakest that they may be, nor, past the path's end, where the plan has ended."""
    pairs = tuple(Pair(axis, 0.15, 300.0, max_current=60.0) for axis in "xyz")
    coils = Helmholtz(pairs=pairs, pose=Pose(translation=(0.02, 0.0, 0.0)))
    lumen = mw.Lumen.through([[0, 0, 0], [10e-3, 0, 0], [20e-3, 3e-3, 0], [30e-3, 10e-3, 0]], 3e-3)
    sim = mw.Simulation(paper_wire(), lumen, actuator=coils)
    steering = Allocated(mw.TipNavigator(mw.Demands(tip_clearance=0.5)), objective)
    result = sim.run(Feed(1e-3, lumen.length + 4e-3), steering, motion="quasi-static")
    assert result.status == "complete"
    known = np.isfinite(result.tip_departure)
    assert known.sum() > 40
    assert not known[-1]
    assert result.largest_tip_departure < 1e-5 * L
