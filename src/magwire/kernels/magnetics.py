"""Magnetic energy of one edge (P-6, P-7).

E = -m . B(x_mid), m = l (M_1 m1 + M_2 m2 + M_3 t) the edge's moment, turning with the material
frame. The background is affine about the point where it was sampled: B(x) = B_0 + G (x - x_0),
G_ij = dB_i/dx_j; an actuator's field is known everywhere with its derivatives.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel, part
from magwire.kernels.blocks import sym_add, sym_identity, sym_outer, sym_pair, sym_scale
from magwire.kernels.vectors import add, combine, dot, row, scale, sub


@part
def with_background(field, j, x, made):
    """Field at a point, as made by the actuator, together with the background at edge j."""
    b, g, second = made
    away, own = sub(x, row(field.origin, j)), field.gradient[j]
    b = (
        b[0] + field.flux_density[j, 0] + own[0] * away[0] + own[1] * away[1] + own[2] * away[2],
        b[1] + field.flux_density[j, 1] + own[3] * away[0] + own[4] * away[1] + own[5] * away[2],
        b[2] + field.flux_density[j, 2] + own[6] * away[0] + own[7] * away[1] + own[8] * away[2],
    )
    g = (
        g[0] + own[0],
        g[1] + own[1],
        g[2] + own[2],
        g[3] + own[3],
        g[4] + own[4],
        g[5] + own[5],
        g[6] + own[6],
        g[7] + own[7],
        g[8] + own[8],
    )
    return b, g, second


@kernel
def second_block(space, second):
    """Second derivatives of -m.B by either node of an edge, from those of B at its middle."""
    x, y, z = -0.25 * space[0], -0.25 * space[1], -0.25 * space[2]
    return (
        x * second[0] + y * second[6] + z * second[12],
        x * second[1] + y * second[7] + z * second[13],
        x * second[2] + y * second[8] + z * second[14],
        x * second[3] + y * second[9] + z * second[15],
        x * second[4] + y * second[10] + z * second[16],
        x * second[5] + y * second[11] + z * second[17],
    )


@kernel
def moment_vector(m, m1, m2, t):
    """The moment in space, from its three components in the material frame."""
    return add(combine(m[0], m1, m[1], m2), scale(m[2], t))


@kernel
def torque_gradient(m, m1, m2, t, inv, b):
    """Derivatives of -m.B by the edge vector and by its twist angle, at fixed B."""
    along = dot(t, b)
    across = combine(m[0], m1, m[1], m2)
    by_edge = scale(inv, sub(scale(along, across), scale(m[2], sub(b, scale(along, t)))))
    by_theta = m[1] * dot(m1, b) - m[0] * dot(m2, b)
    return by_edge, by_theta


@kernel
def torque_hessian(m, m1, m2, t, inv, b):
    """Second derivatives of -m.B by edge (symmetric), edge and theta, theta, at fixed B."""
    along = dot(t, b)
    across = combine(m[0], m1, m[1], m2)
    b_across = sub(b, scale(along, t))
    edge = sym_add(
        sym_pair(m[2], b_across, t),
        sym_add(sym_identity(m[2] * along), sym_outer(-m[2] * along, t)),
    )
    edge = sym_add(edge, sym_add(sym_pair(0.5, across, b_across), sym_pair(-along, t, across)))
    edge_theta = scale(inv * along, combine(m[0], m2, -m[1], m1))
    theta = m[0] * dot(m1, b) + m[1] * dot(m2, b)
    return sym_scale(inv * inv, edge), edge_theta, theta


@kernel
def force_block(m, m1, m2, t, inv, g):
    """Second derivatives of -m.B by edge (rows) and midpoint (columns), by theta and midpoint."""
    x, theta_x = torque_gradient(m, m1, m2, t, inv, (g[0], g[3], g[6]))
    y, theta_y = torque_gradient(m, m1, m2, t, inv, (g[1], g[4], g[7]))
    z, theta_z = torque_gradient(m, m1, m2, t, inv, (g[2], g[5], g[8]))
    block = (x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2])
    return block, (theta_x, theta_y, theta_z)
