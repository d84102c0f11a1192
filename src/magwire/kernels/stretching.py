"""Stretching of one edge: energy, gradient, Hessian (P-3).

E = EA/2 (|e|/l - 1)^2 l with the rest length l.
"""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import sym_add, sym_identity, sym_outer


@kernel
def stretching(stiffness, length, rest):
    """Energy and axial tension of an edge of the given length."""
    strain = length / rest - 1.0
    return 0.5 * stiffness * strain * strain * rest, stiffness * strain


@kernel
def stretching_hessian(stiffness, length, rest, t):
    """Second derivative by the edge vector of unit tangent t (symmetric)."""
    across = stiffness * (1.0 / rest - 1.0 / length)
    return sym_add(sym_identity(across), sym_outer(stiffness / length, t))
