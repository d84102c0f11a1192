"""Friction of the wall on every node that it presses, over a time step (P-29 to P-33).

The normal forces are those at the end of the step: the step is solved with the forces as they are
known, they are read off its end, and so on until they no longer change. In between they are given,
so that the step minimises a potential. What a node keeps from step to step is its elastic slip.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel, part
from magwire.kernels.blocks import outer, sym_add, sym_identity, sym_outer, sym_pair
from magwire.kernels.lanes import clear_rows, copy_rows
from magwire.kernels.scatter import add_block, add_column, add_diagonal, add_row, add_vector
from magwire.kernels.vectors import add, combine, dot, norm, row, scale, sub
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.friction import (
    along_wall,
    by_turning,
    lost,
    potential,
    returned,
    spread,
    transported,
    under_load,
)
from magwire.kernels.wall.gap import gap_value

# Columns of State.contact: elastic slip, or with drag the surface's speed, the wall's normal, its
# force, whether the node slides, how far it has slid, the factor of its coefficients; how fast the
# force grew in the last step, how much faster than in the one before, and how fast it will grow.
SLIP, NORMAL, LOAD, SLIDES, SLID, FACTOR, GROWTH, BEND, COMING = 0, 3, 6, 7, 8, 9, 10, 11, 12
CONTACT = 13
MOST = 2.0  # times a normal force that it may be guessed to grow, or shrink, in a step
SETTLED = 1e-3  # relative change of a normal force at which it is known (P-31)
SMALL = 1e-3  # of the largest normal force: what is less is known as well as this is
TURN = 2e-3  # turn of a normal times its coefficient, at which it is known: it tilts the traction


@kernel
def angle_at(q, i):
    """Angle of the wire about its axis at a node: the mean of its edges'."""
    before = q[i - 1, 3]
    return before if i == q.shape[0] - 1 else 0.5 * (before + q[i, 3])


@part
def axis_at(state, i):
    """Direction of the wire at a node."""
    last = state.length.shape[0] - 1
    before = row(state.tangent, i - 1)
    if i > last:
        return before
    both = add(before, row(state.tangent, i))
    return scale(1.0 / norm(both), both)


@kernel
def span_at(state, i):
    """Length of wire between the nodes on either side of a node."""
    last = state.length.shape[0] - 1
    return state.length[i - 1] + (0.0 if i > last else state.length[i])


@kernel
def spread_at(q, i):
    """From the node before a node to the one after it; to the tip itself."""
    return sub(row(q, min(i + 1, q.shape[0] - 1)), row(q, i - 1))


@kernel
def factor_at(friction, x):
    """Factor of the coefficients at a place in the lumen."""
    table = friction.table
    if len(table) == 0:
        return 1.0
    _, arc, branch, _ = gap_value(friction.path, x[0], x[1], x[2])
    last = table.shape[0] - 1
    if branch < 0 or arc <= table[0, 0]:
        return table[0, 1]
    for k in range(last):
        if arc < table[k + 1, 0]:
            share = (arc - table[k, 0]) / (table[k + 1, 0] - table[k, 0])
            return (1.0 - share) * table[k, 1] + share * table[k + 1, 1]
    return table[last, 1]


@kernel
def cone_at(friction, i):
    """Largest traction on a node, and the stiffness of its stick."""
    load, factor = friction.load[i, 3], friction.factor[i]
    full = friction.static[i] * factor * load
    mu = friction.kinetic[i] if friction.slides[i] else friction.static[i]
    return mu * factor * load, full / friction.slip


@kernel
def set_load(friction, state, ahead, i, n, size):
    """Take a normal force for known: the elastic slip of the step's beginning is carried to it.

    ``state``: at the step's beginning; ``ahead``: where the wire's axis is taken from.
    """
    for c in range(3):
        friction.load[i, c] = n[c]
    friction.load[i, 3] = size
    kept = state.contact[i]
    before, now = kept[FACTOR] * kept[LOAD], friction.factor[i] * size
    slip = (0.0, 0.0, 0.0)
    if before > 0.0 and now > 0.0 and friction.drag == 0.0:
        old = (kept[NORMAL], kept[NORMAL + 1], kept[NORMAL + 2])
        slip = transported((kept[SLIP], kept[SLIP + 1], kept[SLIP + 2]), old, n)
        slip = under_load(slip, before, now)
    t, radius = axis_at(ahead, i), friction.radius[i]
    turning = by_turning(n, t, radius)
    leaning = along_wall(n, scale(radius / span_at(ahead, i), t))
    for c in range(3):
        friction.anchor[i, c] = slip[c]
        friction.turning[i, c] = turning[c]
        friction.leaning[i, c] = leaning[c]


@part
def _start(friction, state, held):
    """Take where a wire is, and which nodes slide, for the beginning of a step."""
    nodes = state.q.shape[0]
    copy_rows(state.q, friction.start, held - 1, nodes)
    for i in range(held + 1, nodes):
        friction.slides[i] = state.contact[i, SLIDES] > 0.0


@kernel
def guess(size, growth, dt):
    """A normal force at the end of a step, as it grew in the one before.

    A guess within ``SETTLED`` saves solving the step once more.
    """
    return min(max(size + growth * dt, size / MOST), size * MOST)


@kernel
def look_ahead(kept, growth):
    """Note how fast a normal force grew in a step, and say how fast it will grow in the next.

    As in this one, and as much faster as this one was than the one before, if that would have been
    the better guess for this one.
    """
    bend = growth - kept[GROWTH]
    steady = abs(bend - kept[BEND]) < abs(bend)
    kept[GROWTH], kept[BEND] = growth, bend
    kept[COMING] = growth + bend if steady else growth


@part
def begin(rod, lumen, wall, state, carried, held, dt, work):
    """Begin a step of length dt at a state, with the wall's forces as they go on from there.

    carried: the state, or where a wall that moves in the step has carried it: the wire slips
    against the wall.
    """
    friction = wall.friction[0]
    friction.rate[0] = 1.0 / dt
    read_loads(rod, lumen, wall, carried, held, friction.pushed, work.no_band)
    _start(friction, carried, held)
    for i in range(held + 1, state.q.shape[0]):
        size = pushed_at(friction, i)
        friction.begun[i] = size
        _take(friction, state, state, i, size, guess(size, state.contact[i, COMING], dt))


@kernel
def recall(friction, state, held):
    """Bring back the contacts of the step that ended at a state, whose tractions it is held by."""
    friction.rate[0] = 1.0
    _start(friction, state, held)
    for i in range(held + 1, state.q.shape[0]):
        kept = state.contact[i]
        friction.factor[i] = kept[FACTOR]
        n = (kept[NORMAL], kept[NORMAL + 1], kept[NORMAL + 2])
        set_load(friction, state, state, i, n, kept[LOAD])
        for c in range(3):
            friction.anchor[i, c] = kept[SLIP + c]


@kernel
def reach_at(friction, state, i):
    """Elastic slip at the step's beginning and the surface's way along the wall since (P-29)."""
    n = row(friction.load, i)
    moved = along_wall(n, sub(row(state.q, i), row(friction.start, i)))
    turned = angle_at(state.q, i) - angle_at(friction.start, i)
    leant = dot(n, sub(spread_at(state.q, i), spread_at(friction.start, i)))
    rolled = combine(turned, row(friction.turning, i), leant, row(friction.leaning, i))
    way = add(moved, rolled)
    return add(row(friction.anchor, i), way), way


@part
def pull_at(rod, friction, state, i):
    """Energy, gradient and Hessian by the way of a node's surface."""
    n = row(friction.load, i)
    reach, _ = reach_at(friction, state, i)
    cone, stiffness = cone_at(friction, i)
    energy, pull, block = 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if stiffness > 0.0:
        energy, pull, block = potential(reach, n, cone, stiffness)
    if friction.drag > 0.0:
        thick = friction.drag * rod.cell[i] * friction.rate[0]
        energy += 0.5 * thick * dot(reach, reach)
        pull = combine(1.0, pull, thick, reach)
        block = sym_add(block, sym_add(sym_identity(thick), sym_outer(-thick, n)))
    return energy, pull, block


@part
def add_friction(rod, friction, state, held, gradient, band):
    """What friction adds to a step's potential: see ``friction.potential``.

    The surface moves with its node, with the angles of the edges beside it, and with the nodes
    beside it, since the wire leans as they move along the normal.
    """
    energy = 0.0
    tip = state.q.shape[0] - 1
    for i in range(held + 1, tip + 1):
        if friction.load[i, 3] <= 0.0:
            continue
        value, pull, block = pull_at(rod, friction, state, i)
        energy += value
        n, turning = row(friction.load, i), row(friction.turning, i)
        moment, mixed, twice = spread(pull, block, turning)
        lean, bent, double = spread(pull, block, row(friction.leaning, i))
        share, after = (0.5, i + 1) if i < tip else (1.0, i)
        add_vector(gradient, i, 1.0, pull)
        add_vector(gradient, after, lean, n)
        add_vector(gradient, i - 1, -lean, n)
        gradient[i - 1, 3] += share * moment
        if i < tip:
            gradient[i, 3] += share * moment
        if len(band) > 0:
            r = 4 * (i - held + 1)
            add_diagonal(band, r, block)
            add_column(band, r, r - 1, scale(share, mixed))
            band[r - 1, 0] += share * share * twice
            if i < tip:
                add_row(band, r + 3, r, scale(share, mixed))
                band[r + 3, 0] += share * share * twice
                band[r - 1, 4] += share * share * twice
            both = share * dot(turning, bent)
            _add_leaning(band, r, n, bent, double, both, i < tip)
    return energy


@part
def _add_leaning(band, r, n, bent, double, both, inside):
    """Second derivatives by the nodes beside one at row r: how they move the surface is along n.

    bent: by the node and the lean; double: by the lean twice; both: by lean and an edge's angle.
    """
    add_diagonal(band, r - 4, sym_outer(double, n))
    add_block(band, r, r - 4, outer(-1.0, bent, n))
    add_row(band, r - 1, r - 4, scale(-both, n))
    if inside:
        add_row(band, r + 3, r - 4, scale(-both, n))
        add_diagonal(band, r + 4, sym_outer(double, n))
        add_block(band, r + 4, r, outer(1.0, n, bent))
        add_block(band, r + 4, r - 4, outer(-double, n, n))
        add_column(band, r + 4, r - 1, scale(both, n))
        add_column(band, r + 4, r + 3, scale(both, n))
    else:
        add_diagonal(band, r, sym_add(sym_outer(double, n), sym_pair(1.0, bent, n)))
        add_block(band, r, r - 4, outer(-double, n, n))
        add_column(band, r, r - 1, scale(both, n))


@kernel
def read_loads(rod, lumen, wall, state, held, pushed, no_band):
    """The wall's forces on the nodes, as minus the gradient, into ``pushed``."""
    clear_rows(pushed, held - 1, state.q.shape[0])
    add_walls(rod, lumen, wall, state, held, pushed, no_band)


@kernel
def pushed_at(friction, i):
    """Size of the wall's force on a node."""
    return norm(row(friction.pushed, i))


@kernel
def normal_at(friction, i, size):
    """Direction of the wall's force on a node, of a size above zero."""
    return scale(-1.0 / size, row(friction.pushed, i))


@part
def _take(friction, state, ahead, i, size, most):
    """Take a force of the wall for known: ``size`` where it was read off, ``most`` in the step."""
    if size > 0.0:
        friction.factor[i] = factor_at(friction, row(ahead.q, i))
        set_load(friction, state, ahead, i, normal_at(friction, i, size), most)
    else:
        friction.factor[i], friction.load[i, 3] = 1.0, 0.0


@kernel
def gives_way(friction, ahead, i):
    """Whether a node that sticks, and slides more easily than that, has left its cone."""
    if friction.slides[i] or friction.kinetic[i] == friction.static[i]:
        return False
    reach, _ = reach_at(friction, ahead, i)
    cone, stiffness = cone_at(friction, i)
    return stiffness * norm(reach) > cone


@kernel
def known(friction, ahead, held):
    """Whether a step was solved with the normal forces that it ends with (P-31)."""
    nodes = ahead.q.shape[0]
    largest = 0.0
    for i in range(held + 1, nodes):
        friction.ended[i] = pushed_at(friction, i)
        largest = max(largest, friction.ended[i])
    for i in range(held + 1, nodes):
        size, before = friction.ended[i], friction.load[i, 3]
        if size == 0.0 and before == 0.0:
            continue
        if abs(size - before) > SETTLED * max(size, SMALL * largest):
            return False
        if size > SMALL * largest:
            turn = norm(sub(normal_at(friction, i, size), row(friction.load, i)))
            if friction.static[i] * friction.factor[i] * turn > TURN:
                return False
        if before > 0.0 and gives_way(friction, ahead, i):
            return False
    return True


@part
def reload(friction, state, ahead, share):
    """Whether the normal forces at the end of a step were known; they are taken for known if not.

    share: by which part of the difference they are changed.

    A node that has left its static cone slides for the rest of the step: with two coefficients, one
    that could stick again might go to and fro for ever. ``keep`` decides what it does from there.
    """
    held = state.held[0]
    if friction.drag > 0.0:  # a viscous traction does not depend on the normal force
        return True
    if known(friction, ahead, held):
        return True
    for i in range(held + 1, state.q.shape[0]):
        if friction.load[i, 3] > 0.0 and gives_way(friction, ahead, i):
            friction.slides[i] = True
        size = friction.ended[i]
        if share < 1.0:
            size = _between(friction, i, share)
        _take(friction, state, ahead, i, size, size)
    return False


@kernel
def _between(friction, i, share):
    """Take a force between the one that was known and the one read off; its size."""
    rest = (share - 1.0) * friction.load[i, 3]
    for c in range(3):
        friction.pushed[i, c] = share * friction.pushed[i, c] + rest * friction.load[i, c]
    return pushed_at(friction, i)


@kernel
def keep(rod, friction, state, ahead):
    """Carry the elastic slip over to the end of a step, and count what friction took.

    With the forces that the step was solved with: so records are in balance to round-off.
    """
    for i in range(1, state.q.shape[0]):
        kept = state.contact[i]
        size = friction.load[i, 3] if i > state.held[0] else 0.0
        if size == 0.0 and kept[LOAD] == 0.0:
            continue
        kept[LOAD], kept[FACTOR] = size, friction.factor[i]
        if size == 0.0:
            for c in range(LOAD):
                kept[c] = 0.0
            kept[SLIDES] = kept[GROWTH] = kept[BEND] = kept[COMING] = 0.0
            continue
        if friction.drag == 0.0:
            look_ahead(kept, (friction.ended[i] - friction.begun[i]) * friction.rate[0])
        reach, way = reach_at(friction, ahead, i)
        cone, stiffness = cone_at(friction, i)
        slip = scale(friction.rate[0], way)  # with drag the speed, which the traction follows
        if friction.drag == 0.0:
            slip = (0.0, 0.0, 0.0)
        if stiffness > 0.0:
            slip = returned(reach, cone, stiffness)
            state.spent[0] += lost(reach, cone, stiffness)
        state.spent[0] += friction.drag * rod.cell[i] * friction.rate[0] * dot(way, way)
        for c in range(3):
            kept[SLIP + c] = slip[c]
            kept[NORMAL + c] = friction.load[i, c]
        kept[SLIDES] = 1.0 if stiffness * norm(reach) > cone else 0.0
        kept[SLID] += norm(sub(reach, slip)) if stiffness > 0.0 else norm(way)


@kernel
def held_by(frictions, rod, state, i):
    """Friction of the wall on a node at the end of a step, from its elastic slip or its speed."""
    if len(frictions) == 0:
        return (0.0, 0.0, 0.0)
    else:
        friction, kept = frictions[0], state.contact[i]
        stiffness = friction.static[i] * kept[FACTOR] * kept[LOAD] / friction.slip
        stiffness += friction.drag * rod.cell[i]
        return scale(-stiffness, (kept[SLIP], kept[SLIP + 1], kept[SLIP + 2]))


@kernel
def tractions(rod, friction, state, forces, scale):
    """Fill ``forces`` [N, 3] with the friction of the wall on the nodes of a state at rest."""
    for i in range(1, state.q.shape[0]):
        for c in range(3):
            forces[i - 1, c] = 0.0
        if i > state.held[0] and friction.load[i, 3] > 0.0:
            _, pull, _ = pull_at(rod, friction, state, i)
            for c in range(3):
                forces[i - 1, c] = -pull[c] * scale


# A wall holds its friction in a tuple, which is empty where there is none. The length of a tuple is
# part of its type: kernels for smooth walls are compiled without friction, whose code would slow
# down the others' steps by a fifth.


@kernel
def note_pushes(frictions, pushes, held):
    """Keep the wall's forces, which are all that there is of a gradient, if there is friction."""
    if len(frictions) > 0:
        copy_rows(pushes, frictions[0].pushed, held - 1, pushes.shape[0])


@kernel
def friction_energy(frictions, rod, state, held, gradient, band):
    """What friction adds to a step's potential, if there is any; see ``add_friction``."""
    if len(frictions) == 0:
        return 0.0
    else:
        return add_friction(rod, frictions[0], state, held, gradient, band)


@kernel
def keep_contacts(frictions, rod, state, ahead):
    """Carry the contacts over to the end of a step, if there is friction; see ``keep``."""
    if len(frictions) > 0:
        keep(rod, frictions[0], state, ahead)


@kernel
def read_friction(frictions, rod, state, held, forces, scale):
    """Recall the contacts of a state and fill ``forces`` with their friction, if there is any."""
    if len(frictions) > 0:
        recall(frictions[0], state, held)
        tractions(rod, frictions[0], state, forces, scale)
