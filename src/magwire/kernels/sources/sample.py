"""The field at many points, for Python."""

from __future__ import annotations

from magwire.kernels._jit import kernel
from magwire.kernels.sources.inputs import by_inputs
from magwire.kernels.sources.jet import jet
from magwire.kernels.vectors import row


@kernel
def sample(sources, strength, points, flux, gradient):
    """Flux density [n, 3] and gradient [n, 9] at points [n, 3]."""
    for i in range(points.shape[0]):
        b, g, _ = jet(sources, strength, row(points, i), False)
        for c in range(3):
            flux[i, c] = b[c]
        for c in range(9):
            gradient[i, c] = g[c]


@kernel
def sample_jets(sources, strength, points, made):
    """Flux density, gradient and second derivatives, [n, 30], at points [n, 3]."""
    for i in range(points.shape[0]):
        b, g, d = jet(sources, strength, row(points, i), True)
        for c in range(3):
            made[i, c] = b[c]
        for c in range(9):
            made[i, 3 + c] = g[c]
        for c in range(18):
            made[i, 12 + c] = d[c]


@kernel
def respond(sources, u, strength, points, flux, gradient):
    """Derivatives by the inputs, [n, K, 3] and [n, K, 9], at points [n, 3]."""
    for i in range(points.shape[0]):
        by_inputs(sources, u, strength, row(points, i), flux[i], gradient[i])
