"""Second order in space: the hard-magnetic elastica on ever finer meshes."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.evidence.verify.wires import order
from tables import closed_form
from wires import L, flux, free, magnet

NODES = np.array([26, 51, 101, 201])
ROWS = {row[:2]: row for row in closed_form("hard_magnetic_elastica_uniform")}


def errors(nodes: int, degrees: float, b: float) -> tuple[float, float]:
    """Error of the tip's position over L, and of its angle [rad]."""
    _, _, angle, _, x, y = ROWS[degrees, b]
    wire = magnet(nodes)
    state = free(wire).equilibrium(L, flux(wire, b, degrees))
    along = np.arctan2(state.tip_direction[1], state.tip_direction[0])
    place = np.hypot(state.tip[0] / L - x, state.tip[1] / L - y)
    return float(place), abs(float(along) - angle)


@pytest.mark.parametrize("b", [1.0, 3.0, 10.0])
@pytest.mark.parametrize("degrees", [45.0, 90.0, 135.0])
def test_second_order_in_space(degrees: float, b: float) -> None:
    place, angle = np.array([errors(nodes, degrees, b) for nodes in NODES]).T
    assert order(1.0 / (NODES - 1), place) == pytest.approx(2.0, abs=0.2)
    assert order(1.0 / (NODES - 1), angle) == pytest.approx(2.0, abs=0.2)
