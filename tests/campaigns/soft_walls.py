"""Walls that give way and move, to their deepest: `pytest tests/campaigns/soft_walls.py`."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier, Friction, WallMotion
from magwire.engine.feed import Feed
from magwire.simulation import Simulation
from wires import L, lumen, paper_wire


@pytest.mark.parametrize("friction", [None, Friction(0.3)])
@pytest.mark.parametrize("dt", [0.001, 0.01, 0.1])
@pytest.mark.parametrize("foundation", [1e6, 1e7, 1e8])
def test_a_soft_wall_that_moves(foundation: float, dt: float, friction: Friction | None) -> None:
    sim = Simulation(
        paper_wire(60),
        lumen("half-circle"),
        contact=Barrier(foundation=foundation),
        friction=friction,
        wall_motion=WallMotion((0.6e-3, 0.6e-3, 0.529e-3), 1.0, 25e-3),
    )
    run = sim.run(Feed(0.05 * L if dt < 0.01 else 0.02 * L, 0.5 * L), time_step=dt)
    print(foundation, dt, friction, run.status, run.smallest_clearance, run.largest_indentation)
    assert run.status == "complete", run.message
    assert run.smallest_clearance > 0.0
    assert np.nanmax(run.wall_indentation) > 0.0
