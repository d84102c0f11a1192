"""Forces of walls of triangles against those of hard walls, by an independent calculation (P-41).

A chain of rigid links in the plane, clamped and turned by a magnet at its tip, of least energy
under the condition that its joints stay inside of a cone, or of a sphere on a tube (a sac).
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize, nnls

import magwire as mw
import surfaces
from magwire.lumen import distance

Array = NDArray[np.float64]
Gap = Callable[[Array, Array], tuple[Array, Array]]

RADIUS, EDGE, LONG = 3e-3, 1e-3, 40e-3
TAPER = 1.8e-3 / LONG
SPHERE, MIDDLE = 3.0 * RADIUS, 20e-3
WIRE = mw.Wire.uniform(
    length=60e-3,
    radius=0.5e-3,
    youngs_modulus=3e6,
    shear_modulus=1e6,
    density=2000.0,
    nodes=61,
    magnetized_tip=5e-3,
    magnetization=128e3,
)


def in_cone(x: Array, y: Array) -> tuple[Array, Array]:
    """Distance from the wall, and its gradient."""
    cosine = 1.0 / np.hypot(1.0, TAPER)
    side = np.where(y < 0.0, -1.0, 1.0)
    n = np.column_stack([np.full_like(x, -TAPER * cosine), -side * cosine])
    return (RADIUS - TAPER * x - np.abs(y)) * cosine, n


def in_sac(x: Array, y: Array) -> tuple[Array, Array]:
    """The same in a tube that goes through a sphere."""
    off = np.column_stack([x - MIDDLE, y])
    far = np.linalg.norm(off, axis=1)
    inside = SPHERE - far > RADIUS - np.abs(y)
    along = np.column_stack([0.0 * x, -np.where(y < 0.0, -1.0, 1.0)])
    n = np.where(inside[:, None], -off / np.maximum(far, 1e-12)[:, None], along)
    return np.where(inside, SPHERE - far, RADIUS - np.abs(y)), n


def hard_forces(gap: Gap, links: int, flux: float) -> Array:
    """Forces of a hard wall on the joints, shape (links, 2) [N]."""
    stiff = np.full(links, WIRE.bending_stiffness / EDGE)
    stiff[0] *= 2.0  # half a cell
    pull = np.zeros(links)
    pull[-5:] = WIRE.moment_per_length * EDGE * flux
    unit = WIRE.bending_stiffness / (links * EDGE)
    sums = EDGE * np.tril(np.ones((links, links)))

    def energy(angles: Array) -> tuple[float, Array]:
        half = 0.5 * np.diff(angles, prepend=0.0)
        moment = 2.0 * stiff * np.tan(half) / np.cos(half) ** 2
        torque = moment - np.append(moment[1:], 0.0) - pull * np.cos(angles)
        value = 2.0 * float(stiff @ np.tan(half) ** 2) - float(pull @ np.sin(angles))
        return value / unit, torque / unit

    def wall(angles: Array) -> tuple[Array, Array, Array]:
        room, n = gap(sums @ np.cos(angles), sums @ np.sin(angles))
        turned = np.column_stack([-np.sin(angles), np.cos(angles)])
        return (room - WIRE.radius) / EDGE, n, (n @ turned.T) * sums / EDGE

    inside = {"type": "ineq", "fun": lambda a: wall(a)[0], "jac": lambda a: wall(a)[2]}
    options = {"maxiter": 2000, "ftol": 1e-15}
    start = np.linspace(0.0, 0.2, links)
    angles = minimize(
        energy, start, jac=True, method="SLSQP", constraints=inside, options=options
    ).x
    room, n, slopes = wall(angles)
    touching = room < 1e-4
    sizes, left = nnls(slopes[touching].T, energy(angles)[1])
    assert left < 1e-6 * np.linalg.norm(energy(angles)[1])
    forces = np.zeros((links, 2))
    forces[touching] = (sizes * unit / EDGE)[:, None] * n[touching]
    return forces


def of_triangles(gap: Gap, edge: float) -> mw.Lumen:
    """The same wall as triangles with edges of a part of the tube's radius."""
    x = np.linspace(0.0, LONG, 20_001)
    if gap is in_cone:
        wide = RADIUS - TAPER * x
    else:
        wide = np.sqrt(np.maximum(SPHERE**2 - (x - MIDDLE) ** 2, RADIUS**2))
    arc = np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(wide))))
    rings = round(arc[-1] / (0.87 * edge * RADIUS)) + 1
    at = np.interp(np.linspace(0.0, arc[-1], rings), arc, x)
    around = np.interp(at, x, wide)
    line = np.column_stack([at, np.zeros((rings, 2))])
    sheet = surfaces.tube(
        line, lambda rows, _: around[rows], round(2.0 * np.pi * wide.max() / (edge * RADIUS))
    )
    path = np.column_stack([np.linspace(0.0, LONG, 100), np.zeros((100, 2))])
    narrow = np.interp(path[:, 0], x, wide) if gap is in_cone else np.full(100, RADIUS)
    return mw.Lumen.through(path, narrow).with_surface(*sheet)


@pytest.mark.parametrize(("gap", "links", "flux"), [(in_cone, 30, 30e-3), (in_sac, 26, 40e-3)])
def test_forces_converge_to_those_of_hard_walls(
    gap: Gap, links: int, flux: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Triangles and the lattice of the spline are refined together, down to the lattice's own."""
    hard = hard_forces(gap, links, flux)
    edges, errors = (0.4, 0.2, 0.1), []
    assert (distance.OUTWARD, distance.INWARD, distance.FINEST) == (0.01, 0.02, 0.03)
    for edge in edges:
        for name, factor in (("OUTWARD", 0.1), ("INWARD", 0.2), ("FINEST", 0.3)):
            monkeypatch.setattr(distance, name, factor * edge)
        contact = mw.Barrier(stiffness=3e4, activation_gap=2e-6)
        simulation = mw.Simulation(WIRE, of_triangles(gap, edge), contact=contact)
        state = None
        for part in np.linspace(0.1, 1.0, 10):  # the field rises: the sac is reached from below
            state = simulation.equilibrium(links * EDGE, [0.0, part * flux, 0.0], start=state)
        assert state is not None
        off = state.wall_force[-links:, :2] - hard
        errors.append(
            max(
                np.linalg.norm(off.sum(axis=0)) / np.linalg.norm(hard.sum(axis=0)),
                np.linalg.norm(off[-1]) / np.linalg.norm(hard[-1]),
            )
        )
    assert errors[-1] < 0.02, errors
    assert all(after < 1.05 * before for before, after in pairwise(errors)), errors
    assert np.polyfit(np.log(edges), np.log(errors), 1)[0] > 1.0, errors
