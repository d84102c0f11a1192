"""An inextensible rod pushed through a passage with a hard wall, in space: no barrier is left.

Lengths in L, forces in EI/L^2. The rod is a chain of links of length h; its joints are the
unknowns, and

    E = sum |x_(i+1) - 2 x_i + x_(i-1)|^2 / (2 h^3)

is its bending energy (EI/h (1 - cos) of every turn), twice as stiff at the clamp, where half a cell
is free. |x_i - x_(i-1)| = h and h_i(x_i) >= 0 (`passages`) are constraints; the multipliers of the
latter are the forces of the wall. Newton's method solves the conditions of Karush, Kuhn and Tucker
with s z = mu for gaps s and multipliers z, and mu goes to 1e-9: what is left of it in a gap is
mu/z. The rod is fed link by link, every state from the one before.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cholesky_banded, solve_banded

from magwire.evidence.verify.references.passages import Passage

Array = NDArray[np.float64]
BAND = 8
"""Half-bandwidth of three coordinates and a multiplier for every joint."""

FIRST, LAST, FASTER = 1e-3, 1e-9, 0.2
"""mu [EI/L], and how it falls."""

RESIDUAL = 1e-5  # [EI/L^2]
ITERATIONS = 150


class _Point(NamedTuple):
    """Joints x, multipliers y of links, gaps s and their multipliers z, parameters w of balls."""

    x: Array
    y: Array
    s: Array
    z: Array
    w: Array


@dataclass(frozen=True)
class Rod:
    """A rod at rest in the passage; joints are counted from the clamp, the last is the tip.

    Attributes
    ----------
    joints
        Places, shape (links, 3) [L].
    wall_force
        Force of the wall on the joints, shape (links, 3) [EI/L^2].
    gap
        h of the joints, shape (links,) [L^2].
    """

    joints: Array
    wall_force: Array
    gap: Array

    @property
    def sizes(self) -> Array:
        """Of the wall's forces, shape (links,) [EI/L^2]."""
        return np.asarray(np.linalg.norm(self.wall_force, axis=1))


def push(passage: Passage, step: float, distance: float, first: int = 4) -> Iterator[Rod]:
    """Feed a rod link by link, from ``first`` links that are straight to a length ``distance``.

    Parameters
    ----------
    passage
        The hard wall of the rod's axis.
    step
        Length h of a link.

    Raises
    ------
    RuntimeError
        If the rod comes to where it has no stable equilibrium nearby: it would snap.
    """
    arc = step * np.arange(1.0, first + 1.0)
    joints = arc[:, None] * passage.direction
    guess = _Point(joints, np.zeros(first), np.ones(first), np.zeros(first), arc)
    search = _Search(passage, step)
    while len(guess.x) <= round(distance / step):
        rod, found = search.settle(guess)
        yield rod
        guess = _fed(found)


def _fed(rod: _Point) -> _Point:
    """A link longer: the rod slides along itself, and the tip takes its contact along."""
    tip = 2.0 * rod.x[-1] - rod.x[-2]
    _, y, s, z, w = (np.append(values, values[-1:], axis=0) for values in rod)
    z[-2] = min(z[-2], z[-3])
    return _Point(np.append(rod.x, [tip], axis=0), y, s, z, w)


@dataclass(frozen=True)
class _Search:
    """Newton's method for the conditions of an equilibrium."""

    passage: Passage
    step: float

    def settle(self, guess: _Point) -> tuple[Rod, _Point]:
        """The equilibrium near a guess."""
        mu, z = FIRST, np.maximum(guess.z, 1e-3)
        at = guess._replace(z=z, s=np.maximum(guess.s, mu / z))
        for _ in range(ITERATIONS):
            at = at._replace(w=self.passage.nearest(at.x, at.w))
            room = self.passage.room(at.x, at.w)
            edges = np.diff(at.x, axis=0, prepend=np.zeros((1, 3))) / self.step
            pull = _pulled(at.y[:, None] * edges) - self._slope(at.x)
            length = 0.5 * self.step * ((edges**2).sum(axis=1) - 1.0)
            forces = at.z[:, None] * room[1]
            rest = max(np.abs(pull + forces).max(), np.abs(at.s * at.z - mu).max() / self.step)
            close = max(np.abs(length).max(), np.abs(room[0] - at.s).max())
            if rest < max(RESIDUAL, 10.0 * mu) and close < max(1e-10, 0.1 * mu):
                if mu <= LAST:
                    if not self._stable(at, edges, self._walls(at, room)):
                        break
                    return Rod(at.x, forces, room[0]), at
                mu = max(LAST, FASTER * mu)
            at = self._moved(at, mu, room, edges, (pull, length))
        raise RuntimeError(f"The rod of {len(at.x)} links has no stable equilibrium nearby.")

    def _moved(
        self,
        at: _Point,
        mu: float,
        room: tuple[Array, Array, Array],
        edges: Array,
        left: tuple[Array, Array],
    ) -> _Point:
        """A step of Newton's method, cut so that gaps and multipliers stay positive."""
        gap, inwards, _ = room
        pull, length = left
        stiff = at.z / at.s
        toward = mu / at.s - stiff * (gap - at.s)
        right = np.column_stack((pull + toward[:, None] * inwards, -length))
        found = self._solve(at.y, edges, self._walls(at, room), right)
        dx, dy = found[:, :3], found[:, 3]
        ds = (inwards * dx).sum(axis=1) + gap - at.s
        dz = mu / at.s - at.z - stiff * ds
        go = min(_part(at.s, ds), 0.25 * self.passage.radius / float(np.abs(dx).max()))
        forces = at.z + _part(at.z, dz) * dz
        return _Point(at.x + go * dx, at.y + go * dy, at.s + go * ds, forces, at.w)

    def _slope(self, x: Array) -> Array:
        """Derivative of the bending energy, shape (n, 3)."""
        turns = np.diff(np.vstack((np.zeros((1, 3)), x)), n=2, axis=0) / self.step**3
        slope = np.zeros_like(x)
        slope[0] = -2.0 * self.passage.direction / self.step**2
        slope[1:] += turns
        slope[:-1] -= 2.0 * turns
        slope[:-2] += turns[1:]
        return slope

    def _walls(self, at: _Point, room: tuple[Array, Array, Array]) -> Array:
        """Stiffness of the wall, shape (n, 3, 3)."""
        _, inwards, curved = room
        stiff = (at.z / at.s)[:, None, None] * inwards[:, :, None] * inwards[:, None, :]
        return np.asarray(stiff - at.z[:, None, None] * curved)

    def _bands(self, y: Array) -> tuple[Array, Array, Array]:
        """Of bending and of the links: joints with themselves, the next, the one after."""
        n = len(y)
        own, next_, after = np.zeros(n), np.full(n - 1, -2.0), np.full(n - 2, 1.0)
        own[1:] += 1.0
        own[:-1] += 4.0
        own[:-2] += 1.0
        next_[:-1] -= 2.0
        own, next_, after = (part / self.step**3 for part in (own, next_, after))
        own -= y / self.step
        own[:-1] -= y[1:] / self.step
        return own, next_ + y[1:] / self.step, after

    def _solve(self, y: Array, edges: Array, walls: Array, right: Array) -> Array:
        """Newton's step of joints and multipliers, shape (n, 4)."""
        n = len(y)
        own, next_, after = self._bands(y)
        m = np.zeros((2 * BAND + 1, 4 * n))
        for a in range(3):
            for b in range(3):
                m[BAND + a - b, b::4] = walls[:, a, b]
            m[BAND, a::4] += own
            for k, values in ((4, next_), (8, after)):
                m[BAND - k, a + k :: 4] = values
                m[BAND + k, a : 4 * n - k : 4] = values
            m[BAND + a - 3, 3::4] = -edges[:, a]
            m[BAND + 3 - a, a::4] = edges[:, a]
            m[BAND + a - 7, 7::4] = edges[1:, a]
            m[BAND + 7 - a, a : 4 * n - 4 : 4] = -edges[1:, a]
        found = solve_banded((BAND, BAND), m, right.ravel(), overwrite_ab=True, check_finite=False)
        return np.asarray(found.reshape(n, 4))

    def _stable(self, at: _Point, edges: Array, walls: Array) -> bool:
        """Whether the energy grows for all small motions that the constraints allow.

        That is whether H + J^T D J is positive definite for large D (Debreu), J the constraints.
        """
        n = len(at.y)
        own, next_, after = self._bands(at.y)
        stretch = 1e3 / self.step**3 * edges[:, :, None] * edges[:, None, :]
        blocks = walls + stretch
        blocks[:-1] += stretch[1:]
        m = np.zeros((7, 3 * n))  # the lower bands
        for a in range(3):
            for b in range(3):
                if b <= a:
                    m[a - b, b::3] = blocks[:, a, b]
                m[3 + a - b, b : 3 * n - 3 : 3] -= stretch[1:, a, b]
            m[0, a::3] += own
            m[3, a : 3 * n - 3 : 3] += next_
            m[6, a : 3 * n - 6 : 3] += after
        try:
            cholesky_banded(m, lower=True, overwrite_ab=True, check_finite=False)
        except LinAlgError:
            return False
        return True


def _pulled(links: Array) -> Array:
    """Forces of the links on their two joints."""
    joints = links.copy()
    joints[:-1] -= links[1:]
    return joints


def _part(values: Array, steps: Array) -> float:
    """Part of a step, at most 1, that leaves positive values positive."""
    falls = steps < 0.0
    return min(1.0, 0.99 * float((-values[falls] / steps[falls]).min())) if falls.any() else 1.0
