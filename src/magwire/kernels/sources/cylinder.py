"""The cylinder magnetised along its axis: a sheet of current Br/mu0 around it.

Loops stacked over its length; with J(n, p) of ring.py the integral along the axis is closed, at
each end face. Only B_z is of the third kind: the integral of z (a^2 - a rho cos phi)/(e^2 sqrt(D)),
e^2 = D - z^2, is z J00/2 + sign(z)/2 (pi sign(a - rho) - (a^2 - rho^2) T), with
T the integral of 1/(D + |z| sqrt(D)), which stays regular where e = 0. Near an edge it is taken
from the closed form of Derby and Olbert, Am. J. Phys. 78, 229 (2010). Derivatives are exact.
"""

from __future__ import annotations

from math import pi, sqrt

from magwire.kernels._jit import kernel
from magwire.kernels.sources.elliptic import cel
from magwire.kernels.sources.harmonic import axial
from magwire.kernels.sources.ring import cylinder_elliptic, cylinder_sums, nodes_for
from magwire.kernels.vectors import combine, dot


@kernel
def cylinder(r, t, radius, half, remanence):
    """Field of a cylinder, ``r`` from its centre; inside it is the flux density as well."""
    z = dot(r, t)
    q = combine(1.0, r, -z, t)
    rho = sqrt(dot(q, q))
    a = face(rho, z + half, radius)
    b = face(rho, z - half, radius)
    c = remanence / (2.0 * pi)
    return axial(
        t,
        z,
        q,
        (c * (a[0] - b[0]), c * (a[1] - b[1]), c * (a[2] - b[2])),
        (c * (a[3] - b[3]), c * (a[4] - b[4]), c * (a[5] - b[5])),
    )


@kernel
def face(rho, z, radius):
    """What one end gives, ``z`` behind it: B_z, P_z, D P_z, P, D P, D D P for Br = 2 pi."""
    a2 = radius * radius
    d2 = (radius - rho) * (radius - rho) + z * z
    b2 = 4.0 * radius * rho
    start, n = nodes_for(d2, b2)
    if n > 0:
        j00, j11, j21, j31, j32, j42, j53, third = cylinder_sums(d2, b2, abs(z), start, n)
        b_z = 0.5 * z * j00 + _turn(rho, z, radius, third)
    else:
        j00, j11, j21, j31, j32, j42, j53 = cylinder_elliptic(d2, b2)
        b_z = 0.5 * z * j00
        if rho != radius:
            gamma = (radius - rho) / (radius + rho)
            far = sqrt(d2 + b2)
            b_z = 2.0 * radius * z / ((radius + rho) * far)
            b_z *= cel(sqrt(d2) / far, gamma * gamma, 1.0, gamma)
    return (
        b_z,
        a2 * 3.0 * z * j21,
        a2 * 15.0 * z * (7.0 / 3.0 * a2 * j42 - j31),
        -a2 * j11,
        a2 * (3.0 * j21 - 5.0 * a2 * j32),
        a2 * (a2 * (70.0 * j42 - 63.0 * a2 * j53) - 15.0 * j31),
    )


@kernel
def _turn(rho, z, radius, third):
    """Half of sign(z) (pi sign(a - rho) - (a^2 - rho^2) T)."""
    if z == 0.0:
        return 0.0
    whole = pi if rho < radius else (-pi if rho > radius else 0.0)
    turn = 0.5 * (whole - (radius - rho) * (radius + rho) * third)
    return turn if z > 0.0 else -turn
