"""Contact between the nodes: no point of an edge leaves the lumen (P-11).

An edge is a chord. Where the wall bulges towards it, as on the inside of a bend, its middle comes
nearer to the wall than its nodes do. Points that divide it into equal parts have a barrier of their
own, much thinner than that of the nodes: it acts only where the nodes' barrier leaves an edge
uncovered, and is zero elsewhere. The points keep a margin from the wall that the chords between
them cannot use up.
"""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import full, sym_scale
from magwire.kernels.scatter import add_block, add_diagonal, add_vector
from magwire.kernels.vectors import combine, norm, row, sub
from magwire.kernels.wall.push import clear_of_wall, push, query


@kernel
def margin(rod, between, j):
    """What the wall keeps from the axis at the points of edge j, with their margin."""
    return max(rod.offset[j], rod.offset[j + 1]) + between.margin


@kernel
def at_least(x, known, offset):
    """Lower bound of a node's clearance, from what is known of the gap near it."""
    return known[3] - norm(sub(x, (known[0], known[1], known[2]))) - offset


@kernel
def clear_edge(rod, wall, q, j, length, reach):
    """Whether all of edge j is known to be farther than ``reach`` from the wall.

    Expects that the gap was asked for at or near both nodes.
    """
    here = at_least(row(q, j), wall.known[j], rod.offset[j])
    there = at_least(row(q, j + 1), wall.known[j + 1], rod.offset[j + 1])
    return 0.5 * (here + there - length) >= reach  # the gap is 1-Lipschitz


@kernel
def press_edge(rod, lumen, wall, state, j, gradient, band, r):
    """Barrier of the points of edge j; r is the band's row of its first node.

    Returns the smallest clearance, +inf where no point feels the wall, and the energy.
    """
    between = wall.between
    energy = 0.0
    nearest = inf
    offset = margin(rod, between, j)
    stiffness = between.stiffness * rod.rest[j] / between.parts
    for k in range(1, between.parts):
        s = k / between.parts
        x = combine(1.0 - s, row(state.q, j), s, row(state.q, j + 1))
        known = between.known[j, k]
        if clear_of_wall(x, known, between.gap + offset):
            continue
        d, value, pushed, block = push(
            lumen, x, stiffness, between.gap, offset, known, between.jet[j, k]
        )
        if d < inf:
            nearest = min(nearest, d)
            energy += value
            add_vector(gradient, j, 1.0 - s, pushed)
            add_vector(gradient, j + 1, s, pushed)
            if len(band) > 0:
                add_diagonal(band, r, sym_scale((1.0 - s) * (1.0 - s), block))
                add_diagonal(band, r + 4, sym_scale(s * s, block))
                add_block(band, r + 4, r, full(sym_scale(s * (1.0 - s), block)))
    return nearest, energy


@kernel
def add_between(rod, lumen, wall, state, held, gradient, band):
    """Barrier energy of the edges past the last held node; see ``press_edge``."""
    energy = 0.0
    nearest = inf
    between = wall.between
    reach = between.gap + between.margin
    x = row(state.q, held)
    if not clear_of_wall(x, wall.known[held], rod.offset[held] + reach + state.length[held]):
        query(lumen, x, wall.known[held], wall.jet[held])
    for j in range(held, state.length.shape[0]):
        if not clear_edge(rod, wall, state.q, j, state.length[j], reach):
            r = 4 * (j - held + 1)
            d, value = press_edge(rod, lumen, wall, state, j, gradient, band, r)
            nearest = min(nearest, d)
            energy += value
    return nearest, energy
