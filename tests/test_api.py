"""The public interface as it should read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import magwire as mw


def test_a_whole_navigation(tmp_path: Path) -> None:
    wire = mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=100,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )
    lumen = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    contact = mw.Barrier(stiffness=1e3, activation_gap=0.1e-3)
    sim = mw.Simulation(wire, lumen, field=mw.UniformField(), contact=contact)
    feed, navigator = mw.Feed(speed=1e-3, distance=0.075), mw.TipNavigator(update_every=0.5e-3)
    result = sim.run(feed=feed, navigator=navigator, time_step=0.01)

    assert result.status == "complete"
    assert result.max_tip_force == 0.0
    assert result.contact_free
    assert 0.02 < result.peak_field < 0.06
    result.save(tmp_path / "half-circle.nc")
    assert mw.Result.load(tmp_path / "half-circle.nc").peak_field == result.peak_field
    assert len(result.plot().get_axes()) > 3

    state = sim.equilibrium(feed=0.03, field=[0, 0.01, 0])
    assert state.stable
    assert state.clearance.shape == (100,)
    assert state.wall_force.shape == (100, 3)
    slope = state.sensitivity("tip", wrt="field")
    assert slope.shape == (3, 3)
    nearby = sim.equilibrium(feed=0.03, field=[0, 0.01, 1e-6], start=state)
    np.testing.assert_allclose((nearby.tip - state.tip) / 1e-6, slope[:, 2], rtol=1e-3, atol=1e-4)


def test_a_tip_navigator_has_no_memory() -> None:
    sim = mw.load_scenario("half-circle").build().simulation
    feed, navigator = mw.Feed(speed=1e-3, distance=0.02), mw.TipNavigator(update_every=1e-3)
    first, second = (sim.run(feed, navigator, motion="quasi-static") for _ in range(2))
    np.testing.assert_array_equal(first.field, second.field)
    assert first.peak_field > 0.0


def test_a_tip_navigator_passes_on_what_is_asked_for() -> None:
    sim = mw.load_scenario("half-circle").build().simulation
    feed = mw.Feed(speed=1e-3, distance=0.03)
    navigator = mw.TipNavigator(mw.Demands(max_field=5e-3), plan_every=2e-4)
    result = sim.run(feed, navigator, motion="quasi-static")
    assert result.status == "no field"
    assert "the limit is 5 mT" in result.message


@pytest.mark.parametrize("name", ["update_every", "plan_every"])
def test_faulty_tip_navigators(name: str) -> None:
    with pytest.raises(mw.InputError, match=f"{name} of TipNavigator must be positive"):
        mw.TipNavigator(**{name: -1e-3})
