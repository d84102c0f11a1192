"""Push and torque at the guide: in balance with all else, and the work that they do (P-38)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.feed import Feed
from magwire.engine.system import System
from magwire.field import GradientField, UniformField
from magwire.kernels.hinge import material_frame
from magwire.lumen import Lumen
from magwire.operate import March
from magwire.simulation import Simulation
from magwire.wire import Wire, lay_out
from rubbing import energy
from wires import L, flux, lumen, paper_wire

Array = NDArray[np.float64]
GRAVITY = (1.0, -2.0, 9.0)
GRADIENT = GradientField(
    (2e-3, 4e-3, 1e-3), ((0.2, 0.3, 0.1), (0.3, -0.4, 0.2), (0.1, 0.2, 0.2)), (0.01, 0.0, 0.0)
)
ROUND_OFF = 1e-10


def wire() -> Wire:
    return Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, 80, magnetized_tip=0.03, magnetization=(20e3, -30e3, 60e3)
    )


def loads(system: System, positions: Array, frames: object, held: int) -> tuple[Array, Array]:
    """Forces [N] of field and gravity on the nodes in front of the guide; torques [N m] on edges.

    frames: a state of the kernels, for the directions of the moments.
    """
    mesh = lay_out(system.wire)
    force = mesh.mass[:, None] * np.array(system.gravity)
    force[:held] = 0.0
    torque = np.zeros((len(mesh.moment), 3))
    for i in range(held, len(frames.length)):  # type: ignore[attr-defined]
        t = tuple(frames.tangent[i])  # type: ignore[attr-defined]
        m1, m2 = material_frame(tuple(frames.director[i]), t, frames.q[i, 3])  # type: ignore[attr-defined]
        m = mesh.moment[i - 1] @ np.array([m1, m2, t])
        flux_density, gradient = GRADIENT.at((0.5 * (positions[i - 1] + positions[i]))[None])
        force[i - 1 : i + 1] += 0.5 * m @ gradient[0]
        torque[i - 1] = np.cross(m, flux_density[0])
    return force, torque


def left_over(system: System, gradient: Array, held: int) -> tuple[Array, Array]:
    """What accelerates the free nodes [N] and turns the free edges [N m]; at rest, next to none."""
    unit = system.scales.force
    return -gradient[held + 1 :, :3] * unit, -gradient[held:-1, 3] * unit * L


@pytest.mark.parametrize("name", ["half-circle", "helix"])
def test_push_and_torque_are_in_balance_at_rest(name: str) -> None:
    sim = Simulation(
        wire(), lumen(name), contact=Barrier(wall="centreline"), field=GRADIENT, gravity=GRAVITY
    )
    state = sim.equilibrium(0.0404)
    point, held = state.point, state.point.mouth.held
    gradient = point.gradient(sim.system.new_work())
    axis, start = sim.system.guide.direction, sim.system.lumen.entrance
    force, torque = loads(sim.system, state.positions, point.state, held)
    force += state.wall_force
    moving, turning = left_over(sim.system, gradient, held)
    force[held:] -= moving
    size = np.linalg.norm(force, axis=1).sum()
    assert state.push_force + force.sum(axis=0) @ axis == pytest.approx(0.0, abs=ROUND_OFF * size)
    about = np.cross(state.positions - start, force).sum(axis=0) + torque.sum(axis=0)
    about -= turning @ point.state.tangent[held:]
    left = state.guide_torque + about @ axis
    assert left == pytest.approx(0.0, abs=ROUND_OFF * size * L)
    assert abs(state.guide_torque) > 1e-3 * size * L
    assert np.abs(moving).sum() < 1e-6 * size


def test_push_in_motion_is_what_all_else_leaves_and_what_accelerates_the_wire() -> None:
    system = System(wire(), lumen("half-circle"), Barrier(wall="centreline"), gravity=GRAVITY)
    step = 1e-3
    march = March(system, GRADIENT, Feed(0.1, 0.05), time_step=step)
    march.advance(450)
    records = [march.plant.record()]
    for _ in range(2):
        assert march.advance(1)
        records.append(march.plant.record())
    last, axis = records[-1], system.guide.direction
    held = int(np.flatnonzero(np.isnan(last.clearance))[-1]) + 1  # the kernels count from a ghost
    gradient = march.plant.work.gradient
    moving, _ = left_over(system, gradient, held)
    force = loads(system, last.position, march.plant.state, held)[0] + last.contact_force
    size = np.linalg.norm(force, axis=1).sum()
    balance = last.push_force + (force.sum(axis=0) - moving.sum(axis=0)) @ axis
    assert balance == pytest.approx(0.0, abs=ROUND_OFF * size)
    before, now = (np.diff([r.position for r in records], axis=0) / step)[:, held:]
    mass = lay_out(system.wire).mass[held:, None]
    inertia = mass * ((now - before) / step + system.damping * now)
    assert np.linalg.norm(inertia, axis=1).sum() > 1e-3 * size
    away = last.push_force + (force.sum(axis=0) - inertia.sum(axis=0)) @ axis
    assert away == pytest.approx(0.0, abs=1e-6 * size)


@pytest.mark.parametrize("down", [1.0, -1.0])
def test_a_straight_wire_is_pushed_by_its_weight(down: float) -> None:
    straight = Wire.uniform(L, 0.6e-3, 3e6, 1e6, 2000.0, 101)
    sim = Simulation(straight, Lumen.open_space(), gravity=(down, 0.0, 0.0))
    free = 0.0295  # the node at 70 mm is held: from the end of its cell on
    weight = 2000.0 * np.pi * 0.6e-3**2 * free * down
    assert sim.equilibrium(0.0303).push_force == pytest.approx(-weight, rel=1e-6)


def test_the_torque_turns_a_magnet_across_the_wire() -> None:
    across = Wire.uniform(
        L, 0.6e-3, 3e6, 1e6, 2000.0, 101, magnetized_tip=5e-3, magnetization=(0.0, 50e3, 0.0)
    )
    sim = Simulation(across, Lumen.open_space())
    state = sim.equilibrium(0.05, sim.system.guide.director * 2e-3)
    moment = 50e3 * np.pi * 0.6e-3**2 * 5e-3
    turned = state.point.state.q[-6:-1, 3]  # the edges of the magnet
    torque = moment * 2e-3 * np.cos(turned).mean()
    assert state.guide_torque == pytest.approx(torque, rel=1e-6)
    clamp = 0.045 + 5e-3 / 3.0  # of the mean turn of a magnet along which the torque grows
    stiffness = across.body.twisting_stiffness / clamp
    assert state.guide_torque == pytest.approx(-stiffness * turned.mean(), rel=0.01)


def test_feeding_takes_the_push_less_what_the_bent_wire_does_at_the_mouth() -> None:
    """dE/ds = push - EI kappa^2/2: a bent wire squeezes itself out of a sleeve."""
    straight = paper_wire()
    sim = Simulation(straight, lumen("sinusoid"), contact=Barrier(1e5, wall="centreline"))
    field = UniformField(tuple(flux(straight, 20.0, 60.0)))
    feed, apart = 0.0502, 1e-6
    state = sim.equilibrium(feed, field)
    energies = []
    for there in (feed - apart, feed + apart):
        point = sim.equilibrium(there, field, start=state).point
        energies.append(point.energy(sim.system.new_work())[0])
    force = sim.system.scales.force
    slope = (energies[1] - energies[0]) * force * L / (2.0 * apart)
    mouth = state.point.mouth
    edge = state.positions[mouth.held] - state.positions[mouth.held - 1]
    angle = np.arccos(edge @ sim.system.guide.direction / np.linalg.norm(edge))
    curvature = 2.0 * np.tan(0.5 * angle) / (mouth.fraction * straight.edge_length)
    squeezed = 0.5 * straight.bending_stiffness * curvature**2
    assert squeezed > 0.05 * state.push_force
    assert slope == pytest.approx(state.push_force - squeezed, rel=1e-5)


@pytest.mark.parametrize("rest", [(0.0, 0.0), (20.0, -10.0)])
def test_the_hand_feels_what_feeding_costs(rest: tuple[float, float]) -> None:
    """Also of a wire curved at rest and twisted: what is recorded is the slope of the energy."""
    curved = Wire.uniform(
        L,
        0.6e-3,
        3e6,
        1e6,
        2000.0,
        60,
        magnetized_tip=0.03,
        magnetization=60e3,
        rest_curvature=rest,
    )
    sim = Simulation(curved, lumen("sinusoid"), contact=Barrier(1e5, wall="centreline"))
    session = sim.session(feed=0.0495, motion="quasi-static")
    session.step(twist_rate=0.5 / session.time_step, inputs=(0.0, 5e-3, 10e-3))
    apart, energies = 0.5e-6, []
    for _ in range(2):
        session.step(feed_speed=apart / session.time_step)
        energies.append(energy(session))
        if len(energies) == 1:
            session.step(feed_speed=apart / session.time_step)
            felt = session.record()
    slope = (energies[1] - energies[0]) / (2.0 * apart)
    assert felt.insertion_force == pytest.approx(slope, abs=1e-4 * felt.push_force)
    assert abs(felt.insertion_force - felt.push_force) > 0.05 * abs(felt.push_force)
