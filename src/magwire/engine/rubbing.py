"""Sensitivities of a wire that is held by friction, too: how its course goes on (P-33).

A contact inside its cone is a spring. One on its cone slides on, or sticks if it is to go back.
Where it slides its traction follows the normal force, which makes the tangent unsymmetric; where it
sticks it follows a normal force that falls, not one that grows. So the answer hangs on the sign of
the change, and on what each contact does, which is found by trying until it agrees.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from magwire.engine.point import Point
from magwire.engine.sensitivity import Output, derivative
from magwire.errors import ConvergenceError
from magwire.kernels.arrays import Friction, Motion, Wall
from magwire.kernels.assembly import FIRST, assemble
from magwire.kernels.band import WIDTH
from magwire.kernels.wall.traction import FACTOR, SLIDES, SLIP

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Change = Literal["rising", "falling"]
Course = Literal["field", "inputs", "gradient", "feed", "twist"]

TRIALS = 60  # of what the contacts do
ON_CONE = 1.0 - 1e-6  # part of the elastic slip at the cone from which a contact is on it
TINY = 1e-30  # imaginary step: derivatives without cancellation
LOCAL = 11  # unknowns that move a contact: three nodes, and the angles of the edges between them


class Contacts(NamedTuple):
    """The contacts that rub, one a row, in the terms of ``kernels.wall.traction``.

    node, after [k]; second [k] node whose angle is the second edge's; slip [k, 3] elastic; cone,
    stick [k] coefficient of friction, and of it over the elastic slip at the cone; limit [k]
    elastic slip at the cone; radius, span [k]; push [k, 3] of the wall; on [k] on the cone.
    """

    node: NDArray[np.int64]
    after: NDArray[np.int64]
    second: NDArray[np.int64]
    slip: Array
    cone: Array
    stick: Array
    limit: Array
    radius: Array
    span: Array
    push: Array
    on: Flags


class Branches(NamedTuple):
    """What each contact does: whether it slides, and whether its normal force grows."""

    slides: Flags
    grows: Flags

    def agree(self, others: Branches) -> bool:
        """Whether nothing differs that matters: of one that slides, growing does not."""
        same = self.slides == others.slides
        return bool(np.all(same & (self.slides | (self.grows == others.grows))))


@dataclass(frozen=True, eq=False)
class Rubbing:
    """A wire at rest at the end of a course, with its contacts; ``Plant.rubbing`` makes it.

    Attributes
    ----------
    point
        The same without friction.
    rubs
        Friction of the wall, if there is any.
    """

    point: Point
    rubs: tuple[Friction, ...]

    @cached_property
    def first(self) -> int:
        """The first unknown of the guide's edge, of all 4 (nodes + 1) of them."""
        return 4 * (self.point.mouth.held - 1)

    @cached_property
    def free(self) -> slice:
        """The unknowns that are free."""
        return slice(self.first + FIRST, self.first + self.point.last)

    @cached_property
    def stiffness(self) -> Any:
        """Tangent stiffness without friction, of all unknowns."""
        return self._spread(self.point.stiffness(self.point.system.new_work()))

    @cached_property
    def walls(self) -> tuple[Array, Any]:
        """Force of the wall on each node, shape (nodes + 1, 3), and its derivative, scaled."""
        point = self.point
        system, work = point.system, point.system.new_work()
        wall = system.new_wall()
        none = wall._replace(stiffness=0.0, between=wall.between._replace(stiffness=0.0))
        (gradient, band), (less, less_band) = (self._assembled(w, work) for w in (wall, none))
        return (less - gradient)[:, :3], self._spread(less_band - band)

    def _assembled(self, wall: Wall, work: Any) -> tuple[Array, Array]:
        point = self.point
        model = point.system.new_terms(point.field, wall=wall)
        still = Motion(0.0, work.target)
        assemble(model, point.state, point.mouth, still, work.gradient, work.band)
        return work.gradient.copy(), work.band.copy()

    def _spread(self, band: Array) -> Any:
        """A band of the kernels, its lower triangle by columns, as a sparse matrix."""
        from scipy.sparse import coo_array

        size = 4 * len(self.point.state.q)
        used = size - self.first
        columns, below = np.meshgrid(np.arange(used), np.arange(WIDTH), indexing="ij")
        rows, values = columns + below, band[:used]
        inside = rows < used
        lower = coo_array(
            (values[inside], (rows[inside] + self.first, columns[inside] + self.first)),
            shape=(size, size),
        ).tocsr()
        return (lower + lower.T - _diagonal(lower)).tocsr()

    @cached_property
    def contacts(self) -> Contacts:
        """Those with a normal force and a cone."""
        friction = self.rubs[0]
        state, tip = self.point.state, len(self.point.state.q) - 1
        push = self.walls[0]
        kept = state.contact
        rubs = (np.linalg.norm(push, axis=1) > 0.0) & (friction.static * kept[:, FACTOR] > 0.0)
        rubs[: self.point.mouth.held + 1] = False
        node = np.flatnonzero(rubs)
        after = np.minimum(node + 1, tip)
        static = friction.static[node] * kept[node, FACTOR]
        kinetic = friction.kinetic[node] * kept[node, FACTOR]
        moving = kept[node, SLIDES] > 0.0
        cone = np.where(moving, kinetic, static)
        limit = friction.slip * cone / static
        slip = kept[node, SLIP : SLIP + 3]
        length = np.append(state.length, 0.0)
        return Contacts(
            node=node,
            after=after,
            second=np.where(node < tip, node, node - 1),
            slip=slip,
            cone=cone,
            stick=static / friction.slip,
            limit=limit,
            radius=friction.radius[node],
            span=length[node - 1] + length[node],
            push=push[node],
            on=np.linalg.norm(slip, axis=1) >= ON_CONE * limit,
        )

    def friction(self, branches: Branches) -> tuple[Any, Array]:
        """What friction adds to the tangent of all unknowns; moves of the surfaces by these.

        Returns
        -------
        stiffness
            Not symmetric, sparse.
        by_place
            Derivatives of each contact's way, shape (k, 3, ``LOCAL``).
        """
        from scipy.sparse import coo_array

        c, size = self.contacts, 4 * len(self.point.state.q)
        slopes, ways = [], []
        for k in range(LOCAL + 3):
            forces, way = self._forces(branches, k)
            slopes.append(forces.imag / TINY)
            ways.append(way.imag / TINY)
        slope, way = np.stack(slopes, axis=2), np.stack(ways[:LOCAL], axis=2)
        where = self._unknowns
        rows = np.repeat(where[:, :, None], LOCAL, axis=2)
        columns = np.repeat(where[:, None, :], LOCAL, axis=1)
        shape = (size, size)
        own = coo_array((slope[:, :, :LOCAL].ravel(), (rows.ravel(), columns.ravel())), shape=shape)
        pushed = np.repeat((4 * c.node[:, None] + np.arange(3))[:, None, :], LOCAL, axis=1)
        by_push = slope[:, :, LOCAL:]
        rows = np.repeat(where[:, :, None], 3, axis=2)
        loads = coo_array((by_push.ravel(), (rows.ravel(), pushed.ravel())), shape=shape)
        return (own + loads.tocsr() @ self.walls[1]).tocsr(), way

    @cached_property
    def _unknowns(self) -> NDArray[np.int64]:
        """Which unknowns move each contact, shape (k, LOCAL)."""
        c, three = self.contacts, np.arange(3)
        places = [4 * node[:, None] + three for node in (c.node - 1, c.node, c.after)]
        angles = [4 * node[:, None] + 3 for node in (c.node - 1, c.second)]
        return np.concatenate(places + angles, axis=1)

    def _forces(self, branches: Branches, varied: int) -> tuple[NDArray[Any], NDArray[Any]]:
        """Gradient of friction by each contact's unknowns, and its way; see ``wall.traction``.

        One of the unknowns, or of the three components of the wall's push, has an imaginary part.
        """
        c, q = self.contacts, self.point.state.q
        start = [q[node, :3] for node in (c.node - 1, c.node, c.after)]
        before, here, after = (place.astype(complex) for place in start)
        angle, push = np.zeros(len(c.node), dtype=complex), c.push.astype(complex)
        if varied < 9:
            (before, here, after)[varied // 3][:, varied % 3] += 1j * TINY
        elif varied < LOCAL:
            angle += 0.5j * TINY
        else:
            push[:, varied - LOCAL] += 1j * TINY
        last = (c.after == c.node)[:, None]
        beyond = np.where(last, here - before, after - here)
        axis = _unit(_unit(here - before) + _unit(beyond))
        load, load0 = _norm(push), np.linalg.norm(c.push, axis=1)
        n, n0 = push / load[:, None], c.push / load0[:, None]
        turning = _along(n, np.cross(axis, -c.radius[:, None] * n))
        leaning = _along(n, axis * (c.radius / c.span)[:, None])
        spread = np.where(last, here - start[1], after - start[2]) - (before - start[0])
        way = _along(n, here - start[1]) + angle[:, None] * turning
        way = way + _dot(n, spread)[:, None] * leaning
        slip = c.slip - (_dot(n, c.slip) / (1.0 + _dot(n, n0)))[:, None] * (n + n0)
        slip = np.where(branches.grows[:, None], (load0 / load)[:, None] * slip, slip)
        reach = slip + way
        stuck = (c.stick * load)[:, None] * reach
        size = _norm(np.where(branches.slides[:, None], reach, 1.0))
        pull = np.where(branches.slides[:, None], (c.cone * load / size)[:, None] * reach, stuck)
        lean = _dot(pull, leaning)[:, None] * n
        moment = 0.5 * _dot(pull, turning)[:, None]
        # At the tip the node after is the tip itself, and both halves of the moment are one edge's.
        return np.concatenate((-lean, pull, lean, moment, moment), axis=1), way

    @cached_property
    def inertia(self) -> Array:
        """Mass of all unknowns, that of the ghost and of the tip's angle being none."""
        rod = self.point.system.rod
        turning = np.append(rod.inertia, 0.0)[: len(rod.mass), None]
        whole: Array = np.hstack((np.repeat(rod.mass[:, None], 3, axis=1), turning)).ravel()
        return whole

    def tangent(self, branches: Branches) -> tuple[Any, Array]:
        """The tangent with friction of all unknowns, sparse; moves of the surfaces by these."""
        rubbed, way = self.friction(branches)
        return (self.stiffness + rubbed).tocsr(), way

    def done(self, moved: Array, way: Array) -> Branches:
        """What the contacts do as all unknowns move; way: moves of the surfaces by these."""
        c = self.contacts
        unit = c.slip / np.maximum(np.linalg.norm(c.slip, axis=1), 1e-300)[:, None]
        load = np.linalg.norm(c.push, axis=1)
        goes = np.einsum("kij,kj->ki", way, moved[self._unknowns])
        forces = (self.walls[1] @ moved).reshape(-1, 4)[c.node, :3]
        grown = _dot(c.push / load[:, None], forces) / load
        slides = c.on & (_dot(unit, goes) > c.limit * np.maximum(grown, 0.0))
        return Branches(slides, grown > 0.0)

    def goes_on(self, load: Array, lead: Array) -> Array:
        """How all unknowns move under a load on them while those of the guide are led.

        Raises
        ------
        ConvergenceError
            If no choice of what the contacts do agrees with itself.
        """
        from scipy.sparse.linalg import splu

        c, free = self.contacts, self.free
        branches = Branches(c.on.copy(), np.ones(len(c.node), dtype=bool))
        for _ in range(TRIALS):
            rubbed, way = self.friction(branches)
            whole = (self.stiffness + rubbed).tocsc()
            moved = lead.copy()
            right = -load[free] - (rubbed @ lead)[free]
            moved[free] += splu(whole[free, free]).solve(right)
            found = self.done(moved, way)
            if found.agree(branches):
                return moved
            branches = found
        raise ConvergenceError(
            "No answer of the contacts agrees with itself: some go to and fro between sliding and "
            "sticking; take the difference of two short steps instead.",
            self.point.state.q[1:, :3] * self.point.system.scales.length,
        )


def goes_on(held: Rubbing, output: Output, wrt: Course, change: Change) -> Array:
    """Derivative of an output by an input, from one side; see ``Session.sensitivity``."""
    point = held.point
    if not held.rubs or point.mouth.held == len(point.state.q) - 1:
        return derivative(point, output, wrt)
    direction = 1.0 if change == "rising" else -1.0
    lead = np.zeros(point.state.q.shape)
    if wrt == "feed":
        lead[point.mouth.held - 1 : point.mouth.held + 1, :3] = point.system.guide.direction
    elif wrt == "twist":
        lead[point.mouth.held - 1, 3] = 1.0
    lead = direction * lead.ravel()

    def respond(_: Point, loads: Array) -> Array:
        moved = [direction * held.goes_on(direction * load.ravel(), lead) for load in loads]
        return np.stack(moved).reshape(loads.shape)

    return derivative(point, output, wrt, respond)


def _diagonal(matrix: Any) -> Any:
    from scipy.sparse import diags_array

    return diags_array(matrix.diagonal())


def _dot(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    result: NDArray[Any] = np.sum(a * b, axis=-1)
    return result


def _norm(a: NDArray[Any]) -> NDArray[Any]:
    result: NDArray[Any] = np.sqrt(_dot(a, a))
    return result


def _unit(a: NDArray[Any]) -> NDArray[Any]:
    result: NDArray[Any] = a / _norm(a)[:, None]
    return result


def _along(n: NDArray[Any], v: NDArray[Any]) -> NDArray[Any]:
    """The part of v along the wall."""
    result: NDArray[Any] = v - _dot(n, v)[:, None] * n
    return result
