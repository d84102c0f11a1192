"""The arrays that travel through the kernels, scaled by length L and force EI/L^2 (P-17).

Nodes carry index 1 ... N; node 0 is a massless ghost behind the proximal end, so that the
direction of the guide is an edge like any other (P-15). Edge i runs from node i to node i + 1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.kernels.centreline import LumenArrays
from magwire.kernels.sources.table import Sources

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Flag = NDArray[np.bool_]

JET = 12  # numbers that are remembered of the gap at a point


class Rod(NamedTuple):
    """A wire laid out on its mesh (P-4).

    station [N+1] material coordinate of each node, 0 at the proximal end; cell_end [N+1] where
    the node's Voronoi cell ends; rest, stretch [N] rest length and EA of each edge; bend, twist
    [N+1] EI/l and GJ/l of each hinge; rest_curvature [N+1, 2] integrated over the cell;
    moment [N, 3] of each edge; mass [N+1], inertia [N] of nodes and of edges about their axis;
    weight [N+1, 3] gravity less buoyancy; cell, offset [N+1] length of wire that a node's contact
    stands for, and what the wall keeps from the axis there (P-12).
    """

    station: Array
    cell_end: Array
    rest: Array
    stretch: Array
    bend: Array
    twist: Array
    rest_curvature: Array
    moment: Array
    mass: Array
    inertia: Array
    weight: Array
    cell: Array
    offset: Array


class Guide(NamedTuple):
    """The straight guide in front of the entrance: entrance [3], direction [3], director [3]."""

    entrance: Array
    direction: Array
    director: Array
    sliding: bool


class Field(NamedTuple):
    """Background and actuator (P-7, P-24).

    Samples of the background at each edge: B_0 [N, 3], gradient [N, 9] by rows, where sampled
    [N, 3]. sources, strength: the actuator, if it is more than three components of a uniform
    field, and the state that its inputs put it in; see ``sources.table``. uniform [1]: whether
    neither of the two has a gradient.
    """

    flux_density: Array
    gradient: Array
    origin: Array
    uniform: Flag
    sources: tuple[()] | tuple[Sources]
    strength: Array


class Bulges(NamedTuple):
    """How sharply the wall bulges inward along each branch; see ``lumen.bulge``.

    value [k] curvature at even places of the branches, one branch after the other; first [m + 1]
    where a branch's begin; per_arc [m] how many there are for each length of it.
    """

    value: Array
    first: Index
    per_arc: Array


class BulgeGrid(NamedTuple):
    """How sharply a wall of triangles bulges inward, by cubes of a grid; see ``lumen.bulge``.

    value [nx, ny, nz] curvature, -1 where that is not known; x0, y0, z0 lower corner; per_cube how
    many cubes there are for each length.
    """

    value: Array
    x0: float
    y0: float
    z0: float
    per_cube: float


class Between(NamedTuple):
    """Contact of the edges between their nodes; see ``wall.between``.

    parts: into how many an edge is divided, 1 if the nodes are enough; stiffness, gap of the
    points' barrier; margin that they keep from the wall; known [N, parts, 4], jet [N, parts, JET]
    as in ``Wall``; clear [N, 7]: where an edge's nodes were, and how far they may move from there
    before one of its points may feel the wall. bulges: how sharply the wall bulges, by place.
    waiting: scratch, points of an edge between which others are asked for.
    """

    parts: int
    stiffness: float
    gap: float
    margin: float
    known: Array
    jet: Array
    clear: Array
    bulges: Bulges | BulgeGrid
    waiting: Array


class Friction(NamedTuple):
    """Friction of the wall on each node, over a time step; see ``wall.traction``.

    static, kinetic [N+1] coefficients; radius [N+1] of the wire's
    surface; slip: elastic slip at the static cone; drag: viscous force per length and speed; table
    [k, 2] arc parameter on ``path`` and factor of the coefficients there.

    Of the step: rate [1] one over its length; start [N+1, 4] positions and angles at its beginning;
    load [N+1, 4] normal and normal force; anchor
    [N+1, 3] elastic slip at its beginning; turning, leaning [N+1, 3] displacement of the surface
    per angle about the axis, and as the nodes beside it move along the normal; factor [N+1];
    slides [N+1]; begun, ended [N+1] normal forces at its ends; pushed [N+1, 4] minus the wall's
    forces where they were read off last. tangent: scratch, a row with what is left and right of the
    diagonal for each of a band; see ``wall.onward``.
    """

    static: Array
    kinetic: Array
    radius: Array
    slip: float
    drag: float
    table: Array
    path: LumenArrays
    rate: Array
    start: Array
    load: Array
    anchor: Array
    turning: Array
    leaning: Array
    factor: Array
    slides: Flag
    begun: Array
    ended: Array
    pushed: Array
    tangent: Array


class Bed(NamedTuple):
    """Elastic foundation of the wall; see ``wall.foundation``.

    ratio [N+1]: the barrier's stiffness over the foundation's at the nodes, between which it is the
    mean of theirs; deepest: how far the wall may be pressed in. A rigid wall has zeros.
    """

    ratio: Array
    deepest: float


class Wall(NamedTuple):
    """Barrier stiffness and activation gap, and what is known of the gap near each node.

    known [N+1, 4]: a point, and by how much the gap may fall from there before the wall could be
    crossed; nearer than that less the activation gap, no query is needed (P-8). jet [N+1, JET]:
    gap, gradient and Hessian there, and arc parameter and branch of the ball that it is from. easy
    [1]: whether Hessians are wanted of which Newton steps are made, see ``wall.eased``.
    """

    stiffness: float
    gap: float
    known: Array
    jet: Array
    easy: Array
    between: Between
    bed: Bed
    friction: tuple[()] | tuple[Friction]


class Tube(NamedTuple):
    """The virtual tube around the centreline, which only the tip feels; see ``kernels.tube``.

    path: a tube around the centreline; offset: its radius less the virtual tube's; known [1, 4],
    jet [1, JET] as in ``Wall``. A stiffness of zero: there is none.
    """

    stiffness: float
    gap: float
    offset: float
    path: LumenArrays
    known: Array
    jet: Array


class Terms(NamedTuple):
    """What the energy of a wire is made of; kernels take it as their ``model``.

    lumen: where the wall is. tube: what a navigator adds; without one its stiffness is zero.
    """

    rod: Rod
    field: Field
    wall: Wall
    lumen: LumenArrays
    tube: Tube


class State(NamedTuple):
    """All that a wire carries from one step to the next.

    q [N+1, 4] configuration (x, y, z, theta), and what follows from it along its path: tangent
    [N, 3], length [N], director [N, 3] (reference frame d1), twist [N+1] reference twist. velocity
    [N+1, 4]; guide [2] insertion and twist of the guide; held [1] last node that the guide holds;
    inputs [m] of the actuator; contact [N+1, 11] what friction remembers of each node, its columns
    named in ``wall.traction``; spent [2] energy that friction took so far, and work of a wall that
    moves; clock [1] time, by which such a wall is where it is.
    """

    q: Array
    tangent: Array
    length: Array
    director: Array
    twist: Array
    velocity: Array
    guide: Array
    held: Index
    inputs: Array
    contact: Array
    spent: Array
    clock: Array


class Mouth(NamedTuple):
    """Where the guide ends: the last held node, the part of its cell that is past the entrance."""

    held: int
    fraction: float


class Motion(NamedTuple):
    """Inertia of a time step (P-14): (1 + mu dt)/dt^2, 0 in statics, and its target [N+1, 4]."""

    factor: float
    target: Array


class Work(NamedTuple):
    """Scratch arrays of the solver, allocated once; ``no_band`` has no rows.

    kept: the band before it is factored, where that takes more than one attempt. way: change of the
    unknowns in a step whose edges turn, laid out as ``step``. before: state at the start of a step
    that is cut. inputs [m]: of the actuator, within a step.
    """

    gradient: Array
    band: Array
    kept: Array
    no_band: Array
    step: Array
    way: Array
    trial: State
    spare: State
    ahead: State
    before: State
    inputs: Array
    target: Array
