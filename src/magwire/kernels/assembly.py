"""Energy, gradient and Hessian of the whole wire, element by element.

The band starts at the position of the node before the last held one: 8 leading rows couple the
free unknowns to the guide (P-15, P-21); the first free row is FIRST, the mouth's twist angle.
"""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel, part
from magwire.kernels.bending import (
    bending_energy,
    bending_gradient,
    bending_hessian,
    curvatures,
)
from magwire.kernels.blocks import (
    full,
    mat_add,
    mat_scale,
    sym_add,
    sym_scale,
    transpose,
)
from magwire.kernels.hinge import hinge, material_frame
from magwire.kernels.magnetics import (
    force_block,
    moment_vector,
    second_block,
    torque_gradient,
    torque_hessian,
    with_background,
)
from magwire.kernels.scatter import add_block, add_column, add_diagonal, add_row, add_vector
from magwire.kernels.sources.steer import field_of
from magwire.kernels.stretching import stretching, stretching_hessian
from magwire.kernels.twisting import twisting_gradient, twisting_hessian
from magwire.kernels.vectors import add, combine, dot, row, scale, sub
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.traction import friction_energy

FIRST = 7
LEAD = 8


@kernel
def clear(array, first, last):
    """Set rows first ... last - 1 to zero."""
    for i in range(first, last):
        for k in range(array.shape[1]):
            array[i, k] = 0.0


@part
def add_hinges(rod, state, mouth, gradient, band):
    """Bending and twisting of every hinge from the mouth to the tip (P-3, P-15)."""
    energy = 0.0
    held = mouth.held
    last = state.length.shape[0]
    te = row(state.tangent, held - 1)
    m1_e, m2_e = material_frame(row(state.director, held - 1), te, state.q[held - 1, 3])
    for i in range(held, last):
        part = mouth.fraction if i == held else 1.0
        tf = row(state.tangent, i)
        m1_f, m2_f = material_frame(row(state.director, i), tf, state.q[i, 3])
        h = hinge(te, tf, state.length[i - 1], state.length[i])
        c1, c2 = curvatures(h, m1_e, m2_e, m1_f, m2_f)
        kb, kt = rod.bend[i] / part, rod.twist[i] / part
        w1 = kb * (c1.value - part * rod.rest_curvature[i, 0])
        w2 = kb * (c2.value - part * rod.rest_curvature[i, 1])
        tau = state.q[i, 3] - state.q[i - 1, 3] + state.twist[i]
        energy += bending_energy(kb, w1, w2) + 0.5 * kt * tau * tau

        be, bf, b_te, b_tf = bending_gradient(c1, c2, w1, w2)
        we, wf, w_te, w_tf = twisting_gradient(h, kt * tau)
        by_e, by_f = add(be, we), add(bf, wf)
        add_vector(gradient, i - 1, -1.0, by_e)
        add_vector(gradient, i, 1.0, sub(by_e, by_f))
        add_vector(gradient, i + 1, 1.0, by_f)
        gradient[i - 1, 3] += b_te + w_te
        gradient[i, 3] += b_tf + w_tf
        if len(band) > 0:
            frames = (m1_e, m2_e, m1_f, m2_f)
            bent = bending_hessian(h, kb, c1, c2, w1, w2, frames)
            twisted = twisting_hessian(h, kt, kt * tau)
            _scatter_hinge(band, 4 * (i - held), bent, twisted)
        te, m1_e, m2_e = tf, m1_f, m2_f
    return energy


@part
def _scatter_hinge(band, r, bent, twisted):
    """Add the blocks of one hinge; r is the row of the node before it."""
    ee, ff = sym_add(bent[0], twisted[0]), sym_add(bent[1], twisted[1])
    ef = mat_add(bent[2], twisted[2])
    e_te, e_tf = add(bent[3][0], twisted[3][0]), add(bent[3][1], twisted[3][1])
    f_te, f_tf = add(bent[3][2], twisted[3][2]), add(bent[3][3], twisted[3][3])
    x0, x1, x2 = r, r + 4, r + 8
    fe = transpose(ef)
    add_diagonal(band, x0, ee)
    add_diagonal(band, x1, sym_add(sym_add(ee, ff), _minus_sum(ef)))
    add_diagonal(band, x2, ff)
    add_block(band, x1, x0, mat_add(fe, full(sym_scale(-1.0, ee))))
    add_block(band, x2, x0, mat_scale(-1.0, fe))
    add_block(band, x2, x1, mat_add(fe, full(sym_scale(-1.0, ff))))
    add_row(band, x0 + 3, x0, scale(-1.0, e_te))
    add_column(band, x1, x0 + 3, sub(e_te, f_te))
    add_column(band, x2, x0 + 3, f_te)
    add_row(band, x1 + 3, x0, scale(-1.0, e_tf))
    add_row(band, x1 + 3, x1, sub(e_tf, f_tf))
    add_column(band, x2, x1 + 3, f_tf)
    band[x0 + 3, 0] += bent[4][0] + twisted[4][0]
    band[x0 + 3, 4] += bent[4][1] + twisted[4][1]
    band[x1 + 3, 0] += bent[4][2] + twisted[4][2]


@kernel
def _minus_sum(a):
    """-(a + a^T) as a symmetric matrix."""
    return (
        -2.0 * a[0],
        -a[1] - a[3],
        -a[2] - a[6],
        -2.0 * a[4],
        -a[5] - a[7],
        -2.0 * a[8],
    )


@part
def add_edges(rod, field, state, mouth, gradient, band):
    """Stretching and magnetic energy of every edge from the mouth to the tip (P-3, P-7)."""
    energy = 0.0
    held = mouth.held
    for j in range(held, state.length.shape[0]):
        t = row(state.tangent, j)
        stored, tension = stretching(rod.stretch[j], state.length[j], rod.rest[j])
        energy += stored
        by_e = scale(tension, t)
        m = row(rod.moment, j)
        magnetic = m[0] != 0.0 or m[1] != 0.0 or m[2] != 0.0
        if len(band) > 0:
            block = stretching_hessian(rod.stretch[j], state.length[j], rod.rest[j], t)
            r = 4 * (j - held + 1)
            add_diagonal(band, r, block)
            add_diagonal(band, r + 4, block)
            add_block(band, r + 4, r, full(sym_scale(-1.0, block)))
        if magnetic:
            energy += _add_magnet(field, state, j, m, gradient, band, 4 * (j - held + 1))
        add_vector(gradient, j, -1.0, by_e)
        add_vector(gradient, j + 1, 1.0, by_e)
    return energy


@part
def _add_magnet(field, state, j, m, gradient, band, r):
    """Magnetic energy of one edge at its present middle (P-7); r is the row of its first node."""
    t = row(state.tangent, j)
    inv = 1.0 / state.length[j]
    m1, m2 = material_frame(row(state.director, j), t, state.q[j, 3])
    if field.uniform[0]:
        u = field.strength
        b = add(row(field.flux_density, j), (u[0], u[1], u[2]))
    else:
        middle = combine(0.5, row(state.q, j), 0.5, row(state.q, j + 1))
        made = field_of(field.sources, field.strength, middle, len(band) > 0)
        b, g, second = with_background(field, j, middle, made)
        space = moment_vector(m, m1, m2, t)
        pull = (
            -0.5 * (space[0] * g[0] + space[1] * g[3] + space[2] * g[6]),
            -0.5 * (space[0] * g[1] + space[1] * g[4] + space[2] * g[7]),
            -0.5 * (space[0] * g[2] + space[1] * g[5] + space[2] * g[8]),
        )
        add_vector(gradient, j, 1.0, pull)
        add_vector(gradient, j + 1, 1.0, pull)
        if len(band) > 0:
            em, theta_m = force_block(m, m1, m2, t, inv, g)
            half = mat_scale(0.5, em)
            other = transpose(half)
            bent = second_block(space, second)
            add_diagonal(band, r, sym_add(bent, _minus_sum(half)))
            add_diagonal(band, r + 4, sym_add(bent, sym_scale(-1.0, _minus_sum(half))))
            turned = mat_add(half, mat_scale(-1.0, other))
            add_block(band, r + 4, r, mat_add(full(bent), turned))
            add_row(band, r + 3, r, scale(0.5, theta_m))
            add_column(band, r + 4, r + 3, scale(0.5, theta_m))
    by_edge, by_theta = torque_gradient(m, m1, m2, t, inv, b)
    add_vector(gradient, j, -1.0, by_edge)
    add_vector(gradient, j + 1, 1.0, by_edge)
    gradient[j, 3] += by_theta
    if len(band) > 0:
        block, edge_theta, theta = torque_hessian(m, m1, m2, t, inv, b)
        add_diagonal(band, r, block)
        add_diagonal(band, r + 4, block)
        add_block(band, r + 4, r, full(sym_scale(-1.0, block)))
        add_row(band, r + 3, r, scale(-1.0, edge_theta))
        add_column(band, r + 4, r + 3, edge_theta)
        band[r + 3, 0] += theta
    return -dot(moment_vector(m, m1, m2, t), b)


@part
def add_bodies(rod, state, motion, held, gradient, band):
    """Inertia of the time step and gravity (P-14)."""
    energy = 0.0
    nodes = state.q.shape[0]
    for i in range(held, nodes):
        if i > held:
            pull = rod.mass[i] * motion.factor
            for c in range(3):
                away = state.q[i, c] - motion.target[i, c]
                energy += 0.5 * pull * away * away - rod.weight[i, c] * state.q[i, c]
                gradient[i, c] += pull * away - rod.weight[i, c]
                if len(band) > 0:
                    band[4 * (i - held + 1) + c, 0] += pull
        if i < nodes - 1:
            pull = rod.inertia[i] * motion.factor
            away = state.q[i, 3] - motion.target[i, 3]
            energy += 0.5 * pull * away * away
            gradient[i, 3] += pull * away
            if len(band) > 0:
                band[4 * (i - held + 1) + 3, 0] += pull
    return energy


@kernel
def assemble(model, state, mouth, motion, gradient, band):
    """Energy, and the smallest clearance where the wall is felt; fills gradient and band.

    A band without rows says that no Hessian is wanted; so in every function of this file.
    """
    rod, field, wall, lumen = model
    held = mouth.held
    nodes = state.q.shape[0]
    clear(gradient, held - 1, nodes)
    if len(band) > 0:
        clear(band, 0, 4 * (nodes - held + 1))
    contact, nearest = add_walls(rod, lumen, wall, state, held, gradient, band)
    if contact == inf:
        return inf, nearest
    energy = contact + add_hinges(rod, state, mouth, gradient, band)
    energy += add_edges(rod, field, state, mouth, gradient, band)
    energy += add_bodies(rod, state, motion, held, gradient, band)
    energy += friction_energy(wall.friction, rod, state, held, gradient, band)
    return energy, nearest
