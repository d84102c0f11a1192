"""Wires under friction that tests and campaigns share: what holds them, and their energy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from magwire.engine.record import Record
from magwire.kernels.arrays import Motion
from magwire.kernels.assembly import assemble
from magwire.kernels.wall.traction import FACTOR, LOAD, SLIP
from magwire.session import Session

Array = NDArray[np.float64]


def in_balance(record: Record, load: Array, direction: Array) -> tuple[float, float]:
    """What is missing along the guide of the forces on the wire, and the largest of them [N]."""
    parts = np.array([
        record.push_force,
        float(record.contact_force.sum(axis=0) @ direction),
        float(record.friction_force.sum(axis=0) @ direction),
        float(load @ direction),
    ])  # fmt: skip
    return float(parts.sum()), float(np.abs(parts).max())


def energy(session: Session) -> float:
    """Of the wire, the wall and the elastic slip [J], with that of its motion."""
    plant, system = session.plant, session.plant.system
    state, work = plant.state, system.new_work()
    rod, wall = plant.model.rod, plant.model.wall
    smooth = plant.model._replace(wall=wall._replace(friction=()))
    still = Motion(0.0, np.zeros_like(state.q))
    stored, _ = assemble(smooth, state, plant.mouth, still, work.gradient, work.no_band)
    held = int(state.held[0])
    moving = 0.5 * float(rod.mass[held + 1 :] @ (state.velocity[held + 1 :, :3] ** 2).sum(axis=1))
    moving += 0.5 * float(rod.inertia[held:] @ state.velocity[held:-1, 3] ** 2)
    if not wall.friction:
        return (stored + moving) * system.scales.force * system.scales.length
    kept, rubs = state.contact, wall.friction[0]
    stick = rubs.static * kept[:, FACTOR] * kept[:, LOAD] / rubs.slip
    slips = 0.5 * float(stick @ (kept[:, SLIP : SLIP + 3] ** 2).sum(axis=1))
    return (stored + moving + slips) * system.scales.force * system.scales.length
