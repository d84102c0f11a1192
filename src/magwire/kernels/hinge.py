"""The hinge between two edges: tangents, curvature binormal, frames (P-2, P-3).

An edge e into a node and the edge f out of it meet at an angle; everything that bending and
twisting need of that geometry is computed here once.
"""

from __future__ import annotations

from math import atan2, cos, pi, sin, sqrt
from typing import NamedTuple

from magwire.kernels._jit import kernel
from magwire.kernels.vectors import add, cross, dot, scale, sub


class Hinge(NamedTuple):
    """Two adjacent edges with unit tangents te, tf and inverse lengths.

    ``chi`` = 1 + te.tf vanishes at a fold, where the curvature diverges (P-3); ``binormal`` is
    2 te x tf / chi, of length 2 tan(phi/2); ``tilde`` is (te + tf) / chi.
    """

    te: tuple[float, float, float]
    tf: tuple[float, float, float]
    inv_e: float
    inv_f: float
    inv_chi: float
    binormal: tuple[float, float, float]
    tilde: tuple[float, float, float]


@kernel
def hinge(te, tf, length_e, length_f):
    """Geometry of the hinge between two edges of given unit tangents and lengths."""
    inv_chi = 1.0 / (1.0 + dot(te, tf))
    binormal = scale(2.0 * inv_chi, cross(te, tf))
    tilde = scale(inv_chi, add(te, tf))
    return Hinge(te, tf, 1.0 / length_e, 1.0 / length_f, inv_chi, binormal, tilde)


@kernel
def transport(v, a, b):
    """Parallel transport of v from unit tangent a to unit tangent b, kept orthonormal to b.

    The rotation about a x b that takes a to b; v is orthogonal to a.
    """
    axis = cross(a, b)
    moved = add(scale(dot(a, b), v), cross(axis, v))
    moved = add(moved, scale(dot(axis, v) / (1.0 + dot(a, b)), axis))
    moved = sub(moved, scale(dot(moved, b), b))
    return scale(1.0 / sqrt(dot(moved, moved)), moved)


@kernel
def material_frame(d1, t, theta):
    """Material directors m1, m2: the reference frame d1, t x d1 turned by theta (P-2)."""
    d2 = cross(t, d1)
    if theta == 0.0:
        return d1, d2
    c = cos(theta)
    s = sin(theta)
    return add(scale(c, d1), scale(s, d2)), sub(scale(c, d2), scale(s, d1))


@kernel
def angle_between(sine, cosine):
    """Angle of a sine and a cosine."""
    return atan2(sine, cosine)


@kernel
def reference_twist(d1_e, te, d1_f, tf, before):
    """Angle from the space-parallel transport of d1_e to d1_f, on the branch next to ``before``."""
    carried = transport(d1_e, te, tf)
    angle = atan2(dot(cross(carried, d1_f), tf), dot(carried, d1_f))
    turn = angle - before
    while turn > pi:
        turn -= 2.0 * pi
    while turn < -pi:
        turn += 2.0 * pi
    return before + turn
