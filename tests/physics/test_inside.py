"""No point of an edge leaves the lumen, and what the wall carries is said, whatever the wire."""

from __future__ import annotations

import pytest

import magwire as mw
from campaigns.random_setups import answer, deepest
from magwire.report.run import lines


def guidewire(nodes: int, steered: bool) -> tuple[mw.Simulation, mw.Result]:
    """0.014 inch of nitinol with a magnet of 1 GPa, pushed around a bend of 20 mm in a phantom."""
    shaft = mw.Section(0.12, 60e9, 60e9 / 2.6, 0.178e-3, 6500.0)
    magnet = mw.Section(0.01, 1e9, 1e9 / 2.6, 0.178e-3, 4000.0, magnetization=(0.0, 0.0, 300e3))
    simulation = mw.Simulation(mw.Wire((shaft, magnet), nodes), mw.Lumen.half_circle(20e-3, 2.5e-3))
    navigator = mw.TipNavigator() if steered else None
    feed = mw.Feed(2e-3, 0.06)
    return simulation, simulation.run(feed, navigator, time_step=0.01, record_every=1e-3)


@pytest.mark.parametrize("steered", [False, True])
def test_a_guidewire_in_a_phantom(steered: bool) -> None:
    """Its tip may be free; its shaft is not, and the summary has both."""
    simulation, result = guidewire(131, steered)
    assert result.status == "complete"
    assert result.smallest_clearance > 0.0
    assert deepest(simulation, result) == 0.0
    assert result.tip_contact_free == steered
    assert not result.wire_contact_free
    finer = guidewire(261, steered)[1]
    assert result.max_wall_force == pytest.approx(finer.max_wall_force, rel=0.05)
    assert result.max_wall_force > 0.1  # [N]
    assert result.max_patch_force == pytest.approx(finer.max_patch_force, rel=0.05)
    said = f"{1e3 * result.max_wall_force:.3g} mN in all"
    assert any(said in line for line in lines(result, steered=steered))


@pytest.mark.parametrize("seed", [1, 3, 6, 8, 9, 25, 36])
def test_random_set_ups(seed: int) -> None:
    """A few of the 600; ``python -m campaigns.random_setups`` runs them all."""
    found = answer(seed)
    assert found.status == "complete"
    assert found.outside == 0.0
