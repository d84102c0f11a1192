"""An inextensible rod pushed through a passage with a hard wall, in space: no barrier is left.

Lengths in L, forces in EI/L^2. The rod is a chain of links of length h; its joints are the
unknowns, and

    E = sum |x_(i+1) - 2 x_i + x_(i-1)|^2 / (2 h^3)

is its bending energy (EI/h (1 - cos) of every turn), twice as stiff at the clamp, where half a cell
is free. |x_i - x_(i-1)| = h and h_i(x_i) >= 0 (`passages`) are constraints; their multipliers are
the tensions of the links and the forces of the wall. Newton's method solves the conditions of
Karush, Kuhn and Tucker with s z = mu for gaps s and multipliers z, and mu goes to 1e-9: what
is left of it in a gap is mu/z. The rod is fed link by link, every state from the one before.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cholesky_banded, solve_banded

from magwire.verify.references.passages import Passage

Array = NDArray[np.float64]
BAND = 8
"""Half-bandwidth of three coordinates and a tension for every joint."""

FIRST, LAST, FASTER = 1e-3, 1e-9, 0.2
"""mu [EI/L], and how it falls."""

RESIDUAL = 1e-5  # [EI/L^2]
ITERATIONS = 150
PULLS = (3e3, 1e3, 3e2, 1e2, 3e1, 1e1, 1.0)
"""Springs of a rod that lost its equilibrium to where it was just before [EI/L^3]."""


@dataclass(frozen=True)
class Rod:
    """A rod in the passage; joints are counted from the clamp, the last is the tip.

    Attributes
    ----------
    joints
        Places, shape (links, 3) [L].
    tension
        Multipliers of the links' lengths, shape (links,) [EI/L^2]; positive if compressed.
    gap, force
        Gap h and its multiplier z, shape (links,).
    w
        Parameters of the deepest balls.
    wall_force
        Of the wall on the joints, shape (links, 3) [EI/L^2].
    stable
        Whether the energy is least among neighbouring states.
    slipped
        Whether it came here by leaving an equilibrium that was lost.
    """

    joints: Array
    tension: Array
    gap: Array
    force: Array
    w: Array
    wall_force: Array = field(default_factory=lambda: np.zeros((0, 3)))
    stable: bool = True
    slipped: bool = False

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
        If no equilibrium is found.
    """
    arc = step * np.arange(1.0, first + 1.0)
    joints = arc[:, None] * passage.direction
    w = passage.nearest(joints, arc)
    rod = _Search(passage, step).settle(
        Rod(joints, np.zeros(first), np.ones(first), np.zeros(first), w)
    )
    yield rod
    while len(rod.joints) < round(distance / step):
        rod = _next(_Search(passage, step), _fed(rod))
        yield rod


def _fed(rod: Rod) -> Rod:
    """A link longer: the rod slides along itself, and the tip takes its contact along."""

    def longer(values: Array) -> Array:
        return np.append(values, values[-1:], axis=0)

    joints = np.append(rod.joints, [2.0 * rod.joints[-1] - rod.joints[-2]], axis=0)
    force = longer(rod.force)
    force[-2] = min(force[-2], force[-3])
    return Rod(joints, longer(rod.tension), longer(rod.gap), force, longer(rod.w))


def _next(search: _Search, guess: Rod) -> Rod:
    """The equilibrium near a guess; or, if there is no stable one, where the rod slips to."""
    try:
        rod = search.settle(guess)
        if rod.stable and np.abs(rod.joints - guess.joints).max() < 4.0 * search.step:
            return rod
    except RuntimeError:
        pass
    rod = guess
    for pull in PULLS:
        for _ in range(40):
            before = rod.joints
            rod = search.settle(rod, pull * search.step)
            if np.abs(rod.joints - before).max() < 1e-4:
                break
    rod = search.settle(rod)
    moved = float(np.abs(rod.joints - guess.joints).max())
    return Rod(**{**vars(rod), "slipped": moved > 4.0 * search.step})


@dataclass(frozen=True)
class _Search:
    """Newton's method for the conditions of an equilibrium."""

    passage: Passage
    step: float

    def settle(self, start: Rod, pull: float = 0.0) -> Rod:
        """Equilibrium; with springs of stiffness ``pull`` on the joints to where they start."""
        x, y, w = start.joints.copy(), start.tension.copy(), start.w
        z = np.maximum(start.force, 1e-3)
        s = np.maximum(start.gap, FIRST / z)
        mu = FIRST
        for _ in range(ITERATIONS):
            w = self.passage.nearest(x, w)
            gap, inwards, curved = self.passage.room(x, w)
            edges = np.diff(x, axis=0, prepend=np.zeros((1, 3))) / self.step
            length = 0.5 * self.step * ((edges**2).sum(axis=1) - 1.0)
            slope = self._slope(x) + pull * (x - start.joints)
            slope -= _pulled(y[:, None] * edges)
            rest = slope - z[:, None] * inwards
            worst = max(np.abs(rest).max(), np.abs(s * z - mu).max() / self.step)
            close = max(np.abs(length).max(), np.abs(gap - s).max())
            if worst < max(RESIDUAL, 10.0 * mu) and close < max(1e-10, 0.1 * mu):
                if mu <= LAST:
                    stable = self._stable(edges, y, z, s, inwards, curved)
                    return Rod(x, y, gap, z, w, z[:, None] * inwards, stable)
                mu = max(LAST, FASTER * mu)
            stiff = z / s
            toward = mu / s - stiff * (gap - s)
            blocks = stiff[:, None, None] * inwards[:, :, None] * inwards[:, None, :]
            blocks -= z[:, None, None] * curved
            dx, dy = self._solve(edges, y, blocks, pull, toward[:, None] * inwards - slope, -length)
            ds = (inwards * dx).sum(axis=1) + gap - s
            dz = mu / s - z - stiff * ds
            go = min(1.0, 0.25 * self.passage.radius / np.abs(dx).max(), _room(s, ds))
            x, y, s = x + go * dx, y + go * dy, s + go * ds
            z = z + _room(z, dz) * dz
        raise RuntimeError(f"No equilibrium of {len(x)} links was found; left over {worst:.1e}.")

    def _slope(self, x: Array) -> Array:
        """Derivative of the bending energy."""
        turns = np.diff(np.vstack((np.zeros((1, 3)), x)), n=2, axis=0) / self.step**3
        slope = np.zeros_like(x)
        slope[0] = -2.0 * self.passage.direction / self.step**2
        slope[1:] += turns
        slope[:-1] -= 2.0 * turns
        slope[:-2] += turns[1:]
        return slope

    def _bands(self, y: Array) -> tuple[Array, Array, Array]:
        """What joints have to do with themselves, the next and the one after, every coordinate."""
        n = len(y)
        own, next_, after = np.zeros(n), np.zeros(n - 1), np.full(n - 2, 1.0)
        own[1:] += 1.0
        own[:-1] += 4.0
        own[:-2] += 1.0
        next_ -= 2.0
        next_[:-1] -= 2.0
        own, next_, after = (a / self.step**3 for a in (own, next_, after))
        own -= y / self.step
        own[:-1] -= y[1:] / self.step
        next_ += y[1:] / self.step
        return own, next_, after

    def _solve(
        self, edges: Array, y: Array, blocks: Array, pull: float, force: Array, length: Array
    ) -> tuple[Array, Array]:
        """Newton's step of joints and tensions."""
        n = len(y)
        own, next_, after = self._bands(y)
        m = np.zeros((2 * BAND + 1, 4 * n))
        for a in range(3):
            for b in range(3):
                m[BAND + a - b, b::4] = blocks[:, a, b]
            m[BAND, a::4] += own + pull
            for k, values in ((4, next_), (8, after)):
                m[BAND - k, a + k :: 4] = values
                m[BAND + k, a : 4 * n - k : 4] = values
            m[BAND + a - 3, 3::4] = -edges[:, a]
            m[BAND + 3 - a, a::4] = edges[:, a]
            m[BAND + a - 7, 7::4] = edges[1:, a]
            m[BAND + 7 - a, a : 4 * n - 4 : 4] = -edges[1:, a]
        right = np.column_stack((force, length)).ravel()
        found = solve_banded((BAND, BAND), m, right, overwrite_ab=True, check_finite=False)
        found = found.reshape(n, 4)
        return found[:, :3], found[:, 3]

    def _stable(
        self, edges: Array, y: Array, z: Array, s: Array, inwards: Array, curved: Array
    ) -> bool:
        """Whether the energy grows for all small motions that the constraints allow.

        That is whether H + J^T D J is positive definite for large D (Debreu), J the constraints.
        """
        n = len(y)
        own, next_, after = self._bands(y)
        blocks = (z / s)[:, None, None] * inwards[:, :, None] * inwards[:, None, :]
        blocks -= z[:, None, None] * curved
        stretch = 1e3 / self.step**3 * edges[:, :, None] * edges[:, None, :]
        blocks += stretch
        blocks[:-1] += stretch[1:]
        m = np.zeros((7, 3 * n))  # lower bands
        for a in range(3):
            for b in range(a + 1):
                m[a - b, b::3] = blocks[:, a, b]
            for b in range(3):
                m[3 + a - b, b : 3 * n - 3 : 3] -= stretch[1:, a, b]
            m[0, a::3] += own
            m[3, a : 3 * n - 3 : 3] += next_
            m[6, a : 3 * n - 6 : 3] += after
        try:
            cholesky_banded(m, lower=True, overwrite_ab=True, check_finite=False)
        except LinAlgError:
            return False
        return True


def _pulled(edges: Array) -> Array:
    """Transpose of differences: edge by edge on its two joints."""
    joints = edges.copy()
    joints[:-1] -= edges[1:]
    return joints


def _room(values: Array, steps: Array) -> float:
    """Part of a step that leaves positive values positive."""
    falls = steps < 0.0
    return min(1.0, 0.99 * float((-values[falls] / steps[falls]).min())) if falls.any() else 1.0
