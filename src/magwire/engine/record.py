"""What the engine hands to whoever records a run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.contact import WallMotion
from magwire.kernels.sheet import MAX_TIP_FORCE, NUMBERS, STABLE, Sheet
from magwire.units import show

Array = NDArray[np.float64]
Motion = Literal["dynamic", "quasi-static"]

UNIFORM_INPUTS = (("Bx", "T"), ("By", "T"), ("Bz", "T"))
"""Inputs of a field that is uniform: its components."""
BLOCKS: dict[str, tuple[str, ...]] = {
    "flux_density": ("xyz",),
    "inputs": ("input",),
    "clearance": ("node",),
    "slip": ("node",),
    "wall_indentation": ("node",),
    "position": ("node", "xyz"),
    "contact_force": ("node", "xyz"),
    "friction_force": ("node", "xyz"),
    "wall_displacement": ("node", "xyz"),
    "material_director": ("node", "xyz"),
}
"""Arrays of a record, as ``Sheet`` has them after its numbers, and their dimensions."""
MAY_BE_ABSENT = ("friction_force", "slip", "wall_indentation", "wall_displacement")
"""Arrays that are zero throughout, and not kept, where nothing in a run makes them."""
TOTALS = slice(MAX_TIP_FORCE, len(NUMBERS))
PATCH = 5e-3  # length of wire over which forces are summed or averaged [m]
EDGES = 2.0  # edges in a patch at least: forces are not known any finer


def patch_length(length: float, nodes: int) -> float:
    """Length over which forces on a wire of some length and nodes are summed [m]."""
    return min(length, max(PATCH, EDGES * (length / max(nodes - 1, 1))))


@dataclass(frozen=True)
class Scales:
    """The paper's scales (P-17, P-18).

    Attributes
    ----------
    length
        The wire's length L [m].
    force
        EI / L^2 [N].
    flux_density
        EI / (M L^2) [T]; NaN for a wire without magnetisation.
    """

    length: float
    force: float
    flux_density: float


@dataclass(frozen=True)
class RunInfo:
    """What is known of a run before its first step.

    Attributes
    ----------
    nodes
        Number of nodes of the wire.
    scales
        Scales that make the paper's numbers.
    centreline, lumen_radius, lumen_branch
        The lumen as drawn: points, shape (q, 3) [m]; radius, shape (q,) [m]; branch, shape (q,).
    magnet
        Where the distal magnet begins and ends on the wire [m]; NaN without one.
    way
        Points and radius of the path from the entrance to the target, densely along it, shape
        (q, 4) [m]; no rows in open space.
    title, scenario
        Title, and the whole scenario as TOML ("" for a run that was set up in Python).
    motion
        How the wire moves: in time, or from one equilibrium to the next.
    inputs
        Names and units of the actuator's inputs.
    resistances
        Those of the coils that they are currents of [ohm]; 0 where there is none, or none known.
    surface
        Corners, shape (n, 3) [m], and triangles, shape (m, 3), of a wall that is a surface; none of
        a wall of balls.
    wall_motion
        How the wall moves.
    absent
        Arrays that the records are without, by name; see ``row_type``.
    """

    nodes: int
    scales: Scales
    centreline: Array
    lumen_radius: Array
    lumen_branch: NDArray[np.int64]
    magnet: tuple[float, float]
    way: Array
    title: str = ""
    scenario: str = ""
    motion: Motion = "dynamic"
    inputs: tuple[tuple[str, str], ...] = UNIFORM_INPUTS
    resistances: tuple[float, ...] = ()
    hardware: str = ""
    surface: tuple[Array, NDArray[np.int64]] = (
        np.zeros((0, 3)),
        np.zeros((0, 3), dtype=np.int64),
    )
    wall_motion: tuple[WallMotion, ...] = ()
    absent: frozenset[str] = frozenset()


class Totals(NamedTuple):
    """What a run adds up over all its steps, recorded or not.

    Attributes
    ----------
    max_tip_force, mean_tip_force
        Over all steps so far [N].
    first_contact_feed
        Feed at which any node first felt the wall [m]; NaN if none did.
    smallest_clearance
        Over all recorded states, anywhere along the wire [m].
    steps, newton_iterations, factorisations, retries
        Counts so far.
    wall_time
        Time spent since the start of the run [s].
    """

    max_tip_force: float = 0.0
    mean_tip_force: float = 0.0
    first_contact_feed: float = float("nan")
    smallest_clearance: float = float("inf")
    steps: int = 0
    newton_iterations: int = 0
    factorisations: int = 0
    retries: int = 0
    wall_time: float = 0.0


@cache
def row_type(nodes: int, inputs: int, absent: frozenset[str] = frozenset()) -> np.dtype[Any]:
    """Where the numbers of a record are in its row: single ones, then arrays, by name.

    With all of ``MAY_BE_ABSENT`` it is nearly twice as long as without.
    """
    sizes = {"xyz": 3, "input": inputs, "node": nodes}
    blocks = [
        (name, float, tuple(sizes[d] for d in dims))
        for name, dims in BLOCKS.items()
        if name not in absent
    ]
    return np.dtype([(name, float) for name in NUMBERS] + blocks)


def block(rows: NDArray[Any], name: str) -> Array:
    """An array of some records, in order; zeros for an absent one."""
    if name in (rows.dtype.names or ()):
        found: Array = rows[name]
        return found
    of_nodes = rows["material_director" if "xyz" in BLOCKS[name] else "clearance"].shape
    return np.zeros(of_nodes)


def sheet_of(row: Array, kind: np.dtype[Any]) -> Sheet:
    """A row, shape (size,), as kernels write to it."""
    blocks = row.view(kind)
    return Sheet(row[: len(NUMBERS)], *(block(blocks, name)[0] for name in BLOCKS))


class _Number:
    """A single number of a record."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._place = NUMBERS.index(name)

    def __get__(self, record: Record | None, owner: type) -> float:
        if record is None:  # asked of the class
            return self  # type: ignore[return-value]
        return float(record.row[self._place])


class _Block:
    """An array of a record: a view of its row, made when it is asked for, or zeros."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, record: Record | None, owner: type) -> Array:
        if record is None:  # asked of the class
            return self  # type: ignore[return-value]
        found: Array = block(record.row.view(record.kind), self._name)[0]
        return found


class Record:
    """The state of the wire at one recorded time.

    Attributes
    ----------
    time, feed
        Simulated time [s] and insertion length [m].
    position
        Nodes, proximal first, shape (nodes, 3) [m].
    flux_density
        At the tip, shape (3,) [T].
    inputs
        Inputs of the actuator, shape (m,).
    contact_force
        Force of the wall on each node, shape (nodes, 3) [N].
    clearance
        Distance of each node to the wall by the scenario's wall convention, as it is: moved, and
        pressed in; shape (nodes,) [m]; NaN for nodes on the guide.
    clearance_midpoint
        The smallest of the midpoints between nodes [m]; NaN if all are on the guide.
    clearance_along
        The smallest anywhere along the wire, nodes and edges [m]; NaN if all is on the guide.
    tip_force, tip_offset
        Size of the wall force on the tip node [N]; distance of the tip from the centreline [m].
    friction_force
        Force of the wall on each node, along the wall, shape (nodes, 3) [N]; zero without it.
    slip
        How far the surface of each node has slid on the wall so far, shape (nodes,) [m].
    friction_work
        What friction has taken so far [J].
    wall_indentation
        How far each node presses the wall in, shape (nodes,) [m]; zero at a rigid wall (P-39).
    wall_displacement
        How far the wall has moved at each node, shape (nodes, 3) [m]; zero on the guide (P-40).
    wall_work
        What the wall that moves has done to the wire so far [J].
    guide_twist, tip_twist
        Angle by which the guide has turned the wire, and by which the tip is turned, against a
        wire that is not twisted [rad].
    material_director
        The first material director of the edge from each node, of the last one at the tip, shape
        (nodes, 3).
    push_force, guide_torque
        Force along the guide [N] and torque about it [N m], of the guide on the wire in front.
    newton_iterations
        Per step, mean since the record before.
    stable
        Whether the tangent stiffness of the state is positive definite; under friction, whether
        there is no direction that the wire would take by itself (P-33).
    totals
        Sums over all steps so far.
    tip_departure
        Distance of the tip from where the navigator's model has it, the largest since the record
        before [m]; NaN if nobody compared.
    insertion_force
        Force that feeds the wire through the guide [N]: the push, less what the bend at the guide's
        mouth squeezes out by itself (P-38).
    row, kind
        All these numbers, shape (size,), and where each is in it.
    """

    __slots__ = ("kind", "row")

    time, feed = _Number(), _Number()
    clearance_midpoint, clearance_along = _Number(), _Number()
    tip_force, tip_offset = _Number(), _Number()
    friction_work, wall_work = _Number(), _Number()
    guide_twist, tip_twist = _Number(), _Number()
    push_force, insertion_force, guide_torque = _Number(), _Number(), _Number()
    newton_iterations, tip_departure = _Number(), _Number()
    flux_density, inputs = _Block(), _Block()
    clearance, slip, wall_indentation = _Block(), _Block(), _Block()
    position, contact_force, friction_force = _Block(), _Block(), _Block()
    wall_displacement, material_director = _Block(), _Block()

    def __init__(self, row: Array, kind: np.dtype[Any]) -> None:
        self.row, self.kind = row, kind

    def __repr__(self) -> str:
        return f"<Record: {show(self.time, 'time')}, {show(self.feed, 'length')} of feed>"

    @property
    def stable(self) -> bool:
        """Whether the wire stays where it is; see the class."""
        return bool(self.row[STABLE])

    @property
    def totals(self) -> Totals:
        """Sums over all steps so far."""
        a, b, c, d, *counts, spent = self.row[TOTALS].tolist()
        steps, iterations, factorisations, retries = (int(count) for count in counts)
        return Totals(a, b, c, d, steps, iterations, factorisations, retries, spent)
