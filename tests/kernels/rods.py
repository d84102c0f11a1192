"""Random rods in random states, and the whole energy's derivatives by the kernels."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.contact import Barrier
from magwire.engine.system import System
from magwire.kernels.arrays import Field, Motion, Mouth, Rod, State
from magwire.kernels.assembly import assemble
from magwire.kernels.frames import update_frames
from magwire.kernels.hinge import reference_twist
from magwire.lumen import Lumen
from magwire.wire import Wire

Array = NDArray[np.float64]
NODES = 7
ENERGIES = ("stretching", "bending", "twisting", "uniform field", "field", "bodies")


class Case(NamedTuple):
    """All that the energy depends on, besides the state itself."""

    system: System
    model: tuple[object, ...]
    state: State
    mouth: Mouth
    motion: Motion


def system(lumen: Lumen | None = None, *, nodes: int = NODES, gap: float = 0.1e-3) -> System:
    """A wire of length 1 m in a lumen, so that scaled lengths are metres."""
    wire = Wire.uniform(1.0, 0.01, 1e6, 3e5, 1000.0, nodes)
    where = Lumen.open_space() if lumen is None else lumen
    return System(wire, where, Barrier(1e3, gap, wall="centreline"))


def random_rod(rng: np.random.Generator, rod: Rod, energies: tuple[str, ...]) -> Rod:
    """Random stiffnesses and loads for some energies, and none for the others."""
    count = len(rod.station)
    on = {name: 1.0 if name in energies else 0.0 for name in ENERGIES}
    magnetic = max(on["uniform field"], on["field"])
    return rod._replace(
        stretch=on["stretching"] * rng.uniform(5.0, 10.0, count - 1),
        bend=rng.uniform(1.0, 2.0, count) * (1.0 if "bending" in energies else 1e-30),
        twist=on["twisting"] * rng.uniform(1.0, 2.0, count),
        rest_curvature=rng.normal(0.0, 0.5, (count, 2)),
        moment=magnetic * rng.normal(size=(count - 1, 3)),
        mass=on["bodies"] * rng.uniform(0.5, 1.0, count),
        inertia=on["bodies"] * rng.uniform(0.5, 1.0, count - 1),
        weight=on["bodies"] * rng.normal(size=(count, 3)),
    )


def random_field(rng: np.random.Generator, edges: int, *, uniform: bool) -> Field:
    """Samples of a field that differ from edge to edge."""
    return Field(
        flux_density=rng.normal(size=(edges, 3)),
        gradient=rng.normal(size=(edges, 9)),
        origin=rng.normal(size=(edges, 3)),
        uniform=np.array([uniform]),
        sources=(),
        strength=rng.normal(size=3),
    )


def state_at(where: System, q: Array, directors: Array, held: int) -> State:
    """The state of given positions and angles; directors are made normal to their edges."""
    state = where.new_state()
    state.q[:] = q
    edges = np.diff(q[:, :3], axis=0)
    state.length[:] = np.linalg.norm(edges, axis=1)
    state.tangent[:] = edges / state.length[:, None]
    across = directors - np.sum(directors * state.tangent, axis=1)[:, None] * state.tangent
    state.director[:] = across / np.linalg.norm(across, axis=1)[:, None]
    for i in range(held, len(edges)):
        state.twist[i] = reference_twist(
            tuple(state.director[i - 1]),
            tuple(state.tangent[i - 1]),
            tuple(state.director[i]),
            tuple(state.tangent[i]),
            0.0,
        )
    return state


def random_state(rng: np.random.Generator, where: System, held: int, rough: float) -> State:
    """A crumpled wire with random twist angles and frames."""
    count = len(where.rod.station)
    q = np.zeros((count, 4))
    q[:, 0] = where.rod.station
    q[:, :3] += rough * rng.normal(size=(count, 3))
    q[:, 3] = rng.normal(size=count)
    return state_at(where, q, rng.normal(size=(count - 1, 3)), held)


def random_case(seed: int, *energies: str, held: int = 1, rough: float = 0.1) -> Case:
    """A crumpled wire in open space that has only the named energies, all if none is named."""
    rng = np.random.default_rng(seed)
    where = system()
    chosen = energies or ENERGIES
    rod = random_rod(rng, where.rod, chosen)
    field = random_field(rng, len(rod.rest), uniform="field" not in chosen)
    state = random_state(rng, where, held, rough)
    pull = 1.3 if "bodies" in chosen else 0.0
    motion = Motion(pull, rng.normal(size=state.q.shape))
    model = where.new_terms(field, rod=rod)
    return Case(where, model, state, Mouth(held, float(rng.uniform(0.3, 1.0))), motion)


def moved(case: Case, dq: Array) -> State:
    """The state displaced by dq, with its frames transported along."""
    there = case.system.new_state()
    for target, source in zip(there, case.state, strict=True):
        target[...] = source
    there.q[:] += dq
    update_frames(case.state, there, case.mouth.held)
    return there


def derivatives(case: Case, state: State | None = None) -> tuple[float, Array, Array]:
    """Energy, gradient and dense Hessian over the unknowns from node ``held - 1`` on."""
    work = case.system.new_work()
    here = case.state if state is None else state
    energy, _ = assemble(case.model, here, case.mouth, case.motion, work.gradient, work.band)
    first = case.mouth.held - 1
    size = 4 * (len(here.q) - first) - 1
    dense = np.zeros((size, size))
    for k in range(work.band.shape[1]):
        column = np.arange(size - k)
        dense[column + k, column] = dense[column, column + k] = work.band[: size - k, k]
    return energy, work.gradient[first:].ravel()[:size].copy(), dense


def difference_quotients(case: Case, step: float) -> tuple[Array, Array]:
    """Gradient and raw Hessian by differences of fourth order: of energy, and of gradient."""
    first = case.mouth.held - 1
    size = 4 * (len(case.state.q) - first) - 1
    work = case.system.new_work()

    def at(index: int, distance: float) -> tuple[float, Array]:
        dq = np.zeros_like(case.state.q)
        dq.reshape(-1)[4 * first + index] = distance
        there = moved(case, dq)
        energy, _ = assemble(
            case.model, there, case.mouth, case.motion, work.gradient, work.no_band
        )
        return energy, work.gradient[first:].ravel()[:size].copy()

    gradient, hessian = np.zeros(size), np.zeros((size, size))
    for i in range(size):
        weights = ((8.0, step), (-8.0, -step), (-1.0, 2.0 * step), (1.0, -2.0 * step))
        for weight, distance in weights:
            energy, slope = at(i, distance)
            gradient[i] += weight / (12.0 * step) * energy
            hessian[:, i] += weight / (12.0 * step) * slope
    return gradient, hessian
