"""The tangent of a wire at rest under friction, as it is if what is on its cone slides on (P-33).

Where a contact slides its traction follows the normal force: the tangent is not symmetric. A row of
it holds what is left and right of the diagonal, by ``HALF_BANDWIDTH`` columns each.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel, part
from magwire.kernels.band import HALF_BANDWIDTH, factor
from magwire.kernels.lanes import clear_rows
from magwire.kernels.vectors import add, combine, cross, dot, norm, row, scale
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.friction import ON_CONE
from magwire.kernels.wall.traction import axis_at, cone_at, span_at

FULL = 2 * HALF_BANDWIDTH + 1


@kernel
def entry_at(band, r, c):
    """An entry of a symmetric band, which has its lower triangle by columns."""
    low, high = (c, r) if c < r else (r, c)
    return band[low, high - low] if high - low <= HALF_BANDWIDTH else 0.0


@kernel
def pushed_by(walls, r, c):
    """How the wall's force on the node of row r follows the unknown c; ``walls``: its Hessian."""
    return (
        -entry_at(walls, r, c),
        -entry_at(walls, r + 1, c),
        -entry_at(walls, r + 2, c),
    )


@kernel
def axis_turns(state, i, node, c):
    """How the wire's direction at node i follows the coordinate c of a node (P-29)."""
    last = state.length.shape[0] - 1
    way = (1.0 if c == 0 else 0.0, 1.0 if c == 1 else 0.0, 1.0 if c == 2 else 0.0)
    before = row(state.tangent, i - 1)
    near = (1.0 if node == i else 0.0) - (1.0 if node == i - 1 else 0.0)
    turn = scale(near / state.length[i - 1], combine(1.0, way, -dot(before, way), before))
    if i > last:
        return turn
    after = row(state.tangent, i)
    far = (1.0 if node == i + 1 else 0.0) - (1.0 if node == i else 0.0)
    other = scale(far / state.length[i], combine(1.0, way, -dot(after, way), after))
    both, turn = add(before, after), add(turn, other)
    t = scale(1.0 / norm(both), both)
    return scale(1.0 / norm(both), combine(1.0, turn, -dot(t, turn), t))


@part
def _add_column(friction, state, walls, i, held, slides, node, c, full):
    """What a contact's tangent has besides ``add_friction``'s, by the coordinate c of a node.

    Its traction follows the normal force, if it slides, and turns with the normal, as do the ways
    of the surface by turning and leaning.
    """
    tip = state.q.shape[0] - 1
    n, load = row(friction.load, i), friction.load[i, 3]
    _, stiffness = cone_at(friction, i)
    pull = scale(stiffness, row(friction.anchor, i))
    r, column = 4 * (i - held + 1), 4 * (node - held + 1) + c
    push = pushed_by(walls, r, column)
    grown = dot(n, push)
    dn = scale(1.0 / load, combine(1.0, push, -grown, n))
    follows = scale(grown / load if slides else 0.0, pull)
    t, radius = axis_at(state, i), friction.radius[i]
    dt = axis_turns(state, i, node, c)
    by_node = combine(1.0, follows, -dot(dn, pull), n)
    turned = scale(-radius, add(cross(dt, n), cross(t, dn)))
    moment = dot(follows, row(friction.turning, i)) + dot(pull, turned)
    leant = (radius / span_at(state, i)) * (dot(pull, dt) - dot(n, t) * dot(pull, dn))
    leant += dot(follows, row(friction.leaning, i))
    by_lean = combine(leant, n, dot(pull, row(friction.leaning, i)), dn)
    share, after = (0.5, i + 1) if i < tip else (1.0, i)
    _add_to(full, r, column, by_node)
    _add_to(full, r - 4, column, scale(-1.0, by_lean))
    _add_to(full, 4 * (after - held + 1), column, by_lean)
    _add_one(full, r - 1, column, share * moment)
    if i < tip:
        _add_one(full, r + 3, column, share * moment)


@kernel
def _add_one(full, r, c, value):
    full[r, HALF_BANDWIDTH + c - r] += value


@kernel
def _add_to(full, r, c, v):
    for k in range(3):
        _add_one(full, r + k, c, v[k])


@kernel
def is_on_cone(friction, i):
    """Whether a contact at rest is on its cone."""
    cone, stiffness = cone_at(friction, i)
    return stiffness * norm(row(friction.anchor, i)) >= ON_CONE * cone


@kernel
def fill(friction, state, held, walls, band, full):
    """Fill ``full`` with the tangent of a wire at rest whose contacts are recalled.

    Parameters
    ----------
    walls
        Band of the wall's Hessian alone.
    band
        That of the step's potential, with friction; see ``traction.add_friction``.
    """
    rows = 4 * (state.q.shape[0] - held + 1)
    for r in range(rows):
        for k in range(FULL):
            c = r + k - HALF_BANDWIDTH
            full[r, k] = entry_at(band, r, c) if 0 <= c < rows else 0.0
    tip = state.q.shape[0] - 1
    for i in range(held + 1, tip + 1):
        _, stiffness = cone_at(friction, i)
        if friction.load[i, 3] > 0.0 and stiffness > 0.0:
            slides = is_on_cone(friction, i)
            for node in range(i - 1, min(i + 1, tip) + 1):
                for c in range(3):
                    _add_column(friction, state, walls, i, held, slides, node, c, full)


@kernel
def _lean_rows(friction, state, held, full):
    """Add to a sliding node's rows what its row along the normal has, by its traction's slope.

    What follows the normal force drops out, and the determinant is the same: a stiff wall makes no
    large entries off the diagonal.
    """
    for i in range(held + 1, state.q.shape[0]):
        _, stiffness = cone_at(friction, i)
        load = friction.load[i, 3]
        if load > 0.0 and stiffness > 0.0 and is_on_cone(friction, i):
            n = row(friction.load, i)
            slope = scale(stiffness / load, row(friction.anchor, i))
            r = 4 * (i - held + 1)
            for c in range(max(r + 2 - HALF_BANDWIDTH, 0), r + HALF_BANDWIDTH + 1):
                k = HALF_BANDWIDTH + c - r
                along = n[0] * full[r, k] + n[1] * full[r + 1, k - 1] + n[2] * full[r + 2, k - 2]
                full[r, k] += slope[0] * along
                full[r + 1, k - 1] += slope[1] * along
                full[r + 2, k - 2] += slope[2] * along


@kernel
def negative_pivots(full, first, last):
    """How many pivots of rows first ... last - 1 are not positive; eliminates in place.

    An odd number of them is a negative determinant.
    """
    count = 0
    for j in range(first, last):
        pivot = full[j, HALF_BANDWIDTH]
        if not pivot > 0.0:
            count += 1
        for r in range(j + 1, min(j + HALF_BANDWIDTH + 1, last)):
            share = full[r, HALF_BANDWIDTH + j - r] / pivot
            if share != 0.0:
                for k in range(1, HALF_BANDWIDTH + 1):
                    full[r, HALF_BANDWIDTH + j - r + k] -= share * full[j, HALF_BANDWIDTH + k]
    return count


@kernel
def hold_walls(frictions, rod, lumen, wall, state, held, work):
    """Keep the band of the wall's Hessian in ``work.kept``, if there is friction."""
    if len(frictions) > 0:
        clear_rows(work.kept, 0, 4 * (state.q.shape[0] - held + 1))
        clear_rows(work.gradient, held - 1, state.q.shape[0])
        add_walls(rod, lumen, wall, state, held, work.gradient, work.kept)


@kernel
def positive(frictions, state, held, work, first, last):
    """Whether the tangent in ``work.band`` is positive definite; with friction, see ``fill``.

    Then: whether that with all contacts sliding that are on their cones has positive pivots only.
    """
    if len(frictions) == 0:
        return factor(work.band, first, last) < 0
    else:
        full = frictions[0].tangent
        fill(frictions[0], state, held, work.kept, work.band, full)
        _lean_rows(frictions[0], state, held, full)
        return negative_pivots(full, first, last) == 0
