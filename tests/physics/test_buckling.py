"""Where a straight wire loses its stability: in an antiparallel field, and under twist."""

from __future__ import annotations

import numpy as np
import pytest

from magwire.contact import Barrier
from magwire.engine.sampling import sample
from magwire.engine.system import System
from magwire.evidence.verify.wires import critical
from magwire.field import UniformField
from magwire.kernels.arrays import Motion, Mouth
from magwire.kernels.assembly import assemble
from magwire.lumen import Lumen
from tables import closed_form, critical_load
from wires import L, flux, free, magnet

TABLE = [row[:2] for row in closed_form("critical_antiparallel_field")]


@pytest.mark.parametrize(("part", "expected"), TABLE, ids=[f"{row[0]:g}" for row in TABLE])
def test_critical_antiparallel_field(part: float, expected: float) -> None:
    wire = magnet(100, part)
    sim = free(wire)

    def stable(b: float) -> bool:
        state = sim.equilibrium(L, flux(wire, b, 180.0))
        assert state.tip[0] == pytest.approx(L)
        return state.stable

    assert critical(stable, expected) == pytest.approx(expected, rel=1e-3)


def test_short_magnet_buckles_as_a_dipole() -> None:
    """m B L/EI = 1 for a dipole at the tip; an edge-long magnet comes within two percent."""
    wire = magnet(100, 1.01 / 99)
    sim = free(wire)
    scale = 99 / 1.01
    found = critical(lambda b: sim.equilibrium(L, flux(wire, b, 180.0)).stable, 1.01 * scale)
    assert found / scale == pytest.approx(critical_load("tip dipole"), rel=0.02)


def test_critical_field_has_an_imperfect_buckling_branch() -> None:
    """A field 0.1 degrees off: hardly bent below the critical field, far over above it."""
    wire = magnet(100)
    sim = free(wire)
    expected = critical_load("hard_magnetic antiparallel")
    angles = []
    for part in (0.9, 1.1):
        state = sim.equilibrium(L, flux(wire, part * expected, 179.9))
        assert state.stable
        angles.append(np.degrees(np.arccos(state.tip_direction[0])))
    assert angles[0] < 2.0
    assert angles[1] > 40.0


def smallest_stiffness(angle: float, nodes: int) -> float:
    """Of a straight wire clamped at both ends, twisted by an angle [rad]; the end may slide.

    The clamps hold the first and the last edge: the wire between their middles is what twists.
    """
    system = System(magnet(nodes, 0.0), Lumen.open_space(), Barrier())
    state, work = system.new_state(), system.new_work()
    rod = system.rod
    state.q[:, 0] = rod.station
    first, last = 1, nodes - 1  # the clamped edges
    state.q[:-1, 3] = angle * np.clip((np.arange(nodes) - first) / (last - first), 0.0, 1.0)
    field = sample(system, UniformField(), state)
    model = system.new_terms(field, rod=rod)
    still = Motion(0.0, work.target)
    assemble(model, state, Mouth(1, 1.0), still, work.gradient, work.band)
    size = 4 * (nodes + 1) - 1
    dense = np.zeros((size, size))
    for k in range(work.band.shape[1]):
        column = np.arange(size - k)
        dense[column + k, column] = dense[column, column + k] = work.band[: size - k, k]
    # Free: nodes between the clamps and the edges between them.
    free_nodes = np.arange(3, nodes - 1)
    rows = [4 * i + c for i in free_nodes for c in range(3)]
    rows += [4 * i + 3 for i in range(first + 1, last)]
    modes = np.zeros((size, len(rows) + 1))
    modes[rows, np.arange(len(rows))] = 1.0
    modes[[4 * (nodes - 1), 4 * nodes], -1] = 1.0  # the far clamp slides along the axis
    return float(np.linalg.eigvalsh(modes.T @ dense @ modes)[0])


def test_twist_buckling_of_a_clamped_wire() -> None:
    """M l/EI = 8.9868 with the end distance free, approached with second order."""
    nodes = np.array([40, 80])
    section = magnet(40, 0.0).sections[0]
    ratio = section.twisting_stiffness / section.bending_stiffness
    expected = critical_load("twist_clamped_clamped")
    # M = GJ angle / l with l between the clamps, so M l/EI = angle GJ/EI.
    found = [
        critical(lambda load, n=n: smallest_stiffness(load / ratio, n) > 0.0, expected)
        for n in nodes
    ]
    errors = expected - np.array(found)
    assert np.all(errors > 0.0)
    sizes = 1.0 / (nodes - 2)
    assert np.diff(np.log(errors))[0] / np.diff(np.log(sizes))[0] == pytest.approx(2.0, abs=0.1)
    extrapolated = np.polynomial.Polynomial.fit(sizes**2, found, 1)(0.0)
    assert extrapolated == pytest.approx(expected, rel=2e-3)
