"""Twisting of one hinge: energy, gradient, Hessian (P-3, P-5).

E = k/2 tau^2, k = GJ / l, with the integrated twist tau = theta^f - theta^e + reference twist.
The frames' parallel transport makes tau depend on the edges: d tau = kb . (de/|e| + df/|f|) / 2.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import mat_add, outer, skew, sym_add, sym_outer, sym_pair
from magwire.kernels.vectors import add, scale


@kernel
def twisting_gradient(h, moment):
    """Derivatives by edge e, edge f, theta e, theta f; moment = k tau."""
    return (
        scale(0.5 * moment * h.inv_e, h.binormal),
        scale(0.5 * moment * h.inv_f, h.binormal),
        -moment,
        moment,
    )


@kernel
def twisting_hessian(h, k, moment):
    """Blocks ee, ff (symmetric), ef, e-theta and f-theta columns, theta-theta (P-5)."""
    kb = h.binormal
    square_e, square_f = h.inv_e * h.inv_e, h.inv_f * h.inv_f
    quarter_e, quarter_f = -0.25 * moment * square_e, -0.25 * moment * square_f
    ee = sym_add(sym_outer(0.25 * k * square_e, kb), sym_pair(quarter_e, kb, add(h.te, h.tilde)))
    ff = sym_add(sym_outer(0.25 * k * square_f, kb), sym_pair(quarter_f, kb, add(h.tf, h.tilde)))
    both = h.inv_e * h.inv_f
    ef = mat_add(outer(0.25 * k * both, kb, kb), outer(-0.5 * moment * both, kb, h.tilde))
    ef = mat_add(ef, skew(moment * both * h.inv_chi, h.te))
    by_e, by_f = scale(0.5 * k * h.inv_e, kb), scale(0.5 * k * h.inv_f, kb)
    columns = (scale(-1.0, by_e), by_e, scale(-1.0, by_f), by_f)
    return ee, ff, ef, columns, (k, -k, k)
