"""What of a wall's curvature a Newton step is spared: that of bulges towards the wire (P-14).

A wall of triangles has a ridge along many an edge. A point that a force presses against one is on
top of a hill: the Hessian of its barrier has a negative part as large as the force. Mostly that is
no sign of an instability, but it would have to be met by a shift of the whole matrix. Without it
the matrix is positive definite for longer; where the steps lead is decided by the gradient, which
stays as it is. Stability is asked of the whole Hessian.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.blocks import sym_add, sym_outer
from magwire.kernels.vectors import combine, cross, dot, norm, scale

EASED = 8  # iterations of Newton's method; if they do not do, it goes on with the whole Hessian


@kernel
def times(h, v):
    """Product of a symmetric matrix xx xy xz yy yz zz and a vector."""
    return (
        h[0] * v[0] + h[1] * v[1] + h[2] * v[2],
        h[1] * v[0] + h[3] * v[1] + h[4] * v[2],
        h[2] * v[0] + h[4] * v[1] + h[5] * v[2],
    )


@kernel
def without_bulges(n, h):
    """A gap's Hessian h without the positive ones of its two curvatures across its gradient n."""
    size = norm(n)
    if size == 0.0:
        return h
    m = scale(1.0 / size, n)
    e = (0.0, m[2], -m[1]) if abs(m[0]) < 0.6 else (-m[2], 0.0, m[0])
    e = scale(1.0 / norm(e), e)
    f = cross(m, e)
    along, other = times(h, e), times(h, f)
    mean, half = 0.5 * (dot(e, along) + dot(f, other)), 0.5 * (dot(e, along) - dot(f, other))
    mixed = dot(f, along)
    apart = sqrt(half * half + mixed * mixed)
    u, v = (half + apart, mixed) if half > 0.0 else (mixed, apart - half)
    size = sqrt(u * u + v * v)
    u, v = (u / size, v / size) if size > 0.0 else (1.0, 0.0)
    h = sym_add(h, sym_outer(-max(mean + apart, 0.0), combine(u, e, v, f)))
    return sym_add(h, sym_outer(-max(mean - apart, 0.0), combine(-v, e, u, f)))


@kernel
def eased(sheets, n, h, now):
    """The Hessian of a gap that a Newton step uses, ``now``: whether it is to be an easier one."""
    if len(sheets) == 0:
        return h
    else:
        return without_bulges(n, h) if now[0] > 0.0 else h
