"""The circular loop of thin wire.

B = mu0 I/(4 pi) times the ring's integral of dl x r/r^3. With J(n, p) of ring.py and
c = mu0 I a^2/(2 pi):
B_z = c (J10 - 3 rho^2 J21), B_rho = c rho 3 z J21; the derivatives follow by the rule there.
On the axis B_z = mu0 I a^2 / (2 (a^2 + z^2)^(3/2)). Compare Simpson and others,
NASA/TM-2013-217919.
"""

from __future__ import annotations

from math import sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.sources.harmonic import axial
from magwire.kernels.sources.ring import loop_elliptic, loop_sums, nodes_for
from magwire.kernels.vectors import combine, dot


@kernel
def loop(r, t, radius, factor):
    """Field of a loop, ``r`` from its centre; ``factor`` is mu0 I / (2 pi)."""
    z = dot(r, t)
    q = combine(1.0, r, -z, t)
    rho2 = dot(q, q)
    rho = sqrt(rho2)
    z2, a2 = z * z, radius * radius
    d2 = (radius - rho) * (radius - rho) + z2
    b2 = 4.0 * radius * rho
    start, n = nodes_for(d2, b2)
    if n > 0:
        j10, j21, j31, j41, j42, j52, j63 = loop_sums(d2, b2, start, n)
    else:
        j10, j21, j31, j41, j42, j52, j63 = loop_elliptic(d2, b2)
    c = factor * a2
    bend = 15.0 * (7.0 / 3.0 * a2 * j42 - j31)
    along = (
        c * (j10 - 3.0 * rho2 * j21),
        c * (3.0 * j21 - 15.0 * z2 * j31),
        c * (bend + z2 * 105.0 * (j41 - 3.0 * a2 * j52)),
    )
    radial = (
        c * 3.0 * z * j21,
        c * z * bend,
        c * z * (105.0 * j41 - 630.0 * a2 * j52 + 693.0 * a2 * a2 * j63),
    )
    return axial(t, z, q, along, radial)
