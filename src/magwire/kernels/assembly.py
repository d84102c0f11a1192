"""Energy, gradient and Hessian of the whole wire, element by element.

The band starts at the position of the node before the last held one: 8 leading rows couple the
free unknowns to the guide (P-15, P-21); the first free row is FIRST, the mouth's twist angle.
"""

from __future__ import annotations

from math import inf

from magwire.kernels._jit import kernel, part
from magwire.kernels.bending import (
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
from magwire.kernels.frames import after, material_frames
from magwire.kernels.groups import add_rows, any_of, column, group, numbers, total, vectors
from magwire.kernels.hinge import hinge, material_frame
from magwire.kernels.lanes import clear_rows, following, four, load, splat, store, transposed
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
from magwire.kernels.tube import add_tube
from magwire.kernels.twisting import twisting_gradient, twisting_hessian
from magwire.kernels.vectors import add, combine, dot, row, scale, sub
from magwire.kernels.wall.contact import add_walls
from magwire.kernels.wall.traction import friction_energy, note_pushes

FIRST = 7
LEAD = 8


@part
def add_elements(rod, field, state, mouth, gradient, band):
    """Bending and twisting of every hinge, and stretching and torque of the edge after it.

    From the mouth to the tip, four at a time (P-3, P-7, P-15). Where fewer are left, those that
    there are not have no stiffness and no moment. The torque is that of a uniform field.
    """
    held = mouth.held
    last = state.length.shape[0] - 1
    before = vectors(state.tangent, group(held - 1, held - 1))
    m1, m2 = material_frames(
        vectors(state.director, group(held - 1, held - 1)),
        before,
        column(state.q, group(held - 1, held - 1), 3),
    )
    edge = before, m1, m2, numbers(state.length, group(held - 1, held - 1))
    theta_e = column(state.q, group(held - 1, held - 1), 3)
    energy = splat(0.0)
    magnetic = field.uniform[0]
    u = field.strength
    for i in range(held, last + 1, 4):
        g = group(i, last)
        count = last + 1 - i
        there = four(1.0, one_if(count > 1), one_if(count > 2), one_if(count > 3))
        part = four(mouth.fraction if i == held else 1.0, 1.0, 1.0, 1.0)
        tf, theta_f = vectors(state.tangent, g), column(state.q, g, 3)
        m1_f, m2_f = material_frames(vectors(state.director, g), tf, theta_f)
        length_f = numbers(state.length, g)
        te, m1_e, m2_e = after(edge[0], tf), after(edge[1], m1_f), after(edge[2], m2_f)
        h = hinge(te, tf, following(edge[3], length_f), length_f)
        c1, c2 = curvatures(h, m1_e, m2_e, m1_f, m2_f)
        share = there / part
        kb, kt = share * numbers(rod.bend, g), share * numbers(rod.twist, g)
        bent1 = c1.value - part * column(rod.rest_curvature, g, 0)
        bent2 = c2.value - part * column(rod.rest_curvature, g, 1)
        w1, w2 = kb * bent1, kb * bent2
        tau = theta_f - following(theta_e, theta_f) + numbers(state.twist, g)
        energy = energy + 0.5 * (w1 * bent1 + w2 * bent2 + kt * tau * tau)

        be, bf, b_te, b_tf = bending_gradient(c1, c2, w1, w2)
        we, wf, w_te, w_tf = twisting_gradient(h, kt * tau)
        elastic, rest = there * numbers(rod.stretch, g), numbers(rod.rest, g)
        stored, tension = stretching(elastic, length_f, rest)
        energy = energy + stored
        by_e, by_f = add(be, we), add(add(bf, wf), scale(tension, tf))
        by_te, by_tf = b_te + w_te, b_tf + w_tf
        m = scale(there, vectors(rod.moment, g))
        turned = magnetic and any_of(m)
        b = (length_f, length_f, length_f)
        if turned:
            b = add(vectors(field.flux_density, g), (u[0], u[1], u[2]))
            energy = energy - dot(moment_vector(m, m1_f, m2_f, tf), b)
            by_edge, by_theta = torque_gradient(m, m1_f, m2_f, tf, h.inv_f, b)
            by_f, by_tf = add(by_f, by_edge), by_tf + by_theta
        _scatter_gradient(gradient, i, last + 1, by_e, by_f, by_te, by_tf)
        if len(band) > 0:
            frames = (m1_e, m2_e, m1_f, m2_f)
            bent = bending_hessian(h, kb, c1, c2, w1, w2, frames)
            twisted = twisting_hessian(h, kt, kt * tau)
            ee = sym_add(bent[0], twisted[0])
            ff = sym_add(bent[1], twisted[1])
            ff = sym_add(ff, stretching_hessian(elastic, length_f, rest, tf))
            ef = mat_add(bent[2], twisted[2])
            e_te, e_tf = add(bent[3][0], twisted[3][0]), add(bent[3][1], twisted[3][1])
            f_te, f_tf = add(bent[3][2], twisted[3][2]), add(bent[3][3], twisted[3][3])
            tt_ee, tt_ef = bent[4][0] + twisted[4][0], bent[4][1] + twisted[4][1]
            tt_ff = bent[4][2] + twisted[4][2]
            if turned:
                block, edge_theta, theta = torque_hessian(m, m1_f, m2_f, tf, h.inv_f, b)
                ff, f_tf, tt_ff = sym_add(ff, block), add(f_tf, edge_theta), tt_ff + theta
            columns = (e_te, e_tf, f_te, f_tf)
            _scatter_hessian(
                band, 4 * (i - held), count, (ee, ff, ef), columns, (tt_ee, tt_ef, tt_ff)
            )
        edge = tf, m1_f, m2_f, length_f
        theta_e = theta_f
    return total(energy)


@kernel
def one_if(holds):
    """One if something holds, else zero."""
    return 1.0 if holds else 0.0


@kernel
def _scatter_gradient(gradient, i, tip, by_e, by_f, by_te, by_tf):
    """Add the derivatives of four hinges from node i on, by their edges and these' angles."""
    middle = sub(by_e, by_f)
    a0, a1, a2, a3 = transposed(-by_e[0], -by_e[1], -by_e[2], by_te)
    b0, b1, b2, b3 = transposed(middle[0], middle[1], middle[2], by_tf)
    c0, c1, c2, c3 = transposed(by_f[0], by_f[1], by_f[2], 0.0 * by_tf)
    store(gradient, i - 1, 0, load(gradient, i - 1, 0) + a0)
    store(gradient, i, 0, load(gradient, i, 0) + (a1 + b0))
    store(gradient, i + 1, 0, load(gradient, i + 1, 0) + (a2 + b1 + c0))
    if i + 2 <= tip:
        store(gradient, i + 2, 0, load(gradient, i + 2, 0) + (a3 + b2 + c1))
    if i + 3 <= tip:
        store(gradient, i + 3, 0, load(gradient, i + 3, 0) + (b3 + c2))
    if i + 4 <= tip:
        store(gradient, i + 4, 0, load(gradient, i + 4, 0) + c3)


@kernel
def _scatter_hessian(band, r, count, blocks, columns, angles):
    """Add the blocks of up to four hinges; r is the row of the node before the first of them.

    Column by column of its lower triangle, as the band has them.
    """
    ee, ff, ef = blocks
    e_te, e_tf, f_te, f_tf = columns
    tt_ee, tt_ef, tt_ff = angles
    none = 0.0 * tt_ee
    bb = sym_add(sym_add(ee, ff), _minus_sum(ef))
    be = mat_add(transpose(ef), full(sym_scale(-1.0, ee)))
    cb = mat_add(transpose(ef), full(sym_scale(-1.0, ff)))
    u, v = sub(e_te, f_te), sub(e_tf, f_tf)
    add_rows(band, r, count, 4, 0, (ee[0], ee[1], ee[2], -e_te[0]))
    add_rows(band, r, count, 4, 4, (be[0], be[3], be[6], -e_tf[0]))
    add_rows(band, r, count, 4, 8, (-ef[0], -ef[1], -ef[2], none))
    add_rows(band, r + 1, count, 4, 0, (ee[3], ee[4], -e_te[1], be[1]))
    add_rows(band, r + 1, count, 4, 4, (be[4], be[7], -e_tf[1], -ef[3]))
    add_rows(band, r + 1, count, 4, 8, (-ef[4], -ef[5], none, none))
    add_rows(band, r + 2, count, 4, 0, (ee[5], -e_te[2], be[2], be[5]))
    add_rows(band, r + 2, count, 4, 4, (be[8], -e_tf[2], -ef[6], -ef[7]))
    add_rows(band, r + 2, count, 4, 8, (-ef[8], none, none, none))
    add_rows(band, r + 3, count, 4, 0, (tt_ee, u[0], u[1], u[2]))
    add_rows(band, r + 3, count, 4, 4, (tt_ef, f_te[0], f_te[1], f_te[2]))
    add_rows(band, r + 4, count, 4, 0, (bb[0], bb[1], bb[2], v[0]))
    add_rows(band, r + 4, count, 4, 4, (cb[0], cb[3], cb[6], none))
    add_rows(band, r + 5, count, 4, 0, (bb[3], bb[4], v[1], cb[1]))
    add_rows(band, r + 5, count, 4, 4, (cb[4], cb[7], none, none))
    add_rows(band, r + 6, count, 4, 0, (bb[5], v[2], cb[2], cb[5]))
    add_rows(band, r + 6, count, 4, 4, (cb[8], none, none, none))
    add_rows(band, r + 7, count, 4, 0, (tt_ff, f_tf[0], f_tf[1], f_tf[2]))
    add_rows(band, r + 8, count, 4, 0, (ff[0], ff[1], ff[2], none))
    add_rows(band, r + 9, count, 4, 0, (ff[3], ff[4], none, none))
    add_rows(band, r + 10, count, 4, 0, (ff[5], none, none, none))


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
def add_magnets(rod, field, state, held, gradient, band):
    """Magnetic energy of every edge from the mouth to the tip in a field with a gradient (P-7)."""
    energy = 0.0
    for j in range(held, state.length.shape[0]):
        m = row(rod.moment, j)
        if m[0] != 0.0 or m[1] != 0.0 or m[2] != 0.0:
            energy += _add_magnet(field, state, j, m, gradient, band, 4 * (j - held + 1))
    return energy


@part
def _add_magnet(field, state, j, m, gradient, band, r):
    """Magnetic energy of one edge at its present middle (P-7); r is the row of its first node."""
    t = row(state.tangent, j)
    inv = 1.0 / state.length[j]
    m1, m2 = material_frame(row(state.director, j), t, state.q[j, 3])
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
    nodes = state.q.shape[0]
    energy = splat(0.0)
    for i in range(held, nodes):
        mass = rod.mass[i] * motion.factor if i > held else 0.0
        inertia = rod.inertia[i] * motion.factor if i < nodes - 1 else 0.0
        pull = four(mass, mass, mass, inertia)
        weight = four(rod.weight[i, 0], rod.weight[i, 1], rod.weight[i, 2], 0.0)
        if i == held:
            weight = 0.0 * weight
        q = load(state.q, i, 0)
        away = q - load(motion.target, i, 0)
        energy = energy + (0.5 * pull * away * away - weight * q)
        store(gradient, i, 0, load(gradient, i, 0) + (pull * away - weight))
        if len(band) > 0:
            r = 4 * (i - held + 1)
            band[r, 0] += mass
            band[r + 1, 0] += mass
            band[r + 2, 0] += mass
            band[r + 3, 0] += inertia
    return total(energy)


@kernel
def assemble(model, state, mouth, motion, gradient, band):
    """Energy, and the smallest clearance where the wall is felt; fills gradient and band.

    A band without rows says that no Hessian is wanted; so in every function of this file.
    """
    rod, field, wall, lumen, tube = model
    held = mouth.held
    nodes = state.q.shape[0]
    clear_rows(gradient, held - 1, nodes)
    if len(band) > 0:
        clear_rows(band, 0, 4 * (nodes - held + 1))
    contact, nearest = add_walls(rod, lumen, wall, state, held, gradient, band)
    if contact == inf:
        return inf, nearest
    note_pushes(wall.friction, gradient, held)
    confined, near = add_tube(rod, tube, state, held, gradient, band)
    if confined == inf:
        return inf, near
    nearest = min(nearest, near)
    energy = contact + confined + add_elements(rod, field, state, mouth, gradient, band)
    if not field.uniform[0]:
        energy += add_magnets(rod, field, state, held, gradient, band)
    energy += add_bodies(rod, state, motion, held, gradient, band)
    energy += friction_energy(wall.friction, rod, state, held, gradient, band)
    return energy, nearest
