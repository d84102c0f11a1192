"""Newton's method is quadratic: from a distance d, k iterations leave a residual ~ d^(2^k).

Slopes over d, not over the iterations of one solve: the wire is stiff in stretching, and what is
left in its length after one iteration hides the rest.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.wires import order
from magwire.kernels.arrays import Motion
from magwire.kernels.newton import Limits, newton
from magwire.simulation import Simulation
from tangent import copy
from wires import L, flux, free, lumen, magnet, paper_wire

Array = NDArray[np.float64]


def left_over(start: Equilibrium, target: Equilibrium, iterations: int) -> float:
    """Residual after a few iterations from one equilibrium towards another at the same feed."""
    point, state = target.point, copy(start)
    system, work = point.system, point.system.new_work()
    model = system.new_terms(point.field)
    limits = Limits(0.0, iterations, 1.0)
    still = Motion(0.0, work.target)
    _, _, _, residual, _ = newton(model, state, point.mouth, still, work, limits)
    return float(residual)


def planar() -> tuple[Simulation, float, Array, Array]:
    """Simulation, feed, field, and the direction in which the field is changed."""
    wire = magnet(100)
    return free(wire), L, flux(wire, 3.0, 90.0), flux(wire, 1.0, 90.0)


def spatial() -> tuple[Simulation, float, Array, Array]:
    wire = magnet(100, magnetization=(10e3, 5e3, 20e3), rest_curvature=(10.0, 5.0))
    return free(wire), L, flux(wire, 3.0, 90.0) + [0.0, 0.0, 1e-4], flux(wire, 1.0, 45.0)


def in_contact() -> tuple[Simulation, float, Array, Array]:
    sim = Simulation(
        paper_wire(), lumen("half-circle"), contact=Barrier(1e3, 1e-4, wall="centreline")
    )
    return sim, 0.0404, np.array([1e-3, 5e-3, 2e-3]), np.array([0.0, 0.01, 0.0])


@pytest.mark.parametrize(
    ("case", "iterations", "distances"),
    [
        (planar, 1, (2e-3, 5e-3, 1e-2)),
        (planar, 2, (1e-2, 1.5e-2, 2e-2)),
        (spatial, 1, (2e-3, 5e-3, 1e-2)),
        (spatial, 2, (5e-3, 1e-2, 2e-2)),
        (in_contact, 1, (1e-3, 3e-3, 1e-2)),
        (in_contact, 2, (1.5e-2, 3e-2, 6e-2)),
    ],
)
def test_quadratic(case: object, iterations: int, distances: tuple[float, ...]) -> None:
    sim, feed, field, change = case()  # type: ignore[operator]
    start = sim.equilibrium(feed, field)
    assert (start.tip_force > 0.0) == (case is in_contact)
    ends = [sim.equilibrium(feed, field + d * change, start=start) for d in distances]
    residuals = [left_over(start, end, iterations) for end in ends]
    assert order(distances, residuals) == pytest.approx(2.0**iterations, rel=0.15)
