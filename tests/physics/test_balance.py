"""Forces and torques on the whole wire are in balance, each computed on its own (P-7, P-13)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.statics import Equilibrium
from magwire.evidence.verify.wires import guide_load as scaled_guide_load
from magwire.field import FieldSource, GradientField, UniformField
from magwire.kernels.hinge import material_frame
from magwire.lumen import Lumen
from magwire.simulation import Simulation
from magwire.wire import Wire, lay_out
from wires import L, lumen

Array = NDArray[np.float64]
GRAVITY = (1.0, -2.0, 9.0)
FLUID = 700.0
GRADIENT = GradientField(
    (2e-3, 4e-3, 1e-3), ((0.2, 0.3, 0.1), (0.3, -0.4, 0.2), (0.1, 0.2, 0.2)), (0.01, 0.0, 0.0)
)


def wire() -> Wire:
    return Wire.uniform(
        L,
        0.6e-3,
        3e6,
        1e6,
        2000.0,
        80,
        magnetized_tip=0.03,
        magnetization=(20e3, -30e3, 60e3),
        rest_curvature=(10.0, 5.0),
    )


def guide_load(state: Equilibrium) -> tuple[Array, Array]:
    """Force [N] of the guide on the wire, and its torque about the origin [N m]."""
    force, torque = scaled_guide_load(state)
    unit = state.point.system.scales.force
    return force * unit, torque * unit * L


def magnet_load(state: Equilibrium, field: FieldSource) -> tuple[Array, Array]:
    """Force m grad B and torque m x B + x m grad B of the field on every free edge."""
    point = state.point
    held = point.mouth.held
    moment = lay_out(point.system.wire).moment
    force, torque = np.zeros(3), np.zeros(3)
    for i in range(held, len(point.state.length)):
        t = tuple(point.state.tangent[i])
        m1, m2 = material_frame(tuple(point.state.director[i]), t, point.state.q[i, 3])
        m = moment[i - 1] @ np.array([m1, m2, t])
        middle = 0.5 * (state.positions[i - 1] + state.positions[i])
        flux, gradient = field.at(middle[None])
        pull = m @ gradient[0]
        force += pull
        torque += np.cross(m, flux[0]) + np.cross(middle, pull)
    return force, torque


def weight(state: Equilibrium) -> tuple[Array, Array]:
    held, mesh = state.point.mouth.held, lay_out(state.point.system.wire)
    pulls = (mesh.mass - FLUID * mesh.volume)[held:, None] * np.array(GRAVITY)
    return pulls.sum(axis=0), np.cross(state.positions[held:], pulls).sum(axis=0)


CASES = {
    "open space": (Lumen.open_space, 0.0707, GRADIENT),
    "half-circle": (lambda: lumen("half-circle"), 0.0404, GRADIENT),
    "helix": (lambda: lumen("helix"), 0.0555, UniformField((3e-3, -2e-3, 4e-3))),
}


@pytest.mark.parametrize("case", CASES)
def test_everything_is_in_balance(case: str) -> None:
    where, feed, field = CASES[case]
    sim = Simulation(
        wire(),
        where(),
        contact=Barrier(1e3, 1e-4, wall="centreline"),
        field=field,
        gravity=GRAVITY,
        fluid_density=FLUID,
    )
    state = sim.equilibrium(feed)
    loads = [guide_load(state), magnet_load(state, field), weight(state)]
    wall = state.wall_force.sum(axis=0), np.cross(state.positions, state.wall_force).sum(axis=0)
    assert (np.linalg.norm(wall[0]) > 0.0) == (case != "open space")
    forces = np.array([wall[0], *[load[0] for load in loads]])
    torques = np.array([wall[1], *[load[1] for load in loads]])
    size = np.linalg.norm(forces, axis=1).max()
    assert np.linalg.norm(forces.sum(axis=0)) < 1e-8 * size
    assert np.linalg.norm(torques.sum(axis=0)) < 1e-8 * size * L
    assert np.all(np.linalg.norm(forces[1:], axis=1)[[0, 2]] > 1e-3 * size)
