"""Tangents, frames and reference twist of a configuration, carried along its path (P-2)."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.hinge import reference_twist, transport
from magwire.kernels.vectors import norm, row, scale, sub


@kernel
def update_frames(base, state, held):
    """Tangents and frames of ``state``, transported from ``base`` along time (P-2)."""
    edges = state.length.shape[0]
    for j in range(held - 1, edges):
        e = sub(row(state.q, j + 1), row(state.q, j))
        length = norm(e)
        t = scale(1.0 / length, e)
        d1 = transport(row(base.director, j), row(base.tangent, j), t)
        state.length[j] = length
        for c in range(3):
            state.tangent[j, c] = t[c]
            state.director[j, c] = d1[c]
        if j >= held:
            state.twist[j] = reference_twist(
                row(state.director, j - 1), row(state.tangent, j - 1), d1, t, base.twist[j]
            )
