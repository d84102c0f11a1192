"""Bending of one hinge: energy, gradient, Hessian (P-3, P-5).

E = k/2 [(kappa_1 - rest_1)^2 + (kappa_2 - rest_2)^2], k = EI / l, with the integrated curvatures
kappa_1 = (m2^e + m2^f)/2 . kb and kappa_2 = -(m1^e + m1^f)/2 . kb of the binormal kb.

With time-parallel frames the second derivative has a skew part (holonomy), which is left out:
it is proportional to dE/dtheta and so vanishes at equilibrium (P-5).
"""

from __future__ import annotations

from typing import NamedTuple

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import (
    mat_add,
    mat_scale,
    outer,
    skew,
    sym_add,
    sym_identity,
    sym_outer,
    sym_pair,
    sym_scale,
)
from magwire.kernels.vectors import add, combine, cross, dot, scale, sub


class Curvature(NamedTuple):
    """One integrated curvature and its derivatives by edge e, edge f and the two twist angles."""

    value: float
    by_e: tuple[float, float, float]
    by_f: tuple[float, float, float]
    by_theta_e: float
    by_theta_f: float


@kernel
def curvature(h, a_e, a_f, b_e, b_f):
    """Curvature (a_e + a_f)/2 . kb; the directors a turn into -b under a twist angle."""
    mean = scale(h.inv_chi, add(a_e, a_f))
    value = 0.5 * dot(add(a_e, a_f), h.binormal)
    by_e = scale(h.inv_e, sub(cross(h.tf, mean), scale(value, h.tilde)))
    by_f = scale(-h.inv_f, add(cross(h.te, mean), scale(value, h.tilde)))
    return Curvature(value, by_e, by_f, -0.5 * dot(h.binormal, b_e), -0.5 * dot(h.binormal, b_f))


@kernel
def curvatures(h, m1_e, m2_e, m1_f, m2_f):
    """Both integrated curvatures of a hinge."""
    first = curvature(h, m2_e, m2_f, m1_e, m1_f)
    second = curvature(h, scale(-1.0, m1_e), scale(-1.0, m1_f), m2_e, m2_f)
    return first, second


@kernel
def bending_gradient(c1, c2, w1, w2):
    """Derivatives by edge e, edge f, theta e, theta f."""
    return (
        combine(w1, c1.by_e, w2, c2.by_e),
        combine(w1, c1.by_f, w2, c2.by_f),
        w1 * c1.by_theta_e + w2 * c2.by_theta_e,
        w1 * c1.by_theta_f + w2 * c2.by_theta_f,
    )


@kernel
def _same_edge(h, t, inv, kappa, turned, a):
    """Second derivative of w.kappa by one edge, twice (P-5)."""
    block = sym_add(sym_outer(2.0 * kappa, h.tilde), sym_pair(-1.0, turned, h.tilde))
    block = sym_add(block, sym_identity(-kappa * h.inv_chi))
    block = sym_add(block, sym_outer(kappa * h.inv_chi, t))
    return sym_scale(inv * inv, sym_add(block, sym_pair(0.25, h.binormal, a)))


@kernel
def bending_hessian(h, k, c1, c2, w1, w2, frames):
    """Blocks ee, ff (symmetric), ef, e-theta and f-theta columns, theta-theta (P-5)."""
    m1_e, m2_e, m1_f, m2_f = frames
    a_e, a_f = combine(w1, m2_e, -w2, m1_e), combine(w1, m2_f, -w2, m1_f)
    b_e, b_f = combine(w1, m1_e, w2, m2_e), combine(w1, m1_f, w2, m2_f)
    kappa = w1 * c1.value + w2 * c2.value
    mean = scale(h.inv_chi, add(a_e, a_f))
    turned_e, turned_f = cross(h.tf, mean), cross(h.te, mean)
    minus_f = scale(-1.0, turned_f)

    ee = _same_edge(h, h.te, h.inv_e, kappa, turned_e, a_e)
    ff = _same_edge(h, h.tf, h.inv_f, kappa, minus_f, a_f)
    ee = sym_add(ee, sym_add(sym_outer(k, c1.by_e), sym_outer(k, c2.by_e)))
    ff = sym_add(ff, sym_add(sym_outer(k, c1.by_f), sym_outer(k, c2.by_f)))

    ef = mat_add(outer(2.0 * kappa, h.tilde, h.tilde), outer(-kappa * h.inv_chi, h.te, h.tf))
    ef = mat_add(ef, mat_add(outer(-1.0, turned_e, h.tilde), outer(1.0, h.tilde, turned_f)))
    ef = mat_add(ef, skew(-1.0, mean))
    diagonal = -kappa * h.inv_chi
    ef = mat_add(ef, (diagonal, 0.0, 0.0, 0.0, diagonal, 0.0, 0.0, 0.0, diagonal))
    ef = mat_scale(h.inv_e * h.inv_f, ef)
    ef = mat_add(ef, mat_add(outer(k, c1.by_e, c1.by_f), outer(k, c2.by_e, c2.by_f)))

    e_te = _edge_theta(
        h, h.inv_e, h.tf, -1.0, b_e, k, c1.by_e, c2.by_e, c1.by_theta_e, c2.by_theta_e
    )
    e_tf = _edge_theta(
        h, h.inv_e, h.tf, -1.0, b_f, k, c1.by_e, c2.by_e, c1.by_theta_f, c2.by_theta_f
    )
    f_te = _edge_theta(
        h, h.inv_f, h.te, 1.0, b_e, k, c1.by_f, c2.by_f, c1.by_theta_e, c2.by_theta_e
    )
    f_tf = _edge_theta(
        h, h.inv_f, h.te, 1.0, b_f, k, c1.by_f, c2.by_f, c1.by_theta_f, c2.by_theta_f
    )

    e1, e2, f1, f2 = c1.by_theta_e, c2.by_theta_e, c1.by_theta_f, c2.by_theta_f
    tt_ee = k * (e1 * e1 + e2 * e2) - 0.5 * dot(h.binormal, a_e)
    tt_ff = k * (f1 * f1 + f2 * f2) - 0.5 * dot(h.binormal, a_f)
    tt_ef = k * (e1 * f1 + e2 * f2)
    return ee, ff, ef, (e_te, e_tf, f_te, f_tf), (tt_ee, tt_ef, tt_ff)


@kernel
def _edge_theta(h, inv, t, sign, b, k, by1, by2, theta1, theta2):
    """Second derivative by one edge and one twist angle."""
    bent = combine(0.5 * dot(h.binormal, b) * inv, h.tilde, sign * h.inv_chi * inv, cross(t, b))
    return add(bent, combine(k * theta1, by1, k * theta2, by2))
