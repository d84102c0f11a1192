"""Barrier of one point near the wall, and what is remembered of the gap there (P-8, P-11)."""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import sym_add, sym_outer, sym_scale
from magwire.kernels.groups import smallest_of
from magwire.kernels.lanes import splat, where
from magwire.kernels.vectors import dot, norm, scale, sub
from magwire.kernels.wall.eased import eased
from magwire.kernels.wall.foundation import at_node, response
from magwire.kernels.wall.gap import fall, gap_jet


@kernel
def query(lumen, x, known, jet):
    """Ask for the gap at a point and remember it, and which place of the centreline it is from."""
    g, s, branch, safe, n, h = gap_jet(lumen, x[0], x[1], x[2])
    known[0], known[1], known[2], known[3] = x[0], x[1], x[2], safe
    jet[0], jet[1], jet[2], jet[3] = g, n[0], n[1], n[2]
    jet[4], jet[5], jet[6], jet[7], jet[8], jet[9] = h[0], h[1], h[2], h[3], h[4], h[5]
    jet[10], jet[11] = s, branch


@kernel
def asked_at(x, known):
    """Whether what is remembered of the gap is that of this very point."""
    return x[0] == known[0] and x[1] == known[1] and x[2] == known[2]


@kernel
def clear_of_wall(x, known, fast, reach):
    """Whether a point is known to be farther than ``reach`` from the wall.

    ``known`` remembers where the gap was last asked for and how far from there no wall is. It is
    asked before ``push``, since a call hands over the whole lumen, and most nodes need none. fast:
    as of ``gap.fall``.
    """
    return fast * norm(sub(x, (known[0], known[1], known[2]))) + reach <= known[3]


@kernel
def all_clear(x, known, fast, reach):
    """Whether ``clear_of_wall`` holds for four points: columns of points and of what is known."""
    room = known[3] - reach
    away = sub(x, (known[0], known[1], known[2]))
    return smallest_of(where(room, room * room - fast * fast * dot(away, away), splat(-1.0))) > 0.0


@kernel
def push(lumen, x, stiffness, gap, offset, known, jet, give, easy):
    """Barrier of a point near the wall (P-8, P-11), and what gives way behind it (P-39).

    give: as of ``foundation.at_node``; easy: see ``Wall``.

    Returns
    -------
    clearance
        Of the point, from the wall as it is; +inf if the wall does not act on it.
    energy, gradient, hessian
        The energy is +inf if the point is in the wall, as deep as that may give way.
    """
    if not asked_at(x, known):
        query(lumen, x, known, jet)
    d, n = jet[0] - offset, (jet[1], jet[2], jet[3])
    if d >= gap:
        return inf, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if not d > -give[1]:
        return 0.0, inf, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    d, value, first, curved = response(give, d, gap)
    h = eased(lumen.sheet, n, (jet[4], jet[5], jet[6], jet[7], jet[8], jet[9]), easy)
    block = sym_add(sym_outer(stiffness * curved, n), sym_scale(stiffness * first, h))
    return d, stiffness * value, scale(stiffness * first, n), block


@kernel
def press(rod, lumen, wall, x, i):
    """Barrier of the wall on node i at x; see ``push``."""
    if clear_of_wall(x, wall.known[i], fall(lumen), wall.gap + rod.offset[i]):
        return inf, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    stiffness, give = wall.stiffness * rod.cell[i], at_node(wall.bed, i)
    known, jet, easy = wall.known[i], wall.jet[i], wall.easy
    return push(lumen, x, stiffness, wall.gap, rod.offset[i], known, jet, give, easy)
